// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "BallBlocks.h"
#include "BlockSplines.h"
#include "TSpline/DualCompatibility.h"
#include "ThreadedExecution.h"

#include <gtest/gtest.h>

#include <set>

namespace
{
using namespace trivariate;

TSpline RefinedAtRandom(
  const BlockSpline& layout, int cells, int rounds, TSpline spline, std::mt19937& random)
{
  const BlockComplex& blocks = layout.Blocks();
  const auto rule = MakeAnalysisSuitableBlockRule(layout, cells);
  for (int round = 0; round < rounds; ++round)
  {
    const Index b = static_cast<Index>(random() % blocks.Size());
    rule->Refine(spline, RandomMarks(spline, RandomPointIn(blocks, b, random), 3, random));
  }
  return spline;
}

// Promise 7 over a domain: refined at random the spline is what it was, functions sum to one with
// weights one, any two are dual-compatible, and no face has a gap, whatever the control points.
TEST(AnalysisSuitableBlocks, StayWholeUnderRefinement)
{
  for (const NamedComplex& shape : BlockShapes())
  {
    SCOPED_TRACE(shape.Name);
    const BlockComplex& blocks = shape.Blocks;
    const BlockSpline layout(blocks, 4);
    for (unsigned seed = 0; seed < 4; ++seed)
    {
      std::mt19937 random(seed);
      const int cells = seed % 2 ? 2 : 1;
      TSpline coarse = layout.MakeCoarsest(cells, 1);
      Scatter(layout, coarse, random);
      TSpline spline = RefinedAtRandom(layout, cells, 4, coarse, random);
      ASSERT_EQ(Validate(spline), "");
      EXPECT_GT(spline.Size(), coarse.Size() + 20);
      EXPECT_EQ(CheckDualCompatibility(spline), "");
      EXPECT_EQ(spline.Weights, std::vector<double>(spline.Functions.size(), 1.0));
      ExpectSameSpline(blocks, coarse, spline, random);
      EXPECT_LT(LargestGap(blocks, spline, random), 1e-12);
      Scatter(layout, spline, random);
      EXPECT_LT(LargestGap(blocks, spline, random), 1e-13);
    }
  }
}

// Every function on a glued face has a partner of the same trace on the other side: as many points
// as the face has, not more.
TEST(AnalysisSuitableBlocks, HaveEqualTraces)
{
  const BlockComplex blocks = ThreeAroundAnEdge();
  const BlockSpline layout(blocks, 4);
  for (unsigned seed = 0; seed < 6; ++seed)
  {
    std::mt19937 random(seed);
    const TSpline spline = RefinedAtRandom(layout, 1, 6, layout.MakeCoarsest(1, 0), random);
    const SharedPoints shared = layout.Share(spline, Sharing::Places);
    std::vector<std::set<Index>> blocksOf(shared.Count());
    for (Index i = 0; i < spline.Size(); ++i)
    {
      blocksOf[shared.PointOf[i]].insert(layout.BlockOf(spline.Functions[i]));
    }
    for (Index i = 0; i < spline.Size(); ++i)
    {
      const BlendingFunction& f = spline.Functions[i];
      const Index b = layout.BlockOf(f);
      for (int face = 0; face < 6; ++face)
      {
        const int axis = face / 2, side = face % 2;
        const std::int32_t end = (blocks.Origins[b][axis] + side) * 16;
        if (blocks.IsGlued({ b, axis, side }) && f[axis][side ? 1 : 3] == end)
        {
          const Index other = blocks.Twin({ b, axis, side }).Face.Block;
          EXPECT_EQ(blocksOf[shared.PointOf[i]].count(other), 1u);
        }
      }
    }
  }
}

TEST(AnalysisSuitableBlocks, ReproduceCubicsInABlock)
{
  const BlockComplex blocks = LayeredCubeComplex();
  const BlockSpline layout(blocks, 3);
  std::mt19937 random(5);
  TSpline spline = RefinedAtRandom(layout, 1, 5, layout.MakeCoarsest(1, 0), random);
  for (const Index b : { 0, 4 })
  {
    const TricubicPolynomial polynomial(random);
    for (Index i = 0; i < spline.Size(); ++i)
    {
      spline.ControlPoint(i)[0] = polynomial.Coefficient(spline, i);
    }
    for (int trial = 0; trial < 30; ++trial)
    {
      const Point x = RandomPointIn(blocks, b, random);
      EXPECT_NEAR(
        HomogeneousValue(spline, x)[0], polynomial(x), 1e-9 * (1.0 + std::abs(polynomial(x))));
    }
  }
}

// A fit with this rule is as sound as one with the compact rule, and the same for any threads.
TEST(AnalysisSuitableBlocks, CarryAFit)
{
  const BallPhantom ball(20);
  const auto fit = [&ball](Refinement rule, int threads)
  {
    BlockFitOptions options;
    options.Rule = rule;
    options.MaximumControlPoints = 900;
    return FitBlocks(
      ball.Map.Blocks, ball.Voxels, ball.Map.Nodes(6), options, ThreadedExecution(threads));
  };
  const BlockFitResult one = fit(Refinement::AnalysisSuitable, 1);
  const BlockFitResult three = fit(Refinement::AnalysisSuitable, 3);
  EXPECT_EQ(one.Spline.Functions, three.Spline.Functions);
  EXPECT_EQ(one.Spline.ControlPoints, three.Spline.ControlPoints);
  EXPECT_EQ(CheckDualCompatibility(one.Spline), "");
  EXPECT_LE(one.ControlPoints, 900);
  EXPECT_GT(one.ControlPoints, 500);
  EXPECT_EQ(one.Folds.Folded, 0);
  EXPECT_LT(100.0 * one.Rounds.back().Rms, 2.0);
  std::mt19937 random(1);
  EXPECT_LT(LargestGap(ball.Map.Blocks, one.Spline, random), 1e-12 * ball.Map.Radius);
  EXPECT_THROW(fit(Refinement::Uniform, 1), std::invalid_argument);
}
}
