// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// Linear independence of blending functions by brute force.
#ifndef trivariate_Rank_h
#define trivariate_Rank_h

#include "TSpline/TSpline.h"

#include <Eigen/Dense>

namespace trivariate
{
/**
 * Eigenvalues, ascending, of the Gram matrix of the functions' values at 4 x 4 x 4 points of each
 * unit cell of the knot grid, which decide every piecewise tricubic function; each function scaled
 * to length one. For a few hundred functions.
 */
inline Eigen::VectorXd GramEigenvalues(const TSpline& spline)
{
  const auto n = static_cast<int>(spline.Size());
  // The points are a tensor grid, so the matrix is a product of one for each direction.
  Eigen::MatrixXd gram = Eigen::MatrixXd::Ones(n, n);
  for (int a = 0; a < 3; ++a)
  {
    const KnotLine& line = spline.KnotLines[a];
    Eigen::MatrixXd values(n, 4 * (line.size() - 1));
    for (int i = 0; i < n; ++i)
    {
      for (int p = 0; p < values.cols(); ++p)
      {
        const double s = 0.125 + 0.25 * (p % 4);
        const double x = line[p / 4] + s * (line[p / 4 + 1] - line[p / 4]);
        values(i, p) = EvaluateBSpline(spline.LocalKnotValues(i, a), x)[0];
      }
    }
    gram.array() *= (values * values.transpose()).array();
  }
  const Eigen::VectorXd scale = gram.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd scaled = scale.asDiagonal() * gram * scale.asDiagonal();
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(scaled, Eigen::EigenvaluesOnly)
    .eigenvalues();
}

/// Smallest singular value of the matrix of those values.
inline double SmallestSingularValue(const TSpline& spline)
{
  return std::sqrt(std::max(GramEigenvalues(spline)[0], 0.0));
}

/// By how many the functions are more than the dimension of their space.
inline int RankDeficiency(const TSpline& spline)
{
  return static_cast<int>((GramEigenvalues(spline).array() < 1e-12).count());
}
}

#endif
