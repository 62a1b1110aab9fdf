// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// What the gradients of a parameter should be, on the nodes of a box.
#ifndef trivariate_TargetField_h
#define trivariate_TargetField_h

#include "ParameterCells.h"

namespace trivariate
{
/// The wanted gradient at each node of a box; zero where it is not known.
using TargetField = std::vector<Eigen::Vector3d>;

/**
 * Row `axis` of the frames at the voxels of the segment; on the band the mean of the neighbours
 * that are closer to the segment. Throws std::invalid_argument where one is zero or not finite.
 */
TargetField FillTargets(
  const ParameterCells& cells, const ParameterVoxels& voxels, int axis, const Execution& execution);
}

#endif
