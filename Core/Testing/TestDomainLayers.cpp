// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Domain/InnerCorners.h"
#include "Domain/InnerPath.h"
#include "Domain/LayoutCheck.h"
#include "Domain/TriangleTree.h"
#include "LayoutSurfaces.h"
#include "Parameter/CoarseHexahedra.h"
#include "Search/DomainShell.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

using namespace trivariate;
using namespace trivariate_testing;

namespace
{
std::vector<Point> CornersOf(const Polycube& cubes, double scale)
{
  std::vector<Point> corners;
  for (Index i = 0; i < cubes.NumberOfCorners; ++i)
  {
    const LatticePoint& p = cubes.Points[i];
    corners.push_back(scale * Point(p[0], p[1], p[2]));
  }
  return corners;
}

// The polycube itself, its cubes `size` wide and their faces cut into n x n.
SegmentDomain Voxels(const Polycube& cubes, double size, int n)
{
  const SurfaceMesh mesh =
    Moved(SurfaceOf(cubes, n), [size](const Point& p) { return Point(size * p); });
  return DomainFromCorners(mesh, cubes, CornersOf(cubes, size), Execution());
}

SurfaceMesh Ball(double radius, const Point& centre = Point::Zero())
{
  return Moved(Icosphere(4), [&](const Point& p) { return Point(radius * p + centre); });
}

double Least(const DomainBlocks& blocks)
{
  double least = 1.0;
  for (const DomainBlock& block : blocks.Blocks)
  {
    least = std::min(least, ScaledJacobian(blocks.Places, block.Points));
  }
  return least;
}

// Each face of a block is shared by two blocks, or else it is one of `outside` on the boundary.
void ExpectConforming(const DomainBlocks& blocks, std::size_t outside)
{
  constexpr int faces[6][4] = { { 0, 4, 7, 3 }, { 1, 2, 6, 5 }, { 0, 1, 5, 4 }, { 3, 7, 6, 2 },
    { 0, 3, 2, 1 }, { 4, 5, 6, 7 } };
  std::map<std::set<Index>, int> count;
  for (const DomainBlock& block : blocks.Blocks)
  {
    EXPECT_EQ(std::set<Index>(block.Points.begin(), block.Points.end()).size(), 8u);
    for (const auto& face : faces)
    {
      std::set<Index> corners;
      for (const int corner : face)
      {
        corners.insert(block.Points[corner]);
      }
      ++count[corners];
    }
  }
  std::size_t once = 0;
  for (const auto& [corners, blocksThere] : count)
  {
    EXPECT_LE(blocksThere, 2);
    once += blocksThere == 1;
  }
  EXPECT_EQ(once, outside);
}
}

//------------------------------------------------------------------------------
TEST(TriangleTree, FindsTheNearestPointOfAll)
{
  const SurfaceMesh mesh = Moved(Icosphere(3),
    [](const Point& p) { return Point(3.0 * p[0], p[1] + 0.3 * std::sin(5.0 * p[0]), p[2]); });
  const TriangleTree tree(mesh.Points, mesh.Triangles);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> number(-4.0, 4.0);
  for (int i = 0; i < 300; ++i)
  {
    const Point p(number(random), number(random), number(random));
    double least = std::numeric_limits<double>::infinity();
    for (const Triangle& c : mesh.Triangles)
    {
      least = std::min(least,
        (NearestOfTriangle(p, mesh.Points[c[0]], mesh.Points[c[1]], mesh.Points[c[2]]) - p).norm());
    }
    const TriangleTree::Foot foot = tree.Nearest(p);
    EXPECT_EQ(foot.Distance, least);
    EXPECT_EQ((foot.Place - p).norm(), least);
  }
}

