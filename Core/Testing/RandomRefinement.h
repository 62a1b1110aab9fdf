// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// Random splines, random wishes for refinement, and slow but plain ways to evaluate.
#ifndef trivariate_RandomRefinement_h
#define trivariate_RandomRefinement_h

#include "TSpline/RefinementRule.h"

#include <array>
#include <cmath>
#include <random>
#include <vector>

namespace trivariate
{
using Point = std::array<double, 3>;

inline double Random(std::mt19937& random, double low, double high)
{
  return std::uniform_real_distribution<double>(low, high)(random);
}

/// Root cells of 2^depth knot spans, knots at random distances (ratio of neighbours up to 2), two
/// attributes with random coefficients.
inline TSpline RandomTensorProduct(const std::array<int, 3>& rootCells,
  const std::array<int, 3>& depth, std::mt19937& random, bool uniform = false)
{
  std::array<KnotLine, 3> lines;
  for (int a = 0; a < 3; ++a)
  {
    lines[a].push_back(Random(random, -1.0, 1.0));
    for (int k = 0; k < rootCells[a] << depth[a]; ++k)
    {
      lines[a].push_back(lines[a].back() + (uniform ? 1.0 : Random(random, 0.7, 1.4)));
    }
  }
  TSpline spline = MakeTensorProduct(lines, { 1 << depth[0], 1 << depth[1], 1 << depth[2] }, 2);
  for (Index i = 0; i < spline.Size(); ++i)
  {
    spline.ControlPoint(i)[3] = Random(random, -1.0, 1.0);
    spline.ControlPoint(i)[4] = Random(random, -1.0, 1.0);
  }
  return spline;
}

inline Point RandomPoint(const TSpline& spline, std::mt19937& random)
{
  Point x;
  for (int a = 0; a < 3; ++a)
  {
    x[a] = Random(random, spline.KnotLines[a].front(), spline.KnotLines[a].back());
  }
  return x;
}

/// Wishes for new knots in functions whose support holds the point x. Wishes that leave no room for
/// a knot are skipped.
inline std::vector<RefinementMark> RandomMarks(
  const TSpline& spline, const Point& x, int count, std::mt19937& random)
{
  std::vector<Index> near;
  for (Index i = 0; i < spline.Size(); ++i)
  {
    bool inside = true;
    for (int a = 0; a < 3; ++a)
    {
      const Knots5 t = spline.LocalKnotValues(i, a);
      inside = inside && t[0] <= x[a] && x[a] <= t[4];
    }
    if (inside)
    {
      near.push_back(i);
    }
  }
  std::vector<RefinementMark> marks;
  for (int m = 0; m < count; ++m)
  {
    const Index i = near[random() % near.size()];
    const int direction = static_cast<int>(random() % 3);
    const int span = static_cast<int>(random() % 4);
    const LocalKnots& k = spline.Functions[i][direction];
    const std::int32_t knot = DyadicMiddle(k[span], k[span + 1]);
    if (knot >= 0)
    {
      marks.push_back({ i, direction, knot });
    }
  }
  return marks;
}

/// The same at one random point, so that rounds of them make steeply graded meshes.
inline std::vector<RefinementMark> RandomMarks(
  const TSpline& spline, int count, std::mt19937& random)
{
  return RandomMarks(spline, RandomPoint(spline, random), count, random);
}

/// Value of blending function i.
inline double ValueOf(const TSpline& spline, Index i, const Point& x)
{
  double b = 1.0;
  for (int a = 0; a < 3 && b != 0.0; ++a)
  {
    const KnotLine& line = spline.KnotLines[a];
    const LocalKnots& k = spline.Functions[i][a];
    b *= x[a] < line[k[0]] || x[a] > line[k[4]]
           ? 0.0
           : EvaluateBSpline(spline.LocalKnotValues(i, a), x[a])[0];
  }
  return b;
}

/// The numerator of the spline in all components, and last its denominator.
inline std::vector<double> HomogeneousValue(const TSpline& spline, const Point& x)
{
  std::vector<double> sum(spline.Components + 1, 0.0);
  for (Index i = 0; i < spline.Size(); ++i)
  {
    const double b = spline.Weights[i] * ValueOf(spline, i, x);
    for (int c = 0; c < spline.Components && b != 0.0; ++c)
    {
      sum[c] += b * spline.ControlPoint(i)[c];
    }
    sum.back() += b;
  }
  return sum;
}

/// A polynomial of degree up to three in each variable: values, and its coefficients in a tensor
/// product spline (the blossom at the inner knots of each function).
struct TricubicPolynomial
{
  std::array<double, 64> Coefficients;

  explicit TricubicPolynomial(std::mt19937& random)
  {
    for (double& c : this->Coefficients)
    {
      c = Random(random, -1.0, 1.0);
    }
  }

  // Monomials of x are the blossoms of 1, x, x^2, x^3 at three equal arguments.
  static std::array<double, 4> Blossoms(double r, double s, double t)
  {
    return { 1.0, (r + s + t) / 3.0, (r * s + r * t + s * t) / 3.0, r * s * t };
  }
  double Combine(const std::array<std::array<double, 4>, 3>& powers) const
  {
    double sum = 0.0;
    for (int m = 0; m < 64; ++m)
    {
      sum += this->Coefficients[m] * powers[0][m % 4] * powers[1][m / 4 % 4] * powers[2][m / 16];
    }
    return sum;
  }
  double operator()(const Point& x) const
  {
    return this->Combine(
      { Blossoms(x[0], x[0], x[0]), Blossoms(x[1], x[1], x[1]), Blossoms(x[2], x[2], x[2]) });
  }
  double Coefficient(const TSpline& spline, Index i) const
  {
    std::array<std::array<double, 4>, 3> powers;
    for (int a = 0; a < 3; ++a)
    {
      const Knots5 t = spline.LocalKnotValues(i, a);
      powers[a] = Blossoms(t[1], t[2], t[3]);
    }
    return this->Combine(powers);
  }
};

/// A tensor product refined at random, with three components.
inline TSpline RandomRefined(std::mt19937& random, int rounds, bool analysisSuitable = false)
{
  TSpline spline = RandomTensorProduct({ 2, 3, 2 }, { 3, 2, 3 }, random);
  const auto rule =
    analysisSuitable ? MakeAnalysisSuitableRule(spline) : MakeKnotInsertionRule(spline);
  for (int round = 0; round < rounds; ++round)
  {
    rule->Refine(spline, RandomMarks(spline, 6, random));
  }
  return spline;
}
}

#endif
