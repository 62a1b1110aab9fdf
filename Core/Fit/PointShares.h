// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * How many of the control points each part of a volume needs.
 */
#ifndef trivariate_PointShares_h
#define trivariate_PointShares_h

#include "Execution.h"

#include <array>
#include <cstdint>
#include <vector>

namespace trivariate
{
/**
 * Shares that sum to one, of each part of a grid in parts[voxel] (0 to count - 1). A part gets them
 * by its content, the sum over its voxels of how far a value is from the mean of its two neighbours
 * along an axis (both in the same part; the three axes summed), and a tenth by its number of
 * voxels. Without any content by its voxels alone. One pass, O(voxels).
 */
std::vector<double> PointShares(const std::array<Index, 3>& size, const double* values,
  const std::vector<std::int32_t>& parts, int count, const Execution& execution = {});
}

#endif
