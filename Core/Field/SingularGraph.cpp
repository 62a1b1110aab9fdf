// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "SingularGraph.h"

#include <algorithm>
#include <map>

namespace trivariate
{
namespace
{
constexpr Index BlockSize = 4096;
// Blocks between two looks at the user's abort flag: below a second.
constexpr Index BlocksInARow = 256;

struct BlockResult
{
  Index Plaquettes = 0;
  std::vector<std::array<Index, 2>> Singular; // voxel, normal axis
};

// The voxels v, v + a, v + a + b, v + b; false unless all are in the segment.
bool VoxelsAround(
  const FrameVoxels& voxels, Index v, int normal, std::array<std::int32_t, 4>& around)
{
  const int a = 2 * ((normal + 1) % 3) + 1, b = 2 * ((normal + 2) % 3) + 1;
  around[0] = static_cast<std::int32_t>(v);
  around[1] = voxels.Neighbours[v][a];
  around[3] = voxels.Neighbours[v][b];
  around[2] = around[1] >= 0 ? voxels.Neighbours[around[1]][b] : -1;
  // Coarse levels can lack a pair although all four voxels are there.
  return around[2] >= 0 && around[3] >= 0 && voxels.Neighbours[around[3]][a] == around[2];
}

// Lines between points where not exactly two edges meet, then the closed ones.
std::vector<std::vector<Index>> JoinEdges(
  Index points, const std::vector<std::array<Index, 2>>& edges)
{
  std::vector<std::vector<Index>> at(points);
  for (std::size_t e = 0; e < edges.size(); ++e)
  {
    at[edges[e][0]].push_back(static_cast<Index>(e));
    at[edges[e][1]].push_back(static_cast<Index>(e));
  }
  std::vector<bool> used(edges.size(), false);
  std::vector<std::vector<Index>> lines;
  const auto follow = [&](Index point, Index edge)
  {
    std::vector<Index> line = { point };
    while (true)
    {
      used[edge] = true;
      point = edges[edge][0] == point ? edges[edge][1] : edges[edge][0];
      line.push_back(point);
      const std::vector<Index>& next = at[point];
      if (next.size() != 2 || (used[next[0]] && used[next[1]]))
      {
        break;
      }
      edge = used[next[0]] ? next[1] : next[0];
    }
    lines.push_back(std::move(line));
  };
  for (const bool closed : { false, true })
  {
    for (Index point = 0; point < points; ++point)
    {
      for (const Index edge : at[point])
      {
        if (!used[edge] && (closed || at[point].size() != 2))
        {
          follow(point, edge);
        }
      }
    }
  }
  return lines;
}
}

//------------------------------------------------------------------------------
SingularGraph FindSingularGraph(
  const FrameLevel& level, const FrameList& frames, bool boundary, const Execution& execution)
{
  const FrameVoxels& voxels = level.Voxels;
  const Index n = voxels.Count();
  std::vector<std::uint8_t> bound(n, 0);
  for (const FrameBound& b : level.Bounds)
  {
    bound[b.Voxel] = boundary ? 0 : 1;
  }
  std::vector<BlockResult> blocks((n + BlockSize - 1) / BlockSize);
  const auto visit = [&](Index number)
  {
    BlockResult& block = blocks[number];
    std::array<std::int32_t, 4> around;
    std::array<Frame, 4> corners;
    for (Index v = number * BlockSize; v < std::min(n, (number + 1) * BlockSize); ++v)
    {
      for (int normal = 0; normal < 3; ++normal)
      {
        if (!VoxelsAround(voxels, v, normal, around) ||
            std::any_of(
              around.begin(), around.end(), [&](std::int32_t i) { return bound[i] != 0; }))
        {
          continue;
        }
        for (int i = 0; i < 4; ++i)
        {
          corners[i] = frames[around[i]].cast<double>().toRotationMatrix();
        }
        ++block.Plaquettes;
        if (PlaquetteRotation(corners) != 0)
        {
          block.Singular.push_back({ v, normal });
        }
      }
    }
  };
  const Index count = static_cast<Index>(blocks.size());
  for (Index row = 0; row < count; row += BlocksInARow)
  {
    execution.Check(static_cast<double>(row) / static_cast<double>(count));
    execution.ParallelFor(std::min(BlocksInARow, count - row),
      [&](Index begin, Index end)
      {
        for (Index block = begin; block < end; ++block)
        {
          visit(row + block);
        }
      });
  }
  SingularGraph graph;
  std::map<std::array<Index, 3>, Index> cubes; // by the voxel at the low corner
  const auto pointAt = [&graph, &cubes](const std::array<Index, 3>& cube)
  {
    const auto [place, isNew] = cubes.insert({ cube, static_cast<Index>(graph.Points.size()) });
    if (isNew)
    {
      graph.Points.push_back({ cube[0] + 0.5, cube[1] + 0.5, cube[2] + 0.5 });
    }
    return place->second;
  };
  for (const BlockResult& block : blocks)
  {
    graph.Plaquettes += block.Plaquettes;
    for (const std::array<Index, 2>& singular : block.Singular)
    {
      const std::array<Index, 3> high = voxels.Place(singular[0]);
      std::array<Index, 3> low = high;
      --low[singular[1]];
      const Index from = pointAt(low), to = pointAt(high);
      graph.Edges.push_back({ from, to });
    }
  }
  graph.Lines = JoinEdges(static_cast<Index>(graph.Points.size()), graph.Edges);
  return graph;
}
}
