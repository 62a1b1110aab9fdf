// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
// Residual, gradient, errors and gains of splits against plain sums over the voxels.
#include "Fit/GridFitSystem.h"
#include "GridVolumes.h"

#include <gtest/gtest.h>

#include <set>
#include <tuple>

using namespace trivariate;

namespace
{
// Values of a univariate function at the samples 0 .. n - 1.
std::vector<double> Sampled(const TSpline& spline, const LocalKnots& k, int a, Index n)
{
  TSpline one;
  one.KnotLines = spline.KnotLines;
  one.Functions = { { k, k, k } };
  const Knots5 t = one.LocalKnotValues(0, a);
  std::vector<double> values;
  for (Index x = 0; x < n; ++x)
  {
    const double at = static_cast<double>(x);
    values.push_back(at < t[0] || at > t[4] ? 0.0 : EvaluateBSpline(t, at)[0]);
  }
  return values;
}

double Inner(const std::vector<double>& x, const std::vector<double>& y)
{
  double sum = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i)
  {
    sum += x[i] * y[i];
  }
  return sum;
}

struct System
{
  Volume Data;
  GridSamples Samples;
  Axes Grid;
  Execution Run;
  TSpline Spline;
  GridFitSystem Fit;
  std::vector<double> Coefficients;
  std::vector<double> ResidualAtVoxels; // zero where voxels do not count

  System(const Volume& volume, std::mt19937& random)
    : Data(volume)
    , Samples(Data.Samples())
    , Grid{ DyadicAxis::ForSamples(volume.Size[0], 2.0),
      DyadicAxis::ForSamples(volume.Size[1], 1.0), DyadicAxis::ForSamples(volume.Size[2], 3.0) }
    , Fit(Samples, Grid, Run)
  {
    std::array<KnotLine, 3> lines;
    std::array<int, 3> stride;
    for (int a = 0; a < 3; ++a)
    {
      lines[a] = this->Grid[a].Line();
      stride[a] = 1 << this->Grid[a].FinestLevel();
    }
    this->Spline = MakeTensorProduct(lines, stride, 1);
    const auto rule = MakeKnotInsertionRule(this->Spline);
    for (int round = 0; round < 3; ++round)
    {
      rule->Refine(this->Spline, RandomMarks(this->Spline, 3, random));
      this->Fit.Update(this->Spline); // as a fit does, with tables of the round before
    }
    for (Index i = 0; i < this->Spline.Size(); ++i)
    {
      const double p = Random(random, -1.0, 1.0);
      this->Spline.ControlPoint(i)[3] = p;
      this->Coefficients.push_back(this->Spline.Weights[i] * p);
    }
    this->ResidualAtVoxels = ValuesAtVoxels(this->Spline, 3, this->Data.Size);
    for (Index i = 0; i < this->Data.Count(); ++i)
    {
      double& r = this->ResidualAtVoxels[i];
      r = this->Data.Mask.empty() || this->Data.Mask[i] ? this->Data.Values[i] - r : 0.0;
    }
  }

  // The sum over the voxels of the residual times a product of three univariate functions.
  double Project(const std::array<std::vector<double>, 3>& f) const
  {
    double sum = 0.0;
    for (Index i = 0; i < this->Data.Count(); ++i)
    {
      const Index x = i % this->Data.Size[0], y = i / this->Data.Size[0] % this->Data.Size[1];
      const Index z = i / this->Data.Size[0] / this->Data.Size[1];
      sum += this->ResidualAtVoxels[i] * f[0][x] * f[1][y] * f[2][z];
    }
    return sum;
  }

  std::array<std::vector<double>, 3> Factors(Index i) const
  {
    std::array<std::vector<double>, 3> factors;
    for (int a = 0; a < 3; ++a)
    {
      factors[a] = Sampled(this->Spline, this->Spline.Functions[i][a], a, this->Data.Size[a]);
    }
    return factors;
  }
};

// With and without a mask.
std::vector<Volume> Volumes(std::mt19937& random)
{
  Volume all({ 11, 14, 9 }, { Noise(3) });
  Volume some({ 13, 10, 12 }, { Noise(4) });
  some.CountOnlyABlob(random);
  return { all, some, Volume({ 2, 12, 17 }, { Noise(5) }) };
}
}

TEST(GridFitSystem, ResidualIsSamplesLessSpline)
{
  for (unsigned seed = 0; seed < 4; ++seed)
  {
    std::mt19937 random(seed);
    for (const Volume& volume : Volumes(random))
    {
      System system(volume, random);
      const Residual residual = system.Fit.ComputeResidual(0, system.Coefficients);
      const double squares = Inner(system.ResidualAtVoxels, system.ResidualAtVoxels);
      EXPECT_NEAR(residual.SquaredSum, squares, 1e-12 * squares);
      const std::vector<double> gradient = system.Fit.Gradient(residual);
      ASSERT_EQ(Index(gradient.size()), system.Spline.Size());
      for (Index i = 0; i < system.Spline.Size(); ++i)
      {
        ASSERT_NEAR(gradient[i], system.Project(system.Factors(i)), 1e-11) << "function " << i;
      }
      double largest = 0.0;
      for (const double r : system.ResidualAtVoxels)
      {
        largest = std::max(largest, std::abs(r));
      }
      const FitError error = system.Fit.Error(0, system.Coefficients);
      EXPECT_NEAR(error.Maximum, largest, 1e-12);
      EXPECT_NEAR(
        error.Rms, std::sqrt(squares / static_cast<double>(system.Fit.NumberOfVoxels())), 1e-12);
    }
  }
}

