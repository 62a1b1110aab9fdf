// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
// How the gridded fit takes its input, its threads and being stopped.
#include "Fit/Fit.h"
#include "GridVolumes.h"
#include "ThreadedExecution.h"

#include <gtest/gtest.h>

#include <chrono>
#include <limits>
#include <stdexcept>

using namespace trivariate;

namespace
{
const std::vector<Refinement> Rules = { Refinement::Compact, Refinement::AnalysisSuitable,
  Refinement::Uniform };

FitOptions Options(Refinement rule, Index controlPoints)
{
  FitOptions options;
  options.Rule = rule;
  options.MaximumControlPoints = controlPoints;
  return options;
}

// What the fit says about its input; empty when it takes it.
std::string Complaint(const GridSamples& samples, const FitOptions& options)
{
  try
  {
    FitGrid(samples, options);
  }
  catch (const std::invalid_argument& fault)
  {
    return fault.what();
  }
  return "";
}

bool Contains(const std::string& text, const std::string& part)
{
  return text.find(part) != std::string::npos;
}
}

TEST(FitMask, CountedVoxelsAreFittedBetterThanInTheWholeBox)
{
  const std::array<Index, 3> size = { 24, 22, 26 };
  for (unsigned seed = 0; seed < 3; ++seed)
  {
    std::mt19937 random(seed);
    Volume volume(size, { [f = Shell(size), noise = Noise(seed)](const Point& x) mutable
                          { return std::round(6.0 * f(x)) + 0.2 * noise(x); } });
    for (const Refinement rule : Rules)
    {
      volume.Mask.clear();
      const FitResult whole = FitGrid(volume.Samples(), Options(rule, 1200));
      volume.CountOnlyABlob(random);
      const FitResult masked = FitGrid(volume.Samples(), Options(rule, 1200));
      EXPECT_EQ(Validate(masked.Spline), "");
      EXPECT_LE(masked.Spline.Size(), 1200);
      const VoxelError own = ErrorAtVoxels(masked.Spline, volume);
      EXPECT_NEAR(masked.Rounds.back().Rms, own.Rms, 1e-9);
      EXPECT_NEAR(masked.Rounds.back().MaximumError, own.Maximum, 1e-9);
      EXPECT_LE(own.Rms, ErrorAtVoxels(whole.Spline, volume).Rms)
        << "seed " << seed << ", rule " << int(rule);
    }
  }
}

// What is left is whole between voxels that count, also where functions are zero at the voxels.
TEST(FitMask, FunctionsWithoutAVoxelAreDropped)
{
  const std::vector<std::array<Index, 3>> sizes = { { 30, 30, 30 }, { 24, 2, 19 } };
  for (const auto& size : sizes)
  {
    std::mt19937 random(4);
    Volume volume(size, { Shell(size) });
    volume.Mask.resize(volume.Count());
    for (Index i = 0; i < volume.Count(); ++i)
    {
      const Point x = volume.Voxel(i);
      volume.Mask[i] = x[0] < 7 && x[1] < 6 && x[2] >= 4 && x[2] < 9;
    }
    const std::array<double, 3> low = { 0, 0, 4 };
    const std::array<double, 3> high = { 6, std::min(5.0, double(size[1] - 1)), 8 };
    for (const Refinement rule : Rules)
    {
      const FitResult result = FitGrid(volume.Samples(), Options(rule, 600));
      const TSpline& spline = result.Spline;
      EXPECT_EQ(Validate(spline), "");
      EXPECT_EQ(result.Rounds.back().ControlPoints, spline.Size());
      for (Index f = 0; f < spline.Size(); ++f)
      {
        for (int a = 0; a < 3; ++a)
        {
          const Knots5 t = spline.LocalKnotValues(f, a);
          ASSERT_TRUE(t[0] <= high[a] && t[4] >= low[a]) << "function " << f << " has no voxel";
        }
      }
      for (int sample = 0; sample < 200; ++sample)
      {
        Point x;
        for (int a = 0; a < 3; ++a)
        {
          x[a] = Random(random, low[a], high[a]);
        }
        const std::vector<double> value = HomogeneousValue(spline, x);
        ASSERT_NEAR(value.back(), 1.0, 1e-12) << "rule " << int(rule);
        for (int a = 0; a < 3; ++a)
        {
          ASSERT_NEAR(value[a], x[a], 1e-11);
        }
      }
    }
  }
}

