// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// T-splines for tests of what does not look at their mathematics: anything that Validate accepts.
#ifndef RandomTSplineModel_h
#define RandomTSplineModel_h

#include "TSpline/TSplineModel.h"

#include <algorithm>
#include <limits>
#include <random>
#include <utility>
#include <vector>

namespace trivariate
{
struct RandomModelOptions
{
  Index Functions = 64;
  std::size_t Knots = 9; ///< a knot line
  std::vector<TSplineAttribute> Attributes = { { "density", 1 } };
};

inline TSplineModel RandomModel(unsigned seed, const RandomModelOptions& options = {})
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  // All magnitudes, both zeros, and numbers that a careless conversion changes.
  const auto number = [&random, &unit]()
  {
    const double special[] = { 0.0, -0.0, 0.1, std::numeric_limits<double>::denorm_min(),
      std::numeric_limits<double>::max(), -std::numeric_limits<double>::min() };
    const unsigned pick = random() % 32;
    return pick < 6 ? special[pick] : std::ldexp(unit(random) - 0.5, static_cast<int>(pick) - 16);
  };
  TSplineModel model;
  model.Attributes = options.Attributes;
  model.RootCells = { 1, 2, static_cast<std::int32_t>(1 + seed % 5) };
  TSpline& spline = model.Spline;
  spline.Components = 3;
  for (const TSplineAttribute& attribute : model.Attributes)
  {
    spline.Components += attribute.Components;
  }
  for (KnotLine& line : spline.KnotLines)
  {
    double knot = -unit(random);
    for (std::size_t k = 0; k < options.Knots; ++k)
    {
      line.push_back(knot);
      knot += 0.01 + unit(random);
    }
  }
  const auto last = static_cast<std::int32_t>(options.Knots - 1);
  for (Index i = 0; i < options.Functions; ++i)
  {
    BlendingFunction function;
    for (LocalKnots& local : function)
    {
      for (std::int32_t& knot : local)
      {
        knot = static_cast<std::int32_t>(random() % options.Knots);
      }
      std::sort(local.begin(), local.end());
      local[0] = std::min(local[0], last - 1);
      local[4] = std::max(local[4], local[0] + 1);
    }
    spline.Functions.push_back(function);
    spline.Weights.push_back(1e-3 + unit(random));
    model.Segment.push_back(static_cast<std::int32_t>(random()));
    model.Block.push_back(static_cast<std::int32_t>(random() % 7) - 1);
  }
  // Every knot is used, so that the lines can be rebuilt from the functions.
  for (std::size_t k = 0; k + 1 < options.Knots && k < spline.Functions.size(); ++k)
  {
    for (LocalKnots& local : spline.Functions[k])
    {
      const auto knot = static_cast<std::int32_t>(k);
      local = { knot, knot, knot, knot, knot + 1 };
    }
  }
  spline.ControlPoints.resize(spline.Functions.size() * spline.Components);
  std::generate(spline.ControlPoints.begin(), spline.ControlPoints.end(), number);
  return model;
}
}

#endif
