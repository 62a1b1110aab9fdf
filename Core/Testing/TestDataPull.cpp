// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "BallBlocks.h"
#include "Fit/DataPull.h"
#include "Fit/RefinementHistory.h"
#include "TSpline/Evaluator.h"
#include "ThreadedExecution.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
using namespace trivariate;

// A cube with X, Y, Z = 2u, 2v, 2w and two attributes, 3X + 4Y and Z: control points of a function
// are its mean knots, on which linear functions have their values as coefficients.
TSpline LinearSpline(const BlockSpline& layout)
{
  TSpline spline = layout.MakeCoarsest(2, 2);
  for (Index i = 0; i < spline.Size(); ++i)
  {
    double* p = spline.ControlPoint(i);
    for (int a = 0; a < 3; ++a)
    {
      const auto& knots = spline.Functions[i][a];
      const auto& line = spline.KnotLines[a];
      p[a] = 2.0 * (line[knots[1]] + line[knots[2]] + line[knots[3]]) / 3.0;
    }
    p[3] = 3.0 * p[0] + 4.0 * p[1];
    p[4] = p[2];
  }
  return spline;
}

// What is linear is met by the pull exactly, as if all voxels could move freely.
TEST(DataPull, MeetsLinearAttributes)
{
  const BlockComplex cube = CubesComplex({ { 0, 0, 0 } });
  const BlockSpline layout(cube, 3);
  const TSpline spline = LinearSpline(layout);
  ScatteredSamples samples;
  samples.Components = 2;
  const double errors[3][2] = { { 0.1, 0.0 }, { 0.0, -0.2 }, { 0.0, 100.0 } };
  for (int i = 0; i < 3; ++i)
  {
    samples.Parameters.insert(samples.Parameters.end(), { 0.2, 0.3 + 0.1 * i, 0.5 });
  }
  for (int c = 0; c < 2; ++c)
  {
    for (int i = 0; i < 3; ++i)
    {
      const double value = c == 0 ? 1.2 + 8.0 * samples.Parameters[3 * i + 1] : 1.0;
      samples.Values.push_back(value - errors[i][c]);
    }
  }
  const double ranges[2] = { 10.0, 2.0 }, spacing = 0.5;
  const DataPull pull =
    PullToData(spline, samples, { ranges[0], ranges[1] }, spacing, 1.0, ThreadedExecution(2));
  // Per voxel and range: (3, 4, 0) / 20 and (0, 0, 1) / 4, with the square of their sum.
  const double weight = 0.0625 + 0.0625 + 4e-4;
  for (int i = 0; i < 3; ++i)
  {
    EXPECT_NEAR(pull.Weights[i], weight, 1e-6);
    double wanted[3] = { 0.15, 0.2, 0.25 };
    double length = 0.0;
    for (int a = 0; a < 3; ++a)
    {
      wanted[a] *= spacing * errors[i][a / 2] / ranges[a / 2] / weight;
      length += wanted[a] * wanted[a];
    }
    length = std::sqrt(length);
    for (int a = 0; a < 3; ++a)
    {
      // At most two voxels.
      const double place =
        2.0 * samples.Parameters[3 * i + a] + wanted[a] * std::min(1.0, 2.0 * spacing / length);
      EXPECT_NEAR(pull.Places[3 * i + a], place, 1e-9) << i << " " << a;
    }
  }
}

TEST(RefinementHistory, RefinesAnotherSplineInTheSameWay)
{
  const BallMap ball;
  const BlockSpline layout(ball.Blocks, 4);
  const TSpline coarse = layout.MakeCoarsest(1, 1);
  const auto first = MakeBlockRule(layout, coarse);
  RefinementHistory history(first->Clone());
  TSpline refined = coarse;
  for (int round = 0; round < 3; ++round)
  {
    const BlendingFunction& f = refined.Functions[17 * round];
    history.Refine(refined, { { 17 * round, 0, (f[0][0] + f[0][4]) / 2 } });
  }
  ASSERT_GT(refined.Size(), coarse.Size());
  TSpline other = coarse;
  for (Index i = 0; i < other.Size(); ++i)
  {
    other.ControlPoint(i)[3] = std::sin(double(layout.Share(coarse).PointOf[i]));
  }
  const TSpline before = other;
  history.Repeat(*first, other);
  EXPECT_EQ(other.Functions, refined.Functions);
  const BezierMesh coarseMesh(before), mesh(other);
  const Evaluator wanted(before, coarseMesh, { 3 }), found(other, mesh, { 3 });
  for (int i = 0; i < 50; ++i)
  {
    const auto& o = ball.Blocks.Origins[i % 7];
    const double p[3] = { o[0] + 0.017 * i, o[1] + 0.99 - 0.019 * i, o[2] + 0.013 * i };
    double expected, actual;
    EvaluatorOutput output;
    output.Values = &expected;
    ASSERT_TRUE(wanted.Evaluate(p, output));
    output.Values = &actual;
    ASSERT_TRUE(found.Evaluate(p, output));
    EXPECT_NEAR(actual, expected, 1e-12);
  }
}
}
