// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// Bounds of the determinant of d(X, Y, Z)/d(u, v, w) on the Bezier cells of a spline.
#ifndef trivariate_ShapeJacobian_h
#define trivariate_ShapeJacobian_h

#include "Execution.h"
#include "TSpline/BezierMesh.h"

#include <utility>
#include <vector>

namespace trivariate
{
struct CellJacobian
{
  double Sampled = 0.0; ///< the smallest of 9^3 points of the cell, or where not proven of 33^3
  /// True: positive on the whole cell. The determinant is a polynomial of degree 8 in each
  /// direction; its Bernstein coefficients, on the cell or on parts of it, are all positive.
  bool Certified = false;
};

/// The least and the mean determinant at points of the parameter space, (u, v, w) of each.
std::pair<double, double> JacobianAt(const TSpline& spline, const BezierMesh& mesh,
  const std::vector<double>& parameters, const Execution& execution = {});

/**
 * One for each cell. The weighted functions must sum to one. About 50 microseconds a cell, eight
 * times as many where parts are needed, and some milliseconds where that does not help.
 */
std::vector<CellJacobian> BoundJacobian(
  const TSpline& spline, const BezierMesh& mesh, const Execution& execution = {});

struct ShapeFolds
{
  /// The least determinant at the voxels and at the points that each cell is sampled at, in parts
  /// of the mean over the voxels.
  double SmallestJacobian = 0.0;
  /// All cells, those with a point where it is not positive, and those proven positive everywhere.
  Index Cells = 0, Folded = 0, Certified = 0;
};

/// `parameters`: (u, v, w) of each voxel.
ShapeFolds FindFolds(
  const TSpline& spline, const std::vector<double>& parameters, const Execution& execution = {});
}

#endif