// A gain is the fall of the squared sum by the best multiple of what the split adds to its parent.
TEST(GridFitSystem, GainsAreFallsOfTheSquaredError)
{
  for (unsigned seed = 0; seed < 3; ++seed)
  {
    std::mt19937 random(seed);
    for (const Volume& volume : Volumes(random))
    {
      System system(volume, random);
      const Residual residual = system.Fit.ComputeResidual(0, system.Coefficients);
      std::vector<SplitGain> gains;
      system.Fit.AddGains(residual, 0.25, gains);
      system.Fit.AddGains(residual, 0.5, gains);
      ASSERT_FALSE(gains.empty());
      std::set<std::tuple<Index, int, std::int32_t>> distinct;
      for (const SplitGain& gain : gains)
      {
        ASSERT_TRUE(distinct.emplace(gain.Function, gain.Direction, gain.Knot).second);
        const int a = gain.Direction;
        const LocalKnots& k = system.Spline.Functions[gain.Function][a];
        ASSERT_EQ(std::count(k.begin(), k.end(), gain.Knot), 0);
        std::vector<std::int32_t> all(k.begin(), k.end());
        all.push_back(gain.Knot);
        std::sort(all.begin(), all.end());
        auto factors = system.Factors(gain.Function);
        const std::vector<double> child =
          Sampled(system.Spline, { all[0], all[1], all[2], all[3], all[4] }, a, volume.Size[a]);
        const double share = Inner(child, factors[a]) / Inner(factors[a], factors[a]);
        for (std::size_t x = 0; x < child.size(); ++x)
        {
          factors[a][x] = child[x] - share * factors[a][x];
        }
        const double norm2 = Inner(factors[0], factors[0]) * Inner(factors[1], factors[1]) *
                             Inner(factors[2], factors[2]);
        const double sum = system.Project(factors);
        ASSERT_NEAR(gain.SquaredError, norm2 > 0.0 ? 0.75 * sum * sum / norm2 : 0.0, 1e-9);
      }
    }
  }
}

// Every split that a rule could make of a function that the samples can tell from its parts.
TEST(GridFitSystem, EverySplitHasAGain)
{
  std::mt19937 random(1);
  const System system(Volume({ 17, 17, 17 }, { Noise(3) }), random);
  std::vector<SplitGain> gains;
  GridFitSystem fit = GridFitSystem(system.Samples, system.Grid, system.Run);
  fit.Update(system.Spline);
  fit.AddGains(fit.ComputeResidual(0, system.Coefficients), 1.0, gains);
  Index splits = 0;
  for (const BlendingFunction& f : system.Spline.Functions)
  {
    for (int a = 0; a < 3; ++a)
    {
      for (int s = 0; s < 4; ++s)
      {
        splits += DyadicMiddle(f[a][s], f[a][s + 1]) >= 0;
      }
    }
  }
  EXPECT_GT(static_cast<Index>(gains.size()), splits * 9 / 10);
  EXPECT_LE(static_cast<Index>(gains.size()), splits);
}

TEST(GridFitSystem, RangesAndMeansAreThoseOfTheVoxelsThatCount)
{
  std::mt19937 random(1);
  Volume volume({ 6, 5, 4 }, { Noise(1) });
  volume.Add([](const Point&) { return -3.0; });
  volume.Add([](const Point&) { return 0.0; });
  volume.CountOnlyABlob(random);
  double low = 1e300, high = -1e300, sum = 0.0;
  Index count = 0;
  for (Index i = 0; i < volume.Count(); ++i)
  {
    if (volume.Mask[i])
    {
      low = std::min(low, volume.Values[i]);
      high = std::max(high, volume.Values[i]);
      sum += volume.Values[i];
      ++count;
    }
  }
  const Axes axes{ DyadicAxis(6, 1, 2), DyadicAxis(5, 1, 2), DyadicAxis(4, 1, 1) };
  const GridSamples samples = volume.Samples();
  const Execution run;
  const GridFitSystem fit(samples, axes, run);
  EXPECT_EQ(fit.NumberOfVoxels(), count);
  EXPECT_EQ(fit.Range(0), high - low);
  EXPECT_NEAR(fit.Mean(0), sum / static_cast<double>(count), 1e-14);
  EXPECT_EQ(fit.Range(1), 3.0);
  EXPECT_EQ(fit.Mean(1), -3.0);
  EXPECT_EQ(fit.Range(2), 1.0);
}