TEST(TriangleTree, MeasuresTheDistanceToATriangle)
{
  const Point a(0, 0, 0), b(4, 0, 0), c(0, 4, 0);
  EXPECT_EQ(NearestOfTriangle({ 1, 1, 5 }, a, b, c), Point(1, 1, 0));  // inside
  EXPECT_EQ(NearestOfTriangle({ 3, 3, 1 }, a, b, c), Point(2, 2, 0));  // a side
  EXPECT_EQ(NearestOfTriangle({ 1, -2, 1 }, a, b, c), Point(1, 0, 0)); // a side
  EXPECT_EQ(NearestOfTriangle({ 9, -1, 1 }, a, b, c), Point(4, 0, 0)); // a corner
  EXPECT_EQ(NearestOfTriangle({ 2, 0, 1 }, a, b, b), Point(2, 0, 0));  // no area
  EXPECT_EQ(NearestOfTriangle({ 2, 0, 1 }, a, a, a), Point(0, 0, 0));
}

//------------------------------------------------------------------------------
TEST(DomainLayers, PutABoxIntoABox)
{
  const SegmentDomain box = Voxels(Polycube::FromGrid({ 1, 1, 1 }), 20.0, 20);
  const DomainBlocks blocks = LayeredBlocks(box, 3.0, Execution());
  ASSERT_EQ(blocks.Places.size(), 16u);
  ASSERT_EQ(blocks.Blocks.size(), 7u);
  ExpectConforming(blocks, 6);
  for (int corner = 0; corner < 8; ++corner)
  {
    const Point middle = Point::Constant(10.0);
    const Point inner = middle + 0.7 * (blocks.Places[corner] - middle);
    EXPECT_LT((blocks.Places[8 + corner] - inner).norm(), 0.5);
    EXPECT_EQ(blocks.Coordinates[8 + corner], blocks.Coordinates[corner]);
  }
  EXPECT_EQ(blocks.Blocks[0].Face, -1);
  EXPECT_GT(ScaledJacobian(blocks.Places, blocks.Blocks[0].Points), 0.99);
  EXPECT_GT(Least(blocks), 0.4); // 0.5 is that of a pillow with corners on the diagonals
}

TEST(DomainLayers, LayOneBlockOnEachFaceOfManyShapes)
{
  struct Case
  {
    std::array<int, 3> Size;
    std::vector<unsigned char> Present;
  };
  for (const Case& c : { Case{ { 2, 2, 1 }, { 1, 1, 1, 0 } }, Case{ { 1, 1, 4 }, {} },
         Case{ { 3, 3, 1 }, { 1, 1, 1, 1, 0, 1, 1, 1, 1 } },
         Case{ { 3, 3, 1 }, { 0, 1, 0, 1, 1, 1, 0, 1, 0 } }, Case{ { 3, 3, 3 }, {} } })
  {
    const Polycube cubes = Polycube::FromGrid(c.Size, c.Present);
    const SegmentDomain domain = Voxels(cubes, 10.0, 6);
    const DomainBlocks plain = CubeBlocks(domain);
    EXPECT_NEAR(Least(plain), 1.0, 1e-9);
    ExpectConforming(plain, cubes.Faces.size());
    const DomainBlocks layered = LayeredBlocks(domain, 0.0, Execution());
    EXPECT_EQ(layered.Places.size(), cubes.Points.size() + cubes.NumberOfCorners);
    EXPECT_EQ(layered.Blocks.size(), cubes.Cubes.size() + cubes.Faces.size());
    ExpectConforming(layered, cubes.Faces.size());
    EXPECT_GT(Least(layered), 0.3);
    for (const DomainBlock& block : layered.Blocks)
    {
      const auto onSurface = std::count_if(block.Points.begin(), block.Points.end(),
        [&cubes](Index point) { return point < cubes.NumberOfCorners; });
      EXPECT_EQ(onSurface, block.Face < 0 ? 0 : 4);
    }
  }
}

