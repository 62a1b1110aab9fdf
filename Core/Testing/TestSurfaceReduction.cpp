// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Domain/SurfaceReduction.h"
#include "SegmentSurfaces.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace trivariate;
using namespace trivariate_testing;

namespace
{
double VolumeOf(const SurfaceMesh& mesh)
{
  double sum = 0.0;
  for (Index t = 0; t < mesh.NumberOfTriangles(); ++t)
  {
    sum += mesh.Points[mesh.Triangles[t][0]].dot(mesh.AreaVector(t)) / 3.0;
  }
  return sum;
}

TEST(SurfaceReduction, KeepsVolumeAndHandles)
{
  const SurfaceMesh ball = Icosphere(5);
  const SurfaceMesh frame =
    RoundedSurfaceOf(Polycube::FromGrid({ 3, 3, 1 }, { 1, 1, 1, 1, 0, 1, 1, 1, 1 }), 12);
  for (const SurfaceMesh* mesh : { &ball, &frame })
  {
    const SurfaceMesh less = Reduced(*mesh, 1000, Execution());
    EXPECT_LE(less.NumberOfTriangles(), 1000);
    EXPECT_GT(less.NumberOfTriangles(), 990);
    EXPECT_EQ(less.EulerCharacteristic(), mesh->EulerCharacteristic());
    EXPECT_NEAR(VolumeOf(less) / VolumeOf(*mesh), 1.0, 0.02);
  }
}

TEST(SurfaceReduction, TellsWhatBecameOfWhat)
{
  const SurfaceMesh ball = Icosphere(5);
  const ReducedSurface less = Reduce(ball, 1000, Execution());
  ASSERT_EQ(static_cast<Index>(less.Points.size()), less.Mesh.NumberOfPoints());
  for (std::size_t p = 0; p < less.Points.size(); ++p)
  {
    EXPECT_EQ(less.Mesh.Points[p], ball.Points.at(less.Points[p]));
  }
  ASSERT_EQ(less.TriangleFor.size(), ball.Triangles.size());
  for (std::size_t t = 0; t < ball.Triangles.size(); ++t)
  {
    const Eigen::Vector3d& before = ball.Points[ball.Triangles[t][0]];
    double nearest = 2.0;
    for (const Index p : less.Mesh.Triangles.at(less.TriangleFor[t]))
    {
      nearest = std::min(nearest, (less.Mesh.Points[p] - before).norm());
    }
    EXPECT_LT(nearest, 0.3);
  }
}

TEST(SurfaceReduction, EndsWhereNothingCanBeTaken)
{
  EXPECT_EQ(Reduced(Icosphere(0), 100, Execution()).NumberOfTriangles(), 20);
  const SurfaceMesh least = Reduced(Icosphere(3), 4, Execution());
  EXPECT_EQ(least.EulerCharacteristic(), 2);
  EXPECT_LT(least.NumberOfTriangles(), 30);
}

TEST(SurfaceReduction, Stops)
{
  Execution execution;
  execution.Continue = [](double) { return false; };
  EXPECT_THROW(Reduced(Icosphere(4), 100, execution), Aborted);
}
}
