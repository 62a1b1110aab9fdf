// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// Parts of a segment that are too thin for cells.
#ifndef trivariate_ThinParts_h
#define trivariate_ThinParts_h

#include "Execution.h"

#include <array>
#include <cstdint>
#include <vector>

namespace trivariate
{
/**
 * Which share of the voxels of a mask (nonzero, the first axis fastest) is in parts thinner than
 * four voxels: where no ball with a diameter of four voxels, whose middle is a corner of voxels,
 * fits into the mask and reaches a voxel or one of its 26 neighbours. 0 for an empty mask. O(n).
 */
double ThinShare(const std::vector<std::uint8_t>& mask, const std::array<Index, 3>& size,
  const Execution& execution);
}

#endif