TEST(DomainLayers, AreAsDeepAsWantedButNotBeyondHalf)
{
  const SegmentDomain ball = FindDomain(Ball(10.0), DomainOptions(), Execution());
  for (const auto& [wanted, depth] :
    { std::pair(2.0, 2.0), std::pair(4.0, 4.0), std::pair(8.0, 5.0), std::pair(100.0, 5.0) })
  {
    const DomainBlocks blocks = LayeredBlocks(ball, wanted, Execution());
    for (int corner = 8; corner < 16; ++corner)
    {
      EXPECT_NEAR(blocks.Places[corner].norm(), 10.0 - depth, 0.15) << wanted;
    }
    EXPECT_GT(Least(blocks), 0.3);
  }
  // By default 2.5 edges of the 5120 triangles.
  const double edge = std::sqrt(4.0 / std::sqrt(3.0) * 4.0 * M_PI * 100.0 / 5120.0);
  EXPECT_NEAR(MeanEdge(ball.Layout), edge, 0.01 * edge);
  EXPECT_NEAR(LayeredBlocks(ball, 0.0, Execution()).Places[9].norm(), 10.0 - 2.5 * edge, 0.1);
}

TEST(DomainLayers, StayInsideOfAThinPlate)
{
  const SurfaceMesh plate = Moved(SurfaceOf(Polycube::FromGrid({ 1, 1, 1 }), 30),
    [](const Point& p) { return Point(30.0 * p[0], 30.0 * p[1], 2.0 * p[2]); });
  std::vector<Point> corners = CornersOf(Polycube::FromGrid({ 1, 1, 1 }), 1.0);
  for (Point& corner : corners)
  {
    corner = corner.cwiseProduct(Point(30.0, 30.0, 2.0));
  }
  const SegmentDomain domain =
    DomainFromCorners(plate, Polycube::FromGrid({ 1, 1, 1 }), corners, Execution());
  const DomainBlocks blocks = LayeredBlocks(domain, 5.0, Execution());
  for (int corner = 8; corner < 16; ++corner)
  {
    const double depth = std::abs(blocks.Places[corner][2] - blocks.Places[corner - 8][2]);
    EXPECT_NEAR(depth, 0.5, 0.1); // half of the way to the middle
  }
  EXPECT_GT(Least(blocks), 0.0);
}

TEST(DomainLayers, AreUntangledInside)
{
  const SegmentDomain box = Voxels(Polycube::FromGrid({ 1, 1, 1 }), 20.0, 10);
  const DomainBlocks sound = LayeredBlocks(box, 4.0, Execution());
  const std::vector<Index> corners{ 8, 9, 10, 11, 12, 13, 14, 15 };
  for (const Point& astray : { Point(15, 15, 15), Point(16.5, 4, 4), Point(4, 9, 17) })
  {
    DomainBlocks blocks = sound;
    blocks.Places[8] = astray; // of the corner (0, 0, 0), inside but beyond others
    ASSERT_FALSE(InvertedBlocks(blocks).empty());
    UntangleInnerCorners(blocks, box.Layout, corners, std::vector<double>(8, 4.0));
    EXPECT_TRUE(InvertedBlocks(blocks).empty());
    for (const Index corner : corners)
    {
      EXPECT_GE(blocks.Places[corner].minCoeff(), 1.6 - 1e-9);
      EXPECT_LE(blocks.Places[corner].maxCoeff(), 18.4 + 1e-9);
    }
  }
  DomainBlocks same = sound;
  UntangleInnerCorners(same, box.Layout, corners, std::vector<double>(8, 4.0));
  EXPECT_EQ(same.Places, sound.Places);
}

