// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Search/FindDomain.h"
#include "Search/FlatPolycube.h"
#include "SegmentSurfaces.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>

using namespace trivariate;
using namespace trivariate_testing;

// Balls of 30 to 900 voxels with a rough surface: their flat parts are voxels.
TEST(FlatPolycube, TakesNoVoxelsForTheShape)
{
  int tried = 0;
  for (int seed = 0; seed < 60; ++seed)
  {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> roughness(-0.7, 0.7);
    const double radius = 2.5 + 0.06 * seed;
    const SegmentBoundary boundary = BoundaryOf({ 17, 17, 17 }, [&](int i, int j, int k)
      { return std::hypot(i - 8.0, j - 8.0, k - 8.0) < radius + roughness(random) ? 1 : 0; });
    const SurfaceMesh mesh = SurfaceOfSegment(boundary, 1);
    Index pieces = 0;
    mesh.Components(pieces);
    if (pieces == 1 && mesh.EulerCharacteristic() == 2)
    {
      ++tried;
      EXPECT_EQ(FindDomain(mesh, DomainOptions(), Execution()).Cubes.Cubes.size(), 1u) << seed;
    }
  }
  EXPECT_GT(tried, 15);
}

TEST(FlatPolycube, FindsSmallShapes)
{
  const Polycube shape = Polycube::FromGrid({ 2, 2, 1 }, { 1, 1, 1, 0 });
  for (const int voxels : { 6, 8, 20 })
  {
    const FlatPolycube found = FindFlatPolycube(RoundedSurfaceOf(shape, voxels), 64, Execution());
    EXPECT_EQ(found.Cubes.Cubes.size(), 3u) << voxels;
    EXPECT_EQ(found.Corners.size(), 16u) << voxels;
  }
}

TEST(FlatPolycube, Stops)
{
  const SurfaceMesh cross = SurfaceOf(Polycube({ { 1, 1, 0 }, { 0, 1, 1 }, { 1, 0, 1 }, { 1, 1, 1 },
                                        { 2, 1, 1 }, { 1, 2, 1 }, { 1, 1, 2 } }),
    8);
  int calls = 0;
  Execution execution;
  execution.Continue = [&calls](double done)
  {
    EXPECT_GE(done, 0.0);
    EXPECT_LE(done, 1.0);
    return ++calls < 20;
  };
  EXPECT_THROW(FindFlatPolycube(cross, 64, execution), Aborted);
  execution.Continue = [](double) { return true; };
  EXPECT_EQ(FindFlatPolycube(cross, 64, execution).Corners.size(), 32u);
  EXPECT_THROW(FindFlatPolycube(cross, 6, execution), std::runtime_error);
}
