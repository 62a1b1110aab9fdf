// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Whether the geometry of a T-spline folds, and how far from it the worst cell is.
 */
#ifndef trivariate_JacobianRange_h
#define trivariate_JacobianRange_h

#include "BezierMesh.h"
#include "Execution.h"
#include "TSpline.h"

namespace trivariate
{
struct JacobianRange
{
  /// The smallest scaled Jacobian: the determinant of d(X, Y, Z)/d(u, v, w) divided by the lengths
  /// of its three columns, in [-1, 1]; 1 where u, v, w cross at right angles, 0 where the map
  /// degenerates. NaN without a cell.
  double Minimum;
  Index Inverted; ///< cells with a determinant <= 0 at one of their points
  /// Whether all derivatives are the same everywhere, to 1e-9 of the largest: an affine map.
  bool Constant;
};

/**
 * At the 3^3 points of Gauss's rule in each cell. Where the denominator is one in some cells, the
 * others, which a mask has left open, lie outside of what the spline stands for and do not count.
 * About ten microseconds a cell.
 */
JacobianRange MeasureJacobian(
  const TSpline& spline, const BezierMesh& mesh, const Execution& execution = {});
}

#endif
