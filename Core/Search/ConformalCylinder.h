// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * A surface without handles, laid out on an infinite cylinder between two of its points.
 *
 * Height is the Green's function of the surface's Laplacian with a source at one point and a sink
 * at the other, Angle its conjugate: together the logarithm of the conformal map to the sphere, but
 * as even as that is uneven where a shape is long, bent or waisted. A harmonic function with two
 * poles on a sphere has no saddle, so all its level lines are single closed curves, and those of
 * the angle run from pole to pole.
 */
#ifndef trivariate_ConformalCylinder_h
#define trivariate_ConformalCylinder_h

#include "Domain/SurfaceMesh.h"
#include "Execution.h"

#include <memory>

namespace trivariate
{
struct CylinderCoordinates
{
  std::vector<double> Height; ///< ascends from `low` to `high`; 2 pi a full turn's length
  std::vector<double> Angle;  ///< in [0, 2 pi), anticlockwise seen from outside at the high end;
                              ///< 0 on the steepest edge at `low`
};

/// The Laplacian of a surface, factorised once for all pairs of poles. Throws std::runtime_error if
/// that fails. Cost: a sparse Cholesky factorisation (5e5 triangles: some seconds).
class ConformalCylinder
{
public:
  ConformalCylinder(const SurfaceMesh& mesh, const Execution& execution);
  ~ConformalCylinder();

  CylinderCoordinates Map(Index low, Index high) const;

private:
  struct Laplacian;
  const SurfaceMesh& Mesh;
  std::unique_ptr<Laplacian> Operator;
};
}

#endif
