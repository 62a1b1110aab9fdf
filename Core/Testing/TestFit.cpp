// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
// What the gridded fit reaches, checked at the voxels by plain sums.
#include "TSpline/DualCompatibility.h"
#include "Fit/Fit.h"
#include "GridVolumes.h"
#include "Rank.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

using namespace trivariate;

namespace
{
const std::vector<Refinement> Rules = { Refinement::Compact, Refinement::AnalysisSuitable,
  Refinement::Uniform };

FitOptions Options(Refinement rule, Index controlPoints, double rms = 0.0, double maximum = 0.0)
{
  FitOptions options;
  options.Rule = rule;
  options.MaximumControlPoints = controlPoints;
  options.RmsTolerance = rms;
  options.MaximumErrorTolerance = maximum;
  return options;
}

double LargestError(const TSpline& spline, const Volume& volume)
{
  double largest = 0.0;
  const std::vector<double> fitted = ValuesAtVoxels(spline, 3, volume.Size);
  for (Index i = 0; i < volume.Count(); ++i)
  {
    largest = std::max(largest, std::abs(fitted[i] - volume.Values[i]));
  }
  return largest;
}

// The smallest root mean square error that the spline's functions can have over the voxels that
// count, as a share of the samples' range, by dense least squares.
double BestRms(const TSpline& spline, const Volume& volume)
{
  std::vector<Index> voxels;
  for (Index i = 0; i < volume.Count(); ++i)
  {
    if (volume.Mask.empty() || volume.Mask[i])
    {
      voxels.push_back(i);
    }
  }
  Eigen::MatrixXd collocation(voxels.size(), spline.Size());
  Eigen::VectorXd samples(voxels.size());
  for (std::size_t row = 0; row < voxels.size(); ++row)
  {
    samples[row] = volume.Values[voxels[row]];
    for (Index f = 0; f < spline.Size(); ++f)
    {
      collocation(row, f) = ValueOf(spline, f, volume.Voxel(voxels[row]));
    }
  }
  const Eigen::VectorXd best =
    collocation * collocation.completeOrthogonalDecomposition().solve(samples);
  return (best - samples).norm() / std::sqrt(double(voxels.size())) /
         (samples.maxCoeff() - samples.minCoeff());
}

// Sound, X, Y, Z are the parameters, the denominator is one, and the last round tells the truth.
void CheckResult(const FitResult& result, const Volume& volume, unsigned seed = 0)
{
  std::mt19937 random(seed);
  const TSpline& spline = result.Spline;
  ASSERT_EQ(Validate(spline), "");
  const int attributes = volume.Samples().Components;
  ASSERT_EQ(spline.Components, 3 + attributes);
  for (int a = 0; a < 3; ++a)
  {
    EXPECT_EQ(spline.KnotLines[a].front(), 0.0);
    EXPECT_EQ(spline.KnotLines[a].back(), double(volume.Size[a] - 1));
    const auto intervals = static_cast<int>(spline.KnotLines[a].size()) - 1;
    ASSERT_GT(result.RootCells[a], 0);
    EXPECT_EQ(intervals % result.RootCells[a], 0);
  }
  for (int sample = 0; sample < 10; ++sample)
  {
    const Point x = RandomPoint(spline, random);
    const std::vector<double> value = HomogeneousValue(spline, x);
    EXPECT_NEAR(value.back(), 1.0, 1e-12);
    for (int a = 0; a < 3; ++a)
    {
      EXPECT_NEAR(value[a], x[a], 1e-12 * std::max(1.0, double(volume.Size[a])));
    }
  }
  ASSERT_FALSE(result.Rounds.empty());
  const FitRound& last = result.Rounds.back();
  EXPECT_EQ(last.ControlPoints, spline.Size());
  VoxelError worst{ 0.0, 0.0 };
  for (int c = 0; c < attributes; ++c)
  {
    const VoxelError error = ErrorAtVoxels(spline, volume, c);
    worst = { std::max(worst.Rms, error.Rms), std::max(worst.Maximum, error.Maximum) };
  }
  EXPECT_NEAR(last.Rms, worst.Rms, 1e-9 * worst.Rms + 1e-12);
  EXPECT_NEAR(last.MaximumError, worst.Maximum, 1e-9 * worst.Maximum + 1e-12);
  for (std::size_t round = 1; round < result.Rounds.size(); ++round)
  {
    // The last round can have dropped some that depended on others.
    EXPECT_TRUE(round + 1 == result.Rounds.size() ||
                result.Rounds[round].ControlPoints > result.Rounds[round - 1].ControlPoints);
    EXPECT_GE(result.Rounds[round].Seconds, result.Rounds[round - 1].Seconds);
  }
}
}

