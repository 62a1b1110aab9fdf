// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "GradientJump.h"

#include "TSpline/InverseJacobian.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace trivariate
{
namespace
{
constexpr int Points = 16; // along each side of a face

void AppendPoint(const BlockComplex& blocks, const BlockFace& face, const std::array<double, 2>& st,
  std::vector<double>& points)
{
  const auto axes = TangentialAxes(face.Axis);
  std::array<double, 3> local;
  local[face.Axis] = face.Side;
  local[axes[0]] = st[0];
  local[axes[1]] = st[1];
  for (int a = 0; a < 3; ++a)
  {
    points.push_back(blocks.Origins[face.Block][a] + local[a]);
  }
}

// The area in space of a unit of the face on which the axis is constant, from d(X, Y, Z)/d(u, v,
// w).
double AreaOf(const double* gradients, int axis)
{
  const auto [s, t] = TangentialAxes(axis);
  double squares = 0.0;
  for (int a = 0; a < 3; ++a)
  {
    const double *x = gradients + 3 * ((a + 1) % 3), *y = gradients + 3 * ((a + 2) % 3);
    const double cross = x[s] * y[t] - x[t] * y[s];
    squares += cross * cross;
  }
  return std::sqrt(squares);
}
}

//------------------------------------------------------------------------------
std::vector<GradientJump> MeasureGradientJumps(const BlockComplex& blocks, const TSpline& spline,
  const BezierMesh& mesh, const std::vector<double>& units, const Execution& execution)
{
  std::vector<double> parameters; // of a point on one side, then on the other
  std::vector<int> axes;          // of the face on the first side of each point
  for (Index face = 0; face < 6 * blocks.Size(); ++face)
  {
    const BlockFace own{ face / 6, static_cast<int>(face % 6 / 2), static_cast<int>(face % 2) };
    const FaceTwin& twin = blocks.Twin(own);
    if (!blocks.IsGlued(own) || face > 6 * twin.Face.Block + 2 * twin.Face.Axis + twin.Face.Side ||
        blocks.Segments[own.Block] != blocks.Segments[twin.Face.Block])
    {
      continue;
    }
    for (int point = 0; point < Points * Points; ++point)
    {
      const std::array<double, 2> st{ (point % Points + 0.5) / Points,
        (point / Points + 0.5) / Points };
      AppendPoint(blocks, own, st, parameters);
      AppendPoint(blocks, twin.Face, twin.Map(st, 1.0), parameters);
      axes.push_back(own.Axis);
    }
  }

  std::vector<int> components(spline.Components);
  std::iota(components.begin(), components.end(), 0);
  const auto stride = static_cast<std::size_t>(3 * spline.Components);
  std::vector<double> gradients(parameters.size() / 3 * stride);
  EvaluatorOutput output;
  output.Gradients = gradients.data();
  Evaluator(spline, mesh, components, execution.Part(0.0, 0.5))
    .Evaluate(static_cast<Index>(parameters.size() / 3), parameters.data(), output,
      execution.Part(0.5, 1.0));

  std::vector<GradientJump> jumps(units.size());
  double area = 0.0;
  for (std::size_t pair = 0; pair < axes.size(); ++pair)
  {
    const double *own = &gradients[2 * pair * stride], *other = own + stride;
    const InverseJacobian ownMap(own), otherMap(other);
    if (!(ownMap.Determinant > 0.0) || !(otherMap.Determinant > 0.0))
    {
      continue;
    }
    const double weight = AreaOf(own, axes[pair]);
    area += weight;
    for (std::size_t c = 0; c < jumps.size(); ++c)
    {
      const auto g = ownMap.Gradient(own + 9 + 3 * c), h = otherMap.Gradient(other + 9 + 3 * c);
      const double jump = units[c] * std::hypot(g[0] - h[0], g[1] - h[1], g[2] - h[2]);
      jumps[c].Rms += weight * jump * jump;
      jumps[c].Maximum = std::max(jumps[c].Maximum, jump);
    }
  }
  for (GradientJump& jump : jumps)
  {
    jump.Rms = area > 0.0 ? std::sqrt(jump.Rms / area) : 0.0;
  }
  return jumps;
}

//------------------------------------------------------------------------------
GradientJump WorstGradientJump(const BlockComplex& blocks, const TSpline& spline,
  const BezierMesh& mesh, const std::vector<double>& ranges, double spacing,
  const Execution& execution)
{
  std::vector<double> units;
  for (const double range : ranges)
  {
    units.push_back(spacing / range);
  }
  GradientJump worst;
  for (const GradientJump& jump : MeasureGradientJumps(blocks, spline, mesh, units, execution))
  {
    worst.Rms = std::max(worst.Rms, jump.Rms);
    worst.Maximum = std::max(worst.Maximum, jump.Maximum);
  }
  return worst;
}
}
