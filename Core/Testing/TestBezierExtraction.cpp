// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "RandomRefinement.h"
#include "TSpline/BezierExtraction.h"
#include "TSpline/BezierMesh.h"
#include "ThreadedExecution.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

using namespace trivariate;

TEST(BezierExtraction, ReproducesTheSpline)
{
  for (unsigned seed = 0; seed < 12; ++seed)
  {
    std::mt19937 random(seed);
    TSpline spline = RandomRefined(random, 6);
    for (double& weight : spline.Weights)
    {
      weight *= seed % 2 ? Random(random, 0.2, 5.0) : 1.0;
    }
    const BezierMesh mesh(spline);
    const auto bezier = ExtractBezier(spline, mesh, { 4, Denominator, 0, 3 });
    ASSERT_EQ(bezier.size(), static_cast<std::size_t>(mesh.Size()) * 4 * 64);
    for (int n = 0; n < 300; ++n)
    {
      const Point x = RandomPoint(spline, random);
      const Index cell = mesh.FindCell(x[0], x[1], x[2]);
      const auto bounds = mesh.Bounds(cell);
      std::array<std::array<double, 4>, 3> b;
      for (int a = 0; a < 3; ++a)
      {
        b[a] = Bernstein((x[a] - bounds[2 * a]) / (bounds[2 * a + 1] - bounds[2 * a]));
      }
      std::array<double, 4> sums{};
      for (int m = 0; m < 256; ++m)
      {
        sums[m / 64] += bezier[cell * 256 + m] * b[0][m % 4] * b[1][m / 4 % 4] * b[2][m / 16 % 4];
      }
      const auto direct = HomogeneousValue(spline, x);
      EXPECT_NEAR(sums[0], direct[4], 1e-12);
      EXPECT_NEAR(sums[1], direct[5], 1e-12);
      EXPECT_NEAR(sums[2], direct[0], 1e-11); // X is up to ten times as large
      EXPECT_NEAR(sums[3], direct[3], 1e-12);
    }
  }
}

TEST(BezierExtraction, DenominatorOfRefinedSplinesIsOne)
{
  for (unsigned seed = 0; seed < 10; ++seed)
  {
    std::mt19937 random(seed);
    const TSpline spline = RandomRefined(random, 8);
    for (const double d : ExtractBezier(spline, BezierMesh(spline), { Denominator }))
    {
      ASSERT_NEAR(d, 1.0, 1e-12);
    }
  }
}

TEST(BezierExtraction, IsTheSameForAnyThreads)
{
  std::mt19937 random(7);
  const TSpline spline = RandomRefined(random, 8);
  const BezierMesh mesh(spline);
  const BezierMesh threaded(spline, ThreadedExecution(3));
  ASSERT_EQ(mesh.Size(), threaded.Size());
  for (Index cell = 0; cell < mesh.Size(); ++cell)
  {
    const IdRange a = mesh.ActiveFunctions(cell), b = threaded.ActiveFunctions(cell);
    ASSERT_TRUE(std::equal(a.begin(), a.end(), b.begin(), b.end()));
  }
  EXPECT_EQ(ExtractBezier(spline, mesh, { 3, 4 }),
    ExtractBezier(spline, threaded, { 3, 4 }, ThreadedExecution(4)));
}

TEST(BezierExtraction, RefusesUnknownComponents)
{
  std::mt19937 random(1);
  const TSpline spline = RandomTensorProduct({ 1, 1, 1 }, { 0, 0, 0 }, random);
  const BezierMesh mesh(spline);
  EXPECT_THROW(ExtractBezier(spline, mesh, { 5 }), std::invalid_argument);
  EXPECT_THROW(ExtractBezier(spline, mesh, { -2 }), std::invalid_argument);
}