TEST(Fit, ReproducesConstants)
{
  for (const Refinement rule : Rules)
  {
    for (const double constant : { 0.0, 1.0, -37.5, 1e-12, 65535.0, 1e12 })
    {
      const Volume volume({ 20, 11, 33 }, { [=](const Point&) { return constant; } });
      const FitResult result = FitGrid(volume.Samples(), Options(rule, 2000));
      CheckResult(result, volume);
      EXPECT_LE(LargestError(result.Spline, volume), 1e-12 * std::abs(constant));
      EXPECT_EQ(result.Rounds.size(), 1u) << "nothing to refine for";
    }
  }
}

TEST(Fit, ReproducesPolynomials)
{
  const std::vector<std::array<Index, 3>> sizes = { { 20, 31, 25 }, { 9, 64, 12 }, { 33, 33, 33 } };
  for (const Refinement rule : Rules)
  {
    for (unsigned seed = 0; seed < 6; ++seed)
    {
      const std::array<Index, 3> size = sizes[seed % sizes.size()];
      std::mt19937 random(seed);
      const TricubicPolynomial polynomial(random);
      const Volume linear(
        size, { [](const Point& x) { return 3.0 + 2.0 * x[0] - 0.5 * x[1] + x[2]; } });
      const Volume tricubic(size,
        { [&](const Point& x)
          {
            return polynomial({ 2.0 * x[0] / double(size[0] - 1) - 1.0,
              2.0 * x[1] / double(size[1] - 1) - 1.0, 2.0 * x[2] / double(size[2] - 1) - 1.0 });
          } });
      for (const Volume* volume : { &linear, &tricubic })
      {
        const FitResult result = FitGrid(volume->Samples(), Options(rule, 1000));
        CheckResult(result, *volume);
        EXPECT_LE(ErrorAtVoxels(result.Spline, *volume).Maximum, 1e-9)
          << "rule " << int(rule) << ", seed " << seed;
        EXPECT_EQ(result.Rounds.size(), 1u) << "nothing to refine for";
      }
    }
  }
}

TEST(Fit, ErrorsFallWithControlPoints)
{
  const std::array<Index, 3> size = { 48, 40, 44 };
  const Volume volume(size, { Shell(size) });
  std::array<std::vector<double>, 3> rms;
  for (const Index limit : { 400, 900, 2000, 4500 })
  {
    for (const Refinement rule : Rules)
    {
      const FitResult result = FitGrid(volume.Samples(), Options(rule, limit));
      CheckResult(result, volume);
      EXPECT_LE(result.Spline.Size(), limit);
      rms[int(rule)].push_back(ErrorAtVoxels(result.Spline, volume).Rms);
    }
  }
  for (const std::vector<double>& errors : rms)
  {
    for (std::size_t i = 1; i < errors.size(); ++i)
    {
      EXPECT_LT(errors[i], 0.9 * errors[i - 1]);
    }
  }
  // Adaptive beats uniform where the volume asks for it.
  EXPECT_LT(rms[0].back(), 0.3 * rms[2].back());
  EXPECT_LT(rms[1].back(), 0.6 * rms[2].back());
  EXPECT_LT(rms[0].back(), 1e-3);
}

