// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Frames to begin the smoothing with.
 *
 * All take the level they are wanted on, counted from 0 = finest; those that solve go there from
 * the coarsest level. For coarse-to-fine smoothing that is the last one, so that a start costs next
 * to nothing; on the finest level the solvers take 24 to 72 doubles a voxel and a few hundred
 * products with the Laplacian.
 */
#ifndef trivariate_FrameStart_h
#define trivariate_FrameStart_h

#include "FrameVoxels.h"

namespace trivariate
{
/// The principal axes of the segment everywhere, named as fits labels best; the bound frames are
/// turned onto their constraints.
FrameList ConstantFrames(const FrameLevel& level);

struct HarmonicFrames
{
  FrameList Frames;
  /// The share of the voxels at which (grad u, grad v, grad w) is left-handed: next to nothing for
  /// sound labels; most of them where the labels themselves are left-handed.
  double LeftHanded = 0.0;
};

/**
 * The rotations closest to the gradients of the domain's harmonic coordinates: each of u, v, w is 0
 * on its low side, 1 on its high side. Throws std::invalid_argument where constraints have no
 * labels or a coordinate lacks a side.
 */
HarmonicFrames HarmonicCoordinateFrames(
  const std::vector<FrameLevel>& levels, int level, const Execution& execution);

/**
 * The smoothest field of vectors with nine components under the constraints, which are linear in
 * them, each then projected to the closest frame. With labels the components are the entries of
 * the frame; where any axis will do, the harmonics of degree 4 of its cross (Ray and Sokolov 2015).
 */
FrameList LinearFrames(
  const std::vector<FrameLevel>& levels, int level, const Execution& execution);
}

#endif