TEST(FitMask, OtherVoxelsDoNotMatter)
{
  const std::array<Index, 3> size = { 20, 18, 22 };
  std::mt19937 random(1);
  Volume volume(size, { Shell(size) });
  volume.CountOnlyABlob(random);
  Volume damaged = volume;
  for (Index i = 0; i < damaged.Count(); ++i)
  {
    if (!damaged.Mask[i])
    {
      damaged.Values[i] =
        i % 2 ? std::numeric_limits<double>::quiet_NaN() : 1e300 * double(i % 3 - 1);
    }
  }
  for (const Refinement rule : Rules)
  {
    const FitResult expected = FitGrid(volume.Samples(), Options(rule, 600));
    const FitResult result = FitGrid(damaged.Samples(), Options(rule, 600));
    EXPECT_EQ(result.Spline.Functions, expected.Spline.Functions);
    EXPECT_EQ(result.Spline.ControlPoints, expected.Spline.ControlPoints);
  }
}

TEST(FitMask, OfAllVoxelsIsNoMask)
{
  const std::array<Index, 3> size = { 18, 20, 19 };
  Volume volume(size, { Shell(size) });
  for (const Refinement rule : Rules)
  {
    volume.Mask.clear();
    const FitResult without = FitGrid(volume.Samples(), Options(rule, 800));
    volume.Mask.assign(volume.Count(), 7);
    const FitResult with = FitGrid(volume.Samples(), Options(rule, 800));
    EXPECT_NEAR(
      with.Rounds.back().Rms, without.Rounds.back().Rms, 0.02 * without.Rounds.back().Rms + 1e-9);
  }
}

TEST(FitMask, OneVoxelIsEnough)
{
  Volume volume({ 9, 9, 9 }, { Noise(1) });
  volume.Mask.assign(volume.Count(), 0);
  volume.Mask[400] = 1;
  for (const Refinement rule : Rules)
  {
    const FitResult result = FitGrid(volume.Samples(), Options(rule, 500));
    EXPECT_NEAR(ValuesAtVoxels(result.Spline, 3, volume.Size)[400], volume.Values[400], 1e-6);
  }
}

TEST(FitInput, SaysWhatIsWrong)
{
  const Volume good({ 6, 7, 8 }, { Noise(1) });
  const FitOptions options = Options(Refinement::Compact, 100);
  EXPECT_EQ(Complaint(good.Samples(), options), "");

  for (int a = 0; a < 3; ++a)
  {
    std::array<Index, 3> size = { 6, 7, 8 };
    size[a] = 1;
    const std::string complaint = Complaint(Volume(size, { Noise(1) }).Samples(), options);
    EXPECT_TRUE(Contains(complaint, "at least 2")) << complaint;
    EXPECT_TRUE(Contains(complaint,
      std::to_string(size[0]) + " x " + std::to_string(size[1]) + " x " + std::to_string(size[2])))
      << complaint;
  }
  for (const double bad : { std::numeric_limits<double>::quiet_NaN(),
         std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity() })
  {
    Volume volume = good;
    volume.Add(Noise(2));
    volume.Values[volume.Count() + (5 * 7 + 4) * 6 + 3] = bad;
    const std::string complaint = Complaint(volume.Samples(), options);
    EXPECT_TRUE(Contains(complaint, "3, 4, 5 is not a finite number")) << complaint;
  }
  Volume nothing = good;
  nothing.Mask.assign(nothing.Count(), 0);
  EXPECT_TRUE(Contains(Complaint(nothing.Samples(), options), "mask leaves no voxel"));

  for (const Index limit : { -1, 0, 10, 63 })
  {
    const std::string complaint =
      Complaint(good.Samples(), Options(Refinement::AnalysisSuitable, limit));
    EXPECT_TRUE(Contains(complaint, std::to_string(limit) + " control points")) << complaint;
    EXPECT_TRUE(Contains(complaint, "64")) << complaint;
  }
  for (const double tolerance : { -1e-9, -1.0, std::numeric_limits<double>::quiet_NaN() })
  {
    FitOptions bad = options;
    bad.RmsTolerance = tolerance;
    EXPECT_TRUE(Contains(Complaint(good.Samples(), bad), "tolerance is negative"));
    bad = options;
    bad.MaximumErrorTolerance = tolerance;
    EXPECT_TRUE(Contains(Complaint(good.Samples(), bad), "tolerance is negative"));
  }
}