TEST(Fit, NeverExceedsTheLimit)
{
  const std::vector<std::array<Index, 3>> sizes = { { 24, 24, 24 }, { 7, 50, 13 }, { 2, 30, 40 } };
  for (const auto& size : sizes)
  {
    const Volume volume(size, { Noise(5) });
    for (const Refinement rule : Rules)
    {
      for (const Index limit :
        { 64, 65, 79, 80, 100, 124, 125, 126, 215, 216, 300, 342, 343, 344, 345, 500, 777, 2000 })
      {
        const FitResult result = FitGrid(volume.Samples(), Options(rule, limit));
        EXPECT_LE(result.Spline.Size(), limit) << "rule " << int(rule);
        CheckResult(result, volume);
        if (rule == Refinement::Compact)
        {
          EXPECT_GE(result.Spline.Size(), limit * 3 / 4) << "noise can use them all";
        }
      }
    }
  }
}

TEST(Fit, HonoursTolerances)
{
  const std::array<Index, 3> size = { 25, 21, 29 };
  const Volume smooth(size, { Shell(size) });
  const Volume rough(size, { [f = Shell(size), noise = Noise(3)](const Point& x) mutable
                             { return std::round(4.0 * f(x)) + 0.1 * noise(x); } });
  struct Case
  {
    const Volume& Data;
    double Tolerance;
  };
  for (const Case& c : { Case{ smooth, 0.03 }, Case{ smooth, 0.005 }, Case{ rough, 0.2 } })
  {
    for (const Refinement rule : { Refinement::Compact, Refinement::AnalysisSuitable })
    {
      SCOPED_TRACE(testing::Message() << "rule " << int(rule) << ", tolerance " << c.Tolerance);
      const Index limit = 12000;
      const double rms = 0.3 * c.Tolerance, maximum = c.Tolerance;
      const FitResult byRms = FitGrid(c.Data.Samples(), Options(rule, limit, rms));
      CheckResult(byRms, c.Data);
      EXPECT_LE(ErrorAtVoxels(byRms.Spline, c.Data).Rms, rms);
      const FitResult byMaximum = FitGrid(c.Data.Samples(), Options(rule, limit, 0.0, maximum));
      CheckResult(byMaximum, c.Data);
      EXPECT_LE(ErrorAtVoxels(byMaximum.Spline, c.Data).Maximum, maximum);
      const FitResult both = FitGrid(c.Data.Samples(), Options(rule, limit, rms, maximum));
      EXPECT_LE(ErrorAtVoxels(both.Spline, c.Data).Rms, rms);
      EXPECT_LE(ErrorAtVoxels(both.Spline, c.Data).Maximum, maximum);
      EXPECT_EQ(both.Spline.Size(), std::max(byRms.Spline.Size(), byMaximum.Spline.Size()));
      // And stops there: the last round but one was not good enough.
      if (byRms.Rounds.size() > 1)
      {
        EXPECT_GT(byRms.Rounds[byRms.Rounds.size() - 2].Rms, rms);
      }
    }
  }
}

TEST(Fit, SaysWhenAToleranceIsOutOfReach)
{
  const Volume volume({ 30, 30, 30 }, { Noise(1) });
  for (const Refinement rule : Rules)
  {
    const FitResult result = FitGrid(volume.Samples(), Options(rule, 1000, 1e-3));
    CheckResult(result, volume);
    EXPECT_GT(result.Rounds.back().Rms, 1e-3);
  }
}

TEST(Fit, BoundsEveryAttribute)
{
  const std::array<Index, 3> size = { 25, 21, 29 };
  Volume volume(size, { Shell(size) });
  // Another place, another unit, another offset.
  volume.Add(
    [f = Shell(size), size](const Point& x) {
      return 1e6 - 5e4 * f({ double(size[0] - 1) - x[0], x[2], x[1] });
    });
  volume.Add([](const Point& x) { return 1e-9 * (x[0] + x[1] * x[2]); });
  for (const Refinement rule : { Refinement::Compact, Refinement::AnalysisSuitable })
  {
    const FitResult result = FitGrid(volume.Samples(), Options(rule, 30000, 2e-3, 2e-2));
    CheckResult(result, volume);
    for (int c = 0; c < 3; ++c)
    {
      const VoxelError error = ErrorAtVoxels(result.Spline, volume, c);
      EXPECT_LE(error.Rms, 2e-3) << "attribute " << c;
      EXPECT_LE(error.Maximum, 2e-2) << "attribute " << c;
    }
  }
}

