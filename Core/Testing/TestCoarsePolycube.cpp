// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Search/CellShape.h"
#include "Search/CoarsePolycube.h"
#include "Search/FindDomain.h"
#include "Search/NormalAxes.h"
#include "Search/PolycubeFit.h"
#include "Search/SolidGrid.h"
#include "SegmentSurfaces.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace
{
using namespace trivariate;
using namespace trivariate_testing;
using Eigen::Matrix3d;

struct Solid
{
  std::string Name;
  Polycube Cubes;
};

std::vector<Solid> Solids()
{
  return {
    { "L", Polycube::FromGrid({ 2, 2, 1 }, { 1, 1, 1, 0 }) },
    { "T", Polycube::FromGrid({ 3, 2, 1 }, { 1, 1, 1, 0, 1, 0 }) },
    { "U", Polycube::FromGrid({ 3, 2, 1 }, { 1, 1, 1, 1, 0, 1 }) },
    { "plus", Polycube::FromGrid({ 3, 3, 1 }, { 0, 1, 0, 1, 1, 1, 0, 1, 0 }) },
    { "three legs", Polycube({ { 0, 0, 1 }, { 1, 0, 1 }, { 2, 0, 1 }, { 1, 1, 1 }, { 1, 2, 1 },
                      { 0, 0, 0 }, { 2, 0, 0 }, { 1, 2, 0 } }) },
  };
}

Matrix3d TurnBy(double degrees)
{
  return Eigen::AngleAxisd(degrees * std::acos(-1.0) / 180.0, Vector3d(1.0, 2.0, -1.0).normalized())
    .toRotationMatrix();
}

SurfaceMesh TurnedBy(const SurfaceMesh& mesh, const Matrix3d& turn)
{
  return Moved(mesh, [&turn](const Vector3d& p) { return Vector3d(turn * p); });
}

TEST(SolidGrid, MeasuresVolumes)
{
  const SolidGrid ball(Icosphere(5), TurnBy(20.0), 60);
  const double share = ball.Inside({ 0, 0, 0 }, ball.Size()) / (60.0 * 60.0 * 60.0);
  EXPECT_NEAR(share, std::acos(-1.0) / 6.0, 0.004);
  // No line through a ball leaves and enters it again.
  EXPECT_NEAR(
    ball.Outside({ 0, 0, 0 }, ball.Size()) / (60.0 * 60.0 * 60.0), 0.5 * (1.0 - share), 0.002);

  // The notch of a U is a cleft, that of an L is none. Volumes in unit cubes; the grid's box is
  // larger than the solid's by less than a cell on each side.
  const SolidGrid u(SurfaceOf(Solids()[2].Cubes, 4), Matrix3d::Identity(), 90);
  const SolidGrid l(SurfaceOf(Solids()[0].Cubes, 4), Matrix3d::Identity(), 60);
  const double cell = 1.0 / (30.0 * 30.0 * 30.0);
  EXPECT_NEAR(u.Inside({ 0, 0, 0 }, u.Size()) * cell, 5.0, 0.01);
  EXPECT_NEAR(l.Inside({ 0, 0, 0 }, l.Size()) * cell, 3.0, 0.01);
  EXPECT_NEAR(u.Outside({ 31, 31, 1 }, { 59, 59, 29 }), 3.0 * 28 * 28 * 28, 1e-9);
  EXPECT_NEAR(l.Outside({ 31, 31, 1 }, { 59, 59, 29 }), 0.5 * 28 * 28 * 28, 1e-9);
}

// Whatever cells are worth, the full ones are a ball that the constructor of Polycube accepts.
TEST(CellShape, StaysABall)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> gain(-1.0, 1.0);
  for (int trial = 0; trial < 100; ++trial)
  {
    std::vector<double> gains(4 * 3 * 3);
    std::generate(gains.begin(), gains.end(), [&]() { return gain(random); });
    const Polycube cubes(CellShape({ 4, 3, 3 }, gains).Best());
    EXPECT_EQ(cubes.EulerCharacteristic(), 2) << trial;
    double sum = 0.0;
    for (const LatticePoint& cube : cubes.Cubes)
    {
      sum += gains[cube[0] + 4 * (cube[1] + 3 * cube[2])];
    }
    EXPECT_GE(sum, *std::max_element(gains.begin(), gains.end())) << trial;
  }
}

