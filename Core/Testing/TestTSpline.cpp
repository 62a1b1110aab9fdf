// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "TSpline/TSpline.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace trivariate;

namespace
{
TSpline SmallSpline()
{
  const std::array<KnotLine, 3> lines = { MakeUniformKnotLine(0, 7, 8),
    MakeUniformKnotLine(-1, 1, 4), MakeUniformKnotLine(0, 1, 2) };
  return MakeTensorProduct(lines, { 2, 1, 2 }, 1);
}
}

TEST(TSpline, TensorProductIsSoundAndSumsToOne)
{
  const TSpline spline = SmallSpline();
  EXPECT_EQ(Validate(spline), "");
  EXPECT_EQ(spline.Size(), 7 * 7 * 4);
  const std::array<double, 3> at = { 2.3, -0.4, 0.9 };
  double sum = 0.0;
  std::array<double, 3> position = {};
  for (Index i = 0; i < spline.Size(); ++i)
  {
    double b = spline.Weights[i];
    for (int a = 0; a < 3; ++a)
    {
      b *= EvaluateBSpline(spline.LocalKnotValues(i, a), at[a])[0];
    }
    sum += b;
    for (int a = 0; a < 3; ++a)
    {
      position[a] += b * spline.ControlPoint(i)[a];
    }
  }
  EXPECT_NEAR(sum, 1.0, 1e-14);
  for (int a = 0; a < 3; ++a)
  {
    EXPECT_NEAR(position[a], at[a], 1e-14);
  }
}

TEST(TSpline, ValidateNamesTheFault)
{
  TSpline spline = SmallSpline();
  spline.Weights[5] = -1.0;
  EXPECT_NE(Validate(spline), "");
  spline = SmallSpline();
  spline.ControlPoints[3] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(Validate(spline), "");
  spline = SmallSpline();
  spline.Functions[2][1][4] = 1000;
  EXPECT_NE(Validate(spline), "");
  spline = SmallSpline();
  spline.ControlPoints.pop_back();
  EXPECT_NE(Validate(spline), "");
}
