// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "FunctionTable.h"

#include "TSpline/RefinementRule.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace trivariate
{
namespace
{
LocalKnots FirstChild(const LocalKnots& k, std::int32_t knot)
{
  std::array<std::int32_t, 6> all{ k[0], k[1], k[2], k[3], k[4], knot };
  std::sort(all.begin(), all.end());
  return { all[0], all[1], all[2], all[3], all[4] };
}

// g = (child - <child, parent> / <parent, parent> parent) / |...|, in the functions of one level.
LevelExpansion GainOfSplit(
  const DyadicAxis& axis, const Univariate& parent, const LocalKnots& childKnots, int level)
{
  const SampledFunction child = axis.Sample(childKnots);
  const double inner = Dot(child, parent.Samples);
  const double norm2 = Dot(child, child) - inner * inner / parent.SquaredNorm;
  LevelExpansion gain = axis.Expand(parent.Knots, level);
  const LevelExpansion own = axis.Expand(childKnots, level);
  if (!(norm2 > 1e-6 * parent.SquaredNorm))
  {
    return {}; // the samples do not tell the child from its parent
  }
  for (double& c : gain.Coefficients)
  {
    c *= -inner / parent.SquaredNorm;
  }
  for (std::size_t q = 0; q < own.Coefficients.size(); ++q)
  {
    gain.Coefficients[own.First - gain.First + q] += own.Coefficients[q];
  }
  for (double& c : gain.Coefficients)
  {
    c /= std::sqrt(norm2);
  }
  return gain;
}

Univariate MakeUnivariate(const DyadicAxis& axis, const LocalKnots& knots)
{
  Univariate u;
  u.Knots = knots;
  u.Expansion = axis.Expand(knots, axis.LevelOf(knots));
  u.Samples = axis.Sample(knots);
  u.SquaredNorm = Dot(u.Samples, u.Samples);
  std::vector<std::int32_t> middles;
  int level = u.Expansion.Level;
  for (int s = 0; s < 4; ++s)
  {
    const std::int32_t middle = DyadicMiddle(knots[s], knots[s + 1]);
    if (middle >= 0)
    {
      middles.push_back(middle);
      level = std::max(level, axis.LevelOf(FirstChild(knots, middle)));
    }
  }
  for (const std::int32_t middle : middles)
  {
    LevelExpansion gain = GainOfSplit(axis, u, FirstChild(knots, middle), level);
    if (!gain.Coefficients.empty())
    {
      u.Splits.push_back({ middle, std::move(gain) });
    }
  }
  return u;
}
}

//------------------------------------------------------------------------------
void FunctionTable::Update(const TSpline& spline)
{
  this->Ids.assign(spline.Functions.size(), {});
  for (int a = 0; a < 3; ++a)
  {
    // Rebuilt from the factors in use, so that the tables do not grow with the history.
    std::unordered_map<LocalKnots, std::int32_t, LocalKnotsHash> known;
    for (std::size_t id = 0; id < this->Factors[a].size(); ++id)
    {
      known.emplace(this->Factors[a][id].Knots, static_cast<std::int32_t>(id));
    }
    std::vector<Univariate> used;
    std::unordered_map<LocalKnots, std::int32_t, LocalKnotsHash> ids;
    for (std::size_t i = 0; i < spline.Functions.size(); ++i)
    {
      const LocalKnots& knots = spline.Functions[i][a];
      const auto [entry, isNew] = ids.emplace(knots, static_cast<std::int32_t>(used.size()));
      if (isNew)
      {
        const auto old = known.find(knots);
        used.push_back(old == known.end() ? MakeUnivariate(this->Grid[a], knots)
                                          : std::move(this->Factors[a][old->second]));
      }
      this->Ids[i][a] = entry->second;
    }
    this->Factors[a] = std::move(used);
  }
}
}
