// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// Linear independence of blending functions by brute force.
#ifndef trivariate_Rank_h
#define trivariate_Rank_h

#include "TSpline.h"

#include <Eigen/Dense>

namespace trivariate
{
/**
 * Smallest singular value of the collocation matrix, columns scaled to length one, at 4 x 4 x 4
 * points of each unit cell of the knot grid, which decide every piecewise tricubic function. For a
 * few hundred functions.
 */
inline double SmallestSingularValue(const TSpline& spline)
{
  const auto n = static_cast<int>(spline.Size());
  // By direction: function's values at the points.
  std::array<Eigen::MatrixXd, 3> values;
  for (int a = 0; a < 3; ++a)
  {
    const KnotLine& line = spline.KnotLines[a];
    values[a].resize(n, 4 * (line.size() - 1));
    for (int i = 0; i < n; ++i)
    {
      for (int p = 0; p < values[a].cols(); ++p)
      {
        const double s = 0.125 + 0.25 * (p % 4);
        const double x = line[p / 4] + s * (line[p / 4 + 1] - line[p / 4]);
        values[a](i, p) = EvaluateBSpline(spline.LocalKnotValues(i, a), x)[0];
      }
    }
  }
  // The Gram matrix of the tensor grid's points is a product of one for each direction.
  Eigen::MatrixXd gram = values[0] * values[0].transpose();
  gram.array() *= (values[1] * values[1].transpose()).array();
  gram.array() *= (values[2] * values[2].transpose()).array();
  const Eigen::VectorXd scale = gram.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd scaled = scale.asDiagonal() * gram * scale.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(scaled, Eigen::EigenvaluesOnly);
  return std::sqrt(std::max(eigen.eigenvalues()[0], 0.0));
}
}

#endif
