// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The singular curves of a field of frames.
 *
 * Four voxels of a segment around a grid edge of the dual grid make a plaquette. Where the product
 * of the four matchings around it is not the identity, a singular curve passes through it: the line
 * between the middles of the two cubes of 2 x 2 x 2 voxels on its sides.
 */
#ifndef trivariate_SingularGraph_h
#define trivariate_SingularGraph_h

#include "FrameVoxels.h"

namespace trivariate
{
struct SingularGraph
{
  Index Plaquettes = 0;                      ///< how many of them were looked at
  std::vector<std::array<double, 3>> Points; ///< in voxels: half-way between the grid's points
  std::vector<std::array<Index, 2>> Edges;   ///< one for each singular plaquette
  std::vector<std::vector<Index>> Lines; ///< Edges joined up to where one or three and more meet;
                                         ///< of a closed line the first point is also the last
};

/**
 * boundary: also plaquettes with a bound frame. At the edges of a domain on a smooth surface frames
 * turn by a quarter of a circle within a voxel or two, so that matchings there say nothing.
 */
SingularGraph FindSingularGraph(
  const FrameLevel& level, const FrameList& frames, bool boundary, const Execution& execution);
}

#endif
