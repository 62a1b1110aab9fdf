// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * One direction of a gridded fit: samples at 0 .. n-1 and nested uniform clamped B-splines.
 *
 * Level l has Root * 2^l equal intervals over [0, n-1] and three functions more than that. A local
 * knot vector whose indices lie on level l is a short linear combination of the level's functions,
 * so sums over voxels against *any* blending function come from the moments of a uniform basis.
 */
#ifndef trivariate_DyadicAxis_h
#define trivariate_DyadicAxis_h

#include "BandedOperator.h"
#include "TSpline/TSpline.h"

namespace trivariate
{
/// A univariate function as a combination of the functions First, First + 1, ... of a level.
struct LevelExpansion
{
  int Level = 0;
  std::int32_t First = 0;
  std::vector<double> Coefficients;
};

/// A univariate function at the samples: the first sample of its support and the values from there.
using SampledFunction = std::pair<Index, std::vector<double>>;

/// Sum over the samples of the product of two functions.
double Dot(const SampledFunction& a, const SampledFunction& b);

class DyadicAxis
{
public:
  /// `samples` >= 2; `root` >= 1 equal intervals on level 0, halved `levels` times.
  DyadicAxis(Index samples, int root, int levels);

  /**
   * The axis whose root intervals are about `rootCells` and whose finest interval is as close to
   * one sample distance as halving allows.
   */
  static DyadicAxis ForSamples(Index samples, double rootCells);

  Index Samples() const { return this->NumberOfSamples; }
  int Root() const { return this->RootIntervals; }
  int FinestLevel() const { return this->Levels; }
  const KnotLine& Line() const { return this->Knots; }

  /// Functions of level l.
  Index Functions(int l) const { return (Index(this->RootIntervals) << l) + 3; }

  /// The coarsest level that has all knots of k.
  int LevelOf(const LocalKnots& k) const;

  /// N[k] on level l >= LevelOf(k).
  LevelExpansion Expand(const LocalKnots& k, int l) const;

  /// N[k] at the samples.
  SampledFunction Sample(const LocalKnots& k) const;

  /// Samples from coefficients of the finest level, and its transpose: moments from samples.
  BandedOperator Collocation, Moments;
  /// [l]: coefficients of level l + 1 from those of level l (subdivision), and its transpose.
  std::vector<BandedOperator> Prolong, Restrict;
  /// [l]: sums over the samples of products of two functions of level l.
  std::vector<BandedOperator> Gram;

private:
  LocalKnots LevelKnots(int l, Index q) const;
  Knots5 Values(const LocalKnots& k) const;

  Index NumberOfSamples;
  int RootIntervals;
  int Levels;
  KnotLine Knots;
};
}

#endif
