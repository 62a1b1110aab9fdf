// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Search/SurfaceReduction.h"
#include "SegmentSurfaces.h"

#include <gtest/gtest.h>

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
