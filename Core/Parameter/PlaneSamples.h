// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// Points of the surface at which a parameter has the value of a lattice plane.
#ifndef trivariate_PlaneSamples_h
#define trivariate_PlaneSamples_h

#include "ParameterCells.h"

namespace trivariate
{
struct PlaneSample
{
  Index Cell;
  Eigen::Vector3d Local; ///< where in the cell, each in [0, 1]
  int Plane;             ///< place in PlaneSamples::Coordinates
  /// What it stands for in an integral over the surface, divided by the voxels' mean spacing; of a
  /// line, in an integral over its length. In units of the grid space.
  double Weight;

  /// The weights of the cell's corners.
  std::array<double, 8> CornerWeights() const;
};

struct PlaneSamples
{
  std::vector<int> Coordinates; ///< of the planes of an axis, ascending
  std::vector<PlaneSample> Samples;
};

/**
 * Samples of the triangles and lines of one axis, at most 0.7 voxels apart. Throws
 * std::invalid_argument where the axis has fewer than two planes.
 */
PlaneSamples SamplePlanes(const ParameterCells& cells, const ParameterSurface& surface, int axis);
}

#endif
