// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "TSpline/LinearIndependence.h"
#include "RandomRefinement.h"
#include "Rank.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace trivariate;

namespace
{
// Steep, messy refinement by knot insertion, the more two-dimensional the more prone to
// dependences.
TSpline RandomCompact(unsigned seed)
{
  const std::array<int, 3> roots[] = { { 2, 2, 2 }, { 1, 1, 1 }, { 4, 4, 1 }, { 6, 6, 1 },
    { 1, 8, 8 }, { 3, 3, 2 } };
  const std::array<int, 3> depths[] = { { 3, 3, 3 }, { 4, 4, 4 }, { 3, 3, 0 }, { 2, 2, 0 },
    { 0, 3, 3 }, { 3, 3, 1 } };
  std::mt19937 random(seed);
  TSpline spline = RandomTensorProduct(roots[seed % 6], depths[seed % 6], random, true);
  const auto rule = MakeKnotInsertionRule(spline);
  const Index size = 300 + static_cast<Index>(random() % 400);
  const int marks = 1 + static_cast<int>(random() % 12);
  for (int round = 0; round < 60 && spline.Size() < size; ++round)
  {
    rule->Refine(spline, RandomMarks(spline, marks, random));
  }
  return spline;
}

void ExpectVanishes(const TSpline& spline, const LinearDependence& dependence, std::mt19937& random)
{
  ASSERT_EQ(dependence.Functions.size(), dependence.Coefficients.size());
  ASSERT_TRUE(std::is_sorted(dependence.Functions.begin(), dependence.Functions.end()));
  double largest = 0.0;
  for (const double a : dependence.Coefficients)
  {
    largest = std::max(largest, std::abs(a));
  }
  EXPECT_EQ(largest, 1.0);
  for (const Index i : dependence.Functions)
  {
    for (int sample = 0; sample < 10; ++sample)
    {
      Point x;
      for (int a = 0; a < 3; ++a)
      {
        const Knots5 t = spline.LocalKnotValues(i, a);
        x[a] = Random(random, t[0], t[4]);
      }
      double sum = 0.0;
      for (std::size_t k = 0; k < dependence.Functions.size(); ++k)
      {
        sum += dependence.Coefficients[k] * ValueOf(spline, dependence.Functions[k], x);
      }
      ASSERT_NEAR(sum, 0.0, 1e-12);
    }
  }
}

// Repairs and checks all that repair promises; returns the number of removed functions.
Index CheckRepair(TSpline& spline, std::mt19937& random)
{
  const TSpline before = spline;
  const Index removed = RepairLinearDependence(spline);
  EXPECT_EQ(Validate(spline), "");
  EXPECT_EQ(spline.Size(), before.Size() - removed);
  for (int sample = 0; sample < 100; ++sample)
  {
    const Point x = RandomPoint(spline, random);
    const auto was = HomogeneousValue(before, x), is = HomogeneousValue(spline, x);
    EXPECT_NEAR(is.back(), 1.0, 1e-12);
    for (int c = 0; c < spline.Components; ++c)
    {
      EXPECT_NEAR(is[c], was[c], 1e-12 * spline.KnotLines[0].size());
    }
  }
  return removed;
}

// Cuts the range into uneven pieces and runs them last to first.
Execution Backwards()
{
  Execution execution;
  execution.ParallelFor = [](Index n, const Execution::Body& body)
  {
    for (Index end = n; end > 0; end -= std::min<Index>(end, 37))
    {
      body(std::max<Index>(end - 37, 0), end);
    }
  };
  return execution;
}
}

TEST(LinearIndependence, TensorProductsAndAnalysisSuitableSplinesAreIndependent)
{
  for (unsigned seed = 0; seed < 6; ++seed)
  {
    std::mt19937 random(seed);
    TSpline spline = RandomTensorProduct({ 3, 2, 4 }, { 2, 3, 2 }, random);
    EXPECT_TRUE(FindLinearDependences(spline).empty());
    const auto rule = MakeAnalysisSuitableRule(spline);
    for (int round = 0; round < 3; ++round)
    {
      rule->Refine(spline, RandomMarks(spline, 2, random));
    }
    EXPECT_TRUE(FindLinearDependences(spline).empty());
    const TSpline before = spline;
    EXPECT_EQ(RepairLinearDependence(spline), 0);
    EXPECT_EQ(spline.Functions, before.Functions);
    EXPECT_EQ(spline.ControlPoints, before.ControlPoints);
  }
}

