// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * How far a spline over blocks is from being C1 across the faces where it is C0 by construction.
 */
#ifndef trivariate_GradientJump_h
#define trivariate_GradientJump_h

#include "Domain/BlockComplex.h"
#include "TSpline/BezierMesh.h"

#include <vector>

namespace trivariate
{
struct GradientJump
{
  double Rms = 0.0; ///< over the area of the faces in space
  double Maximum = 0.0;
};

/**
 * The length of the difference of the gradients by (X, Y, Z) on the two sides of a glued face, at
 * 16 x 16 points of each face that two blocks of one segment have in common (between segments an
 * attribute may bend as it likes), for each component behind X, Y, Z, times units[component].
 * A smooth attribute has no jump, however the blocks' own coordinates bend there. Points at which
 * the shape folds, on either side, are left out. Zeros where no faces are glued.
 * Cost: two evaluations a point.
 */
std::vector<GradientJump> MeasureGradientJumps(const BlockComplex& blocks, const TSpline& spline,
  const BezierMesh& mesh, const std::vector<double>& units, const Execution& execution = {});

/// The largest of all components, in parts of each one's range a `spacing`.
GradientJump WorstGradientJump(const BlockComplex& blocks, const TSpline& spline,
  const BezierMesh& mesh, const std::vector<double>& ranges, double spacing,
  const Execution& execution = {});
}

#endif
