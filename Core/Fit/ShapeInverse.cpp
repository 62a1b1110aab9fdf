// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ShapeInverse.h"

#include "TSpline/Evaluator.h"
#include "TSpline/InverseMap.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace trivariate
{
namespace
{
void FindFromStarts(const InverseMap& inverse, const std::vector<double>& places,
  std::vector<double>& parameters, std::vector<std::uint8_t>& found, const Execution& execution)
{
  constexpr Index Batch = 1 << 16; // between two looks at the abort flag
  const auto n = static_cast<Index>(found.size());
  for (Index first = 0; first < n; first += Batch)
  {
    execution.Check(0.0);
    execution.ParallelFor(std::min(Batch, n - first),
      [&](Index begin, Index end)
      {
        for (Index i = first + begin; i < first + end; ++i)
        {
          found[i] = inverse.FindFrom(&places[3 * i], &parameters[3 * i]);
        }
      });
  }
}
}

//------------------------------------------------------------------------------
FoundParameters FindParametersOnShape(const TSpline& spline, const BezierMesh& mesh,
  const std::vector<double>& places, const std::vector<double>& starts, const Execution& execution)
{
  const InverseMap inverse(spline, mesh, execution);
  const Index n = static_cast<Index>(places.size() / 3);
  FoundParameters result;
  std::vector<std::uint8_t> found(n);
  if (starts.empty())
  {
    result.Parameters.resize(3 * n);
    inverse.Find(n, places.data(), result.Parameters.data(), found.data(), execution);
  }
  else
  {
    result.Parameters = starts;
    FindFromStarts(inverse, places, result.Parameters, found, execution);
  }
  for (Index i = 0; i < n; ++i)
  {
    if (!found[i])
    {
      result.Outside.push_back(i);
    }
  }
  const Index count = static_cast<Index>(result.Outside.size());
  result.Inside = n - count;
  std::vector<double> lost(3 * count), parameters(3 * count);
  for (Index k = 0; k < count; ++k)
  {
    std::copy_n(&places[3 * result.Outside[k]], 3, &lost[3 * k]);
  }
  inverse.Find(count, lost.data(), parameters.data(), found.data(), execution,
    std::numeric_limits<double>::infinity());
  std::vector<double> nearest(3 * count);
  EvaluatorOutput output;
  output.Values = nearest.data();
  Evaluator(spline, mesh, { 0, 1, 2 }, execution)
    .Evaluate(count, parameters.data(), output, execution);
  for (Index k = 0; k < count; ++k)
  {
    std::copy_n(&parameters[3 * k], 3, &result.Parameters[3 * result.Outside[k]]);
    const double *x = &lost[3 * k], *y = &nearest[3 * k];
    result.Distances.push_back(std::hypot(x[0] - y[0], x[1] - y[1], x[2] - y[2]));
  }
  return result;
}

//------------------------------------------------------------------------------
FoundParameters FindParametersOnSegments(const TSpline& spline, const BlockSpline& layout,
  const std::vector<double>& places, const std::vector<double>& parameters,
  const std::vector<double>& starts, const Execution& execution)
{
  const BlockComplex& blocks = layout.Blocks();
  const std::set<int> segments(blocks.Segments.begin(), blocks.Segments.end());
  if (segments.size() == 1 || parameters.empty())
  {
    return FindParametersOnShape(spline, BezierMesh(spline, execution), places, starts, execution);
  }
  const std::vector<int> segmentOf = layout.SegmentsOf(spline);
  const auto count = static_cast<Index>(places.size() / 3);
  FoundParameters all;
  all.Parameters.resize(places.size());
  for (const int segment : segments)
  {
    std::vector<Index> own;
    std::vector<double> ownPlaces, ownStarts;
    for (Index i = 0; i < count; ++i)
    {
      const double* p = &parameters[3 * i];
      if (blocks.Segments[blocks.BlockAt({ p[0], p[1], p[2] })] == segment)
      {
        own.push_back(i);
        ownPlaces.insert(ownPlaces.end(), &places[3 * i], &places[3 * i] + 3);
        if (!starts.empty())
        {
          ownStarts.insert(ownStarts.end(), &starts[3 * i], &starts[3 * i] + 3);
        }
      }
    }
    std::vector<char> isOther(segmentOf.size());
    std::transform(segmentOf.begin(), segmentOf.end(), isOther.begin(),
      [segment](int other) { return static_cast<char>(other != segment); });
    TSpline part = spline;
    RemoveFunctions(part, isOther);
    const FoundParameters found =
      FindParametersOnShape(part, BezierMesh(part, execution), ownPlaces, ownStarts, execution);
    for (std::size_t i = 0; i < own.size(); ++i)
    {
      std::copy_n(&found.Parameters[3 * i], 3, &all.Parameters[3 * own[i]]);
    }
    for (const Index i : found.Outside)
    {
      all.Outside.push_back(own[i]);
    }
    all.Inside += found.Inside;
    all.Distances.insert(all.Distances.end(), found.Distances.begin(), found.Distances.end());
  }
  return all;
}
}
