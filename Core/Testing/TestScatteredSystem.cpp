// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "BlockShapes.h"
#include "Fit/ScatteredSystem.h"
#include "RandomRefinement.h"
#include "ThreadedExecution.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

namespace
{
using namespace trivariate;

// A refined spline with random coefficients over a layered cube, and samples of some function.
class ScatteredSystemTest : public testing::Test
{
protected:
  ScatteredSystemTest()
    : Spline(Layout.MakeCoarsest(1, 1))
  {
    const auto rule = MakeBlockRule(this->Layout, this->Spline);
    for (int round = 0; round < 5; ++round)
    {
      rule->Refine(this->Spline, RandomMarks(this->Spline, this->RandomPoint(), 6, this->Random));
    }
    const SharedPoints shared = this->Layout.Share(this->Spline, Sharing::Attributes);
    std::vector<double> values(shared.Count());
    for (double& value : values)
    {
      value = trivariate::Random(this->Random, -1.0, 1.0);
    }
    for (Index i = 0; i < this->Spline.Size(); ++i)
    {
      this->Spline.ControlPoint(i)[3] = values[shared.PointOf[i]];
    }
  }

  Point RandomPoint()
  {
    const LatticePoint& o = this->Blocks.Origins[this->Random() % this->Blocks.Size()];
    Point x;
    for (int a = 0; a < 3; ++a)
    {
      x[a] = o[a] + trivariate::Random(this->Random, 0.0, 1.0);
    }
    return x;
  }

  // At random; every tenth on a face.
  template <typename Function>
  ScatteredSamples MakeSamples(int count, const Function& f, bool onFaces = true)
  {
    ScatteredSamples samples;
    samples.Components = 1;
    for (int i = 0; i < count; ++i)
    {
      Point x = this->RandomPoint();
      x[0] = onFaces && i % 10 == 0 ? std::round(x[0]) : x[0];
      samples.Parameters.insert(samples.Parameters.end(), x.begin(), x.end());
      samples.Values.push_back(f(x));
      samples.Weights.push_back(i % 3 ? 1.0f : 2.5f);
    }
    return samples;
  }

  // To rounding; the matrix is of single precision.
  void Solve(ScatteredSystem& system)
  {
    const GramMatrix gram = system.Assemble();
    for (int round = 0; round < 4; ++round)
    {
      system.ComputeResiduals(this->Spline);
      std::vector<double> correction;
      gram.Solve(system.Gradient(0), 1e-8, 1000, correction, this->Run);
      for (Index i = 0; i < this->Spline.Size(); ++i)
      {
        this->Spline.ControlPoint(i)[3] +=
          correction[system.Points().PointOf[i]] / this->Spline.Weights[i];
      }
    }
    system.ComputeResiduals(this->Spline);
  }

