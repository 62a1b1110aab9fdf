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

/**
 * Coefficients of attribute `component` in the order of MakeTensorProduct, u fastest. The Gram
 * matrix is a tensor product, so its inverse is that of three small matrices (least norm where the
 * samples leave it short). No mask.
 */
std::vector<double> FitUniform(
  const GridSamples& samples, int component, const Axes& axes, const Execution& execution);
}

#endif
