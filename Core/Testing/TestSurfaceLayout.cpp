// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Domain/LayoutCheck.h"
#include "LayoutSurfaces.h"
#include "Search/CubeCharts.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <set>
#include <stdexcept>

namespace
{
using namespace trivariate;
using namespace trivariate_testing;

std::vector<double> PatchAreas(const SurfaceLayout& layout)
{
  const SurfaceMesh mesh(layout.Points, layout.Triangles);
  std::vector<double> areas(layout.PatchLabels.size(), 0.0);
  for (Index t = 0; t < mesh.NumberOfTriangles(); ++t)
  {
    areas.at(layout.Patches[t]) += mesh.AreaVector(t).norm();
  }
  return areas;
}

double AreaOf(const SurfaceMesh& mesh)
{
  double area = 0.0;
  for (Index t = 0; t < mesh.NumberOfTriangles(); ++t)
  {
    area += mesh.AreaVector(t).norm();
  }
  return area;
}

std::string Joined(const std::vector<std::string>& messages)
{
  std::string all;
  for (const std::string& message : messages)
  {
    all += message + "\n";
  }
  return all;
}

std::string Refusal(
  const SurfaceMesh& mesh, const Polycube& polycube, const std::vector<Point>& corners)
{
  try
  {
    LayoutFromCorners(mesh, polycube, corners, Execution(), 0.5);
  }
  catch (const std::invalid_argument& error)
  {
    return error.what();
  }
  return "";
}

std::vector<Polycube> Shapes()
{
  return { Polycube::FromGrid({ 1, 1, 1 }), Polycube::FromGrid({ 1, 1, 2 }),
    Polycube::FromGrid({ 1, 2, 3 }), Polycube::FromGrid({ 2, 2, 1 }, { 1, 1, 1, 0 }),
    Polycube::FromGrid({ 3, 2, 1 }, { 1, 1, 1, 0, 1, 0 }),
    Polycube({ { 0, 0, 0 }, { 1, 0, 0 }, { -1, 0, 0 }, { 0, 1, 0 }, { 0, -1, 0 } }),
    Polycube({ { 0, 0, 0 }, { 1, 0, 0 }, { -1, 0, 0 }, { 0, 1, 0 }, { 0, -1, 0 }, { 0, 0, 1 },
      { 0, 0, -1 } }),
    Polycube::FromGrid({ 3, 3, 1 }, { 1, 1, 1, 1, 0, 1, 1, 1, 1 }) };
}

// Labels as charts for the boundary of a polycube: each unit face's own.
std::vector<ChartLabel> LabelsOf(const SurfaceMesh& mesh)
{
  std::vector<ChartLabel> labels;
  for (Index t = 0; t < mesh.NumberOfTriangles(); ++t)
  {
    int axis = 0;
    const double largest = mesh.AreaVector(t).cwiseAbs().maxCoeff(&axis);
    EXPECT_GT(largest, 0.0);
    labels.push_back(static_cast<ChartLabel>(2 * axis + (mesh.AreaVector(t)[axis] > 0.0)));
  }
  return labels;
}

TEST(SurfaceLayout, FindsTheUnitFacesOfVoxelSolids)
{
  for (const Polycube& shape : Shapes())
  {
    for (const int n : { 1, 5, 8 })
    {
      const SurfaceMesh mesh = SurfaceOf(shape, n);
      const SurfaceLayout layout =
        LayoutFromCorners(mesh, shape, LatticeCorners(shape), Execution(), 1e-9);
      EXPECT_EQ(Joined(CheckLayout(layout, shape)), "");
      for (const LayoutBorder& border : layout.Borders)
      {
        EXPECT_NEAR(LengthOf(layout, border), 1.0, 1e-12);
      }
      for (const double area : PatchAreas(layout))
      {
        EXPECT_NEAR(area, 1.0, 1e-12);
      }
    }
  }
}

// Corners off the edges of the mesh, on a bar bent through 180 degrees.
TEST(SurfaceLayout, LaysOutABentBar)
{
  const Polycube shape = Polycube::FromGrid({ 1, 1, 5 });
  const auto bend = [](const Point& p)
  {
    const double angle = std::acos(-1.0) * p.z() / 5.0, radius = 1.2 + p.x();
    return Point(radius * std::cos(angle), p.y(), radius * std::sin(angle));
  };
  const SurfaceMesh bar = Moved(SurfaceOf(shape, 24), [&bend](const Point& p) { return bend(p); });
  std::vector<Point> corners;
  for (const Point& p : LatticeCorners(shape))
  {
    corners.push_back(bend(p));
  }
  const SurfaceLayout layout = LayoutFromCorners(bar, shape, corners, Execution(), 0.1);
  EXPECT_EQ(Joined(CheckLayout(layout, shape)), "");
  const double fifth = std::acos(-1.0) / 5.0;
  for (std::size_t b = 0; b < layout.Borders.size(); ++b)
  {
    const Polycube::Edge& edge = shape.Edges[b];
    const double radius = 1.2 + shape.Points[edge.From][0];
    const double length = LengthOf(layout, layout.Borders[b]);
    // On the flat sides the shortest way along the outer arc is its chord.
    EXPECT_LT(length, (edge.Axis == 2 ? radius * fifth : 1.0) + 1e-9);
    EXPECT_GT(length, (edge.Axis == 2 ? 2.0 * radius * std::sin(0.5 * fifth) : 1.0) - 1e-2);
  }
  const std::vector<double> areas = PatchAreas(layout);
  EXPECT_NEAR(std::accumulate(areas.begin(), areas.end(), 0.0), AreaOf(bar), 1e-9);
}

TEST(SurfaceLayout, DrawsACubeOnTheSphereWithGreatCircles)
{
  const SurfaceMesh sphere = Icosphere(5);
  const Polycube cube = Polycube::FromGrid({ 1, 1, 1 });
  std::vector<Point> corners = LatticeCorners(cube);
  const Eigen::Matrix3d turn =
    Eigen::AngleAxisd(0.7, Point(1, 2, 3).normalized()).toRotationMatrix();
  for (Point& p : corners)
  {
    p = turn * (p - Point(0.5, 0.5, 0.5)).normalized();
  }
  const SurfaceLayout layout = LayoutFromCorners(sphere, cube, corners, Execution());
  EXPECT_EQ(Joined(CheckLayout(layout, cube)), "");
  for (const LayoutBorder& border : layout.Borders)
  {
    EXPECT_NEAR(LengthOf(layout, border), std::acos(1.0 / 3.0), 3e-3);
  }
  for (const double area : PatchAreas(layout))
  {
    EXPECT_NEAR(area, AreaOf(sphere) / 6.0, 5e-3);
  }
}

TEST(SurfaceLayout, IsValidWhereverTheCornersAre)
{
  const SurfaceMesh sphere = Icosphere(3);
  const std::vector<Polycube> shapes = Shapes();
  for (int seed = 0; seed < 36; ++seed)
  {
    const Polycube& shape = shapes[seed % 6 == 5];
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    std::vector<Point> corners;
    for (Index i = 0; i < shape.NumberOfCorners; ++i)
    {
      const double x = normal(random), y = normal(random), z = normal(random);
      corners.push_back(Point(x, y, z).normalized());
    }
    if (!Refusal(sphere, shape, corners).empty())
    {
      for (Point& p : corners)
      {
        p.x() = -p.x(); // they were those of a mirrored polycube
      }
    }
    const SurfaceLayout layout = LayoutFromCorners(sphere, shape, corners, Execution());
    EXPECT_EQ(Joined(CheckLayout(layout, shape)), "") << "seed " << seed;
    const std::vector<double> areas = PatchAreas(layout);
    EXPECT_NEAR(std::accumulate(areas.begin(), areas.end(), 0.0), AreaOf(sphere), 1e-9);
  }
}

TEST(SurfaceLayout, RefusesWrongCorners)
{
  const Polycube cube = Polycube::FromGrid({ 1, 1, 1 });
  const SurfaceMesh mesh = SurfaceOf(cube, 4);
  const std::vector<Point> good = LatticeCorners(cube);
  EXPECT_EQ(Refusal(mesh, cube, good), "");
  std::vector<Point> bad(good.begin(), good.end() - 1);
  EXPECT_NE(Refusal(mesh, cube, bad).find("has 8 corners; 7 were given"), std::string::npos);
  bad = good;
  bad[5] = bad[2];
  EXPECT_NE(Refusal(mesh, cube, bad).find("corner 2 at (0, 1, 0) of the polycube and the corner 5"),
    std::string::npos);
  bad = good;
  bad[0] = Point(-3.0, 0.0, 0.0);
  EXPECT_NE(Refusal(mesh, cube, bad).find("corner 0 at (0, 0, 0) of the polycube is 3.0"),
    std::string::npos);
  bad[0] = Point(std::nan(""), 0.0, 0.0);
  EXPECT_NE(Refusal(mesh, cube, bad).find("not finite"), std::string::npos);
  bad = good;
  for (Point& p : bad)
  {
    p.x() = 1.0 - p.x();
  }
  EXPECT_NE(Refusal(mesh, cube, bad).find("mirrored"), std::string::npos);
  const Polycube ring = Polycube::FromGrid({ 3, 3, 1 }, { 1, 1, 1, 1, 0, 1, 1, 1, 1 });
  EXPECT_NE(
    Refusal(SurfaceOf(ring, 2), cube, good).find("Euler characteristic 0"), std::string::npos);
}

TEST(SurfaceLayout, StraightensChartsOfASphere)
{
  const SurfaceMesh sphere = Icosphere(4);
  const CubeCharts charts = FindCubeCharts(sphere, CubeChartOptions(), Execution());
  const SurfaceLayout layout = LayoutFromCharts(sphere, charts.Labels, Execution());
  std::vector<LatticePoint> corners;
  EXPECT_EQ(Joined(CheckCharts(layout, &corners)), "");
  EXPECT_EQ(layout.Corners.size(), 8u);
  EXPECT_EQ(std::set<LatticePoint>(corners.begin(), corners.end()).size(), 8u);
  for (const LayoutBorder& border : layout.Borders)
  {
    const Point a = layout.Points[border.Points.front()], b = layout.Points[border.Points.back()];
    EXPECT_NEAR(LengthOf(layout, border), std::acos(a.dot(b)), 4e-3);
  }
}

TEST(SurfaceLayout, FindsTheCoordinatesOfVoxelSolidsFromTheirCharts)
{
  // The plus and the cross have points where more than three charts meet; the ring, an annulus.
  for (const int i : { 0, 1, 2, 3, 4 })
  {
    const Polycube shape = Shapes()[i];
    const SurfaceMesh mesh = SurfaceOf(shape, 4);
    const SurfaceLayout layout = LayoutFromCharts(mesh, LabelsOf(mesh), Execution());
    std::vector<LatticePoint> corners;
    EXPECT_EQ(Joined(CheckCharts(layout, &corners)), "");
    ASSERT_EQ(corners.size(), layout.Corners.size());
    for (std::size_t a = 0; a < corners.size(); ++a)
    {
      for (std::size_t b = 0; b < a; ++b)
      {
        const Point from = mesh.Points[layout.Corners[a]], to = mesh.Points[layout.Corners[b]];
        for (int axis = 0; axis < 3; ++axis)
        {
          // The order of the corners along each axis is kept.
          if (from[axis] == to[axis])
          {
            continue;
          }
          EXPECT_EQ(from[axis] < to[axis], corners[a][axis] < corners[b][axis]);
        }
      }
    }
  }
}

TEST(SurfaceLayout, RefusesChartsOfNoPolycube)
{
  const SurfaceMesh cube = SurfaceOf(Polycube::FromGrid({ 1, 1, 1 }), 6);
  const std::vector<ChartLabel> good = LabelsOf(cube);
  const auto complaints = [&cube](const std::vector<ChartLabel>& labels)
  { return Joined(CheckCharts(LayoutFromCharts(cube, labels, Execution()))); };
  EXPECT_EQ(complaints(good), "");

  // All charts are discs with four neighbours, but along u there are two low ones.
  std::vector<ChartLabel> bad = good;
  std::replace(bad.begin(), bad.end(), ChartLabel(1), ChartLabel(0));
  EXPECT_NE(complaints(bad), "");
  // Mirrored along u.
  bad = good;
  for (ChartLabel& label : bad)
  {
    label = label < 2 ? ChartLabel(1 - label) : label;
  }
  EXPECT_NE(complaints(bad), "");
  // Turned inside out: all three exchanged is a point reflection, also mirrored.
  bad = good;
  for (ChartLabel& label : bad)
  {
    label = ChartLabel(label ^ 1);
  }
  EXPECT_NE(complaints(bad), "");
  // Three charts only.
  bad = good;
  for (ChartLabel& label : bad)
  {
    label = ChartLabel(label & 6);
  }
  EXPECT_NE(complaints(bad), "");

  bad = good;
  bad[0] = 7;
  EXPECT_THROW(complaints(bad), std::invalid_argument);
  EXPECT_THROW(complaints(std::vector<ChartLabel>(good.size(), 0)), std::invalid_argument);
  EXPECT_THROW(complaints({ 0, 1 }), std::invalid_argument);
}

TEST(LayoutCheck, NamesWhatIsWrong)
{
  const Polycube cube = Polycube::FromGrid({ 1, 1, 1 });
  const SurfaceMesh mesh = SurfaceOf(cube, 4);
  const SurfaceLayout good = LayoutFromCorners(mesh, cube, LatticeCorners(cube), Execution());
  const auto complaints = [&cube](const SurfaceLayout& layout)
  { return Joined(CheckLayout(layout, cube)); };
  EXPECT_EQ(complaints(good), "");
  SurfaceLayout bad = good;
  bad.Patches[3] = -1;
  EXPECT_NE(complaints(bad).find("Triangle 3 belongs to no patch"), std::string::npos);
  bad = good;
  bad.Patches[3] = 5 - bad.Patches[3];
  EXPECT_NE(complaints(bad).find("is not a disc"), std::string::npos);
  bad = good;
  std::swap(bad.Corners[1], bad.Corners[2]);
  EXPECT_NE(complaints(bad).find("Border"), std::string::npos);
  bad = good;
  bad.Borders[4].Points[2] = bad.Borders[3].Points[2];
  EXPECT_NE(complaints(bad).find("Border 4 touches border 3"), std::string::npos);
  bad = good;
  bad.PatchLabels[2] = 5;
  EXPECT_NE(complaints(bad).find("Patch 2 has label 5"), std::string::npos);
  bad = good;
  for (Triangle& c : bad.Triangles)
  {
    std::swap(c[1], c[2]);
  }
  for (LayoutBorder& border : bad.Borders)
  {
    std::swap(border.Patches[0], border.Patches[1]);
  }
  EXPECT_NE(complaints(bad).find("mirrored"), std::string::npos);
  EXPECT_NE(
    Joined(CheckLayout(good, Polycube::FromGrid({ 1, 1, 2 }))).find("needs 12"), std::string::npos);
}
}
