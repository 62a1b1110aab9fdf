// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Boundary/SegmentBoundary.h"
#include "SegmentVolumes.h"
#include "ThreadedExecution.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

using namespace trivariate;
namespace PMP = CGAL::Polygon_mesh_processing;

namespace
{
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

// The surface of one segment, its normals outwards; no faces if it is not manifold and oriented.
Mesh SurfaceOf(const SegmentBoundary& boundary, int segment)
{
  std::vector<Kernel::Point_3> points;
  for (const Point& p : boundary.Points)
  {
    points.emplace_back(p[0], p[1], p[2]);
  }
  std::vector<std::array<std::size_t, 3>> faces;
  for (std::size_t t = 0; t < boundary.Triangles.size(); ++t)
  {
    const Triangle& v = boundary.Triangles[t];
    const std::size_t a = v[0], b = v[1], c = v[2];
    if (boundary.Labels[t][0] == segment)
    {
      faces.push_back({ a, b, c });
    }
    else if (boundary.Labels[t][1] == segment)
    {
      faces.push_back({ a, c, b });
    }
  }
  Mesh mesh;
  if (PMP::is_polygon_soup_a_polygon_mesh(faces))
  {
    PMP::polygon_soup_to_polygon_mesh(points, faces, mesh);
  }
  return mesh;
}

// Closed, two-manifold, oriented, without self-intersection; the outside of all is segment -1.
void ExpectSound(const SegmentBoundary& boundary, const std::vector<std::int32_t>& labels)
{
  EXPECT_EQ(boundary.Intersections, 0);
  std::set<int> segments(labels.begin(), labels.end());
  segments.insert(-1);
  for (int segment : segments)
  {
    const Mesh mesh = SurfaceOf(boundary, segment);
    EXPECT_GT(mesh.number_of_faces(), 0u) << segment;
    EXPECT_TRUE(CGAL::is_closed(mesh)) << segment;
    EXPECT_FALSE(PMP::does_self_intersect(mesh)) << segment;
    if (segment >= 0)
    {
      EXPECT_GT(PMP::volume(mesh), 0.0) << segment;
    }
  }
}

double CountVoxels(const SegmentVolume& volume, int label)
{
  return static_cast<double>(std::count(volume.Labels.begin(), volume.Labels.end(), label));
}

// Root mean square over the points of the ball's surface of what a function says.
template <typename Function>
double RootMeanSquare(const SegmentBoundary& boundary, const Function& deviation)
{
  std::set<Index> vertices;
  for (std::size_t t = 0; t < boundary.Triangles.size(); ++t)
  {
    if (boundary.Labels[t][0] == 0 && boundary.Labels[t][1] == 1)
    {
      vertices.insert(boundary.Triangles[t].begin(), boundary.Triangles[t].end());
    }
  }
  double sum = 0.0;
  for (Index v : vertices)
  {
    sum += std::pow(deviation(v), 2);
  }
  return std::sqrt(sum / vertices.size());
}

// The distance of a point from the faces between different labels.
double DistanceFromFaces(const LabelVolume& labels, const Point& p)
{
  double least = 1e300;
  const auto first = [&p](int a) { return static_cast<Index>(std::floor(p[a])) - 1; };
  for (Index k = first(2); k < first(2) + 4; ++k)
  {
    for (Index j = first(1); j < first(1) + 4; ++j)
    {
      for (Index i = first(0); i < first(0) + 4; ++i)
      {
        const std::array<double, 3> voxel = { double(i), double(j), double(k) };
        for (int axis = 0; axis < 3; ++axis)
        {
          if (labels(i, j, k) != labels(i + (axis == 0), j + (axis == 1), k + (axis == 2)))
          {
            double sum = 0.0;
            for (int a = 0; a < 3; ++a)
            {
              const double d = std::abs(p[a] - voxel[a] - (a == axis ? 0.5 : 0.0));
              sum += std::pow(a == axis ? d : std::max(d - 0.5, 0.0), 2);
            }
            least = std::min(least, sum);
          }
        }
      }
    }
  }
  return std::sqrt(least);
}

std::vector<double> SmallestAngles(const SegmentBoundary& boundary)
{
  std::vector<double> angles;
  for (const Triangle& t : boundary.Triangles)
  {
    double least = 180.0;
    for (int i = 0; i < 3; ++i)
    {
      const Point &p = boundary.Points[t[i]], &q = boundary.Points[t[(i + 1) % 3]],
                  &r = boundary.Points[t[(i + 2) % 3]];
      const Kernel::Vector_3 u(q[0] - p[0], q[1] - p[1], q[2] - p[2]),
        v(r[0] - p[0], r[1] - p[1], r[2] - p[2]);
      const double cosine = u * v / std::sqrt(u.squared_length() * v.squared_length());
      least = std::min(least, std::acos(cosine) * 180.0 / M_PI);
    }
    angles.push_back(least);
  }
  std::sort(angles.begin(), angles.end());
  return angles;
}

const std::array<double, 3> Centre = { 20.13, 19.71, 20.41 };
}

