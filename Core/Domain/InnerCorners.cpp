// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "InnerCorners.h"

#include "TriangleTree.h"

#include <algorithm>

namespace trivariate
{
namespace
{
using Eigen::Vector3d;

constexpr double LeastDepth = 0.4; // of the depth at first; steps are at most half of it
constexpr double FirstStep = 0.5;  // of the depth at first
constexpr int Halvings = 5;
constexpr int MostRounds = 20;
constexpr double Enough = 0.1; // a block as good as that is left alone
constexpr double Flat = 1e-3;  // a block no better than that is flat at a corner

// What the blocks around a corner lack of being good enough.
double LackOf(const DomainBlocks& blocks, const std::vector<std::size_t>& around)
{
  double lack = 0.0;
  for (const std::size_t b : around)
  {
    lack += std::max(0.0, Enough - ScaledJacobian(blocks.Places, blocks.Blocks[b].Points));
  }
  return lack;
}

// Whether the corner found a better place.
bool MoveCorner(DomainBlocks& blocks, Index point, const std::vector<std::size_t>& around,
  double depth, const TriangleTree& tree)
{
  double lack = LackOf(blocks, around);
  bool moved = false;
  double step = FirstStep * depth;
  for (int halving = 0; halving < Halvings && lack > 0.0; ++halving, step *= 0.5)
  {
    const Vector3d start = blocks.Places[point];
    Vector3d best = start;
    for (int i = 0; i < 27; ++i)
    {
      const Vector3d direction(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
      const Vector3d place = start + step * direction.normalized();
      blocks.Places[point] = place;
      const double there = LackOf(blocks, around);
      if (there < lack && tree.Nearest(place).Distance >= LeastDepth * depth)
      {
        lack = there;
        best = place;
        moved = true;
      }
    }
    blocks.Places[point] = best;
  }
  return moved;
}
}

//------------------------------------------------------------------------------
std::vector<std::size_t> InvertedBlocks(const DomainBlocks& blocks)
{
  std::vector<std::size_t> inverted;
  for (std::size_t b = 0; b < blocks.Blocks.size(); ++b)
  {
    if (!(ScaledJacobian(blocks.Places, blocks.Blocks[b].Points) > Flat))
    {
      inverted.push_back(b);
    }
  }
  return inverted;
}

//------------------------------------------------------------------------------
void UntangleInnerCorners(DomainBlocks& blocks, const SurfaceLayout& layout,
  const std::vector<Index>& corners, const std::vector<double>& depths)
{
  std::vector<std::size_t> inverted = InvertedBlocks(blocks);
  if (inverted.empty())
  {
    return;
  }
  const TriangleTree tree(layout.Points, layout.Triangles);
  std::vector<std::vector<std::size_t>> around(blocks.Places.size());
  for (std::size_t b = 0; b < blocks.Blocks.size(); ++b)
  {
    for (const Index point : blocks.Blocks[b].Points)
    {
      around[point].push_back(b);
    }
  }
  bool moved = true;
  for (int round = 0; round < MostRounds && moved && !inverted.empty(); ++round)
  {
    std::vector<char> tangled(blocks.Places.size(), 0);
    for (const std::size_t b : inverted)
    {
      for (const Index point : blocks.Blocks[b].Points)
      {
        tangled[point] = 1;
      }
    }
    moved = false;
    for (std::size_t corner = 0; corner < corners.size(); ++corner)
    {
      const Index point = corners[corner];
      moved |= tangled[point] && MoveCorner(blocks, point, around[point], depths[corner], tree);
    }
    inverted = InvertedBlocks(blocks);
  }
}
}
