// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// The least-squares fit on a tensor-product mesh: three one-dimensional fits.
#ifndef trivariate_UniformFit_h
#define trivariate_UniformFit_h

#include "Fit.h"
#include "MomentPyramid.h"

namespace trivariate
{
/// Axes without levels whose tensor product has about, and at most, `maximum` functions (>= 64).
Axes MakeUniformAxes(const std::array<Index, 3>& samples, Index maximum);

/// Whether SolveUniform takes less than a second: no direction has more than 512 functions.
bool HasSmallInverse(const Axes& axes);

/**
 * Coefficients, in the order of MakeTensorProduct, u fastest, from the moments of all samples
 * against the functions of such axes. The Gram matrix is a tensor product, so its inverse is that
 * of three small matrices (least norm where the samples leave it short).
 */
std::vector<double> SolveUniform(
  const Axes& axes, const Array3& moments, const Execution& execution);
}

#endif