//------------------------------------------------------------------------------
TEST(SegmentBoundary, OfABallFromLabels)
{
  for (double radius : { 8.0, 16.0, 17.3 })
  {
    const SegmentVolume volume = BallVolume({ 41, 41, 42 }, Centre, radius);
    const SegmentBoundary b = ComputeSegmentBoundary(volume.View(), {}, Execution());
    ExpectSound(b, volume.Labels);
    EXPECT_NEAR(PMP::volume(SurfaceOf(b, 1)) / CountVoxels(volume, 1), 1.0, 0.001);
    const auto deviation = [&](Index v)
    {
      const Point& p = b.Points[v];
      return std::hypot(p[0] - Centre[0], p[1] - Centre[1], p[2] - Centre[2]) - radius;
    };
    EXPECT_LT(RootMeanSquare(b, deviation), 0.1);
    const std::vector<double> angles = SmallestAngles(b);
    EXPECT_GT(angles.front(), 20.0);
    EXPECT_GT(angles[angles.size() / 20], 35.0);
  }
}

TEST(SegmentBoundary, OfABallWithDensity)
{
  for (double radius : { 8.0, 16.0, 17.3 })
  {
    const SegmentVolume volume = BallVolume({ 41, 41, 42 }, Centre, radius);
    BoundaryOptions options;
    options.Density = volume.Density.data();
    const SegmentBoundary b = ComputeSegmentBoundary(volume.View(), options, Execution());
    ExpectSound(b, volume.Labels);
    EXPECT_NEAR(PMP::volume(SurfaceOf(b, 1)) / (4.0 / 3.0 * M_PI * std::pow(radius, 3)), 1.0,
      radius < 16.0 ? 0.004 : 0.0015);
    const std::vector<Point> normals = PointNormals(b.Points, b.Triangles, Execution());
    const auto fromCentre = [&](Index v)
    {
      const Point& p = b.Points[v];
      return Kernel::Vector_3(p[0] - Centre[0], p[1] - Centre[1], p[2] - Centre[2]);
    };
    const auto distance = [&](Index v) { return std::sqrt(fromCentre(v).squared_length()); };
    EXPECT_LT(RootMeanSquare(b, [&](Index v) { return distance(v) - radius; }), 0.05);
    const auto degrees = [&](Index v)
    {
      const Kernel::Vector_3 normal(normals[v][0], normals[v][1], normals[v][2]);
      return std::acos(-(normal * fromCentre(v)) / distance(v)) * 180.0 / M_PI;
    };
    EXPECT_LT(RootMeanSquare(b, degrees), 2.0);
  }
}

TEST(SegmentBoundary, OfABoxKeepsTheVolume)
{
  const SegmentVolume volume = MakeVolume({ 40, 24, 24 }, [](double x, double y, double z)
    { return x > 3 && x < 36 && y > 3 && y < 20 && z > 3 && z < 20; });
  const SegmentBoundary b = ComputeSegmentBoundary(volume.View(), {}, Execution());
  ExpectSound(b, volume.Labels);
  EXPECT_NEAR(PMP::volume(SurfaceOf(b, 1)) / CountVoxels(volume, 1), 1.0, 0.001);
}

