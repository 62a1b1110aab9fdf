// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "InverseMap.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>

namespace trivariate
{
namespace
{
constexpr int MaximumSteps = 40, MaximumHalvings = 12;
constexpr double SmallestGain = 1e-9; // of the distance, in one step

// The distance of a point from a box.
double DistanceFrom(const std::array<double, 3>& low, const std::array<double, 3>& high,
  const std::array<double, 3>& point)
{
  Eigen::Vector3d outside;
  for (int a = 0; a < 3; ++a)
  {
    outside[a] = std::max({ low[a] - point[a], point[a] - high[a], 0.0 });
  }
  return outside.norm();
}
}

//------------------------------------------------------------------------------
// Gauss-Newton steps from the nearest of 27 points of a cell, which stay in the cell: a parameter
// at an end of it rests there as long as the distance falls outwards.
void InverseMap::Approach(const Vector& point, Index cell, Place& nearest) const
{
  const std::array<double, 6> bounds = this->Cells->Bounds(cell);
  Place here;
  here.Distance = std::numeric_limits<double>::infinity();
  for (int start = 0; start < 27; ++start)
  {
    const int thirds[3] = { start % 3, start / 3 % 3, start / 9 };
    Place place;
    for (int a = 0; a < 3; ++a)
    {
      const double low = bounds[2 * a], high = bounds[2 * a + 1];
      place.Parameters[a] = low + (high - low) * (thirds[a] + 0.5) / 3.0;
    }
    if (this->Evaluate(point, place) && place.Distance < here.Distance)
    {
      here = place;
    }
  }
  if (!std::isfinite(here.Distance))
  {
    return;
  }
  for (int step = 0; step < MaximumSteps; ++step)
  {
    const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> jacobian(
      here.Jacobian.data());
    const Eigen::Map<const Eigen::Vector3d> residual(here.Residual.data());
    Eigen::Vector3d gradient = jacobian.transpose() * residual;
    Eigen::Matrix3d hessian = jacobian.transpose() * jacobian;
    for (int a = 0; a < 3; ++a)
    {
      const bool rests = gradient[a] > 0.0 ? here.Parameters[a] <= bounds[2 * a]
                                           : here.Parameters[a] >= bounds[2 * a + 1];
      if (rests)
      {
        hessian.row(a).setZero();
        hessian.col(a).setZero();
        hessian(a, a) = 1.0;
        gradient[a] = 0.0;
      }
    }
    const Eigen::Vector3d move = hessian.fullPivLu().solve(gradient);
    Place there;
    bool closer = false;
    double damping = 1.0;
    for (int halving = 0; halving < MaximumHalvings && !closer; ++halving, damping *= 0.5)
    {
      for (int a = 0; a < 3; ++a)
      {
        there.Parameters[a] =
          std::clamp(here.Parameters[a] - damping * move[a], bounds[2 * a], bounds[2 * a + 1]);
      }
      closer = this->Evaluate(point, there) && there.Distance < here.Distance;
    }
    if (!closer)
    {
      break;
    }
    const bool arrived = here.Distance - there.Distance <= SmallestGain * here.Distance;
    here = there;
    if (arrived)
    {
      break;
    }
  }
  if (here.Distance < nearest.Distance)
  {
    nearest = here;
  }
}

//------------------------------------------------------------------------------
void InverseMap::NearestBelow(std::int32_t node, const Vector& point, Place& nearest) const
{
  const Node& here = this->Tree[node];
  if (here.Children[0] < 0)
  {
    this->Approach(point, -1 - here.Children[0], nearest);
    return;
  }
  std::array<std::int32_t, 2> children = here.Children;
  const auto distance = [&](std::int32_t child)
  { return DistanceFrom(this->Tree[child].Low, this->Tree[child].High, point); };
  if (distance(children[1]) < distance(children[0]))
  {
    std::swap(children[0], children[1]);
  }
  for (const std::int32_t child : children)
  {
    if (distance(child) < nearest.Distance)
    {
      this->NearestBelow(child, point, nearest);
    }
  }
}

//------------------------------------------------------------------------------
bool InverseMap::FindNearest(const double point[3], double reach, double parameters[3]) const
{
  if (this->Find(point, parameters))
  {
    return true;
  }
  if (this->IsAffine)
  {
    return false;
  }
  Place nearest;
  nearest.Distance = reach;
  this->NearestBelow(0, { point[0], point[1], point[2] }, nearest);
  if (nearest.Distance < reach)
  {
    std::copy(nearest.Parameters.begin(), nearest.Parameters.end(), parameters);
  }
  return nearest.Distance < reach;
}
}
