// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "TSpline/AnalysisSuitableRule.h"
#include "TSpline/DualCompatibility.h"
#include "RandomRefinement.h"
#include "Rank.h"
#include "RefinementShapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

using namespace trivariate;

namespace
{
double Scale(const TSpline& spline)
{
  double scale = 1.0;
  for (const KnotLine& line : spline.KnotLines)
  {
    scale *= std::pow(std::max(std::abs(line.front()), std::abs(line.back())), 3);
  }
  return scale;
}

// Refines in rounds of random marks and checks all that must hold after each of them.
void CheckRounds(const Shape& shape, Closure closure, unsigned seed, int rounds, int marksPerRound)
{
  SCOPED_TRACE(testing::Message() << "seed " << seed << ", root cells " << shape.RootCells[0] << " "
                                  << shape.RootCells[1] << " " << shape.RootCells[2]);
  std::mt19937 random(seed);
  TSpline spline = RandomTensorProduct(shape.RootCells, shape.Depth, random);
  const TricubicPolynomial polynomial(random);
  const double scale = Scale(spline);
  for (Index i = 0; i < spline.Size(); ++i)
  {
    spline.ControlPoint(i)[4] = polynomial.Coefficient(spline, i) / scale;
  }
  const auto rule = MakeAnalysisSuitableRule(spline, closure);
  for (int round = 0; round < rounds; ++round)
  {
    const TSpline coarse = spline;
    rule->Refine(spline, RandomMarks(spline, marksPerRound, random));
    ASSERT_EQ(Validate(spline), "");
    ASSERT_GE(spline.Size(), coarse.Size());
    ASSERT_EQ(CheckDualCompatibility(spline), "");
    ASSERT_TRUE(
      std::all_of(spline.Weights.begin(), spline.Weights.end(), [](double w) { return w == 1.0; }));
    for (int sample = 0; sample < 40; ++sample)
    {
      const Point x = RandomPoint(spline, random);
      const auto before = HomogeneousValue(coarse, x), after = HomogeneousValue(spline, x);
      ASSERT_NEAR(after.back(), 1.0, 1e-12);
      for (int c = 0; c < spline.Components; ++c)
      {
        ASSERT_NEAR(
          after[c], before[c], 1e-12 * std::max(1.0, std::abs(spline.KnotLines[0].back())))
          << "component " << c;
      }
      ASSERT_NEAR(after[4], polynomial(x) / scale, 1e-9);
    }
  }
}
}

TEST(AnalysisSuitableRule, KeepsItsPromisesOnRandomMeshes)
{
  for (std::size_t s = 0; s < Shapes.size(); ++s)
  {
    for (unsigned seed = 0; seed < 6; ++seed)
    {
      CheckRounds(
        Shapes[s], Closure::Narrow, static_cast<unsigned>(100 * s) + seed, 4, 1 + 2 * seed);
      if (HasFatalFailure())
      {
        return;
      }
    }
  }
}

TEST(AnalysisSuitableRule, KeepsItsPromisesWithThePublishedClosure)
{
  for (std::size_t s = 0; s < Shapes.size(); ++s)
  {
    CheckRounds(Shapes[s], Closure::Published, static_cast<unsigned>(s), 2, 1);
    if (HasFatalFailure())
    {
      return;
    }
  }
}

TEST(AnalysisSuitableRule, CarriesUnchangedFunctionsBitByBit)
{
  std::mt19937 random(5);
  TSpline spline = RandomTensorProduct({ 6, 6, 6 }, { 2, 2, 2 }, random);
  const auto rule = MakeAnalysisSuitableRule(spline);
  const TSpline coarse = spline;
  rule->Refine(spline, { { 0, 0, 2 } });
  ASSERT_GT(spline.Size(), coarse.Size());
  std::map<BlendingFunction, Index> ids;
  for (Index i = 0; i < spline.Size(); ++i)
  {
    ASSERT_TRUE(ids.emplace(spline.Functions[i], i).second);
  }
  Index kept = 0;
  for (Index j = 0; j < coarse.Size(); ++j)
  {
    const auto found = ids.find(coarse.Functions[j]);
    if (found != ids.end())
    {
      ++kept;
      EXPECT_TRUE(std::equal(coarse.ControlPoint(j), coarse.ControlPoint(j) + coarse.Components,
        spline.ControlPoint(found->second)));
    }
  }
  EXPECT_GT(kept, coarse.Size() / 2);
}

TEST(AnalysisSuitableRule, MeetsAMarkInThreeRounds)
{
  for (unsigned seed = 0; seed < 40; ++seed)
  {
    std::mt19937 random(seed);
    TSpline spline = RandomTensorProduct({ 3, 4, 3 }, { 3, 2, 3 }, random);
    const auto rule = MakeAnalysisSuitableRule(spline);
    rule->Refine(spline, RandomMarks(spline, 3, random));
    const auto marks = RandomMarks(spline, 1, random);
    if (marks.empty())
    {
      continue;
    }
    RefinementMark mark = marks[0];
    const BlendingFunction wished = spline.Functions[mark.Function];
    const auto isMet = [&]()
    {
      const LocalKnots& k = spline.Functions[mark.Function][mark.Direction];
      return mark.Knot <= k[0] || mark.Knot >= k[4] ||
             std::find(k.begin(), k.end(), mark.Knot) != k.end();
    };
    for (int round = 0; round < 3 && !isMet(); ++round)
    {
      rule->Refine(spline, { mark });
      // The function of the same vertex and layer is the one that can still be told by its centre
      // and by how often it has the domain's ends.
      for (Index i = 0; i < spline.Size(); ++i)
      {
        bool same = true;
        for (int a = 0; a < 3; ++a)
        {
          const LocalKnots &f = spline.Functions[i][a], &g = wished[a];
          same = same && f[2] == g[2] && (f[1] == f[2]) == (g[1] == g[2]) &&
                 (f[3] == f[2]) == (g[3] == g[2]);
        }
        mark.Function = same ? i : mark.Function;
      }
    }
    EXPECT_TRUE(isMet()) << "seed " << seed;
  }
}