TEST(DomainLayers, TakeTheBoxForAPerfectHexahedron)
{
  const std::vector<Point> places{ { 0, 0, 0 }, { 2, 0, 0 }, { 2, 3, 0 }, { 0, 3, 0 }, { 0, 0, 4 },
    { 2, 0, 4 }, { 2, 3, 4 }, { 0, 3, 4 } };
  EXPECT_NEAR(ScaledJacobian(places, { 0, 1, 2, 3, 4, 5, 6, 7 }), 1.0, 1e-12);
  EXPECT_NEAR(ScaledJacobian(places, { 4, 5, 6, 7, 0, 1, 2, 3 }), -1.0, 1e-12);
  std::vector<Point> sheared = places;
  for (Point& p : sheared)
  {
    p[0] += p[1];
  }
  EXPECT_NEAR(ScaledJacobian(sheared, { 0, 1, 2, 3, 4, 5, 6, 7 }), std::sqrt(0.5), 1e-12);
  std::vector<Point> flat = places;
  flat[6] = flat[5];
  EXPECT_LE(ScaledJacobian(flat, { 0, 1, 2, 3, 4, 5, 6, 7 }), 0.0);
}

//------------------------------------------------------------------------------
TEST(DomainShell, JoinsTwoSurfacesByTheirPatches)
{
  // Frames of balls are arbitrary; of the box inside they are not.
  const SegmentDomain box = Voxels(Polycube::FromGrid({ 1, 1, 1 }), 6.0, 6);
  const SegmentDomain ball = FindDomain(Ball(5.0, { 3.0, 3.0, 3.0 }), DomainOptions(), Execution());
  for (const SegmentDomain& inner : { box, ball })
  {
    const SegmentDomain outer =
      DomainAround(Ball(10.0, { 3.0, 3.5, 2.0 }), inner, DomainOptions(), Execution());
    const DomainBlocks shell = ShellBlocks(outer, inner);
    ASSERT_EQ(shell.Places.size(), 16u);
    ASSERT_EQ(shell.Blocks.size(), 6u);
    ExpectConforming(shell, 12);
    EXPECT_GT(Least(shell), 0.3);
    for (int corner = 0; corner < 8; ++corner)
    {
      EXPECT_EQ(shell.Coordinates[corner], shell.Coordinates[8 + corner]);
      EXPECT_EQ(shell.Places[8 + corner], inner.Places[corner]);
    }
  }
}

TEST(DomainShell, TurnsACubeInAllWays)
{
  const SegmentDomain box = Voxels(Polycube::FromGrid({ 1, 1, 1 }), 6.0, 6);
  std::array<int, 3> axes{ 0, 1, 2 };
  int turns = 0;
  do
  {
    for (int signs = 0; signs < 8; ++signs)
    {
      Eigen::Matrix3d turn = Eigen::Matrix3d::Zero();
      for (int axis = 0; axis < 3; ++axis)
      {
        turn(axis, axes[axis]) = signs >> axis & 1 ? -1.0 : 1.0;
      }
      if (turn.determinant() < 0.0)
      {
        continue;
      }
      ++turns;
      SegmentDomain other = box;
      const Point middle = Point::Constant(3.0);
      for (Point& place : other.Places)
      {
        place = middle + turn * (place - middle);
      }
      const SegmentDomain turned = TurnedToward(box, other);
      EXPECT_EQ(CheckLayout(turned.Layout, turned.Cubes), std::vector<std::string>());
      for (int corner = 0; corner < 8; ++corner)
      {
        EXPECT_LT((turned.Places[corner] - other.Places[corner]).norm(), 1e-9);
        EXPECT_EQ(turned.Places[corner], turned.Layout.Points[turned.Layout.Corners[corner]]);
      }
    }
  } while (std::next_permutation(axes.begin(), axes.end()));
  EXPECT_EQ(turns, 24);
}

