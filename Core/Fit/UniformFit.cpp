// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "UniformFit.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace trivariate
{
namespace
{
std::array<int, 3> IntervalsAt(const std::array<Index, 3>& samples, double spacing)
{
  std::array<int, 3> intervals;
  for (int a = 0; a < 3; ++a)
  {
    intervals[a] = std::max(1, static_cast<int>(std::lround((samples[a] - 1) / spacing)));
  }
  return intervals;
}

// (C^T C)^-1 of one direction: moments to coefficients.
BandedOperator InverseGram(const DyadicAxis& axis)
{
  const BandedOperator& band = axis.Collocation;
  Eigen::MatrixXd collocation = Eigen::MatrixXd::Zero(band.Rows, band.Columns);
  for (Index r = 0; r < band.Rows; ++r)
  {
    for (int c = 0; c < band.Width; ++c)
    {
      collocation(r, band.First[r] + c) = band.Coefficients[r * band.Width + c];
    }
  }
  const Eigen::MatrixXd gram = collocation.transpose() * collocation;
  const Eigen::MatrixXd inverse = gram.completeOrthogonalDecomposition().pseudoInverse();
  std::vector<std::pair<std::int32_t, std::vector<double>>> rows;
  for (Index r = 0; r < inverse.rows(); ++r)
  {
    const Eigen::VectorXd row = inverse.row(r);
    rows.emplace_back(0, std::vector<double>(row.data(), row.data() + row.size()));
  }
  return BandedOperator::FromRows(inverse.cols(), rows);
}
}

//------------------------------------------------------------------------------
Axes MakeUniformAxes(const std::array<Index, 3>& samples, Index maximum)
{
  const auto count = [](const std::array<int, 3>& n)
  { return Index(n[0] + 3) * Index(n[1] + 3) * Index(n[2] + 3); };
  // The finest spacing, down to one sample distance, that keeps to the limit.
  double fine = 1.0,
         coarse = static_cast<double>(*std::max_element(samples.begin(), samples.end()));
  if (count(IntervalsAt(samples, fine)) <= maximum)
  {
    coarse = fine;
  }
  for (int step = 0; step < 60; ++step)
  {
    const double middle = 0.5 * (fine + coarse);
    (count(IntervalsAt(samples, middle)) <= maximum ? coarse : fine) = middle;
  }
  const std::array<int, 3> intervals = IntervalsAt(samples, coarse);
  return { DyadicAxis(samples[0], intervals[0], 0), DyadicAxis(samples[1], intervals[1], 0),
    DyadicAxis(samples[2], intervals[2], 0) };
}

//------------------------------------------------------------------------------
bool HasSmallInverse(const Axes& axes)
{
  return std::all_of(
    axes.begin(), axes.end(), [](const DyadicAxis& axis) { return axis.Functions(0) <= 512; });
}

//------------------------------------------------------------------------------
std::vector<double> SolveUniform(
  const Axes& axes, const Array3& moments, const Execution& execution)
{
  Array3 solution = moments.Clone();
  for (int a = 0; a < 3; ++a)
  {
    solution = Apply(InverseGram(axes[a]), a, solution, execution);
  }
  return { solution.Values.begin(), solution.Values.end() };
}
}
