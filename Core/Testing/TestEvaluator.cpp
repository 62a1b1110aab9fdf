// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "TSpline/Evaluator.h"
#include "RandomRefinement.h"
#include "Shapes.h"
#include "ThreadedExecution.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

using namespace trivariate;

namespace
{
// A randomly refined spline; rational ones have random weights.
TSpline RandomSpline(unsigned seed, bool rational, std::mt19937& random)
{
  TSpline spline = RandomTensorProduct({ 2, 2, 3 }, { 3, 3, 2 }, random);
  const auto rule = seed % 2 ? MakeKnotInsertionRule(spline) : MakeAnalysisSuitableRule(spline);
  for (int round = 0; round < 3; ++round)
  {
    rule->Refine(spline, RandomMarks(spline, 5, random));
  }
  for (double& weight : spline.Weights)
  {
    weight *= rational ? Random(random, 0.5, 2.0) : 1.0;
  }
  return spline;
}

// Everything that an evaluator can tell of n points.
struct Results
{
  std::vector<double> Values, Gradients, Hessians;
  std::vector<std::uint8_t> Inside;

  Results(Index n, int components)
    : Values(n * components, -7.0)
    , Gradients(3 * n * components, -7.0)
    , Hessians(6 * n * components, -7.0)
    , Inside(n, 7)
  {
  }

  EvaluatorOutput Output(int order = 2)
  {
    return { this->Values.data(), order > 0 ? this->Gradients.data() : nullptr,
      order > 1 ? this->Hessians.data() : nullptr, this->Inside.data() };
  }

  bool operator==(const Results& other) const
  {
    return this->Values == other.Values && this->Gradients == other.Gradients &&
           this->Hessians == other.Hessians && this->Inside == other.Inside;
  }
};

double LargestDifference(const std::vector<double>& a, const std::vector<double>& b)
{
  double largest = a.size() == b.size() ? 0.0 : std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
  {
    largest = std::max(largest, std::abs(a[i] - b[i]) / (1.0 + std::abs(a[i])));
  }
  return largest;
}

std::vector<double> RandomPoints(const TSpline& spline, Index n, std::mt19937& random)
{
  std::vector<double> points;
  for (Index i = 0; i < n; ++i)
  {
    const Point x = RandomPoint(spline, random);
    points.insert(points.end(), x.begin(), x.end());
  }
  return points;
}

// Ascending coordinates with knots, repeats, and some outside the domain.
std::array<std::vector<double>, 3> RandomLattice(const TSpline& spline, std::mt19937& random)
{
  std::array<std::vector<double>, 3> lattice;
  for (int a = 0; a < 3; ++a)
  {
    const KnotLine& line = spline.KnotLines[a];
    lattice[a] = { line.front(), line[2], line[2], line.back(), line.front() - 0.5,
      line.back() + 1e-9 };
    for (int i = 0; i < 8 + 5 * a; ++i)
    {
      lattice[a].push_back(Random(random, line.front(), line.back()));
    }
    std::sort(lattice[a].begin(), lattice[a].end());
  }
  return lattice;
}

std::vector<double> LatticePoints(const std::array<std::vector<double>, 3>& lattice)
{
  std::vector<double> points;
  for (const double w : lattice[2])
  {
    for (const double v : lattice[1])
    {
      for (const double u : lattice[0])
      {
        points.insert(points.end(), { u, v, w });
      }
    }
  }
  return points;
}
}

TEST(Evaluator, ReproducesTheSpline)
{
  for (unsigned seed = 0; seed < 10; ++seed)
  {
    std::mt19937 random(seed);
    const bool rational = seed % 3 == 0;
    const TSpline spline = RandomSpline(seed, rational, random);
    const BezierMesh mesh(spline);
    const Evaluator evaluator(spline, mesh, { 3, 0, 4 });
    EXPECT_EQ(evaluator.Rational(), rational);
    const Index n = 300;
    const std::vector<double> points = RandomPoints(spline, n, random);
    Results results(n, 3);
    evaluator.Evaluate(n, points.data(), results.Output());
    for (Index i = 0; i < n; ++i)
    {
      const auto direct =
        HomogeneousValue(spline, { points[3 * i], points[3 * i + 1], points[3 * i + 2] });
      ASSERT_NEAR(results.Values[3 * i], direct[3] / direct[5], 1e-12);
      ASSERT_NEAR(results.Values[3 * i + 1], direct[0] / direct[5], 1e-11);
      ASSERT_NEAR(results.Values[3 * i + 2], direct[4] / direct[5], 1e-12);
      ASSERT_EQ(results.Inside[i], 1);
    }
  }
}

