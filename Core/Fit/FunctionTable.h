// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The univariate factors of a T-spline's blending functions, each worked out once.
 *
 * Tens of thousands of blending functions share some hundreds of local knot vectors a direction.
 */
#ifndef trivariate_FunctionTable_h
#define trivariate_FunctionTable_h

#include "MomentPyramid.h"
#include "TSpline/BlendingFunctionMap.h"

namespace trivariate
{
/// A way to split a univariate function, and what the split adds to the space.
struct SplitCandidate
{
  std::int32_t Knot; ///< the new knot
  /// The first child made orthogonal to its parent over the samples, of norm one.
  LevelExpansion Gain;
};

/// One local knot vector of one direction with all that the fit needs of it.
struct Univariate
{
  LocalKnots Knots;
  LevelExpansion Expansion; ///< on its own level
  SampledFunction Samples;
  double SquaredNorm;                 ///< over the samples
  std::vector<SplitCandidate> Splits; ///< all on one level
};

class FunctionTable
{
public:
  explicit FunctionTable(const Axes& axes)
    : Grid(axes)
  {
  }

  /// Ids of the factors of every function of the spline.
  void Update(const TSpline& spline);

  Index Size() const { return static_cast<Index>(this->Ids.size()); }
  int Id(Index i, int a) const { return this->Ids[i][a]; }
  const Univariate& Factor(Index i, int a) const { return this->Factors[a][this->Ids[i][a]]; }
  const std::vector<Univariate>& AllFactors(int a) const { return this->Factors[a]; }

  LevelFunction Expansion(Index i) const
  {
    return { { &this->Factor(i, 0).Expansion, &this->Factor(i, 1).Expansion,
      &this->Factor(i, 2).Expansion } };
  }

private:
  const Axes& Grid;
  std::array<std::vector<Univariate>, 3> Factors;
  std::vector<std::array<std::int32_t, 3>> Ids;
};
}

#endif
