// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Equations for the coefficients a of a linear dependence sum_j a_j B_j = 0 (see
 * LinearIndependence.h), and the blocks in which they can be solved one after the other.
 */
#ifndef trivariate_DependenceRows_h
#define trivariate_DependenceRows_h

#include "Execution.h"
#include "TSpline.h"

#include <vector>

namespace trivariate
{
/// Row i reads: sum of Value * a_Column = 0.
struct DependenceEntry
{
  int Column;
  double Value;
};
using DependenceRows = std::vector<std::vector<DependenceEntry>>;

/// In this round places are next to the functions' centres, for equations with small coefficients.
constexpr unsigned CentralRound = 0;

/// In this round and later ones places are anywhere in the supports. The first one is for all
/// functions of a spline: where no more than 64 are active, it takes the equations of all of them.
constexpr unsigned FirstSearchRound = 1;

/**
 * One equation for each of the given functions (rows and columns count within the list), provided
 * that the coefficients of all others are zero: its dual functional around a place in its support,
 * in which its own coefficient has the value one. The place depends on the function and the round.
 */
DependenceRows MakeDependenceRows(const TSpline& spline, const std::vector<Index>& functions,
  unsigned round, const Execution& execution);

/// The same with the functions' values at a point in the support of each.
DependenceRows MakeValueRows(const TSpline& spline, const std::vector<Index>& functions,
  unsigned round, const Execution& execution);

/**
 * The strongly connected components of the graph of rows and their columns, each after all that its
 * rows refer to (Tarjan 1972).
 */
std::vector<std::vector<int>> SolvableBlocks(const DependenceRows& rows);
}

#endif