TEST(AnalysisSuitableRule, HalvesACellOnceForManyMarks)
{
  std::mt19937 random(0);
  TSpline once = RandomTensorProduct({ 4, 4, 4 }, { 3, 3, 3 }, random), often = once;
  const auto rule = MakeAnalysisSuitableRule(once);
  const auto copy = rule->Clone();
  rule->Refine(once, { { 24, 0, 4 } });
  std::vector<RefinementMark> marks;
  for (const std::int32_t knot : { 4, 2, 6, 1, 4, 7 })
  {
    marks.push_back({ 24, 0, knot });
  }
  copy->Refine(often, marks);
  EXPECT_EQ(once.Functions, often.Functions);
}

TEST(AnalysisSuitableRule, EndsInTheFinestTensorProduct)
{
  std::mt19937 random(1);
  for (const Shape& shape :
    { Shape{ { 2, 3, 1 }, { 1, 0, 2 } }, Shape{ { 2, 2, 2 }, { 1, 1, 1 } } })
  {
    TSpline spline = RandomTensorProduct(shape.RootCells, shape.Depth, random);
    const auto rule = MakeAnalysisSuitableRule(spline);
    RefineToTheEnd(spline, *rule);
    const TSpline finest = MakeTensorProduct(spline.KnotLines, { 1, 1, 1 }, 0);
    EXPECT_EQ(spline.Functions, finest.Functions);
    for (Index i = 0; i < finest.Size(); ++i)
    {
      for (int a = 0; a < 3; ++a)
      {
        EXPECT_NEAR(spline.ControlPoint(i)[a], finest.ControlPoint(i)[a], 1e-12);
      }
    }
    const TSpline before = spline;
    rule->Refine(spline, { { 0, 0, 0 }, { 7, 2, spline.Functions[7][2][2] } });
    EXPECT_EQ(spline.Functions, before.Functions);
    EXPECT_EQ(spline.ControlPoints, before.ControlPoints);
  }
}

TEST(AnalysisSuitableRule, FunctionsAreLinearlyIndependent)
{
  for (unsigned seed = 0; seed < 8; ++seed)
  {
    std::mt19937 random(seed);
    TSpline spline = RandomTensorProduct({ 2, 2, 2 }, { 2, 2, 2 }, random);
    const auto rule = MakeAnalysisSuitableRule(spline);
    for (int round = 0; round < 3; ++round)
    {
      rule->Refine(spline, RandomMarks(spline, 1, random));
    }
    EXPECT_GT(SmallestSingularValue(spline), 1e-5) << spline.Size() << " functions, seed " << seed;
  }
}

TEST(AnalysisSuitableRule, RefusesWhatItCannotBegin)
{
  const KnotLine line = MakeUniformKnotLine(0, 1, 12);
  EXPECT_THROW(MakeAnalysisSuitableRule(MakeTensorProduct({ line, line, line }, { 3, 4, 4 }, 0)),
    std::invalid_argument);
  TSpline spline = MakeTensorProduct({ line, line, line }, { 4, 4, 2 }, 0);
  const auto rule = MakeAnalysisSuitableRule(spline);
  EXPECT_THROW(rule->Refine(spline, { { spline.Size(), 0, 2 } }), std::out_of_range);
  EXPECT_THROW(rule->Refine(spline, { { 0, 0, 13 } }), std::out_of_range);
  EXPECT_THROW(rule->Refine(spline, { { 0, 3, 2 } }), std::out_of_range);
  TSpline refined = spline;
  rule->Refine(refined, { { 0, 0, 2 } });
  EXPECT_THROW(MakeAnalysisSuitableRule(refined), std::invalid_argument);
  EXPECT_THROW(rule->Refine(spline, { { 0, 0, 2 } }), std::invalid_argument);
  EXPECT_THROW(MakeAnalysisSuitableRule(TSpline()), std::invalid_argument);
}

TEST(AnalysisSuitableRule, CloneIsIndependent)
{
  std::mt19937 random(3);
  TSpline spline = RandomTensorProduct({ 3, 3, 3 }, { 2, 2, 2 }, random);
  const auto rule = MakeAnalysisSuitableRule(spline);
  const auto copy = rule->Clone();
  TSpline other = spline, again = spline;
  rule->Refine(other, { { 0, 0, 2 } });
  copy->Refine(again, { { 0, 0, 2 } });
  EXPECT_EQ(other.Functions, again.Functions);
  EXPECT_EQ(other.ControlPoints, again.ControlPoints);
}
