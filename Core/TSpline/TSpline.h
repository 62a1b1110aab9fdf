// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * A trivariate cubic T-spline: control points with local knot vectors and weights.
 *
 *   F(u, v, w) = sum_i w_i p_i B_i(u, v, w) / sum_i w_i B_i(u, v, w)        (the paper's eq. (9))
 *   B_i(u, v, w) = N[knots u](u) N[knots v](v) N[knots w](w)
 *
 * That is all there is: the T-mesh, the Bezier cells and everything else are rebuilt from it. Only
 * where the domain is an L, say, some boxes next to it are told too: functions reach into them, but
 * there is no spline.
 */
#ifndef trivariate_TSpline_h
#define trivariate_TSpline_h

#include "BSpline.h"
#include "IndexBox.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace trivariate
{
/// Ids and counts of functions, cells, voxels.
using Index = std::int64_t;

/// The local knot vector of one direction as five non-decreasing indices into a knot line.
using LocalKnots = std::array<std::int32_t, 5>;

/// A trivariate blending function: the local knot vectors in u, v and w.
using BlendingFunction = std::array<LocalKnots, 3>;

inline IndexBox SupportOf(const BlendingFunction& f)
{
  return { { f[0][0], f[1][0], f[2][0] }, { f[0][4], f[1][4], f[2][4] } };
}

/// Strictly increasing knot values of one direction; the first and last are the domain's ends.
using KnotLine = std::vector<double>;

/// See the head of this file. Plain data; Validate says whether it makes sense.
struct TSpline
{
  std::array<KnotLine, 3> KnotLines;
  std::vector<BlendingFunction> Functions;
  std::vector<double> Weights; ///< one a function, > 0
  int Components = 0;          ///< numbers a control point: X, Y, Z, then the attributes
  std::vector<double>
    ControlPoints;             ///< Functions.size() rows of Components numbers, p_i of eq. (9)
  std::vector<IndexBox> Holes; ///< disjoint boxes that are no part of the domain

  Index Size() const { return static_cast<Index>(this->Functions.size()); }

  const double* ControlPoint(Index i) const { return &this->ControlPoints[i * this->Components]; }
  double* ControlPoint(Index i) { return &this->ControlPoints[i * this->Components]; }

  /// Knot values of function i in direction a.
  Knots5 LocalKnotValues(Index i, int a) const
  {
    const LocalKnots& k = this->Functions[i][a];
    const KnotLine& line = this->KnotLines[a];
    return { line[k[0]], line[k[1]], line[k[2]], line[k[3]], line[k[4]] };
  }
};

/// Empty when the spline is sound (sizes agree, knots increase and are in range, numbers finite,
/// weights positive); otherwise one sentence that names the first fault and its place.
std::string Validate(const TSpline& spline);

/// Whether a part of the support of a function is in none of some disjoint holes.
bool HasSupportOutside(const std::vector<IndexBox>& holes, const BlendingFunction& f);

/**
 * The tensor-product spline on every `stride[a]`-th knot of the lines (each stride divides the
 * number of intervals of its line): clamped, all weights one, X, Y, Z the Greville abscissae (so
 * that the geometry is the identity on the parameter domain) and `attributes` further components
 * of zeros.
 */
TSpline MakeTensorProduct(
  const std::array<KnotLine, 3>& lines, const std::array<int, 3>& stride, int attributes);

/// Drops the functions i with removed[i] != 0; the others keep their order, weights and control
/// points.
void RemoveFunctions(TSpline& spline, const std::vector<char>& removed);

/// n + 1 equally spaced knots from a to b.
KnotLine MakeUniformKnotLine(double a, double b, int n);
}

#endif
