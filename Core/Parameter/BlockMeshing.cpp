// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "BlockMeshing.h"

#include "BlockStart.h"

#include <algorithm>
#include <cmath>

namespace trivariate
{
namespace
{
using Sizes = std::vector<std::array<int, 3>>;

constexpr int CoarsestCells = 4; // along the longest edge

int Longest(const Sizes& sizes)
{
  int longest = 1;
  for (const std::array<int, 3>& n : sizes)
  {
    longest = std::max(longest, *std::max_element(n.begin(), n.end()));
  }
  return longest;
}

Sizes Halved(Sizes sizes)
{
  for (std::array<int, 3>& n : sizes)
  {
    for (int& cells : n)
    {
      cells = (cells + 1) / 2;
    }
  }
  return sizes;
}
}

//------------------------------------------------------------------------------
Sizes SizesOf(const BlockDomain& domain, const BlockMeshOptions& options)
{
  if (options.CellsPerBlock > 0)
  {
    const int n = options.CellsPerBlock;
    return Sizes(domain.Blocks.size(), { n, n, n });
  }
  return BlockSizes(
    domain.Blocks, [&domain](Index a, Index b) { return domain.EdgeLength(a, b); },
    options.CellLength, options.FewestCells);
}

double CountCells(const Sizes& sizes)
{
  double cells = 0.0;
  for (const std::array<int, 3>& n : sizes)
  {
    cells += double(n[0]) * n[1] * n[2];
  }
  return cells;
}

//------------------------------------------------------------------------------
BlockMesh MakeBlockMesh(const BlockDomain& domain, const BlockMeshOptions& options,
  const Execution& execution, BlockMeshReport* report)
{
  std::vector<Sizes> levels{ SizesOf(domain, options) };
  while (Longest(levels.back()) > CoarsestCells)
  {
    levels.push_back(Halved(levels.back()));
  }
  const std::vector<PatchMap> maps = MapPatches(domain, execution.Part(0.0, 0.1));
  BlockMesh mesh;
  for (std::size_t level = levels.size(); level-- > 0;)
  {
    const BlockMesh start = StartOfBlockMesh(domain, maps, levels[level]);
    const SlidingNodes sliding(domain, start);
    mesh = mesh.Places.empty() ? start : Resampled(mesh, domain.Blocks, levels[level]);
    sliding.SendHome(mesh.Places);
    // Each level is about eight times the work of the one before.
    const double end = std::pow(0.125, level);
    Repair(mesh, sliding, CellTargets(mesh), options.Repair,
      execution.Part(0.1 + 0.9 * end / 8.0, 0.1 + 0.9 * end));
    if (report && level == 0)
    {
      report->Start = QualityOf(start, execution);
      report->End = QualityOf(mesh, execution);
    }
  }
  return mesh;
}

//------------------------------------------------------------------------------
BlockMesh RefineBlockMesh(const BlockDomain& domain, const BlockMesh& mesh,
  const BlockMeshOptions& options, const Execution& execution, BlockMeshReport* report)
{
  BlockMesh refined = Resampled(mesh, domain.Blocks, SizesOf(domain, options));
  const SlidingNodes onSurface(domain, refined);
  for (std::size_t node = 0; node < refined.Places.size(); ++node)
  {
    refined.Places[node] = onSurface.Allowed(static_cast<Index>(node), refined.Places[node]);
  }
  const CellQuality before = QualityOf(refined, execution);
  RepairOptions repair = options.Repair;
  repair.MostSmoothing = before.Inverted > 0 ? repair.MostSmoothing : 0;
  Repair(refined, SlidingNodes(domain, refined), CellTargets(refined), repair, execution);
  if (report)
  {
    *report = { before, QualityOf(refined, execution) };
  }
  return refined;
}
}
