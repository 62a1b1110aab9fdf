// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "LinearIndependence.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace trivariate
{
namespace
{
constexpr double LeastShareOfWeight = 1e-6;

// A function to take out of a dependence: no other weight falls below LeastShare of what it was.
struct Removal
{
  std::size_t Member = 0;
  double LeastShare = 0.0;
};

// Moving along the dependence, one way or the other, until the first weight is zero.
Removal BestRemoval(const TSpline& spline, const LinearDependence& dependence)
{
  Removal best;
  double bestScore = 0.0;
  for (const double way : { 1.0, -1.0 })
  {
    // Relative changes of the weights for a step of one.
    std::vector<double> changes;
    for (std::size_t k = 0; k < dependence.Functions.size(); ++k)
    {
      changes.push_back(way * dependence.Coefficients[k] / spline.Weights[dependence.Functions[k]]);
    }
    const auto first = std::max_element(changes.begin(), changes.end());
    const double largest = *first;
    if (largest <= 0.0)
    {
      continue;
    }
    const auto member = static_cast<std::size_t>(first - changes.begin());
    *first = -std::numeric_limits<double>::infinity();
    const double share = 1.0 - *std::max_element(changes.begin(), changes.end()) / largest;
    // Coefficients grow by the inverse of the removed function's part in the dependence.
    const double score = std::min(share, 1.0) * std::abs(dependence.Coefficients[member]);
    if (score > bestScore)
    {
      bestScore = score;
      best = { member, std::min(share, 1.0) };
    }
  }
  return best;
}

// Changes weights and coefficients along the dependence so that those of one member become zero.
void MoveAlong(TSpline& spline, const LinearDependence& dependence, std::size_t member)
{
  const Index removed = dependence.Functions[member];
  for (std::size_t k = 0; k < dependence.Functions.size(); ++k)
  {
    const Index i = dependence.Functions[k];
    if (i == removed)
    {
      continue;
    }
    const double change =
      dependence.Coefficients[k] / dependence.Coefficients[member] * spline.Weights[removed];
    const double weight = spline.Weights[i] - change;
    for (int c = 0; c < spline.Components; ++c)
    {
      double& p = spline.ControlPoint(i)[c];
      p = (spline.Weights[i] * p - change * spline.ControlPoint(removed)[c]) / weight;
    }
    spline.Weights[i] = weight;
  }
}

// Adds a multiple of the other dependence so that the function of its member drops out.
void Eliminate(LinearDependence& target, const LinearDependence& other, std::size_t member)
{
  const Index removed = other.Functions[member];
  const auto place = std::lower_bound(target.Functions.begin(), target.Functions.end(), removed);
  if (place == target.Functions.end() || *place != removed)
  {
    return;
  }
  const double factor =
    target.Coefficients[place - target.Functions.begin()] / other.Coefficients[member];
  std::map<Index, double> sum;
  for (std::size_t k = 0; k < target.Functions.size(); ++k)
  {
    sum[target.Functions[k]] += target.Coefficients[k];
  }
  for (std::size_t k = 0; k < other.Functions.size(); ++k)
  {
    sum[other.Functions[k]] -= factor * other.Coefficients[k];
  }
  sum.erase(removed);
  target = {};
  for (const auto& [function, coefficient] : sum)
  {
    target.Functions.push_back(function);
    target.Coefficients.push_back(coefficient);
  }
}
}

//------------------------------------------------------------------------------
Index RepairLinearDependence(TSpline& spline, const Execution& execution)
{
  std::vector<char> removed(spline.Functions.size(), false);
  std::vector<LinearDependence> dependences = FindLinearDependences(spline, execution);
  for (std::size_t d = 0; d < dependences.size(); ++d)
  {
    const LinearDependence& dependence = dependences[d];
    const Removal removal = BestRemoval(spline, dependence);
    if (removal.LeastShare < LeastShareOfWeight)
    {
      continue;
    }
    MoveAlong(spline, dependence, removal.Member);
    removed[dependence.Functions[removal.Member]] = true;
    for (std::size_t e = d + 1; e < dependences.size(); ++e)
    {
      Eliminate(dependences[e], dependence, removal.Member);
    }
  }
  RemoveFunctions(spline, removed);
  return std::count(removed.begin(), removed.end(), true);
}
}
