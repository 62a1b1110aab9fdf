// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Dual-compatibility: the property of analysis-suitable T-splines from which the others follow.
 *
 * Two local knot vectors overlap if they are runs of one common knot vector (which vectors of
 * disjoint supports always are). Two blending functions are dual-compatible (in the weak sense) if
 * there is a direction in which their knots overlap and differ. If all pairs are, tensor products
 * of univariate dual functionals are a dual basis, and the functions are linearly independent.
 *
 * Reference: L. Beirao da Veiga, A. Buffa, G. Sangalli, R. Vazquez. Analysis-suitable T-splines of
 * arbitrary degree: definition, linear independence and approximation properties. M3AS 23, 2013.
 */
#ifndef trivariate_DualCompatibility_h
#define trivariate_DualCompatibility_h

#include "TSpline.h"

namespace trivariate
{
/// Whether the supports have an interval in common.
inline bool SupportsMeet(const LocalKnots& a, const LocalKnots& b)
{
  return a[0] < b[4] && b[0] < a[4];
}

/// Whether b starts at one of a's first four knots and agrees with a from there on.
inline bool Continues(const LocalKnots& a, const LocalKnots& b)
{
  for (int shift = 0; shift < 4; ++shift)
  {
    int k = 0;
    while (k + shift < 5 && a[k + shift] == b[k])
    {
      ++k;
    }
    if (k + shift == 5)
    {
      return true;
    }
  }
  return false;
}

/// Whether both vectors are runs of consecutive knots (repeated ones counted) of one knot vector.
inline bool Overlap(const LocalKnots& a, const LocalKnots& b)
{
  return !SupportsMeet(a, b) || Continues(a, b) || Continues(b, a);
}

/// The blossom of the polynomial that N[k] is on the unit interval [unit, unit + 1] of the knot
/// line, which must lie in its support.
double BlossomAround(
  const LocalKnots& k, std::int32_t unit, const KnotLine& line, double x1, double x2, double x3);

/**
 * The univariate dual functional of N[a], applied to the polynomial that N[b] is on the unit
 * interval [unit, unit + 1] of the knot line, which must lie in both supports. One if a and b are
 * equal; zero, to rounding, if they overlap and differ.
 */
double DualOf(const LocalKnots& a, const LocalKnots& b, std::int32_t unit, const KnotLine& line);

/// Whether the pair is dual-compatible.
bool DualCompatible(const BlendingFunction& f, const BlendingFunction& g);

/**
 * Empty if every pair of blending functions is dual-compatible; otherwise a sentence that names the
 * first pair that is not (lowest ids) and its knots. A function that occurs twice is such a pair.
 * Pairs with disjoint supports need no check. Cost: 1e4 functions about 0.1 s, quadratic.
 */
std::string CheckDualCompatibility(const TSpline& spline);
}

#endif
