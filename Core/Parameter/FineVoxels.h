// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// Parameters of segments with parts that are thin beside their voxels.
#ifndef trivariate_FineVoxels_h
#define trivariate_FineVoxels_h

#include "VoxelParameter.h"

namespace trivariate
{
/// The voxels of the finer grid, of which every second one is one of `size`.
Index CountFineVoxels(const std::array<Index, 3>& size);

/**
 * As SolveVoxelParameter, on voxels of half the size, of whose values those at the given voxels are
 * returned. Between these a voxel belongs to the segment where it is inside of the surface and has
 * one of the segment beside it; its frame is the mean of theirs. Eight times the time and memory.
 */
VoxelParameter SolveOnFineVoxels(const ParameterVoxels& voxels, const ParameterSurface& surface,
  const ParameterOptions& options, const Execution& execution);
}

#endif
