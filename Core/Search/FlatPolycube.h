// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// The polycube of a solid that is one itself, but for its lengths, rounded edges and some noise.
#ifndef trivariate_FlatPolycube_h
#define trivariate_FlatPolycube_h

#include "Domain/Polycube.h"
#include "Domain/SurfaceMesh.h"
#include "Execution.h"

namespace trivariate
{
struct FlatPolycube
{
  Polycube Cubes;
  std::vector<Eigen::Vector3d> Corners; ///< where its corners belong, on the surface or close to it
};

/**
 * Cuts space by the planes of all flat parts of the surface that look along one of three axes, and
 * takes the cells whose middles are inside. No more cells than needed: a long arm is one cube.
 * Parts smaller than some triangles, and planes nearer to each other than two edges, are steps of a
 * rough surface, not its shape.
 *
 * Throws std::runtime_error with the reason when there are more than `most` cubes, cubes touch at
 * edges only, or their boundary has not as many handles as the surface. Cost: linear for the axes,
 * n times the number of cells for the insides.
 */
FlatPolycube FindFlatPolycube(const SurfaceMesh& mesh, Index most, const Execution& execution);
}

#endif
