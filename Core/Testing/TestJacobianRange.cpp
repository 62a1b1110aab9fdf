// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "RandomRefinement.h"
#include "Shapes.h"
#include "TSpline/JacobianRange.h"
#include "TSpline/TSplineModel.h"
#include "ThreadedExecution.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace trivariate;

namespace
{
TSpline Box(double width)
{
  const KnotLine line = MakeUniformKnotLine(0.0, width, 8);
  return MakeTensorProduct({ line, line, line }, { 2, 2, 2 }, 1);
}

JacobianRange Measure(const TSpline& spline)
{
  return MeasureJacobian(spline, BezierMesh(spline));
}
}

TEST(JacobianRange, IsOneForABoxAndForTheAnnulus)
{
  TSpline box = Box(8.0);
  for (Index i = 0; i < box.Size(); ++i)
  {
    box.ControlPoint(i)[1] *= 7.0; // stretched, not sheared
  }
  for (const TSpline& spline : { box, QuarterAnnulus(4) })
  {
    const JacobianRange range = Measure(spline);
    EXPECT_EQ(range.Inverted, 0);
    EXPECT_NEAR(range.Minimum, 1.0, 1e-12);
  }
}

TEST(JacobianRange, OfAShearIsTheSineOfItsAngle)
{
  TSpline box = Box(8.0);
  for (Index i = 0; i < box.Size(); ++i)
  {
    box.ControlPoint(i)[0] += box.ControlPoint(i)[1]; // 45 degrees
  }
  EXPECT_NEAR(Measure(box).Minimum, std::sqrt(0.5), 1e-12);
  EXPECT_TRUE(Measure(box).Constant);
  box.ControlPoint(box.Size() / 2)[2] += 1e-6;
  EXPECT_FALSE(Measure(box).Constant);
}

// x = (u - 3)^2 turns round at u = 3, inside the second of four layers of cells.
TEST(JacobianRange, CountsTheCellsThatFold)
{
  TSpline box = Box(8.0);
  for (Index i = 0; i < box.Size(); ++i)
  {
    // The polar form of (u - 3)^2 at the three inner knots.
    const Knots5 k = box.LocalKnotValues(i, 0);
    const double a = k[1] - 3.0, b = k[2] - 3.0, c = k[3] - 3.0;
    box.ControlPoint(i)[0] = (a * b + b * c + c * a) / 3.0;
  }
  const JacobianRange range = Measure(box);
  EXPECT_EQ(range.Inverted, 2 * 16);
  EXPECT_FALSE(range.Constant);
  EXPECT_NEAR(range.Minimum, -1.0, 1e-12);
}

// What a mask left open is garbage outside of the object.
TEST(JacobianRange, LeavesOutCellsWithoutAllOfTheirFunctions)
{
  TSpline box = Box(16.0);
  std::vector<char> removed(box.Size());
  for (Index i = 0; i < box.Size(); ++i)
  {
    removed[i] = box.ControlPoint(i)[0] > 9.0;
  }
  RemoveFunctions(box, removed);
  const JacobianRange range = Measure(box);
  EXPECT_EQ(range.Inverted, 0);
  EXPECT_NEAR(range.Minimum, 1.0, 1e-12);
  EXPECT_TRUE(range.Constant);
}

TEST(JacobianRange, IsTheSameOnAnyNumberOfThreads)
{
  std::mt19937 random(5);
  TSpline spline = RandomTensorProduct({ 2, 2, 4 }, { 2, 2, 2 }, random);
  TwistAndBend(spline, 1.0, 0.7);
  MakeKnotInsertionRule(spline)->Refine(spline, RandomMarks(spline, 6, random));
  const BezierMesh mesh(spline);
  const JacobianRange one = MeasureJacobian(spline, mesh);
  const JacobianRange three = MeasureJacobian(spline, mesh, ThreadedExecution(3));
  EXPECT_EQ(one.Minimum, three.Minimum);
  EXPECT_EQ(one.Inverted, three.Inverted);
  EXPECT_GT(one.Minimum, 0.0);
  EXPECT_LT(one.Minimum, 1.0);
}

TEST(TSplineModelParts, OfASegmentAndOfAnAttributeAreThoseFunctionsAndNumbers)
{
  TSplineModel model;
  model.Spline = Box(4.0);
  model.Spline.Components = 6;
  model.Spline.ControlPoints.resize(6 * model.Spline.Size());
  for (std::size_t i = 0; i < model.Spline.ControlPoints.size(); ++i)
  {
    model.Spline.ControlPoints[i] = static_cast<double>(i);
  }
  model.Attributes = { { "a", 1 }, { "b", 2 } };
  for (Index i = 0; i < model.Spline.Size(); ++i)
  {
    model.Segment.push_back(i % 3 == 0 ? 7 : 2);
    model.Block.push_back(static_cast<std::int32_t>(i));
  }
  EXPECT_EQ(SegmentsOf(model), (std::vector<std::int32_t>{ 2, 7 }));
  const TSplineModel part = SegmentPart(model, 7);
  EXPECT_EQ(Validate(part), "");
  ASSERT_EQ(part.Spline.Size(), (model.Spline.Size() + 2) / 3);
  for (Index i = 0; i < part.Spline.Size(); ++i)
  {
    ASSERT_EQ(part.Segment[i], 7);
    ASSERT_EQ(part.Block[i], 3 * i);
    ASSERT_EQ(part.Spline.ControlPoint(i)[5], 18.0 * i + 5.0);
  }
  const TSplineModel b = AttributePart(model, 1);
  EXPECT_EQ(Validate(b), "");
  ASSERT_EQ(b.Spline.Components, 5);
  EXPECT_EQ(b.Spline.ControlPoint(2)[2], 14.0);
  EXPECT_EQ(b.Spline.ControlPoint(2)[3], 16.0);
  EXPECT_EQ(b.Spline.ControlPoint(2)[4], 17.0);
}
