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
/// Whether both vectors are runs of consecutive knots (repeated ones counted) of one knot vector.
bool Overlap(const LocalKnots& a, const LocalKnots& b);

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