TEST(FitRuns, SameForAnyThreads)
{
  const std::array<Index, 3> size = { 24, 19, 22 };
  std::mt19937 random(2);
  Volume volume(size, { Shell(size) });
  volume.Add(Noise(3));
  for (const bool masked : { false, true })
  {
    if (masked)
    {
      volume.CountOnlyABlob(random);
    }
    for (const Refinement rule : Rules)
    {
      const FitResult one = FitGrid(volume.Samples(), Options(rule, 1200));
      for (const int threads : { 2, 3 })
      {
        const FitResult more =
          FitGrid(volume.Samples(), Options(rule, 1200), ThreadedExecution(threads));
        EXPECT_EQ(one.Spline.Functions, more.Spline.Functions);
        EXPECT_EQ(one.Spline.Weights, more.Spline.Weights);
        EXPECT_EQ(one.Spline.ControlPoints, more.Spline.ControlPoints) << threads << " threads";
        EXPECT_EQ(one.Rounds.back().Rms, more.Rounds.back().Rms);
      }
    }
  }
}

TEST(FitRuns, StopsAtOnceWhenAsked)
{
  const std::array<Index, 3> size = { 40, 40, 40 };
  const Volume volume(size, { Shell(size) });
  for (const Refinement rule : Rules)
  {
    // How often the fit asks.
    int all = 0;
    Execution execution;
    execution.Continue = [&all](double) { return ++all > 0; };
    FitGrid(volume.Samples(), Options(rule, 2000), execution);
    ASSERT_GT(all, rule == Refinement::Uniform ? 0 : 10);
    for (const int last : { 1, (all + 1) / 2, all })
    {
      int asked = 0;
      execution.Continue = [&asked, last](double) { return ++asked < last; };
      EXPECT_THROW(FitGrid(volume.Samples(), Options(rule, 2000), execution), Aborted);
      EXPECT_EQ(asked, last) << "not asked again after no";
    }
  }
}

TEST(FitRuns, AsksAndReportsProgress)
{
  using Clock = std::chrono::steady_clock;
  const std::array<Index, 3> size = { 64, 64, 64 };
  const Volume volume(size, { Shell(size) });
  for (const Refinement rule : { Refinement::Compact, Refinement::AnalysisSuitable })
  {
    double before = 0.0, longest = 0.0;
    auto lastTime = Clock::now();
    Execution execution;
    execution.Continue = [&](double done)
    {
      EXPECT_GE(done, before);
      EXPECT_LE(done, 1.0);
      before = done;
      const auto now = Clock::now();
      longest = std::max(longest, std::chrono::duration<double>(now - lastTime).count());
      lastTime = now;
      return true;
    };
    const FitResult result = FitGrid(volume.Samples(), Options(rule, 8000), execution);
    EXPECT_GT(before, 0.5);
    // Ten times what an idle machine takes, for a busy one.
    EXPECT_LT(longest, 5.0);
    double seconds = 0.0;
    for (const auto& [topic, share] : result.Seconds)
    {
      EXPECT_FALSE(topic.empty());
      EXPECT_GE(share, 0.0);
      seconds += share;
    }
    EXPECT_NEAR(seconds, result.Rounds.back().Seconds, 1e-3 * seconds);
  }
}

TEST(FitRuns, LeavesItsInputAlone)
{
  const std::array<Index, 3> size = { 12, 12, 12 };
  std::mt19937 random(1);
  Volume volume(size, { Shell(size) });
  volume.CountOnlyABlob(random);
  const Volume before = volume;
  FitGrid(volume.Samples(), Options(Refinement::Compact, 500));
  EXPECT_EQ(volume.Values, before.Values);
  EXPECT_EQ(volume.Mask, before.Mask);
}
