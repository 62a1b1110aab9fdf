// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "InverseMap.h"

#include "BezierPiece.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>

namespace trivariate
{
namespace
{
constexpr int MaximumSteps = 40, MaximumHalvings = 12;
constexpr double SmallestGain = 1e-9;  // of the distance, in one step
constexpr double WorthIt = 1.0 - 1e-3; // of the distance: what comes nearer than that is looked for

constexpr double Infinity = std::numeric_limits<double>::infinity();

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

double DistanceBetween(const std::array<double, 3>& x, const std::array<double, 3>& y)
{
  return std::hypot(x[0] - y[0], x[1] - y[1], x[2] - y[2]);
}
}

//------------------------------------------------------------------------------
// Gauss-Newton steps, which stay in the cell: a parameter at an end of it rests there as long as
// the distance falls outwards.
void InverseMap::Approach(
  const Vector& point, const std::array<double, 6>& bounds, Place here, Place& nearest) const
{
  if (!this->Evaluate(point, here))
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
// A distance below which another place is worth the search.
double InverseMap::WorthTheSearch(const Place& nearest) const
{
  return WorthIt * nearest.Distance - AcceptedResidual * this->Size;
}

//------------------------------------------------------------------------------
// Halves the piece until no part of it can come nearer; goes from corners that do.
void InverseMap::NearestIn(const BezierPiece& piece, const std::array<double, 6>& cell,
  const Vector& point, Place& nearest) const
{
  for (int corner = 0; corner < 8; ++corner)
  {
    Place start;
    start.Parameters = piece.CornerParameters(corner);
    if (DistanceBetween(piece.Corner(corner), point) < this->WorthTheSearch(nearest))
    {
      this->Approach(point, cell, start, nearest);
    }
  }
  std::array<BezierPiece, 2> halves = piece.Halves();
  std::array<double, 2> least = { halves[0].LeastDistance(point), halves[1].LeastDistance(point) };
  const int first = least[1] < least[0];
  for (const int half : { first, 1 - first })
  {
    if (least[half] < this->WorthTheSearch(nearest))
    {
      this->NearestIn(halves[half], cell, point, nearest);
    }
  }
}

//------------------------------------------------------------------------------
void InverseMap::NearestBelow(std::int32_t node, const Vector& point, Place& nearest) const
{
  const Node& here = this->Tree[node];
  if (here.Children[0] < 0)
  {
    const Index cell = -1 - here.Children[0];
    const std::array<double, 6> bounds = this->Cells->Bounds(cell);
    const BezierPiece piece(bounds, this->Geometry->Coefficients(cell), this->Geometry->Rational());
    const double least = piece.LeastDistance(point);
    if (least < nearest.Distance)
    {
      Place middle;
      for (int a = 0; a < 3; ++a)
      {
        middle.Parameters[a] = 0.5 * (bounds[2 * a] + bounds[2 * a + 1]);
      }
      this->Approach(point, bounds, middle, nearest);
    }
    if (least < this->WorthTheSearch(nearest))
    {
      this->NearestIn(piece, bounds, point, nearest);
    }
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
  nearest.Distance = (reach + AcceptedResidual * this->Size) / WorthIt;
  this->NearestBelow(0, { point[0], point[1], point[2] }, nearest);
  if (nearest.Distance < reach)
  {
    std::copy(nearest.Parameters.begin(), nearest.Parameters.end(), parameters);
  }
  return nearest.Distance < reach;
}

//------------------------------------------------------------------------------
bool InverseMap::FindNearestFrom(const double point[3], double parameters[3]) const
{
  if (this->IsAffine)
  {
    return this->FindNearest(point, Infinity, parameters);
  }
  const Vector x = { point[0], point[1], point[2] };
  Place nearest;
  nearest.Parameters = { parameters[0], parameters[1], parameters[2] };
  bool isThere = this->Newton(x, nearest.Parameters);
  if (!isThere)
  {
    Place start;
    start.Parameters = { parameters[0], parameters[1], parameters[2] };
    nearest.Distance = Infinity;
    const Index cell = this->Cells->FindCell(parameters[0], parameters[1], parameters[2]);
    if (cell >= 0)
    {
      this->Approach(x, this->Cells->Bounds(cell), start, nearest);
    }
    this->NearestBelow(0, x, nearest);
    isThere = nearest.Distance <= AcceptedResidual * this->Size;
  }
  std::copy(nearest.Parameters.begin(), nearest.Parameters.end(), parameters);
  return isThere;
}
}
