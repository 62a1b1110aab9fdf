// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ShapeInverse.h"

#include "TSpline/Evaluator.h"
#include "TSpline/InverseMap.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace trivariate
{
//------------------------------------------------------------------------------
FoundParameters FindParametersOnShape(const TSpline& spline, const BezierMesh& mesh,
  const std::vector<double>& places, const Execution& execution)
{
  const InverseMap inverse(spline, mesh, execution);
  const Index n = static_cast<Index>(places.size() / 3);
  FoundParameters result;
  result.Parameters.resize(3 * n);
  std::vector<std::uint8_t> found(n);
  inverse.Find(n, places.data(), result.Parameters.data(), found.data(), execution);
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
}