TEST(Fit, AnalysisSuitableResultIsDualCompatible)
{
  for (const Index limit : { 500, 3000 })
  {
    const std::array<Index, 3> size = { 33, 24, 40 };
    const Volume volume(size, { Shell(size) });
    const FitResult result =
      FitGrid(volume.Samples(), Options(Refinement::AnalysisSuitable, limit));
    EXPECT_EQ(CheckDualCompatibility(result.Spline), "");
    for (const double w : result.Spline.Weights)
    {
      ASSERT_EQ(w, 1.0);
    }
  }
}

// A slanted edge, where refinement can make a function too many.
TEST(Fit, GivesIndependentFunctions)
{
  const Volume volume({ 22, 20, 24 }, { [](const Point& x) {
    return x[0] * std::cos(1.0) + x[1] * std::sin(1.0) + x[2] * std::cos(2.0) > 8.0 ? 1.0 : 0.0;
  } });
  FitOptions options = Options(Refinement::Compact, 900);
  options.Independent = false;
  const FitResult dependent = FitGrid(volume.Samples(), options);
  options.Independent = true;
  const FitResult basis = FitGrid(volume.Samples(), options);
  CheckResult(basis, volume);
  EXPECT_GT(SmallestSingularValue(basis.Spline), 1e-5);
  EXPECT_LE(basis.Spline.Size(), dependent.Spline.Size());
  EXPECT_LE(basis.Rounds.back().Rms, 1.01 * dependent.Rounds.back().Rms);
}

// No fit with the same functions is better: the gradient vanishes at the final control points. Few
// voxels a function, as in noise at the edge of a mask, is what the iterations find hardest.
TEST(Fit, IsTheLeastSquaresFitOfItsFunctions)
{
  for (const Refinement rule : Rules)
  {
    for (unsigned seed = 0; seed < 8; ++seed)
    {
      std::mt19937 random(seed);
      Volume volume({ 18, 20, 17 }, { Noise(seed) });
      if (seed > 0)
      {
        volume.CountOnlyABlob(random);
      }
      const FitResult result = FitGrid(volume.Samples(), Options(rule, 300));
      const double gap = result.Rounds.back().Rms / BestRms(result.Spline, volume) - 1.0;
      EXPECT_GE(gap, -1e-6);
      EXPECT_LE(gap, 0.012) << "rule " << int(rule) << ", seed " << seed;
    }
  }
}

TEST(Fit, TakesThinVolumes)
{
  const std::vector<std::array<Index, 3>> sizes = { { 2, 2, 2 }, { 2, 50, 50 }, { 50, 2, 50 },
    { 5, 100, 7 }, { 3, 2, 90 }, { 4, 4, 4 }, { 2, 2, 200 } };
  for (const auto& size : sizes)
  {
    for (const Refinement rule : Rules)
    {
      for (const Index limit : { 64, 2000 })
      {
        SCOPED_TRACE(testing::Message() << size[0] << " x " << size[1] << " x " << size[2]
                                        << ", rule " << int(rule) << ", limit " << limit);
        const Volume noise(size, { Noise(4) });
        const FitResult result = FitGrid(noise.Samples(), Options(rule, limit));
        CheckResult(result, noise);
        EXPECT_LE(result.Spline.Size(), limit);
        const Volume linear(
          size, { [](const Point& x) { return x[0] - 2.0 * x[1] + 0.5 * x[2]; } });
        const FitResult exact = FitGrid(linear.Samples(), Options(rule, limit));
        EXPECT_LE(ErrorAtVoxels(exact.Spline, linear).Maximum, 1e-9);
      }
    }
  }
}
