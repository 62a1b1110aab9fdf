// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "TextureAttributes.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace trivariate
{
using A = TextureAttribute;

namespace
{
// The central moments of a distribution of integers that are not negative.
struct CentralMoments
{
  double Mean, Second, Third, Fourth;

  // From the sums of the first four powers of n integers. About the integer next to the mean, the
  // sums are exact and small: nothing cancels in what remains.
  CentralMoments(std::int64_t n, const std::array<std::int64_t, 4>& sums)
  {
    const double inverse = 1.0 / n;
    this->Mean = sums[0] * inverse;
    const std::int64_t c = static_cast<std::int64_t>(2.0 * this->Mean + 1.0) / 2;
    const std::int64_t first = sums[0] - c * n;
    const std::int64_t second = sums[1] - c * (2 * sums[0] - c * n);
    const std::int64_t third = sums[2] - c * (3 * sums[1] - c * (3 * sums[0] - c * n));
    const std::int64_t fourth =
      sums[3] - c * (4 * sums[2] - c * (6 * sums[1] - c * (4 * sums[0] - c * n)));
    const double shift = first * inverse, square = shift * shift;
    const double m2 = second * inverse, m3 = third * inverse;
    this->Second = m2 - square;
    this->Third = m3 - shift * (3.0 * m2 - 2.0 * square);
    this->Fourth = fourth * inverse - shift * (4.0 * m3 - shift * (6.0 * m2 - 3.0 * square));
  }
};

// One pair of two equal, lowest levels, for windows without any pair.
CooccurrenceSums OnePair(int levels)
{
  CooccurrenceMatrix matrix(levels);
  matrix.Add(0, 0);
  return SumsOf(matrix);
}

// At least one pair.
void AttributesOfPairs(const CooccurrenceSums& sums, TextureAttributeValues& values)
{
  const double pairs = sums.Pairs, inverse = 1.0 / pairs;
  const CentralMoments s(sums.Pairs, sums.Sums);
  const CentralMoments d(sums.Pairs, { sums.Differences[0], sums.Differences[1], 0, 0 });
  const double contrast = sums.Differences[1] * inverse;
  const double inverseUnit = inverse / sums.Units.Inverse;

  values.fill(0.0);
  const auto set = [&values](A attribute, double value)
  { values[static_cast<int>(attribute)] = value; };
  set(A::JointMaximum, 0.5 * inverse * sums.LargestCount);
  set(A::AngularSecondMoment, 0.25 * inverse * inverse * sums.Squares);
  set(A::JointAverage, 0.5 * s.Mean);
  set(A::SumAverage, s.Mean);
  set(A::DifferenceAverage, d.Mean);
  set(A::Dissimilarity, d.Mean);
  set(A::Contrast, contrast);
  // s^2 + d^2 = 2 (i^2 + j^2) and s^2 - d^2 = 4 i j.
  set(A::JointVariance, 0.25 * (s.Second + contrast));
  set(A::Autocorrelation, 0.25 * inverse * (sums.Sums[1] - sums.Differences[1]));
  set(A::SumVariance, s.Second);
  set(A::ClusterTendency, s.Second);
  set(A::DifferenceVariance, d.Second);
  set(A::ClusterShade, s.Third);
  set(A::ClusterProminence, s.Fourth);
  set(A::InverseDifference, inverseUnit * sums.Inverses[0]);
  set(A::NormalisedInverseDifference, inverseUnit * sums.Inverses[1]);
  set(A::InverseDifferenceMoment, inverseUnit * sums.Inverses[2]);
  set(A::NormalisedInverseDifferenceMoment, inverseUnit * sums.Inverses[3]);
  set(A::InverseVariance, inverseUnit * sums.Inverses[4]);
  if (s.Second + contrast == 0.0)
  {
    set(A::Correlation, 1.0); // one level: no entropy either
    return;
  }
  set(A::Correlation, (s.Second - contrast) / (s.Second + contrast));

  // -sum (n / N) log2(n / N) = (N log2 N - sum n log2 n) / N; a pair of different levels has two
  // entries of the matrix with half of its probability each. All in integers until the division.
  const std::int64_t unit = static_cast<std::int64_t>(sums.Units.Logarithm);
  const std::int64_t all = sums.TotalLogarithm, pairBits = 2 * sums.Pairs * unit,
                     equalBits = 2 * sums.EqualPairs * unit;
  const double entropyUnit = 0.5 * inverse / sums.Units.Logarithm;
  const auto entropy = [entropyUnit](std::int64_t value)
  { return std::max(0.0, entropyUnit * value); };
  const double level = entropy(all - sums.LevelLogarithms);
  set(A::JointEntropy, entropy(all - equalBits - 2 * sums.JointLogarithms));
  set(A::SumEntropy, entropy(all - pairBits - 2 * sums.SumLogarithms));
  set(A::DifferenceEntropy, entropy(all - pairBits - 2 * sums.DifferenceLogarithms));
  const double information =
    entropy(all + equalBits + 2 * (sums.JointLogarithms - sums.LevelLogarithms));
  // Less is rounding: i and j are independent. The square root of f13 would make much of it.
  constexpr double leastInformation = 1e-13;
  if (information > leastInformation)
  {
    set(A::InformationCorrelation1, -information / level);
    set(A::InformationCorrelation2, std::sqrt(1.0 - std::exp(-2.0 * information)));
  }
}
}

//------------------------------------------------------------------------------
const char* TextureAttributeName(TextureAttribute attribute)
{
  static const std::array<const char*, TextureAttributeCount> names = { "JointMaximum",
    "JointAverage", "JointVariance", "JointEntropy", "DifferenceAverage", "DifferenceVariance",
    "DifferenceEntropy", "SumAverage", "SumVariance", "SumEntropy", "AngularSecondMoment",
    "Contrast", "Dissimilarity", "InverseDifference", "NormalisedInverseDifference",
    "InverseDifferenceMoment", "NormalisedInverseDifferenceMoment", "InverseVariance",
    "Correlation", "Autocorrelation", "ClusterTendency", "ClusterShade", "ClusterProminence",
    "InformationCorrelation1", "InformationCorrelation2", "MaximalCorrelationCoefficient" };
  return names[static_cast<int>(attribute)];
}

//------------------------------------------------------------------------------
const std::vector<TextureAttribute>& DefaultTextureAttributes()
{
  static const std::vector<TextureAttribute> attributes = []()
  {
    std::vector<TextureAttribute> result;
    for (int k = 0; k < TextureAttributeCount; ++k)
    {
      const A a = static_cast<A>(k);
      if (a != A::JointAverage && a != A::DifferenceAverage && a != A::ClusterTendency &&
          a != A::MaximalCorrelationCoefficient)
      {
        result.push_back(a);
      }
    }
    return result;
  }();
  return attributes;
}

//------------------------------------------------------------------------------
std::pair<double, double> TextureAttributeBounds(TextureAttribute attribute, int levels)
{
  const double g = levels, span = g - 1.0, entropy = std::log2(g);
  switch (attribute)
  {
    case A::JointMaximum:
    case A::AngularSecondMoment:
      return { 1.0 / (g * g), 1.0 };
    case A::JointAverage:
      return { 1.0, g };
    case A::JointVariance:
    case A::DifferenceVariance:
      return { 0.0, span * span / 4.0 };
    case A::JointEntropy:
      return { 0.0, 2.0 * entropy };
    case A::DifferenceAverage:
    case A::Dissimilarity:
      return { 0.0, span };
    case A::DifferenceEntropy:
      return { 0.0, entropy };
    case A::SumAverage:
      return { 2.0, 2.0 * g };
    case A::SumVariance:
    case A::ClusterTendency:
    case A::Contrast:
      return { 0.0, span * span };
    case A::SumEntropy:
      return { 0.0, std::log2(2.0 * g - 1.0) };
    case A::InverseDifference:
      return { 1.0 / g, 1.0 };
    case A::NormalisedInverseDifference:
      return { 1.0 / (1.0 + span / g), 1.0 };
    case A::InverseDifferenceMoment:
      return { 1.0 / (1.0 + span * span), 1.0 };
    case A::NormalisedInverseDifferenceMoment:
      return { 1.0 / (1.0 + span * span / (g * g)), 1.0 };
    case A::InverseVariance:
      return { 0.0, levels > 1 ? 1.0 : 0.0 };
    case A::Correlation:
      return { -1.0, 1.0 };
    case A::Autocorrelation:
      return { 1.0, g * g };
    case A::ClusterShade:
    {
      const double largest = std::pow(2.0 * span, 3) / (6.0 * std::sqrt(3.0));
      return { -largest, largest };
    }
    case A::ClusterProminence:
      return { 0.0, std::pow(2.0 * span, 4) / 12.0 };
    case A::InformationCorrelation1:
      return { -1.0, 0.0 };
    case A::InformationCorrelation2:
      return { 0.0, std::sqrt(1.0 - std::exp(-2.0 * entropy)) };
    case A::MaximalCorrelationCoefficient:
      break;
  }
  return { 0.0, 1.0 };
}

//------------------------------------------------------------------------------
double NormalisedTextureAttribute(TextureAttribute attribute, int levels, double value)
{
  const auto [low, high] = TextureAttributeBounds(attribute, levels);
  return high > low ? std::min(std::max((value - low) / (high - low), 0.0), 1.0) : 0.0;
}

//------------------------------------------------------------------------------
void ComputeTextureAttributes(const CooccurrenceSums& sums, TextureAttributeValues& values)
{
  if (sums.Pairs > 0)
  {
    AttributesOfPairs(sums, values);
  }
  else
  {
    AttributesOfPairs(OnePair(sums.Levels), values);
  }
}

//------------------------------------------------------------------------------
TextureAttributeValues ComputeTextureAttributes(const CooccurrenceMatrix& matrix)
{
  TextureAttributeValues values;
  ComputeTextureAttributes(SumsOf(matrix), values);
  values[static_cast<int>(A::MaximalCorrelationCoefficient)] =
    MaximalCorrelationCoefficient(matrix);
  return values;
}

//------------------------------------------------------------------------------
double MaximalCorrelationCoefficient(const CooccurrenceMatrix& matrix)
{
  std::vector<int> occurring;
  std::vector<double> weights;
  for (int i = 0; i < matrix.Levels; ++i)
  {
    Index sum = 0;
    for (int j = 0; j < matrix.Levels; ++j)
    {
      sum += matrix(i, j);
    }
    if (sum > 0)
    {
      occurring.push_back(i);
      weights.push_back(1.0 / std::sqrt(static_cast<double>(sum)));
    }
  }
  const int n = static_cast<int>(occurring.size());
  if (n < 2)
  {
    return 1.0;
  }
  Eigen::MatrixXd scaled(n, n);
  for (int i = 0; i < n; ++i)
  {
    for (int j = 0; j < n; ++j)
    {
      scaled(i, j) = weights[i] * weights[j] * matrix(occurring[i], occurring[j]);
    }
  }
  // Ascending; the last one is 1, and f14 is the largest modulus of the others.
  const Eigen::VectorXd eigenvalues =
    Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(scaled, Eigen::EigenvaluesOnly).eigenvalues();
  return std::min(1.0, std::max(eigenvalues[n - 2], -eigenvalues[0]));
}
}
