// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Fit/PointShares.h"
#include "TSpline/BezierMesh.h"
#include "TSpline/Evaluator.h"
#include "TSpline/TSplineModel.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace trivariate;

namespace
{
constexpr std::array<Index, 3> Size = { 12, 6, 5 };

std::vector<std::int32_t> Halves()
{
  std::vector<std::int32_t> parts;
  for (Index v = 0; v < Size[0] * Size[1] * Size[2]; ++v)
  {
    parts.push_back(v % Size[0] < 4 ? 0 : 1);
  }
  return parts;
}

std::vector<double> Values(double (*f)(double, double))
{
  std::vector<double> values;
  for (Index v = 0; v < Size[0] * Size[1] * Size[2]; ++v)
  {
    values.push_back(
      f(static_cast<double>(v % Size[0]), static_cast<double>(v / Size[0] % Size[1])));
  }
  return values;
}
}

// What is linear in each part has no content, whatever the jump between the parts.
TEST(PointShares, GoByVoxelsWhereNothingBends)
{
  const auto values = Values([](double x, double y) { return x < 4 ? 3.0 * y : 100.0 + x; });
  const std::vector<double> shares = PointShares(Size, values.data(), Halves(), 2);
  EXPECT_NEAR(shares[0], 1.0 / 3.0, 1e-15);
  EXPECT_NEAR(shares[1], 2.0 / 3.0, 1e-15);
}

TEST(PointShares, GoByWhatBendsWithinAPart)
{
  // Only the second part bends, along x.
  const auto values = Values([](double x, double) { return x < 4 ? 0.0 : x * x; });
  const std::vector<double> one = PointShares(Size, values.data(), Halves(), 2);
  EXPECT_NEAR(one[0], 0.1 / 3.0, 1e-15);
  EXPECT_NEAR(one[1], 0.9 + 0.2 / 3.0, 1e-15);
  // Both bend equally along y at each voxel: a third and two thirds again.
  const auto both = Values([](double, double y) { return y * y; });
  const std::vector<double> two = PointShares(Size, both.data(), Halves(), 2);
  EXPECT_NEAR(two[0], 1.0 / 3.0, 1e-12);
}

// Each part has its own holes.
TEST(TSplineModelParts, KeepTheirHoles)
{
  const auto make = [](std::int32_t segment)
  {
    TSplineModel model;
    const KnotLine line = MakeUniformKnotLine(0.0, segment, 4);
    model.Spline = MakeTensorProduct({ line, line, line }, { 1, 1, 1 }, 0);
    model.Spline.Holes = { { { 2, segment, 0 }, { 4, 4, 4 } } };
    model.Segment.assign(model.Spline.Size(), segment);
    model.Block.assign(model.Spline.Size(), 0);
    return model;
  };
  const TSplineModel both = JoinParts(make(1), make(3));
  ASSERT_EQ(Validate(both), "");
  EXPECT_EQ(BezierMesh(both.Spline).Size(), 2 * 64 - 2 * 3 * 4 - 2 * 1 * 4);
  for (const std::int32_t segment : { 1, 3 })
  {
    const TSplineModel part = SegmentPart(both, segment);
    ASSERT_EQ(part.Spline.Holes.size(), 1u);
    EXPECT_EQ(BezierMesh(part.Spline).Size(), 64 - 2 * (4 - segment) * 4);
  }
}

// Each part keeps its own map and values, in boxes of parameter space apart from each other.
TEST(TSplineModelParts, ComeApartAgainAfterTheyWereJoined)
{
  const auto make = [](int cells, double width, std::int32_t segment)
  {
    TSplineModel model;
    const KnotLine line = MakeUniformKnotLine(-1.0, width, cells);
    model.Spline = MakeTensorProduct({ line, line, line }, { 1, 1, 1 }, 1);
    for (Index i = 0; i < model.Spline.Size(); ++i)
    {
      model.Spline.ControlPoint(i)[3] = static_cast<double>(i * segment);
    }
    model.Attributes = { { "a", 1 } };
    model.Segment.assign(model.Spline.Size(), segment);
    model.Block.assign(model.Spline.Size(), segment / 2);
    return model;
  };
  const TSplineModel one = make(2, 4.0, 2), other = make(3, 7.5, 5);
  EXPECT_EQ(JoinParts(TSplineModel(), one).Spline.Size(), one.Spline.Size());
  const TSplineModel both = JoinParts(one, other);
  ASSERT_EQ(Validate(both), "");
  ASSERT_EQ(both.Spline.Size(), one.Spline.Size() + other.Spline.Size());
  EXPECT_EQ(both.Block.front(), 1);
  EXPECT_EQ(both.Block.back(), 4);
  const BezierMesh mesh(both.Spline);
  EXPECT_EQ(mesh.Size(), 8 + 27);
  const TSplineModel again = SegmentPart(both, 5);
  ASSERT_EQ(again.Spline.ControlPoints, other.Spline.ControlPoints);
  const double shift = again.Spline.KnotLines[0].front() + 1.0;
  EXPECT_GE(shift, 5.0 + 1.0 - 1.0);
  const BezierMesh ownMesh(other.Spline);
  const Evaluator own(other.Spline, ownMesh, { 0, 1, 2, 3 });
  const Evaluator joined(both.Spline, mesh, { 0, 1, 2, 3 });
  const double u[3] = { 2.3, 0.7, 5.1 }, moved[3] = { 2.3 + shift, 0.7, 5.1 };
  double a[4], b[4];
  EvaluatorOutput output;
  output.Values = a;
  ASSERT_TRUE(own.Evaluate(u, output));
  output.Values = b;
  ASSERT_TRUE(joined.Evaluate(moved, output));
  for (int c = 0; c < 4; ++c)
  {
    EXPECT_NEAR(a[c], b[c], 1e-10);
  }
}
