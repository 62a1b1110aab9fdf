// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Exact Bezier form of a T-spline's cells.
 *
 * On a cell, numerator and denominator of eq. (9) are tricubic polynomials. Their Bernstein
 * coefficients are sums over the cell's active functions of products of the univariate coefficients
 * of BernsteinOfBSpline.
 */
#ifndef trivariate_BezierExtraction_h
#define trivariate_BezierExtraction_h

#include "BezierMesh.h"
#include "Execution.h"
#include "TSpline.h"

#include <vector>

namespace trivariate
{
/// Stands for the denominator sum_i w_i B_i in a list of components.
constexpr int Denominator = -1;

/**
 * Bernstein coefficients of w_i p_i[component] (homogeneous: the rational form's numerators) or of
 * the denominator, for every cell of the mesh: cell by cell, within a cell in the order of
 * `components`, of each 64 numbers of which u runs fastest, then v, then w.
 * A cell's control point is the quotient of a numerator's and the denominator's coefficient.
 *
 * Throws std::invalid_argument for a component that the spline does not have. Cost: 1 to 3 us a
 * cell, 512 bytes a cell and component.
 */
std::vector<double> ExtractBezier(const TSpline& spline, const BezierMesh& mesh,
  const std::vector<int>& components, const Execution& execution = {});

/// The same of the cells from firstCell to lastCell - 1 only. Beside the cells it costs some ten
/// nanoseconds for each blending function and some hundred for each distinct local knot vector.
std::vector<double> ExtractBezier(const TSpline& spline, const BezierMesh& mesh,
  const std::vector<int>& components, Index firstCell, Index lastCell,
  const Execution& execution = {});
}

#endif
