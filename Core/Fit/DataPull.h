// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// Where the errors of the attributes would have the shape of a spline.
#ifndef trivariate_DataPull_h
#define trivariate_DataPull_h

#include "ScatteredSystem.h"

#include <vector>

namespace trivariate
{
struct DataPull
{
  std::vector<double> Places; ///< (X, Y, Z) where the shape is wanted at the parameters of samples
  std::vector<float> Weights; ///< of each
};

/**
 * A voxel at x with the value d, where the spline is f, would be met by a shape that is moved by dx
 * where grad f . dx = f - d: the same values lie elsewhere then. The shortest such dx is wanted,
 * with the weight |grad f|^2, so that sum of |grad f|^2 |dx - dx_wanted|^2  >=  sum of (f - d -
 * grad f . dx)^2, equal for dx = 0: what makes the left smaller makes the squared errors smaller,
 * to first order. Errors are in parts of `ranges`, lengths in `spacing`; several attributes are
 * summed. A step is made `factor` times as long, but none longer than two voxels.
 *
 * `spline` has X, Y, Z and the attributes of the samples, whose parameters are those at which it
 * passes through them. 16 numbers a sample are kept meanwhile, for one attribute.
 */
DataPull PullToData(const TSpline& spline, const ScatteredSamples& samples,
  const std::vector<double>& ranges, double spacing, double factor, const Execution& execution);
}

#endif
