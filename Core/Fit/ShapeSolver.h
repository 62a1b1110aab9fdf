// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// Fits a shape that does not fold.
#ifndef trivariate_ShapeSolver_h
#define trivariate_ShapeSolver_h

#include "DataErrors.h"
#include "ScatteredSystem.h"
#include "ShapeTarget.h"

namespace trivariate
{
struct ShapeSolverOptions
{
  /// What FoldEnergy costs: that of cells that are cubes (5) as much as samples that are off by the
  /// root of five times this, in parts of Spacing. It falls from the first to the last.
  double FirstBarrier = 0.3, LastBarrier = 0.003;
  double Spacing = 1.0;  ///< distance of voxels in the unit of the places
  int MostSteps = 40;    ///< with each, without and with folds,
  int MostProducts = 60; ///< with the curvature in each step
};

/**
 * Minimises the squared errors of the samples, with the stiffness of the system, plus FoldEnergy,
 * from the shape as it is. A shape without folds keeps without; folds are regularised, each cell by
 * its own least determinant, less from step to step, until none is left. Newton steps, by conjugate
 * gradients that are preconditioned with the factors of a matrix about as large as the curvature.
 * Where the target slides, it does so between steps. `data`: what else is minimised, a function of
 * how far the shape moves from where it is.
 *
 * The system must know the spline's functions; it has the residuals of the result afterwards. A
 * step costs 1 to 5 milliseconds a cell.
 */
void SolveShape(TSpline& spline, ScatteredSystem& system, ShapeTarget& target,
  const ShapeSolverOptions& options, const Execution& execution, const DataErrors* data = nullptr);
}

#endif