TEST(SegmentBoundary, IsSoundForNoise)
{
  for (unsigned seed = 0; seed < 60; ++seed)
  {
    SegmentVolume volume = RandomVolume({ 7, 6, 5 }, 2 + seed % 5, seed);
    volume.Density.assign(volume.Labels.begin(), volume.Labels.end());
    BoundaryOptions options;
    options.Density = seed % 2 ? volume.Density.data() : nullptr;
    const SegmentBoundary b = ComputeSegmentBoundary(volume.View(), options, Execution());
    ExpectSound(b, volume.Labels);
  }
}

TEST(SegmentBoundary, StaysWithinHalfAVoxelOfTheFaces)
{
  const auto check = [](const SegmentVolume& volume, const char* name)
  {
    BoundaryOptions options;
    options.Density = volume.Density.empty() ? nullptr : volume.Density.data();
    const SegmentBoundary b = ComputeSegmentBoundary(volume.View(), options, Execution());
    double ofPoints = 0.0, inside = 0.0;
    for (const Point& p : b.Points)
    {
      ofPoints = std::max(ofPoints, DistanceFromFaces(volume.View(), p));
    }
    for (const Triangle& t : b.Triangles)
    {
      for (const std::array<double, 3>& w : { std::array<double, 3>{ 0.5, 0.5, 0.0 },
             { 0.0, 0.5, 0.5 }, { 0.5, 0.0, 0.5 }, { 1.0 / 3, 1.0 / 3, 1.0 / 3 } })
      {
        Point p;
        for (int a = 0; a < 3; ++a)
        {
          p[a] = w[0] * b.Points[t[0]][a] + w[1] * b.Points[t[1]][a] + w[2] * b.Points[t[2]][a];
        }
        inside = std::max(inside, DistanceFromFaces(volume.View(), p));
      }
    }
    EXPECT_LE(ofPoints, 0.5) << name;
    EXPECT_LE(inside, 0.5) << name;
  };
  check(BallVolume({ 41, 41, 42 }, Centre, 16.0), "ball");
  check(RandomVolume({ 12, 12, 12 }, 2, 1), "two labels");
  check(RandomVolume({ 12, 12, 12 }, 5, 2), "five labels");
  check(MakeVolume({ 30, 30, 30 },
          [](double x, double y, double z) { return std::abs(x + 0.4 * y + 0.3 * z - 25) < 0.6; }),
    "sheet");
}

// Two halves of a ball in a box: the three meet along a circle.
TEST(SegmentBoundary, MarksTheCurvesWhereThreeSegmentsMeet)
{
  const SegmentVolume volume = MakeVolume({ 41, 41, 41 },
    [](double x, double y, double z) {
      return std::hypot(x - 20, y - 20, z - 20) > 16.2 ? 0 : x + 0.3 * y < 25.7 ? 1 : 2;
    });
  const SegmentBoundary b = ComputeSegmentBoundary(volume.View(), {}, Execution());
  ExpectSound(b, volume.Labels);
  for (int segment : { 1, 2 })
  {
    EXPECT_NEAR(PMP::volume(SurfaceOf(b, segment)) / CountVoxels(volume, segment), 1.0, 0.005);
  }
  std::vector<std::set<int>> meeting(b.Points.size());
  for (std::size_t t = 0; t < b.Triangles.size(); ++t)
  {
    for (Index v : b.Triangles[t])
    {
      meeting[v].insert(b.Labels[t].begin(), b.Labels[t].end());
    }
  }
  for (std::size_t v = 0; v < b.Points.size(); ++v)
  {
    EXPECT_EQ(b.Junctions[v], meeting[v].size() > 2 ? 1 : 0);
    if (b.Junctions[v])
    {
      EXPECT_NEAR(b.Points[v][0] + 0.3 * b.Points[v][1], 25.7, 0.8);
    }
  }
}