// A function beside both halves that it splits into is one too many, with known coefficients.
TEST(LinearIndependence, FindsAFunctionAmongItsSplits)
{
  for (unsigned seed = 0; seed < 10; ++seed)
  {
    std::mt19937 random(seed);
    TSpline spline = RandomTensorProduct({ 5, 6, 5 }, { 1, 1, 1 }, random);
    const Index parent = static_cast<Index>(random() % spline.Size());
    const int a = static_cast<int>(random() % 3);
    const LocalKnots k = spline.Functions[parent][a];
    const int span = static_cast<int>(
      std::find_if(k.begin(), k.end(), [&k](std::int32_t t) { return t > k[0]; }) - k.begin());
    const std::int32_t knot = DyadicMiddle(k[span - 1], k[span]);
    const KnotInsertion factor =
      InsertKnot(spline.LocalKnotValues(parent, a), spline.KnotLines[a][knot]);
    std::array<std::int32_t, 6> all{ k[0], k[1], k[2], k[3], k[4], knot };
    std::sort(all.begin(), all.end());
    // Half of the parent's weight and coefficient is handed to the halves.
    for (const int half : { 0, 1 })
    {
      BlendingFunction f = spline.Functions[parent];
      std::copy_n(all.begin() + half, 5, f[a].begin());
      spline.Functions.push_back(f);
      spline.Weights.push_back(0.5 * (half == 0 ? factor.First : factor.Second));
      for (int c = 0; c < spline.Components; ++c)
      {
        spline.ControlPoints.push_back(spline.ControlPoint(parent)[c]);
      }
    }
    spline.Weights[parent] = 0.5;

    const auto dependences = FindLinearDependences(spline);
    ASSERT_EQ(dependences.size(), 1u);
    const LinearDependence& d = dependences[0];
    ASSERT_EQ(d.Functions, (std::vector<Index>{ parent, spline.Size() - 2, spline.Size() - 1 }));
    EXPECT_NEAR(d.Coefficients[1] / d.Coefficients[0], -factor.First, 1e-13);
    EXPECT_NEAR(d.Coefficients[2] / d.Coefficients[0], -factor.Second, 1e-13);
    EXPECT_EQ(CheckRepair(spline, random), 1);
    EXPECT_TRUE(FindLinearDependences(spline).empty());
  }
}

TEST(LinearIndependence, FindsTwins)
{
  std::mt19937 random(2);
  TSpline spline = RandomTensorProduct({ 4, 4, 4 }, { 1, 1, 1 }, random);
  for (const Index twin : { Index(100), Index(101), Index(300) })
  {
    spline.Functions.push_back(spline.Functions[twin]);
    spline.Weights[twin] = 0.25;
    spline.Weights.push_back(0.75);
    for (int c = 0; c < spline.Components; ++c)
    {
      spline.ControlPoints.push_back(Random(random, -1.0, 1.0));
    }
  }
  EXPECT_EQ(FindLinearDependences(spline).size(), 3u);
  EXPECT_EQ(CheckRepair(spline, random), 3);
  EXPECT_GT(SmallestSingularValue(spline), 1e-5);
}

// Against brute force; the first seeds are known to give dependences, one of them four.
TEST(LinearIndependence, AgreesWithBruteForceOnMeshesOfKnotInsertion)
{
  std::vector<unsigned> seeds = { 231, 1189, 1365, 1602, 2898, 3134, 3429, 3629, 3699, 3841 };
  for (unsigned seed = 0; seed < 4; ++seed)
  {
    seeds.push_back(seed);
  }
  Index found = 0, left = 0;
  for (const unsigned seed : seeds)
  {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937 random(seed);
    TSpline spline = RandomCompact(seed);
    const auto dependences = FindLinearDependences(spline);
    EXPECT_EQ(static_cast<int>(dependences.size()), RankDeficiency(spline));
    for (const LinearDependence& dependence : dependences)
    {
      ExpectVanishes(spline, dependence, random);
    }
    // A dependence stays when two weights come to zero at once, whichever function is removed.
    const Index removed = CheckRepair(spline, random);
    if (removed > 0)
    {
      EXPECT_EQ(RankDeficiency(spline), static_cast<int>(dependences.size() - removed));
    }
    EXPECT_EQ(FindLinearDependences(spline).size(), dependences.size() - removed);
    found += dependences.size();
    left += dependences.size() - removed;
  }
  EXPECT_GE(found, 9);
  EXPECT_LE(left, found / 5);
}

TEST(LinearIndependence, DoesNotDependOnTheThreads)
{
  for (const unsigned seed : { 231u, 1365u })
  {
    TSpline one = RandomCompact(seed), other = one;
    RepairLinearDependence(one);
    RepairLinearDependence(other, Backwards());
    EXPECT_EQ(one.Functions, other.Functions);
    EXPECT_EQ(one.Weights, other.Weights);
    EXPECT_EQ(one.ControlPoints, other.ControlPoints);
  }
}

TEST(LinearIndependence, CanBeStopped)
{
  const TSpline spline = RandomCompact(1);
  Execution execution;
  execution.Continue = [](double) { return false; };
  EXPECT_THROW(FindLinearDependences(spline, execution), Aborted);
}

TEST(LinearIndependence, RefinementGoesOnAfterRepair)
{
  for (const unsigned seed : { 231u, 1365u, 3629u })
  {
    std::mt19937 random(seed);
    TSpline spline = RandomCompact(seed);
    EXPECT_GT(RepairLinearDependence(spline), 0);
    const TSpline coarse = spline;
    MakeKnotInsertionRule(spline)->Refine(spline, RandomMarks(spline, 6, random));
    EXPECT_GT(spline.Size(), coarse.Size());
    EXPECT_EQ(Validate(spline), "");
    for (int sample = 0; sample < 50; ++sample)
    {
      const Point x = RandomPoint(spline, random);
      const auto before = HomogeneousValue(coarse, x), after = HomogeneousValue(spline, x);
      EXPECT_NEAR(after.back(), 1.0, 1e-12);
      for (int c = 0; c < spline.Components; ++c)
      {
        EXPECT_NEAR(after[c], before[c], 1e-12 * spline.KnotLines[0].size());
      }
    }
  }
}
