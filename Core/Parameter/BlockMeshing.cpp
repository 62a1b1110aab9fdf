// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "BlockMeshing.h"

#include "BlockCells.h"
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

// Of the edges of cells along edges of blocks.
double MeanLength(const BlockDomain& domain, const Sizes& sizes)
{
  double length = 0.0, cells = 0.0;
  for (std::size_t b = 0; b < sizes.size(); ++b)
  {
    const BlockPoints& block = domain.Blocks[b];
    for (int axis = 0; axis < 3; ++axis)
    {
      for (int corner = 0; corner < 8; ++corner)
      {
        length += domain.EdgeLength(block[corner], block[AcrossAxis(corner, axis)]);
        cells += sizes[b][axis];
      }
    }
  }
  return length / cells;
}

// The axis across the layer that a block is: it has a patch on one side alone; or -1.
int AxisOfLayer(const BlockDomain& domain, const BlockPoints& block)
{
  int axis = -1, patches = 0;
  for (int face = 0; face < 6; ++face)
  {
    if (domain.PatchOn(FacePoints(block, face / 2, face % 2)) >= 0)
    {
      axis = face / 2;
      ++patches;
    }
  }
  return patches == 1 ? axis : -1;
}

// The lengths as they are; layers as deep as wanted at the finest level. All together they fill as
// much as before, or cells would press against the surface.
std::vector<Eigen::Vector3d> Targets(
  const BlockDomain& domain, const BlockMesh& mesh, const Sizes& finest, double layerCells)
{
  std::vector<Eigen::Vector3d> targets = CellTargets(mesh);
  double before = 0.0, after = 0.0;
  for (std::size_t b = 0; b < mesh.Sizes.size(); ++b)
  {
    const std::array<int, 3>& n = mesh.Sizes[b];
    const double cells = double(n[0]) * n[1] * n[2];
    before += cells * targets[b].prod();
    const int axis = AxisOfLayer(domain, domain.Blocks[b]);
    if (axis >= 0)
    {
      const double depth = layerCells * finest[b][axis] / n[axis];
      targets[b][axis] = std::max(targets[b][axis], depth);
    }
    after += cells * targets[b].prod();
  }
  for (Eigen::Vector3d& lengths : targets)
  {
    lengths *= std::cbrt(before / after);
  }
  return targets;
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
  const DomainSurface surface(domain, MeanLength(domain, levels[0]));
  BlockMesh mesh = StartOfBlockMesh(domain, maps, levels.back());
  SlidingNodes sliding(surface, mesh, options.Freedom, execution.Part(0.1, 0.1));
  BoundaryFit fit(surface, mesh);
  for (std::size_t level = levels.size(); level-- > 0;)
  {
    if (level + 1 < levels.size())
    {
      const BlockMesh coarse = std::move(mesh);
      mesh = Resampled(coarse, domain.Blocks, levels[level]);
      sliding = SlidingNodes(mesh, coarse, sliding);
      fit = BoundaryFit(mesh, fit);
    }
    // Each level is about eight times the work of the one before.
    const double end = std::pow(0.125, level);
    Repair(mesh, sliding, fit, Targets(domain, mesh, levels[0], options.LayerCells), options.Repair,
      execution.Part(0.1 + 0.9 * end / 8.0, 0.1 + 0.9 * end));
  }
  if (report)
  {
    report->Start = QualityOf(StartOfBlockMesh(domain, maps, levels[0]), execution);
    report->End = QualityOf(mesh, execution);
    report->Distances = DistancesOfFaces(domain, mesh, execution.Part(1.0, 1.0));
  }
  return mesh;
}

//------------------------------------------------------------------------------
BlockMesh RefineBlockMesh(const BlockDomain& domain, const BlockMesh& mesh,
  const BlockMeshOptions& options, const Execution& execution, BlockMeshReport* report)
{
  BlockMesh refined = Resampled(mesh, domain.Blocks, SizesOf(domain, options));
  // The borders that hold nodes are those that held them in the mesh, if it was made at its size.
  const DomainSurface surface(domain, MeanLength(domain, mesh.Sizes));
  BlockMesh start = mesh;
  const SlidingNodes slid(
    surface, start, options.Freedom, execution.Part(0.0, 0.1), SlidingNodes::WhereTheySlid);
  SlidingNodes sliding(refined, start, slid);
  BoundaryFit fitted(surface, start);
  fitted.Assign(start.Places, execution);
  BoundaryFit fit(refined, fitted);
  const CellQuality before = QualityOf(refined, execution);
  RepairOptions repair = options.Repair;
  repair.MostRounds = 1; // what folds stayed in the mesh would stay again
  repair.MostSmoothing = before.Inverted > 0 ? repair.MostSmoothing : 0;
  Repair(refined, sliding, fit, CellTargets(refined), repair, execution.Part(0.1, 1.0));
  if (report)
  {
    *report = { before, QualityOf(refined, execution),
      DistancesOfFaces(domain, refined, execution.Part(1.0, 1.0)) };
  }
  return refined;
}
}
