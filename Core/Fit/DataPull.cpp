// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "DataPull.h"

#include "TSpline/Evaluator.h"
#include "TSpline/InverseJacobian.h"

#include <Eigen/Dense>

#include <algorithm>
#include <numeric>

namespace trivariate
{
namespace
{
constexpr double LongestStep = 2.0; // voxels

// Slopes per voxel, as shares of the range: what is flatter has no direction, and what is steeper
// comes from a cell that is nearly flat itself.
constexpr double Flattest = 0.02, Steepest = 2.0;
}

//------------------------------------------------------------------------------
DataPull PullToData(const TSpline& spline, const ScatteredSamples& samples,
  const std::vector<double>& ranges, double spacing, double factor, const Execution& execution)
{
  using Eigen::Vector3d;
  const BezierMesh mesh(spline, execution);
  const int columns = 3 + samples.Components;
  std::vector<int> components(columns);
  std::iota(components.begin(), components.end(), 0);
  const Evaluator evaluator(spline, mesh, components, execution);
  const Index n = samples.Count();
  std::vector<double> values(n * columns), gradients(3 * n * columns);
  EvaluatorOutput output;
  output.Values = values.data();
  output.Gradients = gradients.data();
  evaluator.Evaluate(n, samples.Parameters.data(), output, execution);
  DataPull pull;
  pull.Places.resize(3 * n);
  pull.Weights.resize(n);
  execution.ParallelFor(n,
    [&](Index begin, Index end)
    {
      for (Index i = begin; i < end; ++i)
      {
        const double *value = &values[columns * i], *gradient = &gradients[3 * columns * i];
        const InverseJacobian inverse(gradient);
        Vector3d wanted = Vector3d::Zero();
        double square = 0.0;
        for (int c = 0; c < samples.Components; ++c)
        {
          const auto slopes = inverse.Gradient(gradient + 3 * (3 + c));
          const Vector3d slope = spacing / ranges[c] * Vector3d(slopes.data());
          wanted += slope * (value[3 + c] - samples.Values[c * n + i]) / ranges[c];
          square += slope.squaredNorm();
        }
        if (square > Steepest * Steepest)
        {
          wanted *= Steepest * Steepest / square;
          square = Steepest * Steepest;
        }
        square += Flattest * Flattest;
        wanted *= factor / square;
        wanted *= spacing * std::min(1.0, LongestStep / std::max(wanted.norm(), 1e-300));
        for (int a = 0; a < 3; ++a)
        {
          pull.Places[3 * i + a] = value[a] + wanted[a];
        }
        pull.Weights[i] = static_cast<float>(square);
      }
    });
  return pull;
}
}