// An L and what lies within three voxels of it.
TEST(DomainShell, GoesAroundSeveralCubes)
{
  const auto inside = [](int i, int j, int k) {
    return std::min({ i, j, k }) >= 0 && i < 12 && j < 12 && k < 6 && (i < 6 || j < 6);
  };
  std::vector<LatticePoint> voxels;
  for (int i = -3; i < 15; ++i)
  {
    for (int j = -3; j < 15; ++j)
    {
      for (int k = -3; k < 9; ++k)
      {
        bool near = false;
        for (int n = 0; n < 343; ++n)
        {
          near = near || inside(i + n % 7 - 3, j + n / 7 % 7 - 3, k + n / 49 - 3);
        }
        if (near)
        {
          voxels.push_back({ i, j, k });
        }
      }
    }
  }
  const SegmentDomain inner = Voxels(Polycube::FromGrid({ 2, 2, 1 }, { 1, 1, 1, 0 }), 6.0, 6);
  const SegmentDomain outer =
    DomainAround(SurfaceOf(Polycube(voxels), 1), inner, DomainOptions(), Execution());
  EXPECT_EQ(outer.Cubes.Cubes, inner.Cubes.Cubes);
  EXPECT_EQ(CheckLayout(outer.Layout, outer.Cubes), std::vector<std::string>());
  const DomainBlocks shell = ShellBlocks(outer, inner);
  ASSERT_EQ(shell.Places.size(), 32u);
  ASSERT_EQ(shell.Blocks.size(), 14u);
  ExpectConforming(shell, 28);
  EXPECT_GT(Least(shell), 0.3);
}

// What is around a cup is long below it, and its own domain is aligned best, but hexahedra down to
// the cup are not.
TEST(DomainShell, IsJudgedByWhatIsBetween)
{
  // A ball's surface drawn into a cup, open below.
  const SurfaceMesh cup = Moved(Icosphere(4),
    [](const Point& p)
    {
      const double way = std::acos(p.z()) / M_PI; // from the top, around the rim to the inside
      const double rim = std::clamp(10.0 * (way - 0.45), 0.0, 1.0), radius = 12.0 - 4.0 * rim;
      const double angle = 1.9 * std::min({ way / 0.45, 1.0, (1.0 - way) / 0.45 });
      const double across = std::max(std::hypot(p.x(), p.y()), 1e-12);
      return Point(radius * std::sin(angle) * p.x() / across,
        radius * std::sin(angle) * p.y() / across, radius * std::cos(angle));
    });
  const SurfaceMesh outside = Moved(Icosphere(4), [](const Point& p)
    { return Point(13.0 * p.x(), 13.0 * p.y(), (p.z() > 0 ? 13.0 : 45.0) * p.z()); });
  std::vector<Point> corners; // around the top, and on the rim
  for (int i = 0; i < 8; ++i)
  {
    const double angle = i < 4 ? 1.9 : 0.9, radius = i < 4 ? 10.0 : 12.0;
    const double across = radius * std::sin(angle) * std::sqrt(0.5);
    corners.push_back(
      { i & 1 ? across : -across, i & 2 ? across : -across, radius * std::cos(angle) });
  }
  const SegmentDomain inner =
    DomainFromCorners(cup, Polycube::FromGrid({ 1, 1, 1 }), corners, Execution());
  const SegmentDomain outer = DomainAround(outside, inner, DomainOptions(), Execution());
  const SegmentDomain own = TurnedToward(FindDomain(outside, DomainOptions(), Execution()), inner);
  EXPECT_GT(own.Alignment, outer.Alignment + 0.1);
  EXPECT_GT(
    CoarseHexahedra(outer, inner, Execution()), CoarseHexahedra(own, inner, Execution()) + 0.1);
}

TEST(DomainShell, RefusesDifferentPolycubes)
{
  const SegmentDomain one = Voxels(Polycube::FromGrid({ 1, 1, 1 }), 6.0, 6);
  const SegmentDomain two = Voxels(Polycube::FromGrid({ 1, 1, 2 }), 6.0, 6);
  EXPECT_THROW(ShellBlocks(one, two), std::invalid_argument);
  EXPECT_THROW(ShellBlocks(two, one), std::invalid_argument);
}
