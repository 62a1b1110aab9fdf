// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "BSpline.h"

namespace trivariate
{
namespace
{
// Index of the non-empty span [t_k, t_k+1) that holds x, right-continuous, closed at t4; -1
// outside.
int FindSpan(const Knots5& t, double x)
{
  if (!(x >= t[0] && x <= t[4]))
  {
    return -1;
  }
  int span = -1;
  for (int k = 0; k < 4; ++k)
  {
    if (t[k] < t[k + 1] && t[k] <= x)
    {
      span = k;
    }
  }
  return span;
}

double Ratio(double numerator, double denominator)
{
  return denominator > 0.0 ? numerator / denominator : 0.0;
}
}

//------------------------------------------------------------------------------
// De Boor's recursion with another argument at each degree gives the piece's blossom, not its
// value.
double Blossom(const Knots5& t, int k, double x1, double x2, double x3)
{
  const double x[3] = { x1, x2, x3 };
  double n[4] = { 0.0, 0.0, 0.0, 0.0 };
  n[k] = 1.0;
  for (int degree = 1; degree <= 3; ++degree)
  {
    for (int i = 0; i + degree < 4; ++i)
    {
      n[i] = n[i] * Ratio(x[degree - 1] - t[i], t[i + degree] - t[i]) +
             n[i + 1] * Ratio(t[i + degree + 1] - x[degree - 1], t[i + degree + 1] - t[i + 1]);
    }
  }
  return n[0];
}

//------------------------------------------------------------------------------
Jet EvaluateBSpline(const Knots5& t, double x)
{
  const int k = FindSpan(t, x);
  if (k < 0)
  {
    return { 0.0, 0.0, 0.0 };
  }
  const double a = t[k];
  const double h = t[k + 1] - a;
  const double s = (x - a) / h;
  const auto c = BernsteinOfBSpline(t, a, t[k + 1]);
  const double r = 1.0 - s;
  const double d0 = c[1] - c[0], d1 = c[2] - c[1], d2 = c[3] - c[2];
  const auto b = Bernstein(s);
  return { b[0] * c[0] + b[1] * c[1] + b[2] * c[2] + b[3] * c[3],
    3.0 * (r * r * d0 + 2.0 * r * s * d1 + s * s * d2) / h,
    6.0 * (r * (d1 - d0) + s * (d2 - d1)) / (h * h) };
}

//------------------------------------------------------------------------------
std::array<double, 4> BernsteinOfBSpline(const Knots5& t, double a, double b)
{
  const int k = FindSpan(t, 0.5 * (a + b));
  if (k < 0)
  {
    return { 0.0, 0.0, 0.0, 0.0 };
  }
  return { Blossom(t, k, a, a, a), Blossom(t, k, a, a, b), Blossom(t, k, a, b, b),
    Blossom(t, k, b, b, b) };
}

//------------------------------------------------------------------------------
KnotInsertion InsertKnot(const Knots5& t, double x)
{
  return { x >= t[3] ? 1.0 : (x - t[0]) / (t[3] - t[0]),
    x <= t[1] ? 1.0 : (t[4] - x) / (t[4] - t[1]) };
}

//------------------------------------------------------------------------------
double DualFunctional(const Knots5& t, const std::array<double, 4>& c, double a, double b)
{
  std::array<double, 4> p = c;
  for (int degree = 1; degree <= 3; ++degree)
  {
    const double s = (t[degree] - a) / (b - a);
    for (int i = 0; i + degree < 4; ++i)
    {
      p[i] += s * (p[i + 1] - p[i]);
    }
  }
  return p[0];
}
}
