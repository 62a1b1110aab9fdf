// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// The block mesh of a domain: the inverse x(u, v, w) of its parameterization.
#ifndef trivariate_BlockMeshing_h
#define trivariate_BlockMeshing_h

#include "BlockRepair.h"
#include "SurfaceDistance.h"

namespace trivariate
{
struct BlockMeshOptions
{
  double CellLength = 0.0; ///< wanted, in space
  int FewestCells = 2;     ///< along an edge of a block
  int CellsPerBlock = 0;   ///< along each edge, whatever its length; 0: CellLength decides
  double Freedom = 0.0;    ///< how far nodes may leave the surface, in space
  double LayerCells = 0.0; ///< cells of layers are wanted to be this deep at least, in space
  RepairOptions Repair;
};

struct BlockMeshReport
{
  CellQuality Start; ///< the mesh interpolated at once at the wanted resolution
  CellQuality End;
  SurfaceDistances Distances; ///< of the mesh in the end
};

/// Cells of each block.
std::vector<std::array<int, 3>> SizesOf(const BlockDomain& domain, const BlockMeshOptions& options);

double CountCells(const std::vector<std::array<int, 3>>& sizes);

/**
 * Interpolated (BlockStart.h) at a coarse resolution, repaired, refined to twice as many cells
 * along each edge and repaired again, until cells are as long as wanted.
 */
BlockMesh MakeBlockMesh(const BlockDomain& domain, const BlockMeshOptions& options,
  const Execution& execution, BlockMeshReport* report = nullptr);

/// A mesh of the domain at another resolution, nodes on the surface where they slid: at its own
/// resolution the same. Untangled, in one round, where new nodes on the surface fold cells.
BlockMesh RefineBlockMesh(const BlockDomain& domain, const BlockMesh& mesh,
  const BlockMeshOptions& options, const Execution& execution, BlockMeshReport* report = nullptr);
}

#endif
