// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Domain/Polycube.h"
#include "Parameter/BlockMesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <stdexcept>

using namespace trivariate;

namespace
{
using Eigen::Vector3d;

// The block with its axes exchanged and turned round: one of all 48 ways.
BlockPoints Reordered(const BlockPoints& block, std::mt19937& random)
{
  std::array<int, 3> axes{ 0, 1, 2 }, flips;
  std::shuffle(axes.begin(), axes.end(), random);
  std::generate(flips.begin(), flips.end(), [&random]() { return int(random() % 2); });
  BlockPoints reordered;
  for (int corner = 0; corner < 8; ++corner)
  {
    std::array<int, 3> ends;
    for (int axis = 0; axis < 3; ++axis)
    {
      ends[axes[axis]] = EndOfCorner(corner, axis) ^ flips[axis];
    }
    reordered[corner] = block[CornerAtEnds(ends[0], ends[1], ends[2])];
  }
  return reordered;
}

Vector3d At(const Polycube& cubes, const BlockPoints& block, const Vector3d& uvw)
{
  Vector3d place = Vector3d::Zero();
  for (int corner = 0; corner < 8; ++corner)
  {
    double weight = 1.0;
    for (int axis = 0; axis < 3; ++axis)
    {
      weight *= EndOfCorner(corner, axis) ? uvw[axis] : 1.0 - uvw[axis];
    }
    const LatticePoint& p = cubes.Points[block[corner]];
    place += weight * Vector3d(2.0 * p[0], 3.0 * p[1], 5.0 * p[2]);
  }
  return place;
}

double LengthOf(const Polycube& cubes, Index a, Index b)
{
  const LatticePoint &p = cubes.Points[a], &q = cubes.Points[b];
  return std::abs(2.0 * (p[0] - q[0]) + 3.0 * (p[1] - q[1]) + 5.0 * (p[2] - q[2]));
}
}

TEST(BlockMesh, SharesNodesWhicheverWayBlocksLie)
{
  std::mt19937 random(7);
  const Polycube cubes = Polycube::FromGrid({ 2, 3, 2 }, { 1, 1, 1, 0, 1, 1, 1, 0, 1, 0, 1, 1 });
  for (int round = 0; round < 20; ++round)
  {
    std::vector<BlockPoints> blocks;
    for (const BlockPoints& cube : cubes.CubePoints)
    {
      blocks.push_back(Reordered(cube, random));
    }
    const auto sizes = BlockSizes(
      blocks, [&cubes](Index a, Index b) { return LengthOf(cubes, a, b); }, 0.99);
    const Index points = static_cast<Index>(cubes.Points.size());
    const BlockMesh mesh = NumberNodes(blocks, points, sizes);
    EXPECT_EQ(mesh.NumberOfCells(), Index(cubes.Cubes.size()) * 2 * 3 * 5);

    // One number for one place, and the other way round.
    std::map<std::array<int, 3>, Index> numberAt;
    for (std::size_t b = 0; b < blocks.size(); ++b)
    {
      const auto& n = mesh.Sizes[b];
      for (int k = 0; k <= n[2]; ++k)
      {
        for (int j = 0; j <= n[1]; ++j)
        {
          for (int i = 0; i <= n[0]; ++i)
          {
            const Vector3d place =
              At(cubes, blocks[b], Vector3d(double(i) / n[0], double(j) / n[1], double(k) / n[2]));
            const std::array<int, 3> key{ int(std::lround(place[0])), int(std::lround(place[1])),
              int(std::lround(place[2])) };
            const Index node = mesh.Node(b, i, j, k);
            EXPECT_EQ(numberAt.emplace(key, node).first->second, node);
          }
        }
      }
    }
    EXPECT_EQ(numberAt.size(), mesh.Places.size());
    std::vector<char> seen(mesh.Places.size(), 0);
    for (const auto& [key, node] : numberAt)
    {
      EXPECT_FALSE(seen[node]);
      seen[node] = 1;
    }
    for (std::size_t b = 0; b < blocks.size(); ++b)
    {
      const auto& n = mesh.Sizes[b];
      for (int corner = 0; corner < 8; ++corner)
      {
        EXPECT_EQ(mesh.Node(b, EndOfCorner(corner, 0) * n[0], EndOfCorner(corner, 1) * n[1],
                    EndOfCorner(corner, 2) * n[2]),
          blocks[b][corner]);
      }
    }
  }
}

TEST(BlockMesh, GivesFacesAndEdgesAsGrids)
{
  const std::vector<BlockPoints> blocks{ { 0, 1, 2, 3, 4, 5, 6, 7 } };
  const BlockMesh mesh = NumberNodes(blocks, 8, { { 2, 3, 4 } });
  const std::vector<Index> face = mesh.FaceNodes(0, 1, 1);
  ASSERT_EQ(face.size(), 15u);
  EXPECT_EQ(face[0], 3);
  EXPECT_EQ(face[2], 2);
  EXPECT_EQ(face[14], 6);
  EXPECT_EQ(face[1 + 3 * 2], mesh.Node(0, 1, 3, 2));
  const std::vector<Index> edge = mesh.EdgeNodes(0, 2, 1, 0);
  ASSERT_EQ(edge.size(), 5u);
  EXPECT_EQ(edge[0], 1);
  EXPECT_EQ(edge[4], 5);
  EXPECT_EQ(edge[3], mesh.Node(0, 2, 0, 3));
  const BlockPoints cell = mesh.Cell(0, 1, 2, 3);
  EXPECT_EQ(cell[0], mesh.Node(0, 1, 2, 3));
  EXPECT_EQ(cell[2], mesh.Node(0, 2, 3, 3));
  EXPECT_EQ(cell[7], mesh.Node(0, 1, 3, 4));
}

TEST(BlockMesh, TakesTheMeanOfParallelEdges)
{
  // Two blocks side by side: their common axes agree, the third ones are their own.
  const std::vector<BlockPoints> blocks{ { 0, 1, 2, 3, 4, 5, 6, 7 }, { 1, 8, 9, 2, 5, 10, 11, 6 } };
  const auto length = [](Index a, Index b) {
    return a + b == 1 ? 10.0 : std::max(a, b) < 8 ? 6.0 : std::min(a, b) >= 8 ? 12.0 : 2.0;
  };
  const auto sizes = BlockSizes(blocks, length, 1.0);
  EXPECT_EQ(sizes[0], (std::array<int, 3>{ 7, 8, 8 })); // (10 + 3 * 6) / 4, (4 * 6 + 2 * 12) / 6
  EXPECT_EQ(sizes[1], (std::array<int, 3>{ 2, 8, 8 }));
  EXPECT_EQ(BlockSizes(blocks, length, 100.0, 3)[1], (std::array<int, 3>{ 3, 3, 3 }));
}

TEST(BlockMesh, RefusesWhatDoesNotFit)
{
  const std::vector<BlockPoints> blocks{ { 0, 1, 2, 3, 4, 5, 6, 7 }, { 1, 8, 9, 2, 5, 10, 11, 6 } };
  EXPECT_THROW(NumberNodes(blocks, 12, { { 2, 2, 2 }, { 2, 2, 3 } }), std::invalid_argument);
  EXPECT_THROW(NumberNodes(blocks, 11, { { 2, 2, 2 }, { 2, 2, 2 } }), std::invalid_argument);
}
