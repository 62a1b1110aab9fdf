// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// The frame field of a segment: start, smoothing from coarse to fine, and what came of it.
#ifndef trivariate_SegmentField_h
#define trivariate_SegmentField_h

#include "FrameSmoothing.h"
#include "SingularGraph.h"

namespace trivariate
{
enum class FieldStart
{
  Linear,             ///< LinearFrames
  Constant,           ///< ConstantFrames
  HarmonicCoordinates ///< HarmonicCoordinateFrames
};

struct FieldOptions
{
  FieldStart Start = FieldStart::Linear;
  bool ChooseStep = true; ///< Step and Jumps of Smoothing are those of DefaultSmoothing
  SmoothingOptions Smoothing;
  bool CoarseToFine = true; ///< false: start and sweeps on the voxels alone
};

struct SegmentField
{
  FrameVoxels Voxels;
  FrameList Frames;                 ///< of the voxels
  std::vector<SweepRecord> Records; ///< the last one is of the result
  double Alignment = 0.0;           ///< AlignmentError, in degrees
  SingularGraph Graph;              ///< without plaquettes at the boundary
};

/**
 * Throws std::invalid_argument where labels are left-handed (their harmonic coordinates are, at
 * most voxels), which no right-handed frames can follow; where a start needs what is not there.
 */
SegmentField ComputeSegmentField(FrameVoxels voxels, std::vector<FrameConstraint> constraints,
  const FieldOptions& options, const Execution& execution);

/// Bytes a voxel of the segment that the computation takes at its peak.
double FieldBytesPerVoxel(const FieldOptions& options);
}

#endif
