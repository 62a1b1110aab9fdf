// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * A segment made whole: one piece, no cavities, no handles, by as few voxels as can be had.
 *
 * A ball is grown inside the segment, deepest voxels first, by voxels that do not change its
 * topology; what stays outside are sheets, each of which cuts a handle. The same from the outside
 * inwards gives the sheets that would close it. Small sheets, of either kind, are taken before
 * larger ones.
 */
#ifndef trivariate_SegmentTopology_h
#define trivariate_SegmentTopology_h

#include "Execution.h"

#include <array>
#include <cstdint>
#include <vector>

namespace trivariate
{
struct TopologyOptions
{
  /// The largest sheet, in voxels, that is cut or closed. Larger handles stay.
  Index LargestSheet = 1000;
  /// Cavities up to this many voxels are filled; larger ones stay closed off.
  Index LargestCavity = 1000;
};

struct TopologyChanges
{
  Index Pieces = 0;                   ///< voxels of all pieces but the largest, removed
  Index Cavities = 0;                 ///< voxels of cavities, filled
  Index Cut = 0, CutVoxels = 0;       ///< sheets removed from the segment, and their voxels
  Index Closed = 0, ClosedVoxels = 0; ///< sheets added to the segment, and their voxels
  /// 1 - handles + cavities as they are now: 1 for a ball, 2 for a shell.
  Index EulerCharacteristic = 0;
};

/**
 * mask: nonzero inside the segment, x fastest; outside of the volume is background. Changed in
 * place. Memory: 10 bytes a voxel. Time: a few passes with 0.2 microseconds a voxel.
 */
TopologyChanges MakeSegmentWhole(std::vector<std::uint8_t>& mask, const std::array<Index, 3>& size,
  const TopologyOptions& options, const Execution& execution);
}

#endif
