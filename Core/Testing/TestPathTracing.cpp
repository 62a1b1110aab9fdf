// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Domain/PathTracing.h"
#include "LayoutSurfaces.h"

#include <gtest/gtest.h>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_shortest_path.h>

#include <random>
#include <stdexcept>

namespace
{
using namespace trivariate;
using namespace trivariate_testing;

PathEnd FreeEnd(const LayoutMesh& mesh, Index point)
{
  return SectorWith(mesh, point, mesh.TriangleAt(point));
}

Index Nearest(const SurfaceMesh& mesh, const Point& place)
{
  Index best = 0;
  for (Index p = 0; p < mesh.NumberOfPoints(); ++p)
  {
    best = (mesh.Points[p] - place).norm() < (mesh.Points[best] - place).norm() ? p : best;
  }
  return best;
}

double TracedLength(const SurfaceMesh& surface, Index from, Index to)
{
  LayoutMesh mesh(surface);
  return PolylineLength(mesh, TracePath(mesh, FreeEnd(mesh, from), FreeEnd(mesh, to), 0));
}

TEST(LayoutMesh, StaysManifoldWithItsAreaUnderRandomSplits)
{
  const SurfaceMesh sphere = Icosphere(2);
  LayoutMesh mesh(sphere);
  for (Index t = 0; t < sphere.NumberOfTriangles(); t += 3)
  {
    mesh.SetMark(t, 1, 5);
  }
  std::mt19937 random(1);
  for (int i = 0; i < 2000; ++i)
  {
    const Index t = random() % mesh.NumberOfTriangles();
    mesh.SplitEdge(t, random() % 3, 0.3 + 0.4 * (random() % 100) / 100.0);
  }
  const SurfaceMesh split(mesh.Points, mesh.Triangles);
  EXPECT_EQ(split.EulerCharacteristic(), 2);
  std::vector<double> area(sphere.NumberOfTriangles(), 0.0);
  double marked = 0.0, markedBefore = 0.0;
  for (Index t = 0; t < split.NumberOfTriangles(); ++t)
  {
    area[mesh.Origins[t]] += split.AreaVector(t).norm();
    for (int k = 0; k < 3; ++k)
    {
      ASSERT_EQ(mesh.Neighbour(t, k), split.Neighbour(t, k));
      ASSERT_EQ(mesh.Mark(t, k), mesh.Mark(mesh.Neighbour(t, k), mesh.SideAcross(t, k)));
      const Triangle& c = mesh.Triangles[t];
      marked += mesh.Mark(t, k) == 5 ? (mesh.Points[c[k]] - mesh.Points[c[(k + 1) % 3]]).norm() : 0;
      EXPECT_TRUE(mesh.HasCorner(mesh.TriangleAt(c[k]), c[k]));
    }
  }
  for (Index t = 0; t < sphere.NumberOfTriangles(); ++t)
  {
    EXPECT_NEAR(area[t], sphere.AreaVector(t).norm(), 1e-14);
  }
  const LayoutMesh whole = [&]
  {
    LayoutMesh same(sphere);
    for (Index t = 0; t < sphere.NumberOfTriangles(); t += 3)
    {
      same.SetMark(t, 1, 5);
    }
    return same;
  }();
  for (Index t = 0; t < sphere.NumberOfTriangles(); ++t)
  {
    for (int k = 0; k < 3; ++k)
    {
      const Triangle& c = whole.Triangles[t];
      markedBefore +=
        whole.Mark(t, k) == 5 ? (whole.Points[c[k]] - whole.Points[c[(k + 1) % 3]]).norm() : 0;
    }
  }
  EXPECT_NEAR(marked, markedBefore, 1e-11);
}

TEST(PathTracing, EqualsTheUnfoldedCube)
{
  const SurfaceMesh cube = SurfaceOf(Polycube::FromGrid({ 1, 1, 1 }), 12);
  const auto at = [&cube](double x, double y, double z) { return Nearest(cube, { x, y, z }); };
  // To the far corner over two faces: sqrt(5). From middle to middle of opposite faces: 2.
  EXPECT_NEAR(TracedLength(cube, at(0, 0, 0), at(1, 1, 1)), std::sqrt(5.0), 1e-3);
  EXPECT_NEAR(TracedLength(cube, at(0.5, 0.5, 0), at(0.5, 0.5, 1)), 2.0, 1e-3);
  EXPECT_NEAR(TracedLength(cube, at(0, 0, 0), at(1, 0, 0)), 1.0, 1e-12);
  EXPECT_NEAR(TracedLength(cube, at(0, 0, 0), at(1, 1, 0)), std::sqrt(2.0), 1e-3);
  EXPECT_NEAR(TracedLength(cube, at(0.25, 0, 0.5), at(1, 0.25, 0.75)), std::hypot(1.0, 0.25), 1e-3);
}

// CGAL's is the shortest of all geodesics: none of ours is shorter, most are the same, and the
// others (on a rough surface there are many side by side) are at most one percent longer.
TEST(PathTracing, HardlyEverMissesCgalsShortestPaths)
{
  using Kernel = CGAL::Simple_cartesian<double>;
  using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
  using ShortestPath =
    CGAL::Surface_mesh_shortest_path<CGAL::Surface_mesh_shortest_path_traits<Kernel, Mesh>>;
  int count = 0, same = 0;
  double worst = 1.0;
  for (const double roughness : { 0.0, 0.03 })
  {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> shift(-roughness, roughness);
    const SurfaceMesh surface = Moved(Icosphere(4),
      [&](const Point& p)
      {
        return Point((2.0 + 0.3 * std::sin(4.0 * p.y()) + shift(random)) * p.x(),
          p.y() + shift(random), (1.0 + 0.3 * p.x() * p.x()) * p.z());
      });
    Mesh mesh;
    for (const Point& p : surface.Points)
    {
      mesh.add_vertex({ p.x(), p.y(), p.z() });
    }
    for (const Triangle& c : surface.Triangles)
    {
      mesh.add_face(Mesh::Vertex_index(c[0]), Mesh::Vertex_index(c[1]), Mesh::Vertex_index(c[2]));
    }
    const LayoutMesh layout(surface);
    for (int source = 0; source < 6; ++source)
    {
      const Index from = random() % surface.NumberOfPoints();
      ShortestPath shortest(mesh);
      shortest.add_source_point(Mesh::Vertex_index(from));
      for (int i = 0; i < 60; ++i)
      {
        const Index to = random() % surface.NumberOfPoints();
        const double exact =
          shortest.shortest_distance_to_source_points(Mesh::Vertex_index(to)).first;
        const std::vector<Crossing> sleeve =
          FindSleeve(layout, FreeEnd(layout, from), FreeEnd(layout, to));
        if (to == from || exact < 0.3 || sleeve.empty())
        {
          continue;
        }
        const double ratio = Straighten(layout, from, to, sleeve).Length / exact;
        EXPECT_GT(ratio, 1.0 - 1e-9);
        worst = std::max(worst, ratio);
        ++count;
        same += ratio < 1.0 + 1e-9;
      }
    }
  }
  RecordProperty("Pairs", count);
  RecordProperty("Same", same);
  RecordProperty("Worst", std::to_string(worst));
  EXPECT_GT(count, 600);
  EXPECT_GT(same, 0.7 * count);
  EXPECT_LT(worst, 1.01);
}

TEST(PathTracing, ApproachesGreatCirclesQuadratically)
{
  double before = 0.0;
  for (const int levels : { 3, 4, 5 })
  {
    const SurfaceMesh sphere = Icosphere(levels);
    const Index from = Nearest(sphere, Point(1, 2, 3).normalized());
    const Index to = Nearest(sphere, Point(3, -1, -1).normalized());
    const double arc = std::acos(sphere.Points[from].dot(sphere.Points[to]));
    const double error = std::abs(TracedLength(sphere, from, to) / arc - 1.0);
    EXPECT_LT(error, 0.2 * std::pow(4.0, -levels));
    if (before > 0.0)
    {
      EXPECT_LT(error, 0.6 * before);
    }
    before = error;
  }
}

// A second path between the same corners, on the given side of the first, goes around the sphere.
TEST(PathTracing, NeverTouchesAnotherBorder)
{
  const SurfaceMesh sphere = Icosphere(3);
  LayoutMesh mesh(sphere);
  const Index north = Nearest(sphere, Point::UnitZ()), south = Nearest(sphere, -Point::UnitZ());
  const Index east = Nearest(sphere, Point::UnitX());
  mesh.Occupied[north] = mesh.Occupied[south] = mesh.Occupied[east] = 1;
  const std::vector<Index> first = TracePath(mesh, FreeEnd(mesh, north), FreeEnd(mesh, east), 0);
  std::vector<char> used(10000, 0);
  for (const Index p : first)
  {
    used.at(p) = 1;
  }
  // Five more from pole to pole, all squeezed between the same two sectors.
  for (Index mark = 1; mark < 6; ++mark)
  {
    const std::vector<Index> path =
      TracePath(mesh, FreeEnd(mesh, north), FreeEnd(mesh, south), mark);
    for (std::size_t i = 1; i + 1 < path.size(); ++i)
    {
      EXPECT_EQ(used.at(path[i]), 0) << "path " << mark << " touches another at point " << path[i];
      used.at(path[i]) = 1;
    }
  }
  EXPECT_EQ(SurfaceMesh(mesh.Points, mesh.Triangles).EulerCharacteristic(), 2);
  EXPECT_THROW(
    TracePath(mesh, FreeEnd(mesh, north), FreeEnd(mesh, north), 9), std::invalid_argument);
}

TEST(PathTracing, SaysSoWhereBordersLieBetween)
{
  const SurfaceMesh cube = SurfaceOf(Polycube::FromGrid({ 1, 1, 1 }), 4);
  LayoutMesh mesh(cube);
  for (Index t = 0; t < cube.NumberOfTriangles(); ++t)
  {
    for (int k = 0; k < 3; ++k)
    {
      const Triangle& c = cube.Triangles[t];
      if (cube.Points[c[k]].z() == 0.5 && cube.Points[c[(k + 1) % 3]].z() == 0.5)
      {
        mesh.SetMark(t, k, 0);
      }
    }
  }
  EXPECT_THROW(TracePath(mesh, FreeEnd(mesh, Nearest(cube, { 0.5, 0.5, 0 })),
                 FreeEnd(mesh, Nearest(cube, { 0.5, 0.5, 1 })), 1),
    std::runtime_error);
}
}
