// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// Inner corners moved until no block is inverted.
#ifndef trivariate_InnerCorners_h
#define trivariate_InnerCorners_h

#include "DomainLayers.h"

namespace trivariate
{
/// Blocks that are inverted or flat at one of their corners.
std::vector<std::size_t> InvertedBlocks(const DomainBlocks& blocks);

/**
 * Moves inner corners of inverted blocks, one after the other, to where the blocks around
 * them are better: a pattern search, with steps from half of the corner's depth downwards.
 * Corners stay deeper than 0.4 of the depth that they had, so inside. corners: their points;
 * depths: of each, in space.
 */
void UntangleInnerCorners(DomainBlocks& blocks, const SurfaceLayout& layout,
  const std::vector<Index>& corners, const std::vector<double>& depths);
}

#endif
