// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "JacobianRange.h"

#include "BezierExtraction.h"
#include "Evaluator.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace trivariate
{
namespace
{
constexpr Index CellsAtATime = 4096; // bounds the memory, and how long the user waits to be heard
constexpr double WholeTolerance = 1e-9, ConstantTolerance = 1e-9;
constexpr int Rule = 3, Points = Rule * Rule * Rule;

double ScaledJacobian(const double* g)
{
  const auto length = [g](int c) { return std::hypot(g[c], g[3 + c], g[6 + c]); };
  const double lengths = length(0) * length(1) * length(2);
  return lengths > 0.0 ? JacobianDeterminant(g) / lengths : 0.0;
}

// Whether each nine of the numbers are `wanted`.
bool AreAll(const std::vector<double>& gradients, const std::array<double, 9>& wanted)
{
  const auto smaller = [](double a, double b) { return std::abs(a) < std::abs(b); };
  const double size = std::abs(*std::max_element(wanted.begin(), wanted.end(), smaller));
  for (std::size_t i = 0; i < gradients.size(); ++i)
  {
    if (!(std::abs(gradients[i] - wanted[i % 9]) <= ConstantTolerance * size))
    {
      return false;
    }
  }
  return true;
}

// Gauss's points of a cell, u fastest.
void AddPoints(const std::array<double, 6>& bounds, std::vector<double>& points)
{
  const double offset = 0.5 * std::sqrt(0.6);
  const double shares[Rule] = { 0.5 - offset, 0.5, 0.5 + offset };
  for (int p = 0; p < Points; ++p)
  {
    const int ijk[3] = { p % Rule, p / Rule % Rule, p / Rule / Rule };
    for (int a = 0; a < 3; ++a)
    {
      const double low = bounds[2 * a], high = bounds[2 * a + 1];
      points.push_back(low + shares[ijk[a]] * (high - low));
    }
  }
}

// The cells on which the blending functions sum to one; all if there is none, which is a rational
// spline.
std::vector<Index> WholeCells(
  const TSpline& spline, const BezierMesh& mesh, const Execution& execution)
{
  std::vector<Index> whole, all;
  for (Index begin = 0; begin < mesh.Size(); begin += CellsAtATime)
  {
    const Index end = std::min(mesh.Size(), begin + CellsAtATime);
    const std::vector<double> sums = ExtractBezier(spline, mesh, { Denominator }, begin, end,
      execution.Part(1.0 * begin / mesh.Size(), 1.0 * end / mesh.Size()));
    for (Index cell = begin; cell < end; ++cell)
    {
      const double* sum = &sums[64 * (cell - begin)];
      all.push_back(cell);
      if (std::all_of(sum, sum + 64, [](double s) { return std::abs(s - 1.0) < WholeTolerance; }))
      {
        whole.push_back(cell);
      }
    }
  }
  return whole.empty() ? all : whole;
}
}

//------------------------------------------------------------------------------
JacobianRange MeasureJacobian(
  const TSpline& spline, const BezierMesh& mesh, const Execution& execution)
{
  JacobianRange range{ std::numeric_limits<double>::quiet_NaN(), 0, true };
  std::array<double, 9> first{};
  const std::vector<Index> cells = WholeCells(spline, mesh, execution.Part(0.0, 0.2));
  const Index count = static_cast<Index>(cells.size());
  const Evaluator geometry(spline, mesh, { 0, 1, 2 }, execution.Part(0.2, 0.4));
  std::vector<double> points, gradients;
  for (Index begin = 0; begin < count; begin += CellsAtATime)
  {
    const Index end = std::min(count, begin + CellsAtATime);
    points.clear();
    for (Index c = begin; c < end; ++c)
    {
      AddPoints(mesh.Bounds(cells[c]), points);
    }
    gradients.resize(3 * points.size());
    EvaluatorOutput output;
    output.Gradients = gradients.data();
    geometry.Evaluate((end - begin) * Points, points.data(), output,
      execution.Part(0.4 + 0.6 * begin / count, 0.4 + 0.6 * end / count));
    const double* g = gradients.data();
    if (begin == 0)
    {
      std::copy_n(g, 9, first.begin());
    }
    range.Constant = range.Constant && AreAll(gradients, first);
    for (Index c = begin; c < end; ++c)
    {
      double smallest = 1.0;
      for (int p = 0; p < Points; ++p, g += 9)
      {
        smallest = std::min(smallest, ScaledJacobian(g));
      }
      range.Minimum = std::fmin(range.Minimum, smallest);
      range.Inverted += smallest <= 0.0;
    }
  }
  return range;
}
}