TEST(Evaluator, DerivativesMatchFiniteDifferences)
{
  for (unsigned seed = 0; seed < 8; ++seed)
  {
    std::mt19937 random(seed);
    const TSpline spline = RandomSpline(seed, seed % 2 == 0, random);
    const BezierMesh mesh(spline);
    const Evaluator evaluator(spline, mesh, { 3, 4 });
    constexpr double H = 1e-5;
    for (int n = 0; n < 100; ++n)
    {
      Point x = RandomPoint(spline, random);
      for (int a = 0; a < 3; ++a)
      {
        x[a] = std::clamp(
          x[a], spline.KnotLines[a].front() + 2.0 * H, spline.KnotLines[a].back() - 2.0 * H);
      }
      Results at(1, 2);
      ASSERT_TRUE(evaluator.Evaluate(x.data(), at.Output()));
      constexpr int SecondDerivative[3][3] = { { 0, 3, 5 }, { 3, 1, 4 }, { 5, 4, 2 } };
      for (int a = 0; a < 3; ++a)
      {
        Point left = x, right = x;
        left[a] -= H;
        right[a] += H;
        Results l(1, 2), r(1, 2);
        evaluator.Evaluate(left.data(), l.Output());
        evaluator.Evaluate(right.data(), r.Output());
        for (int c = 0; c < 2; ++c)
        {
          ASSERT_NEAR(at.Gradients[3 * c + a], (r.Values[c] - l.Values[c]) / (2.0 * H), 1e-7);
          for (int b = 0; b < 3; ++b)
          {
            // Third derivatives jump at knots: the difference is of first order there.
            ASSERT_NEAR(at.Hessians[6 * c + SecondDerivative[a][b]],
              (r.Gradients[3 * c + b] - l.Gradients[3 * c + b]) / (2.0 * H), 1e-3);
          }
        }
      }
    }
  }
}

TEST(Evaluator, HessianIsExactForCubics)
{
  std::mt19937 random(3);
  TSpline spline = RandomTensorProduct({ 2, 3, 2 }, { 2, 2, 2 }, random);
  const TricubicPolynomial polynomial(random);
  for (Index i = 0; i < spline.Size(); ++i)
  {
    spline.ControlPoint(i)[3] = polynomial.Coefficient(spline, i);
  }
  const auto rule = MakeKnotInsertionRule(spline);
  rule->Refine(spline, RandomMarks(spline, 12, random));
  const BezierMesh mesh(spline);
  const Evaluator evaluator(spline, mesh, { 3 });
  for (int n = 0; n < 200; ++n)
  {
    const Point x = RandomPoint(spline, random);
    Results at(1, 1);
    ASSERT_TRUE(evaluator.Evaluate(x.data(), at.Output()));
    const double scale = 1.0 + std::abs(polynomial(x));
    EXPECT_NEAR(at.Values[0], polynomial(x), 1e-11 * scale);
    // Differences of any width are exact for cubics after one step of extrapolation.
    const auto along = [&](double s, double t, double r) {
      return polynomial({ x[0] + s, x[1] + t, x[2] + r });
    };
    const auto second = [&](int a, double h)
    {
      const double s = a == 0 ? h : 0.0, t = a == 1 ? h : 0.0, r = a == 2 ? h : 0.0;
      return (along(s, t, r) - 2.0 * along(0.0, 0.0, 0.0) + along(-s, -t, -r)) / (h * h);
    };
    for (int a = 0; a < 3; ++a)
    {
      EXPECT_NEAR(at.Hessians[a], second(a, 0.5), 1e-9 * scale);
    }
    const auto mixed = [&](double h)
    {
      return (along(h, h, 0.0) - along(h, -h, 0.0) - along(-h, h, 0.0) + along(-h, -h, 0.0)) /
             (4.0 * h * h);
    };
    EXPECT_NEAR(at.Hessians[3], mixed(1e-3), 1e-4 * scale);
  }
}

