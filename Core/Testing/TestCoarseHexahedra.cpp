// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Parameter/CoarseHexahedra.h"
#include "SegmentSurfaces.h"

#include <gtest/gtest.h>

namespace
{
using namespace trivariate;
using Eigen::Vector3d;
using trivariate_testing::Icosphere;
using trivariate_testing::Moved;
using trivariate_testing::SurfaceOf;

double QualityOf(
  const SurfaceMesh& mesh, const Polycube& cubes, const std::vector<Vector3d>& corners)
{
  return CoarseHexahedra(DomainFromCorners(mesh, cubes, corners, Execution()), Execution());
}

// The corners of a box from 0 to `high`, in order of w, then v, then u.
std::vector<Vector3d> BoxCorners(const Vector3d& high)
{
  std::vector<Vector3d> corners;
  for (int i = 0; i < 8; ++i)
  {
    corners.push_back(high.cwiseProduct(Vector3d(i & 1, i >> 1 & 1, i >> 2)));
  }
  return corners;
}

// Layers meet at the edges of a box at 45 degrees.
TEST(CoarseHexahedra, OfABoxAreGood)
{
  const SurfaceMesh box = SurfaceOf(Polycube::FromGrid({ 1, 2, 3 }), 8);
  const double quality =
    QualityOf(box, Polycube::FromGrid({ 1, 1, 1 }), BoxCorners({ 1.0, 2.0, 3.0 }));
  EXPECT_GT(quality, 0.87);
  EXPECT_LT(quality, 0.93);
}

TEST(CoarseHexahedra, OfABallAreGood)
{
  std::vector<Vector3d> corners = BoxCorners({ 2.0, 2.0, 2.0 });
  for (Vector3d& c : corners)
  {
    c = (c - Vector3d::Ones()).normalized();
  }
  const double quality = QualityOf(Icosphere(4), Polycube::FromGrid({ 1, 1, 1 }), corners);
  EXPECT_GT(quality, 0.9);
  EXPECT_LT(quality, 0.96);
}

// Between two boxes; with the corners of the outer one a quarter turn farther, worse: nodes slide,
// but not across sharp edges.
TEST(CoarseHexahedra, OfAShellAreGoodWhereItIsNotTwisted)
{
  const Polycube cube = Polycube::FromGrid({ 1, 1, 1 });
  const SurfaceMesh large = SurfaceOf(cube, 12);
  const SurfaceMesh small =
    Moved(large, [](const Vector3d& p) { return Vector3d(0.25 * Vector3d::Ones() + 0.5 * p); });
  const std::vector<Vector3d> corners = BoxCorners({ 1.0, 1.0, 1.0 });
  std::vector<Vector3d> inside, turned;
  for (const Vector3d& c : corners)
  {
    inside.push_back(0.25 * Vector3d::Ones() + 0.5 * c);
    turned.push_back({ 1.0 - c.y(), c.x(), c.z() });
  }
  const SegmentDomain inner = DomainFromCorners(small, cube, inside, Execution());
  const auto quality = [&](const std::vector<Vector3d>& at)
  { return CoarseHexahedra(DomainFromCorners(large, cube, at, Execution()), inner, Execution()); };
  EXPECT_GT(quality(corners), 0.7);
  EXPECT_LT(quality(turned), quality(corners) - 0.2);
}

// A plate that stands on a block: the cells of one cube that ends at its foot have good angles and
// the right volume (0.87 against 0.86), but leave the plate.
TEST(CoarseHexahedra, CountWhatTheyLeaveUncovered)
{
  std::vector<unsigned char> present;
  for (int k = 0; k < 10; ++k)
  {
    for (int ij = 0; ij < 25; ++ij)
    {
      present.push_back(k < 5 || ij % 5 == 2);
    }
  }
  const SurfaceMesh mesh = SurfaceOf(Polycube::FromGrid({ 5, 5, 10 }, present), 2);
  const Polycube tee = Polycube::FromGrid({ 3, 1, 2 }, { 1, 1, 1, 0, 1, 0 });
  const double across[4] = { 0.0, 2.0, 3.0, 5.0 };
  std::vector<Vector3d> corners;
  for (Index p = 0; p < tee.NumberOfCorners; ++p)
  {
    const LatticePoint& at = tee.Points[p];
    corners.push_back({ across[at[0]], 5.0 * at[1], 5.0 * at[2] });
  }
  EXPECT_GT(QualityOf(mesh, tee, corners),
    QualityOf(mesh, Polycube::FromGrid({ 1, 1, 1 }), BoxCorners({ 5.0, 5.0, 5.0 })) + 0.02);
}
}
