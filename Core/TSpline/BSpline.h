// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Univariate cubic B-splines on five local knots.
 *
 * N[t0 .. t4] is normalised as in de Boor's "A Practical Guide to Splines": neighbours on one knot
 * vector sum to one. Repeated knots are allowed up to multiplicity four; at a domain end this makes
 * a clamped function that is one there. All functions are exact up to rounding.
 */
#ifndef trivariate_BSpline_h
#define trivariate_BSpline_h

#include <array>
#include <utility>

namespace trivariate
{
/// The five knots of one cubic blending function, non-decreasing, t0 < t4.
using Knots5 = std::array<double, 5>;

/// Values at one parameter: {N, N', N''}.
using Jet = std::array<double, 3>;

/**
 * Value and first two derivatives of N[t] at x. Outside [t0, t4] all are zero. At a knot the limit
 * from the right is taken, at t4 the limit from the left (so clamped ends are one).
 */
Jet EvaluateBSpline(const Knots5& t, double x);

/**
 * The four Bernstein coefficients of N[t] on [a, b], a < b. Exact when no knot lies strictly
 * between a and b; an interval outside [t0, t4] gives zeros.
 */
std::array<double, 4> BernsteinOfBSpline(const Knots5& t, double a, double b);

/**
 * The blossom (polar form) of the cubic polynomial that N[t] is on its non-empty span [t_k, t_k+1]:
 * the symmetric function, linear in each argument, that is the polynomial when all three are equal.
 */
double Blossom(const Knots5& t, int k, double x1, double x2, double x3);

/// Knot insertion: N[t] = first * N[t without t4, with x] + second * N[t without t0, with x].
struct KnotInsertion
{
  double First, Second;
};

/// Factors of inserting x, t0 < x < t4, into N[t] (Boehm 1980).
KnotInsertion InsertKnot(const Knots5& t, double x);

/**
 * The dual functional of N[t] (blossom at t1, t2, t3) of the cubic polynomial given by Bernstein
 * coefficients c on [a, b]. For every spline whose knots agree with t around [a, b] this is the
 * coefficient of N[t].
 */
double DualFunctional(const Knots5& t, const std::array<double, 4>& c, double a, double b);

/// Greville abscissa: where the coefficient of N[t] acts, (t1 + t2 + t3) / 3.
inline double Greville(const Knots5& t)
{
  return (t[1] + t[2] + t[3]) / 3.0;
}

/// The four cubic Bernstein polynomials at s in [0, 1].
inline std::array<double, 4> Bernstein(double s)
{
  const double r = 1.0 - s;
  return { r * r * r, 3.0 * r * r * s, 3.0 * r * s * s, s * s * s };
}
}

#endif
