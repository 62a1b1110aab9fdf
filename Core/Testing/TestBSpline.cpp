// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "TSpline/BSpline.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

using namespace trivariate;

namespace
{
// Five ordered random knots, some of them repeated.
Knots5 RandomKnots(std::mt19937& random)
{
  std::uniform_int_distribution<int> knot(0, 8);
  Knots5 t;
  do
  {
    std::generate(t.begin(), t.end(), [&random, &knot]() { return 0.5 * knot(random); });
    std::sort(t.begin(), t.end());
  } while (t[0] == t[4]);
  return t;
}

double FromBernstein(const std::array<double, 4>& c, double s)
{
  const std::array<double, 4> b = Bernstein(s);
  return c[0] * b[0] + c[1] * b[1] + c[2] * b[2] + c[3] * b[3];
}
}

TEST(BSpline, UniformValuesAreTheKnownSixths)
{
  const Knots5 t = { 0, 1, 2, 3, 4 };
  EXPECT_NEAR(EvaluateBSpline(t, 1.0)[0], 1.0 / 6.0, 1e-15);
  EXPECT_NEAR(EvaluateBSpline(t, 2.0)[0], 4.0 / 6.0, 1e-15);
  EXPECT_NEAR(EvaluateBSpline(t, 3.0)[0], 1.0 / 6.0, 1e-15);
  EXPECT_NEAR(EvaluateBSpline(t, 1.0)[1], 0.5, 1e-15);
  EXPECT_NEAR(EvaluateBSpline(t, 2.0)[2], -2.0, 1e-15);
}

TEST(BSpline, KnotInsertionChangesNothing)
{
  for (unsigned seed = 0; seed < 200; ++seed)
  {
    std::mt19937 random(seed);
    const Knots5 t = RandomKnots(random);
    std::uniform_real_distribution<double> inside(t[0], t[4]);
    const double x = inside(random);
    const KnotInsertion factors = InsertKnot(t, x);
    std::array<double, 6> all = { t[0], t[1], t[2], t[3], t[4], x };
    std::sort(all.begin(), all.end());
    const Knots5 left = { all[0], all[1], all[2], all[3], all[4] };
    const Knots5 right = { all[1], all[2], all[3], all[4], all[5] };
    for (int i = 0; i < 20; ++i)
    {
      const double at = inside(random);
      const double split = factors.First * EvaluateBSpline(left, at)[0] +
                           factors.Second * EvaluateBSpline(right, at)[0];
      ASSERT_NEAR(split, EvaluateBSpline(t, at)[0], 1e-12) << "seed " << seed;
    }
  }
}

TEST(BSpline, BernsteinCoefficientsReproduceTheFunction)
{
  for (unsigned seed = 0; seed < 200; ++seed)
  {
    std::mt19937 random(seed);
    const Knots5 t = RandomKnots(random);
    for (int span = 0; span < 4; ++span)
    {
      if (t[span] == t[span + 1])
      {
        continue;
      }
      const double a = t[span] + 0.25 * (t[span + 1] - t[span]);
      const double b = t[span + 1];
      const std::array<double, 4> c = BernsteinOfBSpline(t, a, b);
      for (double s = 0.1; s < 1.0; s += 0.2)
      {
        ASSERT_NEAR(FromBernstein(c, s), EvaluateBSpline(t, a + s * (b - a))[0], 1e-12)
          << "seed " << seed;
      }
      ASSERT_NEAR(DualFunctional(t, c, a, b), 1.0, 1e-9) << "seed " << seed;
    }
  }
}
