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
// Whether each place is on the shape; takes its parameters, or starts, to those of the nearest
// point.
std::vector<std::uint8_t> FindAll(const InverseMap& inverse, const std::vector<double>& places,
  bool hasStarts, std::vector<double>& parameters, const Execution& execution)
{
  constexpr double Anywhere = std::numeric_limits<double>::infinity();
  constexpr Index Batch = 1 << 16; // between two looks at the abort flag
  const auto n = static_cast<Index>(places.size() / 3);
  std::vector<std::uint8_t> found(n);
  for (Index first = 0; first < n; first += Batch)
  {
    execution.Check(0.0);
    execution.ParallelFor(std::min(Batch, n - first),
      [&](Index begin, Index end)
      {
        for (Index i = first + begin; i < first + end; ++i)
        {
          const double* place = &places[3 * i];
          double* there = &parameters[3 * i];
          found[i] = hasStarts ? inverse.FindNearestFrom(place, there) : inverse.Find(place, there);
          if (!hasStarts && !found[i])
          {
            inverse.FindNearest(place, Anywhere, there);
          }
        }
      });
  }
  return found;
}
}

//------------------------------------------------------------------------------
FoundParameters FindParametersOnShape(const TSpline& spline, const BezierMesh& mesh,
  const std::vector<double>& places, const std::vector<double>& starts, const Execution& execution)
{
  const InverseMap inverse(spline, mesh, execution);
  const Index n = static_cast<Index>(places.size() / 3);
  FoundParameters result;
  result.Parameters = starts;
  result.Parameters.resize(3 * n);
  const std::vector<std::uint8_t> found =
    FindAll(inverse, places, !starts.empty(), result.Parameters, execution);
  for (Index i = 0; i < n; ++i)
  {
    if (!found[i])
    {
      result.Outside.push_back(i);
    }
  }
  const Index count = static_cast<Index>(result.Outside.size());
  result.Inside = n - count;
  std::vector<double> feet(3 * count), nearest(3 * count);
  for (Index k = 0; k < count; ++k)
  {
    std::copy_n(&result.Parameters[3 * result.Outside[k]], 3, &feet[3 * k]);
  }
  EvaluatorOutput output;
  output.Values = nearest.data();
  Evaluator(spline, mesh, { 0, 1, 2 }, execution).Evaluate(count, feet.data(), output, execution);
  for (Index k = 0; k < count; ++k)
  {
    const double *x = &places[3 * result.Outside[k]], *y = &nearest[3 * k];
    result.Distances.push_back(std::hypot(x[0] - y[0], x[1] - y[1], x[2] - y[2]));
  }
  return result;
}

//------------------------------------------------------------------------------
OutsidePlaces OutsideWithin(
  double reach, const FoundParameters& found, const std::vector<double>& places)
{
  OutsidePlaces near;
  for (std::size_t k = 0; k < found.Outside.size(); ++k)
  {
    if (found.Distances[k] <= reach)
    {
      const double *place = &places[3 * found.Outside[k]],
                   *foot = &found.Parameters[3 * found.Outside[k]];
      near.Places.insert(near.Places.end(), place, place + 3);
      near.Feet.insert(near.Feet.end(), foot, foot + 3);
    }
  }
  return near;
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
