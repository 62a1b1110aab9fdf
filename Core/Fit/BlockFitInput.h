// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// What a fit over blocks makes of its input.
#ifndef trivariate_BlockFitInput_h
#define trivariate_BlockFitInput_h

#include "BlockFit.h"

namespace trivariate
{
/// Throws std::invalid_argument for what FitBlocks refuses, but for faults of single numbers.
void CheckBlockFit(const BlockComplex& blocks, const BlockSamples& voxels,
  const ShapeSamples& shape, const BlockFitOptions& options);

/// How often the edge of a block is halved until its knots are about a voxel apart, as far as the
/// index grid has no more than 128 million boxes, of which refinement keeps a byte each.
int KnotDepth(const BlockComplex& blocks, const ShapeSamples& shape, double spacing);
}

#endif
