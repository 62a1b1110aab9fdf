// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Domain/LayoutCheck.h"
#include "Search/FindDomain.h"
#include "SegmentSurfaces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <ctime>
#include <numeric>
#include <random>
#include <stdexcept>

// Surfaces with many triangles, whose domains are found and laid out on fewer.
namespace
{
using namespace trivariate;
using Eigen::Vector3d;
using trivariate_testing::Icosphere;
using trivariate_testing::LatticeCorners;
using trivariate_testing::LengthOf;
using trivariate_testing::SurfaceOf;

DomainOptions OnFewTriangles()
{
  DomainOptions options;
  options.MostTriangles = 40000;
  return options;
}

TEST(LargeSurface, HasTheDomainOfASmallOne)
{
  const Polycube bracket = Polycube::FromGrid({ 2, 2, 1 }, { 1, 1, 1, 0 });
  const Polycube frame = Polycube::FromGrid({ 3, 3, 1 }, { 1, 1, 1, 1, 0, 1, 1, 1, 1 });
  struct Case
  {
    SurfaceMesh Surface;
    Index Corners;
    double Alignment;
  };
  for (const Case& shape : { Case{ Icosphere(6), 8, 0.825 },
         Case{ SurfaceOf(bracket, 40), 16, 0.999 }, Case{ SurfaceOf(frame, 27), 32, 0.999 } })
  {
    ASSERT_GT(shape.Surface.NumberOfTriangles(), OnFewTriangles().MostTriangles);
    const SegmentDomain domain = FindDomain(shape.Surface, OnFewTriangles(), Execution());
    EXPECT_TRUE(CheckLayout(domain.Layout, domain.Cubes).empty());
    EXPECT_EQ(domain.Cubes.NumberOfCorners, shape.Corners);
    EXPECT_GT(domain.Alignment, shape.Alignment);
    EXPECT_GE(domain.Layout.Triangles.size(), shape.Surface.Triangles.size());
    EXPECT_EQ(static_cast<Index>(domain.Layout.Origins.size()),
      static_cast<Index>(domain.Layout.Triangles.size()));
    for (const Index origin : domain.Layout.Origins)
    {
      ASSERT_LT(origin, shape.Surface.NumberOfTriangles());
    }
  }
}

// Corners of a cube on a ball: great circles between them, as far as rounds that gain a thousandth
// go on.
TEST(LargeSurface, HasGeodesicsBetweenItsCorners)
{
  const Polycube cube = Polycube::FromGrid({ 1, 1, 1 });
  std::vector<Vector3d> corners = LatticeCorners(cube);
  for (Vector3d& corner : corners)
  {
    corner = (corner - Vector3d::Constant(0.5)).normalized();
  }
  const SurfaceMesh ball = Icosphere(7);
  ASSERT_GT(ball.NumberOfTriangles(), ManyTriangles);
  const SurfaceLayout layout = LayoutFromCorners(ball, cube, corners, Execution());
  EXPECT_TRUE(CheckLayout(layout, cube).empty());
  const double greatCircle = std::acos(1.0 / 3.0);
  for (const LayoutBorder& border : layout.Borders)
  {
    EXPECT_NEAR(LengthOf(layout, border), greatCircle, 1e-3 * greatCircle);
  }
  for (const Index corner : layout.Corners)
  {
    const auto distance = [&](const Vector3d& place)
    { return (layout.Points[corner] - place).norm(); };
    EXPECT_LT(distance(*std::min_element(corners.begin(), corners.end(),
                [&](const Vector3d& a, const Vector3d& b) { return distance(a) < distance(b); })),
      2e-3);
  }
}

// Four times the triangles may take six times as long, and no more.
TEST(LargeSurface, TakesTimeLikeItsTriangles)
{
  const auto seconds = [](const SurfaceMesh& mesh)
  {
    const std::clock_t start = std::clock();
    FindDomain(mesh, OnFewTriangles(), Execution());
    return double(std::clock() - start) / CLOCKS_PER_SEC;
  };
  const double few = seconds(Icosphere(6)), many = seconds(Icosphere(7));
  EXPECT_LT(many, 6.0 * few) << few << " s, then " << many << " s";
}

// 64 cubes with their corners anywhere: no layout is worth millions of triangles.
TEST(LargeSurface, RefusesPathsThatWindAroundEachOther)
{
  const Polycube cubes = Polycube::FromGrid({ 4, 4, 4 });
  const SurfaceMesh ball = Icosphere(3);
  std::vector<Vector3d> corners = LatticeCorners(cubes);
  std::mt19937 random(1);
  std::shuffle(corners.begin(), corners.end(), random);
  for (Vector3d& corner : corners)
  {
    corner = (corner - Vector3d::Constant(2.0)).normalized();
  }
  try
  {
    LayoutFromCorners(ball, cubes, corners, Execution());
    FAIL();
  }
  catch (const std::runtime_error& error)
  {
    EXPECT_NE(std::string(error.what()).find("wind around each other"), std::string::npos)
      << error.what();
  }
}
}