TEST(Evaluator, LatticeEqualsScattered)
{
  for (unsigned seed = 0; seed < 10; ++seed)
  {
    std::mt19937 random(seed);
    const TSpline spline = RandomSpline(seed, seed % 3 == 0, random);
    const BezierMesh mesh(spline);
    const Evaluator evaluator(spline, mesh, { 4, 3 });
    const auto lattice = RandomLattice(spline, random);
    const std::vector<double> points = LatticePoints(lattice);
    const auto n = static_cast<Index>(points.size()) / 3;
    for (int order = 0; order < 3; ++order)
    {
      Results scattered(n, 2), gridded(n, 2);
      evaluator.Evaluate(n, points.data(), scattered.Output(order));
      evaluator.EvaluateLattice(lattice, gridded.Output(order));
      ASSERT_EQ(scattered.Inside, gridded.Inside);
      ASSERT_LE(LargestDifference(scattered.Values, gridded.Values), 1e-12);
      ASSERT_LE(LargestDifference(scattered.Gradients, gridded.Gradients), 1e-12);
      ASSERT_LE(LargestDifference(scattered.Hessians, gridded.Hessians), 1e-11);
      EXPECT_GT(std::count(gridded.Inside.begin(), gridded.Inside.end(), 1), n / 2);
      EXPECT_GT(std::count(gridded.Inside.begin(), gridded.Inside.end(), 0), n / 10);
    }
  }
}

TEST(Evaluator, IsTheSameForAnyThreadsAndAnyCompany)
{
  std::mt19937 random(11);
  const TSpline spline = RandomSpline(1, true, random);
  const BezierMesh mesh(spline);
  const Evaluator evaluator(spline, mesh, { 0, 1, 2, 3 });
  const Evaluator threaded(spline, mesh, { 0, 1, 2, 3 }, ThreadedExecution(4));
  const Index n = 1000;
  const std::vector<double> points = RandomPoints(spline, n, random);
  Results one(n, 4), many(n, 4), alone(n, 4);
  evaluator.Evaluate(n, points.data(), one.Output());
  threaded.Evaluate(n, points.data(), many.Output(), ThreadedExecution(3));
  EXPECT_TRUE(one == many);
  for (Index i = 0; i < n; ++i)
  {
    const EvaluatorOutput output = { &alone.Values[4 * i], &alone.Gradients[12 * i],
      &alone.Hessians[24 * i], &alone.Inside[i] };
    evaluator.Evaluate(&points[3 * i], output);
  }
  EXPECT_TRUE(one == alone);

  const auto lattice = RandomLattice(spline, random);
  const auto size = static_cast<Index>(LatticePoints(lattice).size()) / 3;
  Results oneLattice(size, 4), manyLattice(size, 4);
  evaluator.EvaluateLattice(lattice, oneLattice.Output());
  threaded.EvaluateLattice(lattice, manyLattice.Output(), ThreadedExecution(3));
  EXPECT_TRUE(oneLattice == manyLattice);
}

// Many points are evaluated in another order than they come in.
TEST(Evaluator, ManyPointsAreEvaluatedAsFew)
{
  std::mt19937 random(12);
  const TSpline spline = RandomSpline(1, false, random);
  const BezierMesh mesh(spline);
  const Evaluator evaluator(spline, mesh, { 3, 4 });
  const Index n = 100000, few = 1000;
  std::vector<double> points = RandomPoints(spline, n, random);
  points[3 * 500] = std::numeric_limits<double>::quiet_NaN();
  points[3 * 501] = 1e300;
  points[3 * 502 + 2] = -1e300;
  Results many(n, 2), pieces(n, 2);
  evaluator.Evaluate(n, points.data(), many.Output());
  for (Index i = 0; i < n; i += few)
  {
    evaluator.Evaluate(few, &points[3 * i],
      { &pieces.Values[2 * i], &pieces.Gradients[6 * i], &pieces.Hessians[12 * i],
        &pieces.Inside[i] });
  }
  EXPECT_TRUE(many == pieces);
  EXPECT_EQ(std::count(many.Inside.begin(), many.Inside.end(), 1), n - 3);
}

