// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// Splines whose geometry is known in closed form.
#ifndef trivariate_Shapes_h
#define trivariate_Shapes_h

#include "TSpline/Evaluator.h"
#include "TSpline/TSpline.h"

#include <array>
#include <cmath>
#include <vector>

namespace trivariate
{
/// A solid quarter annulus over [0, 1]^3, exact with rational weights: radius 1 + u from 1 to 2,
/// angle from 0 (v = 0) to pi / 2 (v = 1), height w from 0 to 1. One cell, whose knot lines have
/// `intervals` intervals for refinement. Its volume is 3 pi / 4.
inline TSpline QuarterAnnulus(int intervals)
{
  const KnotLine line = MakeUniformKnotLine(0.0, 1.0, intervals);
  TSpline spline = MakeTensorProduct({ line, line, line }, { intervals, intervals, intervals }, 0);
  // The quarter circle as a rational quadratic (1, 0), (1, 1), (0, 1) with the weights 1,
  // sqrt(1/2), 1, its degree raised to three.
  const double s = std::sqrt(0.5);
  const double x[4] = { 1.0, (1.0 + 2.0 * s) / 3.0, 2.0 * s / 3.0, 0.0 };
  const double weight[4] = { 1.0, (1.0 + 2.0 * s) / 3.0, (1.0 + 2.0 * s) / 3.0, 1.0 };
  for (Index i = 0; i < 64; ++i)
  {
    const double radius = 1.0 + (i % 4) / 3.0;
    const int v = i / 4 % 4;
    double* p = spline.ControlPoint(i);
    p[0] = radius * x[v] / weight[v];
    p[1] = radius * x[3 - v] / weight[v];
    p[2] = (i / 16) / 3.0;
    spline.Weights[i] = weight[v];
  }
  return spline;
}

/// A bar [-1, 1]^2 x [0, 4] whose cross-section turns by `turn` radians from end to end and is bent
/// by `bend`: smooth, and injective for moderate values. The control points are those of the
/// Greville abscissae.
inline void TwistAndBend(TSpline& spline, double turn, double bend)
{
  for (Index i = 0; i < spline.Size(); ++i)
  {
    std::array<double, 3> t;
    for (int a = 0; a < 3; ++a)
    {
      const KnotLine& line = spline.KnotLines[a];
      t[a] = (Greville(spline.LocalKnotValues(i, a)) - line.front()) / (line.back() - line.front());
    }
    const double x = 2.0 * t[0] - 1.0, y = 2.0 * t[1] - 1.0, z = 4.0 * t[2];
    const double angle = turn * t[2];
    double* p = spline.ControlPoint(i);
    p[0] = x * std::cos(angle) - y * std::sin(angle) + bend * t[2] * t[2];
    p[1] = x * std::sin(angle) + y * std::cos(angle);
    p[2] = z + 0.1 * bend * x;
  }
}

/// Nodes and weights of Gauss's quadrature on [0, 1].
inline std::vector<std::array<double, 2>> GaussRule(int n)
{
  std::vector<std::array<double, 2>> rule;
  for (int i = 0; i < n; ++i)
  {
    double x = std::cos(std::acos(-1.0) * (i + 0.75) / (n + 0.5)), slope = 0.0;
    for (int newton = 0; newton < 20; ++newton)
    {
      double p = 1.0, before = 0.0;
      for (int k = 0; k < n; ++k)
      {
        const double next = ((2 * k + 1) * x * p - k * before) / (k + 1);
        before = p;
        p = next;
      }
      slope = n * (x * p - before) / (x * x - 1.0);
      x -= p / slope;
    }
    rule.push_back({ 0.5 * (1.0 + x), 1.0 / ((1.0 - x * x) * slope * slope) });
  }
  return rule;
}

/// Integral of det J over the cells, by n^3 Gauss points a cell.
inline double Volume(const TSpline& spline, const BezierMesh& mesh, int n)
{
  const Evaluator geometry(spline, mesh, { 0, 1, 2 });
  const auto rule = GaussRule(n);
  double volume = 0.0;
  for (Index cell = 0; cell < mesh.Size(); ++cell)
  {
    const auto b = mesh.Bounds(cell);
    const double size = (b[1] - b[0]) * (b[3] - b[2]) * (b[5] - b[4]);
    for (const auto& [s, p] : rule)
    {
      for (const auto& [t, q] : rule)
      {
        for (const auto& [r, m] : rule)
        {
          const double u[3] = { b[0] + s * (b[1] - b[0]), b[2] + t * (b[3] - b[2]),
            b[4] + r * (b[5] - b[4]) };
          double gradients[9];
          EvaluatorOutput output;
          output.Gradients = gradients;
          geometry.Evaluate(u, output);
          volume += size * p * q * m * JacobianDeterminant(gradients);
        }
      }
    }
  }
  return volume;
}
}

#endif
