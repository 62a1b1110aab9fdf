// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Linear independence of blending functions, and how to get it back.
 *
 * The functions of an analysis-suitable T-spline are independent. Those of a semi-standard one
 * (refined by knot insertion) span all that they should, but now and then a few of them are too
 * many: a function equals a combination of others around it.
 *
 * The search takes dual functionals as equations. In sum_j a_j B_j = 0, the dual functional of B_i,
 * taken around any place in its support, gives an equation with coefficient one for a_i and zero
 * for all but a few others (every B_j whose knots overlap and differ from those of B_i in a
 * direction drops out). Where such equations form a triangle, or small solvable blocks, their
 * unknowns are zero; other places give other equations for the unknowns that are left. What resists
 * is solved for by dense linear algebra.
 *
 * References: T. Dokken, T. Lyche, K. F. Pettersen. Polynomial splines over locally refined
 * box-partitions. CAGD 30, 2013. F. Patrizi, T. Dokken. Linear dependence of bivariate minimal
 * support and locally refined B-splines over LR-meshes. CAGD 77, 2020.
 */
#ifndef trivariate_LinearIndependence_h
#define trivariate_LinearIndependence_h

#include "Execution.h"
#include "TSpline.h"

namespace trivariate
{
/// sum_k Coefficients[k] B[Functions[k]] = 0 everywhere; the largest coefficient is 1 or -1. Each
/// dependence of a list has a function that occurs in no other of them.
struct LinearDependence
{
  std::vector<Index> Functions; ///< ascending
  std::vector<double> Coefficients;
};

/**
 * A basis of all linear dependences between the blending functions; empty if they are independent.
 * As many functions as there are dependences are too many. `spline` must be valid; its control
 * points and weights do not matter.
 *
 * Cost: 35 microseconds a function on steeply graded meshes, 5 on even ones, on one thread, most of
 * it in parallel; memory about 1 kB a function. Throws Aborted when stopped.
 */
std::vector<LinearDependence> FindLinearDependences(
  const TSpline& spline, const Execution& execution = {});

/**
 * Removes functions until the others are independent, and changes weights and control points of
 * those that the removed ones depend on, so that sum_i w_i B_i and the spline stay what they were
 * to rounding and all weights stay positive. Returns the number of functions removed; the others
 * keep their order. The cost is that of FindLinearDependences.
 *
 * Weights and coefficients w_i p_i each move along the dependence until those of the removed
 * function are zero, which is the one whose weight comes to zero first, one way or the other. A
 * dependence in which two weights would come to zero at once (on uniform knots, now and then)
 * stays: without either function there are no positive weights with that sum.
 */
Index RepairLinearDependence(TSpline& spline, const Execution& execution = {});
}

#endif
