// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Parameter/BlockLocation.h"
#include "ThreadedExecution.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace trivariate;

namespace
{
using Eigen::Vector3d;

// A quarter of a thick ring bent out of two blocks, the second one turned round.
BlockMesh QuarterRing(int n)
{
  const std::vector<BlockPoints> blocks{ { 0, 1, 2, 3, 4, 5, 6, 7 }, { 6, 5, 1, 2, 10, 9, 8, 11 } };
  BlockMesh mesh = NumberNodes(blocks, 12, { { n, n, n }, { n, n, n } });
  for (int b = 0; b < 2; ++b)
  {
    for (int k = 0; k <= n; ++k)
    {
      for (int j = 0; j <= n; ++j)
      {
        for (int i = 0; i <= n; ++i)
        {
          const double u = double(i) / n, v = double(j) / n, w = double(k) / n;
          const double along = b == 0 ? 0.5 * u : 0.5 + 0.5 * w;
          const double across = b == 0 ? v : 1.0 - u, up = b == 0 ? w : 1.0 - v;
          const double angle = 0.5 * M_PI * (1.0 - along);
          mesh.Places[mesh.Node(b, i, j, k)] =
            Vector3d((1.0 + across) * std::cos(angle), (1.0 + across) * std::sin(angle), up);
        }
      }
    }
  }
  return mesh;
}
}

TEST(BlockLocation, InvertsTheMapOfTheMesh)
{
  const BlockMesh mesh = QuarterRing(5);
  std::mt19937 random(2);
  std::uniform_real_distribution<double> number(0.0, 1.0);
  std::vector<Vector3d> parameters, points;
  std::vector<Index> blocks;
  for (int i = 0; i < 2000; ++i)
  {
    Vector3d t(number(random), number(random), number(random));
    if (i % 4 == 0)
    {
      t[i / 4 % 3] = i / 12 % 6 / 5.0; // on faces between cells, between blocks and outside
    }
    blocks.push_back(i % 2);
    parameters.push_back(t);
    points.push_back(PlaceInBlock(mesh, blocks.back(), t));
  }
  const std::vector<BlockLocation> found = LocateInBlocks(mesh, { 0, 1 }, points, 0.1, Execution());
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    ASSERT_GE(found[i].Block, 0);
    EXPECT_EQ(found[i].Distance, 0.0);
    EXPECT_LT((PlaceInBlock(mesh, found[i].Block, found[i].Parameter) - points[i]).norm(), 1e-8);
    if (found[i].Block == blocks[i])
    {
      EXPECT_LT((found[i].Parameter - parameters[i]).norm(), 1e-7);
    }
    else
    {
      EXPECT_TRUE(blocks[i] == 0 ? parameters[i][0] > 1.0 - 1e-9 : parameters[i][2] < 1e-9);
    }
  }
  const std::vector<BlockLocation> threaded =
    LocateInBlocks(mesh, { 0, 1 }, points, 0.1, ThreadedExecution(3));
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    EXPECT_EQ(threaded[i].Block, found[i].Block);
    EXPECT_EQ(threaded[i].Parameter, found[i].Parameter);
  }
}

TEST(BlockLocation, TakesTheNearestPlaceOutside)
{
  const BlockMesh mesh = QuarterRing(8);
  const std::vector<Vector3d> points{ { 1.0, 1.0, 1.2 }, { -0.1, 1.5, 0.5 }, { 1.5, -0.2, -0.2 },
    { 0.0, 0.0, 0.5 }, { 1.7, 1.7, 0.5 } };
  const std::vector<BlockLocation> near = LocateInBlocks(mesh, { 0, 1 }, points, 0.3, Execution());
  EXPECT_NEAR(near[0].Distance, 0.2, 1e-9);
  EXPECT_EQ(near[1].Block, 0);
  EXPECT_NEAR(near[1].Distance, 0.1, 1e-9);
  EXPECT_NEAR(near[1].Parameter[0], 0.0, 1e-9);
  EXPECT_NEAR(near[1].Parameter[1], 0.5, 1e-7);
  EXPECT_EQ(near[2].Block, 1);
  EXPECT_NEAR(near[2].Distance, 0.2 * std::sqrt(2.0), 1e-9);
  EXPECT_EQ(near[3].Block, -1); // 1 away
  EXPECT_EQ(near[4].Block, -1); // 0.4 away

  // Of block 0 alone: its end, next to a place in block 1.
  const Vector3d place = PlaceInBlock(mesh, 1, { 0.6, 0.4, 0.05 });
  const BlockLocation other = LocateInBlocks(mesh, { 0 }, { place }, 1.0, Execution())[0];
  EXPECT_EQ(other.Block, 0);
  EXPECT_NEAR(other.Parameter[0], 1.0, 1e-9);
  EXPECT_GT(other.Distance, 0.01);
  EXPECT_NEAR(other.Distance, (PlaceInBlock(mesh, 0, other.Parameter) - place).norm(), 1e-9);
}
