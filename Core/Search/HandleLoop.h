// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef trivariate_HandleLoop_h
#define trivariate_HandleLoop_h

#include "Domain/SurfaceMesh.h"

namespace trivariate
{
struct HandleLoop
{
  Eigen::Vector3d Place; ///< one of its points
  double Length = 0.0;   ///< along edges; 0 where the surface has no handle
};

/**
 * A short loop around a handle or through its hole, of a connected surface: the shortest through
 * one point (greedy homotopy generators of Erickson and Whittlesey, "Greedy optimal homotopy and
 * homology generators", SODA 2005), then through a point of that one, until that is no shorter. To
 * tell a user where a handle is. O(n log n) a round.
 */
HandleLoop FindHandle(const SurfaceMesh& mesh);
}

#endif
