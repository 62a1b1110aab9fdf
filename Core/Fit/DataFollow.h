// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// Moves the inside of a shape to where the errors of the attributes want it.
#ifndef trivariate_DataFollow_h
#define trivariate_DataFollow_h

#include "ScatteredSystem.h"
#include "ShapeTarget.h"

#include <vector>

namespace trivariate
{
/// A spline with X, Y, Z and attributes that are fitted to samples.
struct FittedAttributes
{
  const TSpline& Spline;
  const BlockSpline& Layout;
  const ScatteredSamples& Samples;
  ScatteredSystem& System;           ///< of the attributes, with their residuals
  const std::vector<double>& Ranges; ///< the unit of each attribute's error
  ShapeTarget& Target;
  double Spacing; ///< distance of voxels in the unit of the places
};

/**
 * The shape, that of the spline with fewer functions, after a few steps towards the least errors
 * (DataErrors.h) with its surface held, but so far only that no more of its cells fold. `barrier`
 * as in ShapeSolverOptions, `damping` as in DataErrorOptions. It costs some tens of products with
 * the second derivative of the errors.
 */
TSpline MoveToData(const FittedAttributes& fitted, const TSpline& shape, double barrier,
  double damping, const Execution& execution);
}

#endif
