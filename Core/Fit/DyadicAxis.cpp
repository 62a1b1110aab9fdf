// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "DyadicAxis.h"

#include <algorithm>
#include <cmath>

namespace trivariate
{
namespace
{
using Rows = std::vector<std::pair<std::int32_t, std::vector<double>>>;

int TrailingZeros(std::int32_t k, int limit)
{
  int zeros = 0;
  while (zeros < limit && !((k >> zeros) & 1))
  {
    ++zeros;
  }
  return zeros;
}
}

//------------------------------------------------------------------------------
DyadicAxis DyadicAxis::ForSamples(Index samples, double rootCells)
{
  const double intervals = static_cast<double>(samples - 1);
  const int levels = std::max(0, static_cast<int>(std::lround(std::log2(intervals / rootCells))));
  const int root = std::max(1, static_cast<int>(std::lround(std::ldexp(intervals, -levels))));
  return DyadicAxis(samples, root, levels);
}

//------------------------------------------------------------------------------
DyadicAxis::DyadicAxis(Index samples, int root, int levels)
  : NumberOfSamples(samples)
  , RootIntervals(root)
  , Levels(levels)
  , Knots(MakeUniformKnotLine(0.0, static_cast<double>(samples - 1), root << levels))
{
  Rows collocation(samples);
  const Index last = static_cast<Index>(this->Knots.size()) - 2;
  for (Index x = 0; x < samples; ++x)
  {
    const auto above = std::upper_bound(this->Knots.begin(), this->Knots.end(), double(x));
    const Index span = std::min<Index>(above - this->Knots.begin() - 1, last);
    collocation[x].first = static_cast<std::int32_t>(span);
    for (Index q = span; q < span + 4; ++q)
    {
      collocation[x].second.push_back(
        EvaluateBSpline(this->Values(this->LevelKnots(this->Levels, q)), double(x))[0]);
    }
  }
  this->Collocation = BandedOperator::FromRows(this->Functions(this->Levels), collocation);
  this->Moments = this->Collocation.Transposed();

  for (int l = 0; l < this->Levels; ++l)
  {
    Rows restriction(this->Functions(l));
    for (Index q = 0; q < this->Functions(l); ++q)
    {
      const LevelExpansion fine = this->Expand(this->LevelKnots(l, q), l + 1);
      restriction[q] = { fine.First, fine.Coefficients };
    }
    this->Restrict.push_back(BandedOperator::FromRows(this->Functions(l + 1), restriction));
    this->Prolong.push_back(this->Restrict.back().Transposed());
  }

  for (int l = 0; l <= this->Levels; ++l)
  {
    std::vector<SampledFunction> sampled;
    for (Index q = 0; q < this->Functions(l); ++q)
    {
      sampled.push_back(this->Sample(this->LevelKnots(l, q)));
    }
    Rows gram(this->Functions(l));
    for (Index q = 0; q < this->Functions(l); ++q)
    {
      const Index first = std::max<Index>(0, q - 3);
      const Index end = std::min<Index>(this->Functions(l), q + 4);
      gram[q].first = static_cast<std::int32_t>(first);
      for (Index p = first; p < end; ++p)
      {
        gram[q].second.push_back(Dot(sampled[q], sampled[p]));
      }
    }
    this->Gram.push_back(BandedOperator::FromRows(this->Functions(l), gram));
  }
}

//------------------------------------------------------------------------------
double Dot(const SampledFunction& a, const SampledFunction& b)
{
  const Index begin = std::max(a.first, b.first);
  const Index end = std::min(
    a.first + static_cast<Index>(a.second.size()), b.first + static_cast<Index>(b.second.size()));
  double sum = 0.0;
  for (Index x = begin; x < end; ++x)
  {
    sum += a.second[x - a.first] * b.second[x - b.first];
  }
  return sum;
}

//------------------------------------------------------------------------------
int DyadicAxis::LevelOf(const LocalKnots& k) const
{
  int level = 0;
  for (const std::int32_t knot : k)
  {
    level = std::max(level, this->Levels - TrailingZeros(knot, this->Levels));
  }
  return level;
}

//------------------------------------------------------------------------------
LocalKnots DyadicAxis::LevelKnots(int l, Index q) const
{
  const Index intervals = Index(this->RootIntervals) << l;
  LocalKnots k;
  for (int i = 0; i < 5; ++i)
  {
    k[i] =
      static_cast<std::int32_t>(std::clamp<Index>(q + i - 3, 0, intervals) << (this->Levels - l));
  }
  return k;
}

//------------------------------------------------------------------------------
Knots5 DyadicAxis::Values(const LocalKnots& k) const
{
  return { this->Knots[k[0]], this->Knots[k[1]], this->Knots[k[2]], this->Knots[k[3]],
    this->Knots[k[4]] };
}

//------------------------------------------------------------------------------
LevelExpansion DyadicAxis::Expand(const LocalKnots& k, int l) const
{
  // The level's knots with the same multiplicity at the ends as k bound the functions inside k.
  const int shift = this->Levels - l;
  const auto intervals = static_cast<std::int32_t>(this->RootIntervals) << l;
  const auto lowRepeats = static_cast<std::int32_t>(std::count(k.begin(), k.end(), k[0]));
  const auto highRepeats = static_cast<std::int32_t>(std::count(k.begin(), k.end(), k[4]));
  const std::int32_t first = k[0] == 0 ? 4 - lowRepeats : (k[0] >> shift) + 3;
  const std::int32_t last =
    (k[4] >> shift) == intervals ? intervals + highRepeats - 2 : (k[4] >> shift) - 1;

  LevelExpansion expansion{ l, first, {} };
  const Knots5 own = this->Values(k);
  for (std::int32_t q = first; q <= last; ++q)
  {
    const Knots5 t = this->Values(this->LevelKnots(l, q));
    // Any non-empty span will do; an inner one is the better conditioned.
    int span = 1;
    for (const int candidate : { 1, 2, 3, 0 })
    {
      if (t[candidate] < t[candidate + 1])
      {
        span = candidate;
        break;
      }
    }
    expansion.Coefficients.push_back(
      DualFunctional(t, BernsteinOfBSpline(own, t[span], t[span + 1]), t[span], t[span + 1]));
  }
  return expansion;
}

//------------------------------------------------------------------------------
SampledFunction DyadicAxis::Sample(const LocalKnots& k) const
{
  const Knots5 t = this->Values(k);
  const auto first = static_cast<Index>(std::ceil(t[0]));
  const Index end = std::min(static_cast<Index>(std::floor(t[4])) + 1, this->NumberOfSamples);
  SampledFunction sampled{ first, {} };
  for (Index x = first; x < end; ++x)
  {
    sampled.second.push_back(EvaluateBSpline(t, static_cast<double>(x))[0]);
  }
  return sampled;
}
}