TEST(CellShape, CutsARingWhereThatCostsLeast)
{
  // A ring of eight cells around an empty one: the worst of the ring goes, or the middle is filled.
  std::vector<double> gains(9, 1.0);
  gains[4] = -3.0;
  gains[3] = 0.5;
  EXPECT_EQ(CellShape({ 3, 3, 1 }, gains).Best().size(), 7u);
  gains[4] = -0.1;
  EXPECT_EQ(CellShape({ 3, 3, 1 }, gains).Best().size(), 9u);
}

TEST(CoarsePolycube, HoldsTheCubesOfVoxelSolids)
{
  for (const Solid& solid : Solids())
  {
    for (const double degrees : { 0.0, 30.0 })
    {
      const Matrix3d turn = TurnBy(degrees);
      const SurfaceMesh mesh = TurnedBy(RoundedSurfaceOf(solid.Cubes, 10), turn);
      Index corners = 0;
      double misfit = 2.0;
      bool found = false;
      for (const CoarsePolycube& coarse :
        FindCoarsePolycubes(mesh, turn.transpose(), 64, Execution()))
      {
        EXPECT_EQ(coarse.Cubes.EulerCharacteristic(), 2);
        EXPECT_GT(coarse.Cubes.NumberOfCorners, corners);
        EXPECT_LT(coarse.Misfit, misfit);
        corners = coarse.Cubes.NumberOfCorners;
        misfit = coarse.Misfit;
        found |= coarse.Cubes.Cubes.size() == solid.Cubes.Cubes.size() &&
                 coarse.Cubes.Faces.size() == solid.Cubes.Faces.size() && coarse.Misfit < 0.1;
      }
      EXPECT_TRUE(found) << solid.Name << " " << degrees;
    }
  }
}

// A sheet comes to lie where a box's corners are, from 15 degrees and a fifth of its size off.
TEST(PolycubeFit, FindsTheCornersOfABox)
{
  const Polycube cube = Polycube::FromGrid({ 1, 1, 1 });
  const Vector3d size(2.0, 3.0, 5.0);
  const Matrix3d turn = TurnBy(15.0);
  const SurfaceMesh box = Moved(
    SurfaceOf(cube, 12), [&](const Vector3d& p) { return Vector3d(turn * size.cwiseProduct(p)); });
  std::vector<Vector3d> corners, exact;
  for (const LatticePoint& p : cube.Points)
  {
    const Vector3d place(p[0], p[1], p[2]);
    exact.push_back(turn * size.cwiseProduct(place));
    corners.push_back(1.2 * size.cwiseProduct(place) - 0.1 * size);
  }
  const PolycubeFit fit = PolycubeFitter(box, Matrix3d::Identity()).Fit(cube, corners, Execution());
  for (std::size_t i = 0; i < exact.size(); ++i)
  {
    EXPECT_LT((fit.Corners[i] - exact[i]).norm(), 0.3) << i;
  }
  EXPECT_LT(fit.Stretch, 0.02);
  EXPECT_LT(fit.Distance, 0.02);
}

// A crown of two by one with two roots that taper, oblique, around a cleft a fifth as wide. One is
// a little thicker: no exact symmetry leaves it to rounding what the search finds.
SurfaceMesh TwoRooted()
{
  const auto inside = [](int i, int j, int k)
  {
    const double x = (i - 24.0) / 16.0, y = (j - 16.0) / 9.0, z = k / 16.0;
    if (z > 1.75 && z < 3.5)
    {
      return std::pow(x, 4) + std::pow(y, 4) < 1.0 ? 1 : 0;
    }
    const double taper = (x > 0.0 ? 0.27 : 0.25) + 0.2 * z;
    const bool root = std::hypot((std::abs(x) - 0.55 - 0.05 * (1.8 - z)) / taper, y) < 1.0;
    return z > 0.3 && z <= 1.75 && root ? 1 : 0;
  };
  return SurfaceOfSegment(BoundaryOf({ 49, 33, 64 }, inside), 1);
}

TEST(CoarsePolycube, GivesATwoRootedToothAU)
{
  const SurfaceMesh tooth = TwoRooted();
  ASSERT_EQ(tooth.EulerCharacteristic(), 2);
  for (int seed = 0; seed < 3; ++seed)
  {
    const SegmentDomain domain = FindDomain(
      seed == 0 ? tooth : Turned(Shuffled(tooth, seed), seed), DomainOptions(), Execution());
    EXPECT_EQ(domain.Cubes.Cubes.size(), 5u) << seed;
    EXPECT_EQ(domain.Cubes.NumberOfCorners, 24) << seed;
    EXPECT_EQ(domain.Cubes.Faces.size(), 22u) << seed;
  }
}
}