TEST(SegmentBoundary, IsFlatOnTheBorderOfTheVolume)
{
  const SegmentVolume volume = MakeVolume(
    { 20, 21, 22 }, [](double x, double y, double z) { return std::hypot(x, y, z - 10) < 14.2; });
  const SegmentBoundary b = ComputeSegmentBoundary(volume.View(), {}, Execution());
  ExpectSound(b, volume.Labels);
  for (std::size_t t = 0; t < b.Triangles.size(); ++t)
  {
    if (b.Labels[t][0] == -1)
    {
      bool flat = false;
      for (int a = 0; a < 3; ++a)
      {
        for (double border : { -0.5, volume.Size[a] - 0.5 })
        {
          flat = flat || std::all_of(b.Triangles[t].begin(), b.Triangles[t].end(),
                           [&](Index v) { return b.Points[v][a] == border; });
        }
      }
      EXPECT_TRUE(flat);
    }
  }
  EXPECT_NEAR(PMP::volume(SurfaceOf(b, 0)) + PMP::volume(SurfaceOf(b, 1)), 20 * 21 * 22, 1e-6);
  EXPECT_NEAR(PMP::volume(SurfaceOf(b, 1)) / CountVoxels(volume, 1), 1.0, 0.005);
}

// A density that says nothing about the segments, being noise, does not move the surface.
TEST(SegmentBoundary, IgnoresADensityWithoutContrast)
{
  SegmentVolume volume = BallVolume({ 41, 41, 42 }, Centre, 16.0);
  std::mt19937 random(3);
  for (float& density : volume.Density)
  {
    density = static_cast<float>(random() % 100);
  }
  BoundaryOptions options;
  const SegmentBoundary without = ComputeSegmentBoundary(volume.View(), options, Execution());
  options.Density = volume.Density.data();
  const SegmentBoundary with = ComputeSegmentBoundary(volume.View(), options, Execution());
  double largest = 0.0;
  for (std::size_t v = 0; v < with.Points.size(); ++v)
  {
    for (int a = 0; a < 3; ++a)
    {
      largest = std::max(largest, std::abs(with.Points[v][a] - without.Points[v][a]));
    }
  }
  EXPECT_LT(largest, 0.1); // a few iterations more of smoothing
}

TEST(SegmentBoundary, DoesNotDependOnThreads)
{
  SegmentVolume volume = RandomVolume({ 16, 12, 40 }, 4, 7);
  volume.Density.assign(volume.Labels.begin(), volume.Labels.end());
  BoundaryOptions options;
  options.Density = volume.Density.data();
  const SegmentBoundary one = ComputeSegmentBoundary(volume.View(), options, Execution());
  for (int threads : { 2, 3 })
  {
    const SegmentBoundary more =
      ComputeSegmentBoundary(volume.View(), options, ThreadedExecution(threads));
    EXPECT_EQ(one.Points, more.Points);
    EXPECT_EQ(one.Triangles, more.Triangles);
    EXPECT_EQ(one.Labels, more.Labels);
    EXPECT_EQ(one.Junctions, more.Junctions);
    EXPECT_EQ(PointNormals(one.Points, one.Triangles, Execution()),
      PointNormals(more.Points, more.Triangles, ThreadedExecution(threads)));
  }
}

TEST(SegmentBoundary, StopsWhenAsked)
{
  const SegmentVolume volume = BallVolume({ 41, 41, 42 }, Centre, 16.0);
  double last = 0.0;
  for (int allowed = 0; allowed < 30; allowed += 5)
  {
    Execution execution;
    int calls = 0;
    execution.Continue = [&](double done)
    {
      EXPECT_GE(done, 0.0);
      EXPECT_LE(done, 1.0);
      last = done;
      return ++calls <= allowed;
    };
    EXPECT_THROW(ComputeSegmentBoundary(volume.View(), {}, execution), Aborted);
  }
}
