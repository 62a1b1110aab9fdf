// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "MonotoneMap.h"

#include <algorithm>

namespace trivariate
{
//------------------------------------------------------------------------------
MonotoneMap::MonotoneMap(std::vector<double> places, std::vector<double> values)
  : Places(std::move(places))
  , Values(std::move(values))
{
  const std::size_t n = this->Places.size();
  std::vector<double> steps;
  for (std::size_t i = 0; i + 1 < n; ++i)
  {
    steps.push_back(
      (this->Values[i + 1] - this->Values[i]) / (this->Places[i + 1] - this->Places[i]));
  }
  this->Slopes.push_back(steps.front());
  for (std::size_t i = 1; i + 1 < n; ++i)
  {
    const double before = this->Places[i] - this->Places[i - 1];
    const double after = this->Places[i + 1] - this->Places[i];
    const double share = (before + 2.0 * after) / (3.0 * (before + after));
    const double mean = share * steps[i] + (1.0 - share) * steps[i - 1];
    this->Slopes.push_back(mean > 0.0 ? steps[i - 1] * steps[i] / mean : 0.0);
  }
  this->Slopes.push_back(steps.back());
}

//------------------------------------------------------------------------------
double MonotoneMap::operator()(double place) const
{
  const std::size_t last = this->Places.size() - 1;
  if (place <= this->Places[0])
  {
    return this->Values[0] + this->Slopes[0] * (place - this->Places[0]);
  }
  if (place >= this->Places[last])
  {
    return this->Values[last] + this->Slopes[last] * (place - this->Places[last]);
  }
  const std::size_t i =
    std::upper_bound(this->Places.begin(), this->Places.end(), place) - this->Places.begin() - 1;
  const double width = this->Places[i + 1] - this->Places[i], t = (place - this->Places[i]) / width;
  const double rise = this->Values[i + 1] - this->Values[i];
  const double low = width * this->Slopes[i], high = width * this->Slopes[i + 1];
  // Hermite's cubic by its divided differences.
  return this->Values[i] +
         t * (low + t * (3.0 * rise - 2.0 * low - high + t * (low + high - 2.0 * rise)));
}
}
