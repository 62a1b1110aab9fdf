// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "FeatureSpace.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace trivariate
{
namespace
{
// Coordinates that are nearly all noise are left out, as are attributes that do not vary.
constexpr double LEAST_RELIABILITY = 0.05;
constexpr double LEAST_VARIANCE = 1e-14;
// Attributes are never taken to be more precise than this share of their variance: nearly equal
// ones would otherwise differ by rounding only, and that difference count.
constexpr double NOISE_FLOOR = 0.01;

using Matrix = Eigen::MatrixXd;
using Rows =
  Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>;

Rows View(const PointRows& rows)
{
  return { rows.Values, rows.Count, rows.Dimensions };
}

double ReliabilityOf(double variance, double noise)
{
  return variance > 0.0 ? std::max(0.0, 1.0 - noise / variance) : 0.0;
}
}

//------------------------------------------------------------------------------
void FeatureSpace::Apply(const double* attributes, double* coordinates) const
{
  for (int d = 0; d < this->Dimensions; ++d)
  {
    const double* row = &this->Map[d * this->Attributes];
    double sum = 0.0;
    for (int a = 0; a < this->Attributes; ++a)
    {
      sum += row[a] * (attributes[a] - this->Mean[a]);
    }
    coordinates[d] = sum;
  }
}

//------------------------------------------------------------------------------
FeatureSpace MakeFeatureSpace(const FeatureSamples& samples)
{
  const int attributes = samples.Rows.Dimensions;
  const int textures = attributes - static_cast<int>(samples.Weights.size());
  FeatureSpace space;
  space.Attributes = attributes;
  space.Mean.assign(attributes, 0.0);
  if (samples.Rows.Count == 0)
  {
    return space;
  }
  const Eigen::RowVectorXd mean = View(samples.Rows).colwise().mean();
  std::copy(mean.data(), mean.data() + attributes, space.Mean.begin());
  const Matrix centred = View(samples.Rows).rowwise() - mean;
  const Matrix total = centred.transpose() * centred / static_cast<double>(samples.Rows.Count);
  Matrix noise = Matrix::Zero(attributes, attributes);
  if (samples.Left.Count > 0)
  {
    const Matrix difference = View(samples.Left) - View(samples.Right);
    noise = difference.transpose() * difference / (2.0 * static_cast<double>(samples.Left.Count));
  }

  const auto append = [&space](const Eigen::VectorXd& row, double reliability)
  {
    space.Map.insert(space.Map.end(), row.data(), row.data() + row.size());
    space.Reliability.push_back(reliability);
    ++space.Dimensions;
  };

  // The texture attributes that vary, in units of their standard deviation.
  std::vector<int> varying;
  for (int a = 0; a < textures; ++a)
  {
    if (total(a, a) > LEAST_VARIANCE)
    {
      varying.push_back(a);
    }
  }
  const int n = static_cast<int>(varying.size());
  if (n > 0)
  {
    Matrix t(n, n), s(n, n);
    for (int i = 0; i < n; ++i)
    {
      for (int j = 0; j < n; ++j)
      {
        const double unit =
          std::sqrt(total(varying[i], varying[i]) * total(varying[j], varying[j]));
        t(i, j) = total(varying[i], varying[j]) / unit;
        s(i, j) = noise(varying[i], varying[j]) / unit;
      }
      s(i, i) += NOISE_FLOOR;
    }
    const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix> solver(t, s);
    double variance = 0.0;
    for (int i = n - 1; i >= 0; --i) // the most reliable coordinate first
    {
      const double reliability = ReliabilityOf(solver.eigenvalues()[i], 1.0);
      if (reliability > LEAST_RELIABILITY)
      {
        variance += solver.eigenvalues()[i] * reliability * reliability;
        Eigen::VectorXd row = Eigen::VectorXd::Zero(attributes);
        // The sign of an eigenvector is arbitrary: the largest entry is positive.
        Eigen::Index largest = 0;
        solver.eigenvectors().col(i).cwiseAbs().maxCoeff(&largest);
        const double sign = solver.eigenvectors()(largest, i) < 0.0 ? -1.0 : 1.0;
        for (int j = 0; j < n; ++j)
        {
          row[varying[j]] = sign * reliability * solver.eigenvectors()(j, i) /
                            std::sqrt(total(varying[j], varying[j]));
        }
        append(row, reliability);
      }
    }
    for (double& entry : space.Map)
    {
      entry /= std::sqrt(variance);
    }
  }

  for (int a = textures; a < attributes; ++a)
  {
    const double reliability = ReliabilityOf(total(a, a), noise(a, a));
    const double weight = samples.Weights[a - textures];
    if (total(a, a) > 0.0 && weight * reliability > 0.0)
    {
      Eigen::VectorXd row = Eigen::VectorXd::Zero(attributes);
      row[a] = weight * reliability / std::sqrt(total(a, a));
      append(row, reliability);
    }
  }
  return space;
}
}
