// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Domain/LayoutCheck.h"
#include "Domain/LayoutRelaxation.h"
#include "Domain/RelaxedLayout.h"
#include "Search/ChainLayout.h"
#include "Search/FindDomain.h"
#include "SegmentSurfaces.h"
#include "ThreadedExecution.h"

#include <gtest/gtest.h>

#include <Eigen/SVD>

#include <algorithm>
#include <cmath>

namespace
{
using namespace trivariate;
using Eigen::Vector2d;
using Eigen::Vector3d;
using trivariate_testing::Icosphere;
using trivariate_testing::Moved;
using trivariate_testing::Shuffled;
using trivariate_testing::SurfaceOf;
using trivariate_testing::Turned;

std::vector<Vector3d> CornersOf(const Polycube& cubes, const Vector3d& scale = Vector3d::Ones())
{
  std::vector<Vector3d> corners;
  for (Index i = 0; i < cubes.NumberOfCorners; ++i)
  {
    const LatticePoint& p = cubes.Points[i];
    corners.push_back(scale.cwiseProduct(Vector3d(p[0], p[1], p[2])));
  }
  return corners;
}

SurfaceLayout Relaxed(SurfaceLayout layout, const Polycube& cubes, bool fixed = false)
{
  EXPECT_TRUE(Relax(layout, cubes, fixed, Execution()));
  return layout;
}

// Singular values, the larger first, of the map of each triangle to its face, whose sides have
// these lengths.
std::vector<Vector2d> Stretches(
  const SurfaceLayout& layout, const Polycube& cubes, const Vector3d& lengths)
{
  std::vector<Vector2d> stretches;
  for (std::size_t t = 0; t < layout.Triangles.size(); ++t)
  {
    const Triangle& c = layout.Triangles[t];
    const Polycube::Face& face = cubes.Faces[layout.Patches[t]];
    const int x = (face.Axis + (face.Side ? 1 : 2)) % 3, y = 3 - face.Axis - x;
    const Vector3d a = layout.Points[c[1]] - layout.Points[c[0]];
    const Vector3d b = layout.Points[c[2]] - layout.Points[c[0]];
    Eigen::Matrix2d flat, mapped;
    flat << a.norm(), a.dot(b) / a.norm(), 0.0, a.cross(b).norm() / a.norm();
    for (int k = 0; k < 2; ++k)
    {
      const Vector3d way =
        lengths.cwiseProduct(layout.Parameters[c[k + 1]] - layout.Parameters[c[0]]);
      mapped.col(k) = Vector2d(way[x], way[y]);
    }
    EXPECT_GT(mapped.determinant(), 0.0) << "triangle " << t;
    stretches.push_back((mapped * flat.inverse()).jacobiSvd().singularValues());
  }
  return stretches;
}

// Parameters are those of the lattice at corners, on the edges along borders, on faces elsewhere.
void ExpectOnPolycube(const SurfaceLayout& layout, const Polycube& cubes)
{
  EXPECT_EQ(CheckLayout(layout, cubes), std::vector<std::string>());
  ASSERT_EQ(layout.Parameters.size(), layout.Points.size());
  ASSERT_EQ(layout.Origins.size(), layout.Triangles.size());
  const auto lattice = [&cubes](Index corner)
  {
    const LatticePoint& p = cubes.Points[corner];
    return Vector3d(p[0], p[1], p[2]);
  };
  for (std::size_t c = 0; c < layout.Corners.size(); ++c)
  {
    EXPECT_EQ(layout.Parameters[layout.Corners[c]], lattice(static_cast<Index>(c)));
  }
  for (std::size_t e = 0; e < layout.Borders.size(); ++e)
  {
    const Vector3d from = lattice(cubes.Edges[e].From), along = lattice(cubes.Edges[e].To) - from;
    double before = -1.0;
    for (const Index p : layout.Borders[e].Points)
    {
      const double share = along.dot(layout.Parameters[p] - from);
      EXPECT_GT(share, before);
      EXPECT_LT((layout.Parameters[p] - from - share * along).norm(), 1e-12);
      before = share;
    }
  }
  for (std::size_t t = 0; t < layout.Triangles.size(); ++t)
  {
    const Polycube::Face& face = cubes.Faces[layout.Patches[t]];
    for (const Index p : layout.Triangles[t])
    {
      const Vector3d from = layout.Parameters[p] - lattice(face.Corners[0]);
      EXPECT_EQ(from[face.Axis], 0.0);
      for (int axis = 0; axis < 3; ++axis)
      {
        EXPECT_GE(from[axis], -1e-9);
        EXPECT_LE(from[axis], 1.0 + 1e-9);
      }
    }
  }
}

TEST(RelaxedLayout, LeavesABoxAsItIs)
{
  const Polycube cube = Polycube::FromGrid({ 1, 1, 1 });
  const Vector3d sides(1.0, 1.3, 2.0);
  const SurfaceMesh box =
    Moved(SurfaceOf(cube, 8), [&](const Vector3d& p) { return Vector3d(sides.cwiseProduct(p)); });
  const SurfaceLayout layout =
    Relaxed(LayoutFromCorners(box, cube, CornersOf(cube, sides), Execution()), cube);
  ExpectOnPolycube(layout, cube);
  for (std::size_t p = 0; p < layout.Points.size(); ++p)
  {
    EXPECT_LT((sides.cwiseProduct(layout.Parameters[p]) - layout.Points[p]).norm(), 1e-9);
  }
}

// Borders that make a detour over the faces beside the edges of a box.
TEST(RelaxedLayout, BringsBordersBackToTheEdges)
{
  const Polycube cube = Polycube::FromGrid({ 1, 1, 1 });
  constexpr int n = 12;
  const SurfaceMesh box = SurfaceOf(cube, n);
  const auto pointAt = [&box](const Vector3d& place)
  {
    Index best = 0;
    for (Index p = 1; p < box.NumberOfPoints(); ++p)
    {
      best = (box.Points[p] - place).norm() < (box.Points[best] - place).norm() ? p : best;
    }
    return best;
  };
  std::vector<GivenBorder> detours;
  for (const Index edge : { 0, 5 })
  {
    const std::vector<Vector3d> corners = CornersOf(cube);
    const Polycube::Edge& e = cube.Edges[edge];
    const Vector3d from = corners[e.From], along = corners[e.To] - from;
    const std::array<Index, 4>& face = cube.Faces[e.Left].Corners;
    const Vector3d middle = 0.5 * (corners[face[0]] + corners[face[2]]);
    Vector3d inwards = middle - from;
    inwards = 2.0 * (inwards - inwards.dot(along) * along);
    GivenBorder detour{ edge, {} };
    const auto add = [&](int i, int j)
    { detour.Points.push_back(pointAt(from + double(i) / n * along + double(j) / n * inwards)); };
    for (int i = 0; i <= 3; ++i)
      add(i, 0);
    for (int j = 1; j <= 4; ++j)
      add(3, j);
    for (int i = 4; i <= 8; ++i)
      add(i, 4);
    for (int j = 3; j >= 0; --j)
      add(8, j);
    for (int i = 9; i <= n; ++i)
      add(i, 0);
    detours.push_back(detour);
  }
  const SurfaceLayout start =
    LayoutFromCorners(box, cube, CornersOf(cube), Execution(), 1e-9, detours);
  LayoutUnfolding unfolding(start, cube, false);
  const RelaxationReport report = RelaxUnfolding(unfolding, {}, Execution());
  EXPECT_GT(report.Before, 1.01);
  EXPECT_LT(report.After, 1.0 + 1e-5);
  const SurfaceLayout layout = Relaxed(start, cube);
  ExpectOnPolycube(layout, cube);
  for (std::size_t p = 0; p < layout.Points.size(); ++p)
  {
    EXPECT_LT((layout.Parameters[p] - layout.Points[p]).norm(), 0.02);
  }
}

// Four sides around a cylinder unroll without stretch, but for what the ends do to them.
TEST(RelaxedLayout, UnrollsACylinder)
{
  const Polycube cube = Polycube::FromGrid({ 1, 1, 1 });
  const double height = 12.0;
  const SurfaceMesh cylinder = Moved(SurfaceOf(cube, 16),
    [&](const Vector3d& p)
    {
      const double x = 2.0 * p.x() - 1.0, y = 2.0 * p.y() - 1.0;
      const double scale = std::max(std::abs(x), std::abs(y)) / std::max(std::hypot(x, y), 1e-300);
      return Vector3d(scale * x, scale * y, height * p.z());
    });
  std::vector<Vector3d> corners;
  for (const Vector3d& p : CornersOf(cube))
  {
    corners.emplace_back(
      std::sqrt(2.0) * (p.x() - 0.5), std::sqrt(2.0) * (p.y() - 0.5), height * p.z());
  }
  const SurfaceLayout layout =
    Relaxed(LayoutFromCorners(cylinder, cube, corners, Execution()), cube);
  ExpectOnPolycube(layout, cube);
  const double quarter = 0.5 * std::acos(-1.0);
  const std::vector<Vector2d> stretches =
    Stretches(layout, cube, Vector3d(quarter, quarter, height));
  for (std::size_t t = 0; t < stretches.size(); ++t)
  {
    const Triangle& c = layout.Triangles[t];
    const double z =
      (layout.Points[c[0]].z() + layout.Points[c[1]].z() + layout.Points[c[2]].z()) / 3.0;
    if (z > 2.0 && z < height - 2.0)
    {
      EXPECT_LT(stretches[t][0], 1.05) << z;
      EXPECT_GT(stretches[t][1], 0.95) << z;
    }
  }
  // The rims are edges of the surface and stay borders.
  for (std::size_t e = 0; e < layout.Borders.size(); ++e)
  {
    for (const Index p : layout.Borders[e].Points)
    {
      if (cube.Edges[e].Axis != 2)
      {
        EXPECT_LT(std::min(layout.Points[p].z(), height - layout.Points[p].z()), 1e-6);
      }
    }
  }
}

TEST(RelaxedLayout, StretchesABallEvenly)
{
  const Polycube cube = Polycube::FromGrid({ 1, 1, 1 });
  const SurfaceMesh ball = Icosphere(4);
  std::vector<Vector3d> corners = CornersOf(cube);
  for (Vector3d& p : corners)
  {
    p = (p - Vector3d::Constant(0.5)).normalized();
  }
  const SurfaceLayout layout = Relaxed(LayoutFromCorners(ball, cube, corners, Execution()), cube);
  ExpectOnPolycube(layout, cube);
  const SurfaceMesh mesh(layout.Points, layout.Triangles);
  std::vector<double> areas(6, 0.0);
  for (Index t = 0; t < mesh.NumberOfTriangles(); ++t)
  {
    areas[layout.Patches[t]] += mesh.AreaVector(t).norm();
  }
  const auto [least, most] = std::minmax_element(areas.begin(), areas.end());
  EXPECT_LT(*most / *least, 1.005);
  const double side = std::sqrt(4.0 * std::acos(-1.0) / 6.0);
  double energy = 0.0, area = 0.0;
  const std::vector<Vector2d> stretches = Stretches(layout, cube, Vector3d::Constant(side));
  for (Index t = 0; t < mesh.NumberOfTriangles(); ++t)
  {
    const double here = mesh.AreaVector(t).norm();
    const Vector2d s = stretches[t];
    energy += 0.25 * here * (s.squaredNorm() + s.cwiseInverse().squaredNorm());
    area += here;
  }
  EXPECT_LT(energy / area, 1.03);
}

// The inner corners of a chain are no corners of its surface: they come to lie at one height.
TEST(RelaxedLayout, MovesFlatCornersToTheirLines)
{
  const Polycube chain = Chain(2, 3);
  const SurfaceMesh bar = Moved(SurfaceOf(chain, 6),
    [](const Vector3d& p)
    {
      const double x = 2.0 * p.x() - 1.0, y = 2.0 * p.y() - 1.0;
      const double scale = std::max(std::abs(x), std::abs(y)) / std::max(std::hypot(x, y), 1e-300);
      return Vector3d(scale * x, scale * y, 2.0 * p.z());
    });
  std::vector<Vector3d> corners;
  for (const Vector3d& p : CornersOf(chain))
  {
    const double off = p.z() == 1.0 || p.z() == 2.0 ? 0.5 * (p.x() - p.y()) : 0.0;
    corners.emplace_back(
      std::sqrt(2.0) * (p.x() - 0.5), std::sqrt(2.0) * (p.y() - 0.5), 2.0 * p.z() + off);
  }
  const SurfaceLayout start = LayoutFromCorners(bar, chain, corners, Execution());
  const SurfaceLayout layout = Relaxed(start, chain);
  ExpectOnPolycube(layout, chain);
  const SurfaceLayout fixed = Relaxed(start, chain, true);
  ExpectOnPolycube(fixed, chain);
  for (int height = 0; height <= 3; ++height)
  {
    double low = 1e300, high = -1e300;
    for (Index c = 0; c < chain.NumberOfCorners; ++c)
    {
      if (chain.Points[c][2] == height)
      {
        low = std::min(low, layout.Points[layout.Corners[c]].z());
        high = std::max(high, layout.Points[layout.Corners[c]].z());
      }
      EXPECT_EQ(fixed.Points[fixed.Corners[c]], start.Points[start.Corners[c]]);
    }
    EXPECT_LT(high - low, 0.05) << height;
  }
}

SurfaceMesh Blob()
{
  return Moved(Icosphere(4),
    [](const Vector3d& p)
    {
      const double bumps = 1.0 + 0.25 * std::sin(3.0 * p.x() + 1.0) * std::cos(2.0 * p.y()) +
                           0.15 * std::sin(4.0 * p.z() + 2.0 * p.y());
      return Vector3d(bumps * p.x(), 1.3 * bumps * p.y(), 2.4 * bumps * p.z());
    });
}

SurfaceLayout BlobLayout(
  const SurfaceMesh& blob, const Polycube& cube, const Eigen::Affine3d& motion)
{
  std::vector<Vector3d> corners;
  for (const Vector3d& p : CornersOf(cube))
  {
    const Vector3d d = (p - Vector3d::Constant(0.5)).normalized();
    corners.push_back(motion * Vector3d(d.x(), 1.3 * d.y(), 2.4 * d.z()));
  }
  return LayoutFromCorners(blob, cube, corners, Execution());
}

TEST(RelaxedLayout, FollowsARigidMotion)
{
  const Polycube cube = Polycube::FromGrid({ 1, 1, 1 });
  Eigen::Affine3d motion = Eigen::Affine3d::Identity();
  const SurfaceMesh blob = Blob();
  LayoutUnfolding still(BlobLayout(blob, cube, motion), cube, false);
  const double energy = RelaxUnfolding(still, {}, Execution()).After;
  motion.rotate(Eigen::AngleAxisd(0.7, Vector3d(1.0, 2.0, -1.0).normalized()));
  motion.pretranslate(Vector3d(3.0, -2.0, 5.0));
  const SurfaceMesh moved =
    Moved(Shuffled(blob, 3), [&](const Vector3d& p) { return Vector3d(motion * p); });
  LayoutUnfolding other(BlobLayout(moved, cube, motion), cube, false);
  EXPECT_NEAR(RelaxUnfolding(other, {}, Execution()).After, energy, 1e-2 * (energy - 1.0));
  for (Index line = 0; line < still.Charts.NumberOfLines(); ++line)
  {
    EXPECT_NEAR(other.LineValue(line), still.LineValue(line), 0.02);
  }
}

TEST(RelaxedLayout, LowersTheEnergyAndFoldsNothing)
{
  const Polycube cube = Polycube::FromGrid({ 1, 1, 1 });
  const SurfaceLayout start = BlobLayout(Blob(), cube, Eigen::Affine3d::Identity());
  LayoutUnfolding unfolding(start, cube, false);
  const RelaxationReport report = RelaxUnfolding(unfolding, {}, Execution());
  EXPECT_LT(report.After, report.Before);
  for (const LayoutUnfolding::ChartTriangle& triangle : unfolding.Triangles)
  {
    Eigen::Matrix2d edges;
    edges << unfolding.Place(triangle, 1) - unfolding.Place(triangle, 0),
      unfolding.Place(triangle, 2) - unfolding.Place(triangle, 0);
    EXPECT_GT(edges.determinant(), 0.0);
  }
  ExpectOnPolycube(Relaxed(start, cube), cube);
}

TEST(RelaxedLayout, IsTheSameOnTwoThreads)
{
  const Polycube cube = Polycube::FromGrid({ 1, 1, 1 });
  SurfaceLayout one = BlobLayout(Blob(), cube, Eigen::Affine3d::Identity()), two = one;
  ASSERT_TRUE(Relax(one, cube, false, Execution()));
  ASSERT_TRUE(Relax(two, cube, false, ThreadedExecution(2)));
  EXPECT_EQ(one.Parameters, two.Parameters);
  EXPECT_EQ(one.Points, two.Points);
}

TEST(RelaxedLayout, StopsWhenTold)
{
  const Polycube cube = Polycube::FromGrid({ 1, 1, 1 });
  SurfaceLayout layout = BlobLayout(Blob(), cube, Eigen::Affine3d::Identity());
  Execution stopping;
  int calls = 0;
  stopping.Continue = [&calls](double) { return ++calls < 3; };
  EXPECT_THROW(Relax(layout, cube, false, stopping), Aborted);
  EXPECT_EQ(calls, 3);
  EXPECT_TRUE(layout.Parameters.empty());
}

TEST(RelaxedLayout, WorksAroundAHandle)
{
  const Polycube ring = Polycube::FromGrid({ 3, 3, 1 }, { 1, 1, 1, 1, 0, 1, 1, 1, 1 });
  const SurfaceMesh mesh = SurfaceOf(ring, 5);
  const SurfaceLayout layout =
    Relaxed(LayoutFromCorners(mesh, ring, CornersOf(ring), Execution()), ring);
  ExpectOnPolycube(layout, ring);
  for (std::size_t p = 0; p < layout.Points.size(); ++p)
  {
    EXPECT_LT((layout.Parameters[p] - layout.Points[p]).norm(), 1e-9);
  }
}

TEST(RelaxedLayout, IsThatOfADomainIfWanted)
{
  DomainOptions options;
  const SurfaceMesh blob = Blob();
  EXPECT_TRUE(FindDomain(blob, options, Execution()).Layout.Parameters.empty());
  options.Relax = true;
  const SegmentDomain domain = FindDomain(blob, options, Execution());
  ExpectOnPolycube(domain.Layout, domain.Cubes);
  EXPECT_GT(domain.Alignment, 0.7);
}
}