  std::mt19937 Random{ 5 };
  BlockComplex Blocks = LayeredCubeComplex();
  BlockSpline Layout{ Blocks, 4 };
  TSpline Spline;
  Execution Run = ThreadedExecution(3);
};

TEST_F(ScatteredSystemTest, ResidualAndGradientAgreeWithPlainSums)
{
  const ScatteredSamples samples =
    this->MakeSamples(300, [](const Point& x) { return std::sin(x[0]) + x[1] * x[2]; });
  ScatteredSystem system(samples, 3, this->Layout, this->Run);
  system.Update(this->Spline);
  system.ComputeResiduals(this->Spline);
  double squares = 0.0, weights = 0.0, largest = 0.0;
  std::vector<double> gradient(system.Points().Count(), 0.0);
  for (Index s = 0; s < samples.Count(); ++s)
  {
    const double* p = &samples.Parameters[3 * s];
    const Point x{ p[0], p[1], p[2] };
    const double r = samples.Values[s] - HomogeneousValue(this->Spline, x)[3];
    squares += samples.Weights[s] * r * r;
    weights += samples.Weights[s];
    largest = std::max(largest, std::abs(r));
    for (Index i = 0; i < this->Spline.Size(); ++i)
    {
      gradient[system.Points().PointOf[i]] += samples.Weights[s] * r * ValueOf(this->Spline, i, x);
    }
  }
  EXPECT_NEAR(system.Error(0).Rms, std::sqrt(squares / weights), 1e-12);
  EXPECT_NEAR(system.Error(0).Maximum, largest, 1e-12);
  const std::vector<double> sums = system.Gradient(0);
  for (std::size_t k = 0; k < gradient.size(); ++k)
  {
    EXPECT_NEAR(sums[k], gradient[k], 2e-3); // a little fairness where samples are few
  }
}

// Whatever lies in the space is found, with common control points at all faces.
TEST_F(ScatteredSystemTest, FindsASplineOfTheSpace)
{
  const TSpline wanted = this->Spline;
  const ScatteredSamples samples =
    this->MakeSamples(40000, [&wanted](const Point& x) { return HomogeneousValue(wanted, x)[3]; });
  std::fill(this->Spline.ControlPoints.begin(), this->Spline.ControlPoints.end(), 0.0);
  ScatteredSystem system(samples, 3, this->Layout, this->Run);
  system.Update(this->Spline);
  this->Solve(system);
  EXPECT_LT(system.Error(0).Maximum, 1e-9);
  for (Index i = 0; i < this->Spline.Size(); ++i)
  {
    EXPECT_NEAR(this->Spline.ControlPoint(i)[3], wanted.ControlPoint(i)[3], 1e-6);
  }
}

// The gain of a split is the fall of the squared error when the part of the child that is new is
// added; the univariate ratio of norms stands for the exact one where samples are even.
TEST_F(ScatteredSystemTest, GainsAreFallsOfTheSquaredError)
{
  const ScatteredSamples samples = this->MakeSamples(
    40000,
    [](const Point& x)
    { return std::sin(9.0 * x[0]) * std::cos(7.0 * x[1]) + std::sin(8.0 * x[2]); },
    false);
  ScatteredSystem system(samples, 3, this->Layout, this->Run);
  system.Update(this->Spline);
  this->Solve(system);
  std::vector<SplitGain> gains;
  system.AddGains(0, 2.0, gains);
  ASSERT_GT(gains.size(), 1000u);
  std::vector<int> functionsOf(system.Points().Count(), 0);
  for (const Index point : system.Points().PointOf)
  {
    ++functionsOf[point];
  }
  std::vector<double> ratios;
  for (std::size_t g = 0; g < gains.size(); g += gains.size() / 60)
  {
    const SplitGain& gain = gains[g];
    if (functionsOf[system.Points().PointOf[gain.Function]] > 1)
    {
      continue; // of a part of a control point's functions
    }
    TSpline two = this->Spline;
    two.Functions.push_back(two.Functions[gain.Function]);
    LocalKnots& k = two.Functions.back()[gain.Direction];
    std::array<std::int32_t, 6> all{ k[0], k[1], k[2], k[3], k[4], gain.Knot };
    std::sort(all.begin(), all.end());
    std::copy_n(all.begin(), 5, k.begin());
    double pp = 0.0, cp = 0.0, cc = 0.0, rp = 0.0, rc = 0.0;
    for (Index s = 0; s < samples.Count(); ++s)
    {
      const double* p = &samples.Parameters[3 * s];
      const Point x{ p[0], p[1], p[2] };
      const double parent = ValueOf(two, gain.Function, x);
      if (parent > 0.0)
      {
        const double child = ValueOf(two, this->Spline.Size(), x), weight = samples.Weights[s];
        const double r = samples.Values[s] - HomogeneousValue(this->Spline, x)[3];
        pp += weight * parent * parent;
        cp += weight * child * parent;
        cc += weight * child * child;
        rp += weight * r * parent;
        rc += weight * r * child;
      }
    }
    const double inner = rc - cp / pp * rp, fall = 2.0 * inner * inner / (cc - cp * cp / pp);
    if (fall > 1e-4 && pp > 2.0)
    {
      ratios.push_back(gain.SquaredError / fall);
    }
  }
  ASSERT_GT(ratios.size(), 15u);
  std::sort(ratios.begin(), ratios.end());
  EXPECT_NEAR(ratios[ratios.size() / 2], 1.0, 0.1);
  EXPECT_GT(ratios[ratios.size() / 10], 0.5);
  EXPECT_LT(ratios[9 * ratios.size() / 10], 2.0);
}

TEST_F(ScatteredSystemTest, RefusesSamplesOutsideAndNumbersThatAreNone)
{
  const auto refusal = [this](const ScatteredSamples& samples) -> std::string
  {
    try
    {
      ScatteredSystem(samples, 3, this->Layout, this->Run);
    }
    catch (const std::invalid_argument& error)
    {
      return error.what();
    }
    return "";
  };
  ScatteredSamples samples{ { 0.5, 0.5, 0.5, 1.5, 0.5, 0.5 }, 1, { 1.0, 2.0 }, {} };
  EXPECT_NE(refusal(samples).find("sample 1, (1.5"), std::string::npos);
  samples.Parameters[3] = 0.75;
  EXPECT_EQ(refusal(samples), "");
  samples.Values[1] = std::numeric_limits<double>::infinity();
  EXPECT_NE(refusal(samples).find("sample 1 is not"), std::string::npos);
  samples.Parameters[0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(refusal(samples).find("sample 0"), std::string::npos);
  EXPECT_NE(refusal({ {}, 1, {}, {} }).find("no sample"), std::string::npos);
}
}
