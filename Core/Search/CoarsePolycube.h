// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// Polycubes of a few cubes that fill a solid as well as so few can: branches, bends, steps.
#ifndef trivariate_CoarsePolycube_h
#define trivariate_CoarsePolycube_h

#include "Domain/Polycube.h"
#include "Domain/SurfaceMesh.h"
#include "Execution.h"

namespace trivariate
{
struct CoarsePolycube
{
  Polycube Cubes;
  std::vector<Eigen::Vector3d> Corners; ///< where they are as cuboids, near the surface
  double Misfit; ///< the volume that only one of cubes and solid have, in that of the solid
};

/**
 * Space is cut along the axes of a frame by planes, eight slabs along the longest axis, and planes
 * are moved to where cells are as full or as empty as can be. Then one plane after the other, the
 * one that is missed least, is taken away; the other planes are tried, too. Each time the full
 * cells that are a topological ball (CellShape.h) are a polycube; no two slabs in it are the same.
 * Those are returned that fit better than all with as many corners or fewer, the fewest corners
 * first.
 *
 * Rows of `frame`: the axes. A surface that is a sphere's equal. O(n + 1e6).
 */
std::vector<CoarsePolycube> FindCoarsePolycubes(const SurfaceMesh& mesh,
  const Eigen::Matrix3d& frame, Index mostCubes, const Execution& execution);
}

#endif
