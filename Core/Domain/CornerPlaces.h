// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// Corners of a polycube put on a surface.
#ifndef trivariate_CornerPlaces_h
#define trivariate_CornerPlaces_h

#include "LayoutMesh.h"
#include "Polycube.h"

namespace trivariate
{
/// "corner 3 at (1, 1, 0) of the polycube", for messages.
std::string CornerName(const Polycube& polycube, Index corner);

/// Throws std::invalid_argument where there are more or fewer places than corners, the places are
/// those of a mirrored polycube, or surface and polycube differ in their numbers of components or
/// handles.
void CheckCorners(
  const SurfaceMesh& mesh, const Polycube& polycube, const std::vector<Eigen::Vector3d>& corners);

/**
 * Points of the mesh where it is nearest to the corners: its own where these are near and free, or
 * new ones. `placed`: the points of corners that have one already, -1 for the others. Throws
 * std::invalid_argument, naming the corner, where one is farther than `farthest` or two are at one
 * place. O(n) a corner.
 */
std::vector<Index> PlaceCorners(LayoutMesh& mesh, const Polycube& polycube,
  const std::vector<Eigen::Vector3d>& corners, double farthest, std::vector<Index> placed);
}

#endif
