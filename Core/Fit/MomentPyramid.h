// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Sums over all voxels against any blending function, and their adjoint, without touching a voxel
 * more than a few times.
 *
 * Every univariate function of a dyadic T-mesh is a short combination of uniform B-splines of one
 * level (DyadicAxis). So the moments of a volume against the uniform basis of the finest level are
 * taken once; restricted step by step they give the moments of every combination of levels in u, v
 * and w, and a moment against a blending function is a small weighted sum there. Run backwards the
 * same pyramid turns control points into coefficients of a uniform basis.
 */
#ifndef trivariate_MomentPyramid_h
#define trivariate_MomentPyramid_h

#include "DyadicAxis.h"

#include <functional>

namespace trivariate
{
using Axes = std::array<DyadicAxis, 3>;

/// One level for each direction.
using Levels = std::array<int, 3>;

/// A trivariate function as a product of expansions; pointers stay owned by the caller.
struct LevelFunction
{
  std::array<const LevelExpansion*, 3> Factors;

  Levels Level() const
  {
    return { this->Factors[0]->Level, this->Factors[1]->Level, this->Factors[2]->Level };
  }
};

/// Indices of functions that share a combination of levels.
struct LevelGroup
{
  Levels Level;
  std::vector<Index> Functions;
};
std::vector<LevelGroup> GroupByLevel(const std::vector<LevelFunction>& functions);

/**
 * Restricts `moments`, given on `level`, to the levels of each group, in an order that keeps few
 * arrays alive, and calls visit(group, moments there). Every group's level must not exceed `level`.
 */
void VisitMoments(const Axes& axes, const Array3& moments, const Levels& level,
  const std::vector<LevelGroup>& groups,
  const std::function<void(const LevelGroup&, const Array3&)>& visit, const Execution& execution);

/// sum_i coefficients[i] * function i, as coefficients of the uniform basis on `level`.
Array3 Synthesize(const Axes& axes, const std::vector<LevelFunction>& functions,
  const std::vector<LevelGroup>& groups, const std::vector<double>& coefficients,
  const Levels& level, const std::shared_ptr<ArrayPool>& pool, const Execution& execution);

/**
 * The moments of `function` with its factor in direction a left open: line[q] belongs to the
 * function Factors[a]->First + q of that direction's level.
 */
void ContractLine(
  const Array3& moments, const LevelFunction& function, int a, std::vector<double>& line);

/// Takes moments from one level to another that is nowhere finer.
Array3 Restrict(const Axes& axes, const Array3& moments, Levels from, const Levels& to,
  const Execution& execution);
}

#endif
