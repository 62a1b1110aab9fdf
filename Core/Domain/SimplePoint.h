// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Whether a voxel can change sides without changing the topology of an object and its background.
 *
 * Bertrand, Malandain. A new characterization of three-dimensional simple points. Pattern
 * Recognition Letters 15 (1994). Asked for both pairs of connectivities, (26, 6) and (6, 26), so
 * that the answer holds for whichever a surface assumes.
 */
#ifndef trivariate_SimplePoint_h
#define trivariate_SimplePoint_h

#include <cstdint>

namespace trivariate
{
/// Bit 9 (z + 1) + 3 (y + 1) + x + 1 of `object` says that the neighbour (x, y, z) belongs to it;
/// bit 13, the voxel itself, is not looked at.
bool IsSimple(std::uint32_t object);
}

#endif
