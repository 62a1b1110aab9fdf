// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// Where points are in a block mesh: the parameterization (u, v, w)(x), inverse of x(u, v, w).
#ifndef trivariate_BlockLocation_h
#define trivariate_BlockLocation_h

#include "BlockMesh.h"
#include "Execution.h"

namespace trivariate
{
struct BlockLocation
{
  Index Block = -1;                                    ///< -1: too far outside of the mesh
  Eigen::Vector3d Parameter = Eigen::Vector3d::Zero(); ///< in the block's unit cube
  double Distance = 0.0; ///< from the place of the parameter, 0 inside of the mesh
};

/**
 * The block of each point, one of `blocks`, and its parameter there, in [0, 1]^3. Inside of the
 * blocks a cell whose trilinear map reaches the point; outside, up to `farthest`, the nearest place
 * that was found on the cells near the point. O(n log n), the same whatever the number of threads.
 */
std::vector<BlockLocation> LocateInBlocks(const BlockMesh& mesh, const std::vector<Index>& blocks,
  const std::vector<Eigen::Vector3d>& points, double farthest, const Execution& execution);

/// x(u, v, w), trilinear in the cell of the parameter, which is in the unit cube of the block.
Eigen::Vector3d PlaceInBlock(const BlockMesh& mesh, Index block, const Eigen::Vector3d& parameter);
}

#endif