TEST(Evaluator, OutsideIsZero)
{
  std::mt19937 random(2);
  const TSpline spline = RandomSpline(1, false, random);
  const BezierMesh mesh(spline);
  const Evaluator evaluator(spline, mesh, { 3 });
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double points[9] = { 1e9, 0.0, 0.0, nan, 1.0, 1.0, spline.KnotLines[0].back(),
    spline.KnotLines[1].back(), spline.KnotLines[2].back() };
  Results results(3, 1);
  evaluator.Evaluate(3, points, results.Output());
  EXPECT_EQ(results.Inside, (std::vector<std::uint8_t>{ 0, 0, 1 }));
  EXPECT_EQ(results.Values[0], 0.0);
  EXPECT_EQ(results.Values[1], 0.0);
  EXPECT_EQ(results.Gradients[5], 0.0);
  EXPECT_EQ(results.Hessians[11], 0.0);
  Results one(1, 1);
  EXPECT_FALSE(evaluator.Evaluate(points, one.Output()));
}

TEST(Evaluator, EdgeOfTheOutermostSupportIsOutside)
{
  // One unclamped function: rational, and zero over zero on its support's boundary.
  TSpline spline;
  spline.Components = 4;
  spline.KnotLines.fill({ 0.0, 1.0, 2.0, 3.0, 4.0 });
  const LocalKnots k = { 0, 1, 2, 3, 4 };
  spline.Functions = { { k, k, k } };
  spline.Weights = { 2.0 };
  spline.ControlPoints = { 1.0, 2.0, 3.0, 4.0 };
  const BezierMesh mesh(spline);
  const Evaluator evaluator(spline, mesh, { 3 });
  const std::array<std::vector<double>, 3> lattice = { { { 0.0, 1.5, 4.0 }, { 2.0 }, { 1.0 } } };
  const std::vector<double> points = LatticePoints(lattice);
  Results scattered(3, 1), gridded(3, 1);
  evaluator.Evaluate(3, points.data(), scattered.Output());
  evaluator.EvaluateLattice(lattice, gridded.Output());
  for (const Results& results : { scattered, gridded })
  {
    EXPECT_EQ(results.Inside, (std::vector<std::uint8_t>{ 0, 1, 0 }));
    EXPECT_EQ(results.Values[0], 0.0);
    EXPECT_NEAR(results.Values[1], 4.0, 1e-12);
    EXPECT_NEAR(results.Gradients[3], 0.0, 1e-12);
    EXPECT_EQ(results.Gradients[6], 0.0);
  }
}

TEST(Evaluator, RefusesBadRequests)
{
  std::mt19937 random(2);
  const TSpline spline = RandomTensorProduct({ 1, 1, 1 }, { 0, 0, 0 }, random);
  const BezierMesh mesh(spline);
  EXPECT_THROW(Evaluator(spline, mesh, {}), std::invalid_argument);
  EXPECT_THROW(Evaluator(spline, mesh, { 9 }), std::invalid_argument);
  EXPECT_THROW(Evaluator(spline, mesh, { -1 }), std::invalid_argument);
  const Evaluator evaluator(spline, mesh, { 3 });
  double value[2];
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const std::vector<double>& u : { std::vector<double>{ 1.0, 0.0 }, { nan }, { 0.0, nan } })
  {
    EXPECT_THROW(
      evaluator.EvaluateLattice({ { u, { 0.0 }, { 0.0 } } }, { value }), std::invalid_argument);
  }
}

TEST(Evaluator, QuarterAnnulusHasItsVolume)
{
  const double exact = 0.75 * std::acos(-1.0);
  for (unsigned seed = 0; seed < 4; ++seed)
  {
    std::mt19937 random(seed);
    TSpline spline = QuarterAnnulus(8);
    const auto rule = MakeKnotInsertionRule(spline);
    for (unsigned round = 0; round < 2 * seed; ++round)
    {
      rule->Refine(spline, RandomMarks(spline, 5, random));
    }
    const BezierMesh mesh(spline);
    EXPECT_GE(mesh.Size(), 1 + static_cast<Index>(seed));
    EXPECT_NEAR(Volume(spline, mesh, 12), exact, 1e-10);

    const Evaluator geometry(spline, mesh, { 0, 1, 2 });
    EXPECT_TRUE(geometry.Rational());
    for (int n = 0; n < 100; ++n)
    {
      const Point u = RandomPoint(spline, random);
      double x[3];
      ASSERT_TRUE(geometry.Evaluate(u.data(), { x }));
      EXPECT_NEAR(std::hypot(x[0], x[1]), 1.0 + u[0], 1e-12);
      EXPECT_NEAR(x[2], u[2], 1e-12);
    }
  }
}
