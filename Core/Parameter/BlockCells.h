// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// The hexahedra of a block mesh as one list, and how they should look.
#ifndef trivariate_BlockCells_h
#define trivariate_BlockCells_h

#include "BlockMesh.h"

namespace trivariate
{
class BlockCells
{
public:
  /// A hexahedron around a node, and which of its corners the node is.
  struct Use
  {
    Index Cell;
    int Corner;
  };

  explicit BlockCells(const BlockMesh& mesh);

  const Use* UsesBegin(Index node) const { return this->Uses.data() + this->UseStart[node]; }
  const Use* UsesEnd(Index node) const { return this->Uses.data() + this->UseStart[node + 1]; }

  std::vector<BlockPoints> Cells;
  std::vector<Index> BlockOf;              ///< of each cell
  std::vector<std::vector<Index>> Colours; ///< nodes, no two of one colour in one cell

private:
  void FindUses(Index nodes);
  void FindColours(Index nodes);

  std::vector<Use> Uses;
  std::vector<Index> UseStart;
};

/**
 * The wanted lengths of a block's cells along its axes: their means as they are, scaled so that the
 * cells fill the volume of the block. O(n).
 */
std::vector<Eigen::Vector3d> CellTargets(const BlockMesh& mesh);

/// How the weight of a corner in the trilinear map changes along (u, v, w).
Eigen::Vector3d ShapeGradient(int corner, const Eigen::Vector3d& at);

/// d x / d (u, v, w) of the trilinear map.
Eigen::Matrix3d JacobianAt(
  const std::vector<Eigen::Vector3d>& places, const BlockPoints& cell, const Eigen::Vector3d& at);

/// The volume of a trilinear hexahedron, exactly.
double HexahedronVolume(const std::vector<Eigen::Vector3d>& places, const BlockPoints& cell);

/// Point i of the 3 x 3 x 3 Gauss points.
Eigen::Vector3d GaussPoint(int i);

/// The least determinant of the trilinear map at the corners of a hexahedron and at its 3 x 3 x 3
/// Gauss points.
double LeastDeterminant(const std::vector<Eigen::Vector3d>& places, const BlockPoints& cell);

/// The mesh at other sizes: nodes where the trilinear map has them, evenly spaced in each block.
BlockMesh Resampled(const BlockMesh& mesh, const std::vector<BlockPoints>& blocks,
  const std::vector<std::array<int, 3>>& sizes);
}

#endif
