// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// Texture attributes as the textbook has them: plain sums over a matrix of probabilities.
#ifndef trivariate_PlainTexture_h
#define trivariate_PlainTexture_h

#include "Texture/TextureAttributes.h"
#include "Texture/TextureWindow.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <vector>

namespace trivariate
{
/// -sum x log2 x over the values of a map.
inline double EntropyOf(const std::map<int, double>& distribution)
{
  double entropy = 0.0;
  for (const auto& [key, p] : distribution)
  {
    entropy -= p > 0.0 ? p * std::log2(p) : 0.0;
  }
  return entropy;
}

/// The expectation of f over a map from values to probabilities.
template <typename Function>
double Expectation(const std::map<int, double>& distribution, const Function& f)
{
  double sum = 0.0;
  for (const auto& [key, p] : distribution)
  {
    sum += p * f(key);
  }
  return sum;
}

/// All attributes but f14 of a matrix that has pairs; the definitions one by one.
inline TextureAttributeValues PlainAttributes(const CooccurrenceMatrix& matrix)
{
  using A = TextureAttribute;
  const int levels = matrix.Levels;
  double total = 0.0;
  for (const Index count : matrix.Counts)
  {
    total += count;
  }
  const auto p = [&matrix, total](int i, int j) { return matrix(i - 1, j - 1) / total; };
  const auto expectation = [&p, levels](const auto& f)
  {
    double sum = 0.0;
    for (int i = 1; i <= levels; ++i)
    {
      for (int j = 1; j <= levels; ++j)
      {
        sum += p(i, j) * f(i, j);
      }
    }
    return sum;
  };
  std::map<int, double> joint, level, difference, sum;
  TextureAttributeValues values = {};
  const auto set = [&values](A a, double value) { values[static_cast<int>(a)] = value; };
  double largest = 0.0, squares = 0.0;
  for (int i = 1; i <= levels; ++i)
  {
    for (int j = 1; j <= levels; ++j)
    {
      joint[i * 1000 + j] += p(i, j);
      level[i] += p(i, j);
      difference[std::abs(i - j)] += p(i, j);
      sum[i + j] += p(i, j);
      largest = std::max(largest, p(i, j));
      squares += p(i, j) * p(i, j);
    }
  }
  const double mu = Expectation(level, [](double i) { return i; });
  const double variance = Expectation(level, [mu](double i) { return (i - mu) * (i - mu); });
  const double meanDifference = Expectation(difference, [](double d) { return d; });
  const auto power = [mu](int k) { return [mu, k](double s) { return std::pow(s - 2 * mu, k); }; };
  const double g = levels;
  set(A::JointMaximum, largest);
  set(A::AngularSecondMoment, squares);
  set(A::JointAverage, mu);
  set(A::JointVariance, variance);
  set(A::JointEntropy, EntropyOf(joint));
  set(A::DifferenceAverage, meanDifference);
  set(A::DifferenceVariance, Expectation(difference, [meanDifference](double d)
                               { return (d - meanDifference) * (d - meanDifference); }));
  set(A::DifferenceEntropy, EntropyOf(difference));
  set(A::SumAverage, Expectation(sum, [](double s) { return s; }));
  set(A::SumVariance, Expectation(sum, power(2)));
  set(A::SumEntropy, EntropyOf(sum));
  set(A::Contrast, expectation([](double i, double j) { return (i - j) * (i - j); }));
  set(A::Dissimilarity, expectation([](double i, double j) { return std::abs(i - j); }));
  set(A::InverseDifference,
    expectation([](double i, double j) { return 1.0 / (1.0 + std::abs(i - j)); }));
  set(A::NormalisedInverseDifference,
    expectation([g](double i, double j) { return 1.0 / (1.0 + std::abs(i - j) / g); }));
  set(A::InverseDifferenceMoment,
    expectation([](double i, double j) { return 1.0 / (1.0 + (i - j) * (i - j)); }));
  set(A::NormalisedInverseDifferenceMoment,
    expectation([g](double i, double j) { return 1.0 / (1.0 + (i - j) * (i - j) / (g * g)); }));
  set(A::InverseVariance,
    expectation([](double i, double j) { return i != j ? 1.0 / ((i - j) * (i - j)) : 0.0; }));
  set(A::Correlation,
    variance > 1e-12
      ? expectation([mu](double i, double j) { return (i - mu) * (j - mu); }) / variance
      : 1.0);
  set(A::Autocorrelation, expectation([](double i, double j) { return i * j; }));
  set(A::ClusterTendency, expectation([&](double i, double j) { return power(2)(i + j); }));
  set(A::ClusterShade, expectation([&](double i, double j) { return power(3)(i + j); }));
  set(A::ClusterProminence, expectation([&](double i, double j) { return power(4)(i + j); }));
  // HXY1 as it is defined; HXY2 - HXY as one sum, since its small values go through a square root.
  double hxy1 = 0.0, information = 0.0;
  for (int i = 1; i <= levels; ++i)
  {
    for (int j = 1; j <= levels; ++j)
    {
      const double product = level[i] * level[j];
      hxy1 -= p(i, j) > 0.0 ? p(i, j) * std::log2(product) : 0.0;
      information += p(i, j) > 0.0 ? p(i, j) * std::log2(p(i, j) / product) : 0.0;
    }
  }
  const double hx = EntropyOf(level);
  set(A::InformationCorrelation1, hx > 1e-12 ? (EntropyOf(joint) - hxy1) / hx : 0.0);
  // Less is rounding.
  set(A::InformationCorrelation2,
    information > 1e-13 ? std::sqrt(-std::expm1(-2.0 * information)) : 0.0);
  return values;
}

/// The chosen attributes of a matrix that has pairs, in [0, 1].
inline std::vector<double> PlainNormalised(
  const CooccurrenceMatrix& matrix, const TextureOptions& options)
{
  TextureAttributeValues values = PlainAttributes(matrix);
  values[TextureAttributeCount - 1] = MaximalCorrelationCoefficient(matrix);
  std::vector<double> normalised;
  for (const TextureAttribute a : options.Attributes)
  {
    normalised.push_back(
      NormalisedTextureAttribute(a, options.GreyLevels, values[static_cast<int>(a)]));
  }
  return normalised;
}

/// The window of a voxel, cut at the border.
inline VoxelBox WindowOf(
  const std::array<Index, 3>& voxel, const std::array<Index, 3>& size, int radius)
{
  VoxelBox box;
  for (int a = 0; a < 3; ++a)
  {
    box.Begin[a] = std::max<Index>(0, voxel[a] - radius);
    box.End[a] = std::min(size[a], voxel[a] + radius + 1);
  }
  return box;
}
}

#endif
