// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The trilinear cells of a segment: each between eight voxels, whole or cut by the surface.
 *
 * They lie in a box of voxels, its nodes, with two layers of room around the segment: the band and
 * one that is never used. Cells are numbered by their low node. Places in the box are counted in
 * voxels from its first node.
 */
#ifndef trivariate_ParameterCells_h
#define trivariate_ParameterCells_h

#include "InsideShares.h"
#include "VoxelParameter.h"

namespace trivariate
{
constexpr std::int32_t WholeCell = -1;  ///< in place of a cut cell's number: inside the surface
constexpr std::int32_t UnusedCell = -2; ///< in place of a cut cell's number: not a cell

struct ParameterCells
{
  std::array<Index, 3> Low = { 0, 0, 0 };  ///< voxel of the first node
  std::array<Index, 3> Size = { 0, 0, 0 }; ///< nodes
  Eigen::Vector3d Spacing = Eigen::Vector3d::Ones();
  std::vector<std::int32_t> Cut; ///< of each cell: WholeCell, UnusedCell or its place in CutCells
  std::vector<CellOctants> CutCells; ///< with shares of at least .03
  std::vector<std::uint8_t> Known;   ///< of each node: 2 in the segment, 1 in the band, 0 else

  Index Nodes() const { return this->Size[0] * this->Size[1] * this->Size[2]; }

  Index NodeAt(Index i, Index j, Index k) const
  {
    return i + this->Size[0] * (j + this->Size[1] * k);
  }

  /// The corner c (dx + 2 dy + 4 dz) of a cell.
  Index Corner(Index cell, int c) const
  {
    return cell + (c & 1) + this->Size[0] * ((c >> 1 & 1) + this->Size[1] * (c >> 2));
  }

  /// From grid space to the box.
  Eigen::Vector3d PlaceOf(const Eigen::Vector3d& point) const
  {
    return point.cwiseQuotient(this->Spacing) -
           Eigen::Vector3d(double(this->Low[0]), double(this->Low[1]), double(this->Low[2]));
  }

  /// The cell that a place is in, and where in it, each in [0, 1].
  Index CellOf(const Eigen::Vector3d& place, Eigen::Vector3d& local) const;
};

/// The box alone. Throws std::invalid_argument where there is no segment, or the surface goes
/// elsewhere.
ParameterCells BoxOfCells(const ParameterVoxels& voxels, const ParameterSurface& surface);

/**
 * Finds the cells: those that have a corner in the segment or a part inside the surface, and those
 * in `sampled`, which count as cut whatever their shares. Throws std::invalid_argument where the
 * cells do not hang together, or the surface does not bound the segment.
 */
void FindCells(const ParameterVoxels& voxels, const ParameterSurface& surface,
  const std::vector<Index>& sampled, ParameterCells& cells, const Execution& execution);
}

#endif
