// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * A structured grid of nodes in each block of a domain: x(u, v, w), trilinear in its cells. Blocks
 * that share a face, an edge or a point share its nodes.
 */
#ifndef trivariate_BlockMesh_h
#define trivariate_BlockMesh_h

#include "TSpline/TSpline.h"

#include <Eigen/Core>

#include <array>
#include <functional>
#include <vector>

namespace trivariate
{
/// The points of a block in VTK's order of a hexahedron. Blocks with the same points at a face, in
/// whatever order, are glued there.
using BlockPoints = std::array<Index, 8>;

/// Where corner i of a hexahedron is along an axis: 0 or 1.
constexpr int EndOfCorner(int i, int axis)
{
  return axis == 0 ? (i + 1) / 2 % 2 : axis == 1 ? i / 2 % 2 : i / 4;
}

/// The corner of a hexahedron at these ends of its axes.
constexpr int CornerAtEnds(int a, int b, int c)
{
  return 4 * c + (b ? 3 - a : a);
}

/// The corner of a hexahedron at the other end of an axis.
constexpr int AcrossAxis(int i, int axis)
{
  return axis == 0 ? i ^ 1 : axis == 1 ? i ^ 3 : i ^ 4;
}

/// The points of a face: its two other axes in ascending order, the first one fastest.
std::array<Index, 4> FacePoints(const BlockPoints& block, int axis, int side);

struct BlockMesh
{
  std::vector<std::array<int, 3>> Sizes; ///< cells of each block along its axes; glued faces agree
  std::vector<std::vector<Index>> Nodes; ///< of each block, its first axis fastest
  std::vector<Eigen::Vector3d> Places;   ///< of the nodes; those of the points of the domain first

  Index Node(Index block, int i, int j, int k) const
  {
    const std::array<int, 3>& n = this->Sizes[block];
    return this->Nodes[block][i + (n[0] + 1) * (j + (n[1] + 1) * k)];
  }

  /// The nodes of cell (i, j, k) in VTK's order of a hexahedron.
  BlockPoints Cell(Index block, int i, int j, int k) const
  {
    BlockPoints nodes;
    for (int corner = 0; corner < 8; ++corner)
    {
      nodes[corner] = this->Node(
        block, i + EndOfCorner(corner, 0), j + EndOfCorner(corner, 1), k + EndOfCorner(corner, 2));
    }
    return nodes;
  }

  Index NumberOfCells() const;

  /// Those of the face of a block: its two other axes in ascending order, the first one fastest.
  std::vector<Index> FaceNodes(Index block, int axis, int side) const;

  /// Those along an axis of a block, at these ends of its two other axes in ascending order.
  std::vector<Index> EdgeNodes(Index block, int axis, int firstEnd, int secondEnd) const;
};

/**
 * Cells of each block along its axes: as many for all edges that are parallel through glued blocks,
 * their mean length over `cell`, rounded, but `fewest` at least and 100,000 at most. `length`: of
 * an edge, by its points. O(n log n).
 */
std::vector<std::array<int, 3>> BlockSizes(const std::vector<BlockPoints>& blocks,
  const std::function<double(Index, Index)>& length, double cell, int fewest = 1);

/**
 * Nodes for blocks of these sizes. Nodes 0 to the number of points are the points, then come those
 * on edges, on faces and inside of blocks. Places are zero. Throws std::invalid_argument where
 * glued faces differ in their sizes, or a point is not in [0, points). O(n log n).
 */
BlockMesh NumberNodes(const std::vector<BlockPoints>& blocks, Index points,
  const std::vector<std::array<int, 3>>& sizes);
}

#endif
