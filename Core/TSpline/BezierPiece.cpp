// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "BezierPiece.h"

#include "TargetClones.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace trivariate
{
namespace
{
using Vector = std::array<double, 3>;

constexpr double Infinity = std::numeric_limits<double>::infinity();
constexpr int Stride[3] = { 1, 4, 16 }; // between control points along u, v, w

Vector Minus(const Vector& x, const Vector& y)
{
  return { x[0] - y[0], x[1] - y[1], x[2] - y[2] };
}

double Dot(const Vector& x, const Vector& y)
{
  return x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
}

// The least of 64 control points along a way; weights, if not null, are divided by.
TRIVARIATE_CLONES double LeastAlong(
  const double* way, const double* x, const double* y, const double* z, const double* weights)
{
  double along[64], least[8];
  for (int n = 0; n < 64; ++n)
  {
    along[n] = way[0] * x[n] + way[1] * y[n] + way[2] * z[n];
  }
  for (int n = 0; weights && n < 64; ++n)
  {
    along[n] /= weights[n];
  }
  std::copy_n(along, 8, least);
  for (int n = 8; n < 64; n += 8)
  {
    for (int k = 0; k < 8; ++k)
    {
      least[k] = along[n + k] < least[k] ? along[n + k] : least[k];
    }
  }
  return *std::min_element(least, least + 8);
}

// Halves of all cubics along one direction (de Casteljau).
template <int Stride>
TRIVARIATE_INLINE void Halve(
  const double* __restrict c, double* __restrict low, double* __restrict high)
{
  for (int first = 0; first < 64; first += 4 * Stride)
  {
    for (int n = first; n < first + Stride; ++n)
    {
      const int n1 = n + Stride, n2 = n1 + Stride, n3 = n2 + Stride;
      const double c01 = 0.5 * (c[n] + c[n1]), c12 = 0.5 * (c[n1] + c[n2]),
                   c23 = 0.5 * (c[n2] + c[n3]);
      const double c012 = 0.5 * (c01 + c12), c123 = 0.5 * (c12 + c23);
      low[n] = c[n];
      low[n1] = c01;
      low[n2] = c012;
      low[n3] = high[n] = 0.5 * (c012 + c123);
      high[n1] = c123;
      high[n2] = c23;
      high[n3] = c[n3];
    }
  }
}

TRIVARIATE_CLONES void HalveAlong(int axis, const double* c, double* low, double* high)
{
  if (axis == 0)
  {
    Halve<1>(c, low, high);
  }
  else if (axis == 1)
  {
    Halve<4>(c, low, high);
  }
  else
  {
    Halve<16>(c, low, high);
  }
}

// The control point at a corner.
int AtCorner(int corner)
{
  int n = 0;
  for (int a = 0; a < 3; ++a)
  {
    n += (corner >> a & 1) * 3 * Stride[a];
  }
  return n;
}
}

//------------------------------------------------------------------------------
BezierPiece::BezierPiece(
  const std::array<double, 6>& bounds, const double* coefficients, bool rational)
  : Box(bounds)
  , IsRational(rational)
{
  for (int a = 0; a < 3; ++a)
  {
    std::copy_n(coefficients + 64 * a, 64, this->Form[a].begin());
  }
  this->Form[3].fill(1.0);
  if (rational)
  {
    std::copy_n(coefficients + 192, 64, this->Form[3].begin());
  }
}

//------------------------------------------------------------------------------
Vector BezierPiece::ControlPoint(int n) const
{
  const double weight = this->Form[3][n];
  return { this->Form[0][n] / weight, this->Form[1][n] / weight, this->Form[2][n] / weight };
}

//------------------------------------------------------------------------------
Vector BezierPiece::Corner(int corner) const
{
  return this->ControlPoint(AtCorner(corner));
}

//------------------------------------------------------------------------------
Vector BezierPiece::CornerParameters(int corner) const
{
  return { this->Box[corner & 1], this->Box[2 + (corner >> 1 & 1)],
    this->Box[4 + (corner >> 2 & 1)] };
}

//------------------------------------------------------------------------------
// All control points lie beyond a plane across the way to the middle of the corners. Where the
// piece is small this is exact to the second order of its size.
double BezierPiece::LeastDistance(const Vector& point) const
{
  Vector way{};
  for (int corner = 0; corner < 8; ++corner)
  {
    const Vector offset = Minus(this->Corner(corner), point);
    for (int a = 0; a < 3; ++a)
    {
      way[a] += offset[a];
    }
  }
  const double length = std::sqrt(Dot(way, way));
  if (length == 0.0)
  {
    return 0.0;
  }
  if (!std::isfinite(length))
  {
    return Infinity;
  }
  const auto& [x, y, z, weight] = this->Form;
  const double least = LeastAlong(
    way.data(), x.data(), y.data(), z.data(), this->IsRational ? weight.data() : nullptr);
  return std::max((least - Dot(way, point)) / length, 0.0);
}

//------------------------------------------------------------------------------
// Along the edges of the piece. Weights are left out: they are close to each other within a piece.
int BezierPiece::LongestDirection() const
{
  const auto& [x, y, z, weight] = this->Form;
  std::array<double, 3> longest{};
  for (int a = 0; a < 3; ++a)
  {
    const int stride = Stride[a], s = 3 * Stride[(a + 1) % 3], t = 3 * Stride[(a + 2) % 3];
    for (const int edge : { 0, s, t, s + t })
    {
      for (int n = edge; n < edge + 3 * stride; n += stride)
      {
        const int next = n + stride;
        const Vector step = { x[next] - x[n], y[next] - y[n], z[next] - z[n] };
        longest[a] = std::max(longest[a], Dot(step, step));
      }
    }
  }
  return static_cast<int>(std::max_element(longest.begin(), longest.end()) - longest.begin());
}

//------------------------------------------------------------------------------
std::array<BezierPiece, 2> BezierPiece::Halves() const
{
  const int axis = this->LongestDirection(), stride = Stride[axis];
  std::array<BezierPiece, 2> halves = { *this, *this };
  const double middle = 0.5 * (this->Box[2 * axis] + this->Box[2 * axis + 1]);
  halves[0].Box[2 * axis + 1] = halves[1].Box[2 * axis] = middle;
  const int columns = this->IsRational ? 4 : 3;
  for (int column = 0; column < columns; ++column)
  {
    HalveAlong(axis, this->Form[column].data(), halves[0].Form[column].data(),
      halves[1].Form[column].data());
  }
  return halves;
}
}
