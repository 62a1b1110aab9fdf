// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "RandomRefinement.h"
#include "Shapes.h"
#include "TSpline/InverseMap.h"
#include "ThreadedExecution.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

using namespace trivariate;

namespace
{
// Every point of the spline's geometry comes back to its parameters.
void ExpectRoundTrip(const TSpline& spline, std::mt19937& random, int points, double tolerance)
{
  const BezierMesh mesh(spline);
  const Evaluator geometry(spline, mesh, { 0, 1, 2 });
  const InverseMap inverse(spline, mesh);
  EXPECT_FALSE(inverse.Affine());
  for (int n = 0; n < points; ++n)
  {
    Point u = RandomPoint(spline, random);
    if (n % 10 == 0) // also on the boundary and its edges
    {
      const int a = n / 10 % 3;
      u[a] = spline.KnotLines[a].back();
      u[(a + 1) % 3] = spline.KnotLines[(a + 1) % 3].front();
    }
    Point x, found;
    ASSERT_TRUE(geometry.Evaluate(u.data(), { x.data() }));
    ASSERT_TRUE(inverse.Find(x.data(), found.data())) << x[0] << ' ' << x[1] << ' ' << x[2];
    for (int a = 0; a < 3; ++a)
    {
      ASSERT_NEAR(found[a], u[a], tolerance);
    }
    // From anywhere else, too.
    found = RandomPoint(spline, random);
    ASSERT_TRUE(inverse.FindNearestFrom(x.data(), found.data()));
    for (int a = 0; a < 3; ++a)
    {
      ASSERT_NEAR(found[a], u[a], tolerance);
    }
  }
}

using Path = double[4][2]; // control points

// One cell bent along a path has local minima of the distance: none is taken that is farther away
// than a lattice of points of the cell. `place` gives the control point over a point of the path,
// at a share of the cell's thickness.
void ExpectNearestOfBentCell(const Path& path, Point (*place)(const double at[2], double share),
  const Point& low, const Point& high)
{
  std::array<KnotLine, 3> lines;
  lines.fill(MakeUniformKnotLine(0.0, 1.0, 1));
  TSpline spline = MakeTensorProduct(lines, { 1, 1, 1 }, 0);
  ASSERT_EQ(spline.Size(), 64);
  for (Index i = 0; i < 64; ++i)
  {
    std::array<int, 3> at; // which of the four functions along each axis
    for (int a = 0; a < 3; ++a)
    {
      const auto& knots = spline.Functions[i][a];
      at[a] = knots[1] + knots[2] + knots[3];
    }
    const Point p = place(path[at[0]], at[1] / 3.0);
    std::copy(p.begin(), p.end(), spline.ControlPoint(i));
    spline.ControlPoint(i)[2] = at[2] / 3.0;
  }
  const BezierMesh mesh(spline);
  const Evaluator geometry(spline, mesh, { 0, 1, 2 });
  const InverseMap inverse(spline, mesh);
  std::vector<Point> lattice;
  for (int m = 0; m < 21 * 21 * 21; ++m)
  {
    const Point u = { m % 21 / 20.0, m / 21 % 21 / 20.0, m / 441 / 20.0 };
    lattice.emplace_back();
    ASSERT_TRUE(geometry.Evaluate(u.data(), { lattice.back().data() }));
  }
  std::mt19937 random(5);
  for (int n = 0; n < 300; ++n)
  {
    const Point x = { Random(random, low[0], high[0]), Random(random, low[1], high[1]),
      Random(random, low[2], high[2]) };
    const auto distance = [&x](const Point& y)
    { return std::hypot(x[0] - y[0], x[1] - y[1], x[2] - y[2]); };
    double least = std::numeric_limits<double>::max();
    for (const Point& y : lattice)
    {
      least = std::min(least, distance(y));
    }
    Point u, y;
    ASSERT_TRUE(inverse.FindNearest(x.data(), std::numeric_limits<double>::infinity(), u.data()));
    ASSERT_TRUE(geometry.Evaluate(u.data(), { y.data() }));
    ASSERT_LE(distance(y), least + 1e-9) << x[0] << ' ' << x[1] << ' ' << x[2];
    // From anywhere, too.
    u = RandomPoint(spline, random);
    const bool isInside = inverse.FindNearestFrom(x.data(), u.data());
    ASSERT_TRUE(geometry.Evaluate(u.data(), { y.data() }));
    ASSERT_LE(distance(y), 1.001 * least + 1e-9) << x[0] << ' ' << x[1] << ' ' << x[2];
    ASSERT_EQ(isInside, distance(y) < 1e-8);
  }
}
}

TEST(InverseMap, RoundTripOnTheAnnulus)
{
  for (unsigned seed = 0; seed < 4; ++seed)
  {
    std::mt19937 random(seed);
    TSpline spline = QuarterAnnulus(8);
    const auto rule = MakeKnotInsertionRule(spline);
    for (unsigned round = 0; round < seed; ++round)
    {
      rule->Refine(spline, RandomMarks(spline, 4, random));
    }
    ExpectRoundTrip(spline, random, 500, 1e-12);
  }
}

TEST(InverseMap, RoundTripOnTwistedBars)
{
  const double pi = std::acos(-1.0);
  for (const double turn : { 0.5 * pi, pi, 2.0 * pi })
  {
    std::mt19937 random(1);
    TSpline spline = RandomTensorProduct({ 2, 2, 4 }, { 2, 2, 2 }, random);
    TwistAndBend(spline, turn, 0.7);
    const auto rule = MakeKnotInsertionRule(spline);
    rule->Refine(spline, RandomMarks(spline, 6, random));
    ExpectRoundTrip(spline, random, 500, 1e-10);
  }
}

TEST(InverseMap, OutsideIsNotFound)
{
  std::mt19937 random(3);
  const TSpline spline = QuarterAnnulus(4);
  const BezierMesh mesh(spline);
  const InverseMap inverse(spline, mesh);
  int inside = 0, outside = 0;
  for (int n = 0; n < 3000; ++n)
  {
    const Point x = { Random(random, -0.5, 2.5), Random(random, -0.5, 2.5),
      Random(random, -0.2, 1.2) };
    const double radius = std::hypot(x[0], x[1]);
    const bool expected =
      x[0] >= 0.0 && x[1] >= 0.0 && x[2] >= 0.0 && x[2] <= 1.0 && radius >= 1.0 && radius <= 2.0;
    Point u = { 7.0, 7.0, 7.0 };
    ASSERT_EQ(inverse.Find(x.data(), u.data()), expected);
    ASSERT_EQ(u[0] == 7.0, !expected);
    (expected ? inside : outside) += 1;
  }
  EXPECT_GT(inside, 500);
  EXPECT_GT(outside, 500);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Point bad = { nan, 1.0, 0.5 };
  Point u;
  EXPECT_FALSE(inverse.Find(bad.data(), u.data()));
}

// Off the annulus, as far as the reach: the distance of the point that is found is the true one.
TEST(InverseMap, NearestPointsAreFoundWithinReach)
{
  constexpr double reach = 0.35;
  std::mt19937 random(4);
  TSpline spline = QuarterAnnulus(8);
  const auto rule = MakeKnotInsertionRule(spline);
  rule->Refine(spline, RandomMarks(spline, 4, random));
  rule->Refine(spline, RandomMarks(spline, 4, random));
  const BezierMesh mesh(spline);
  const Evaluator geometry(spline, mesh, { 0, 1, 2 });
  const InverseMap inverse(spline, mesh);
  int inside = 0, near = 0, far = 0;
  for (int n = 0; n < 2000; ++n)
  {
    const Point x = { Random(random, 0.0, 2.5), Random(random, 0.0, 2.5),
      Random(random, -0.5, 1.5) };
    const double radius = std::hypot(x[0], x[1]);
    const double distance = std::hypot(
      std::max({ 1.0 - radius, radius - 2.0, 0.0 }), std::max({ -x[2], x[2] - 1.0, 0.0 }));
    if (std::abs(distance - reach) < 1e-6)
    {
      continue;
    }
    Point u = { 7.0, 7.0, 7.0 }, image;
    ASSERT_EQ(inverse.FindNearest(x.data(), reach, u.data()), distance < reach);
    if (distance > reach)
    {
      ASSERT_EQ(u[0], 7.0);
      ++far;
      continue;
    }
    ASSERT_TRUE(geometry.Evaluate(u.data(), { image.data() }));
    ASSERT_NEAR(std::hypot(image[0] - x[0], image[1] - x[1], image[2] - x[2]), distance, 1e-6);
    (distance > 0.0 ? near : inside) += 1;
  }
  EXPECT_GT(inside, 300);
  EXPECT_GT(near, 300);
  EXPECT_GT(far, 300);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Point bad = { nan, 1.0, 0.5 };
  Point u;
  EXPECT_FALSE(inverse.FindNearest(bad.data(), reach, u.data()));
}

TEST(InverseMap, NearestPointOfAHorseshoeIsTheNearest)
{
  ExpectNearestOfBentCell({ { -1.0, 1.0 }, { -1.5, -2.0 }, { 1.5, -2.0 }, { 1.0, 1.0 } },
    [](const double at[2], double share)
    {
      const double wide = 1.0 + 0.3 * share;
      return Point{ wide * at[0], wide * at[1], 0.0 };
    },
    { -2.5, -3.0, -1.0 }, { 2.5, 2.5, 2.0 });
}

// Many starts are not enough here: descents end in the wrong limb of the N.
TEST(InverseMap, NearestPointOfASteepNIsTheNearest)
{
  ExpectNearestOfBentCell({ { 0.0, 0.0 }, { 1.0, 6.0 }, { 2.0, -6.0 }, { 3.0, 0.0 } },
    [](const double at[2], double share) {
      return Point{ at[0], at[1] + 0.2 * share, 0.0 };
    },
    { -1.0, -3.0, -1.0 }, { 4.0, 3.0, 2.0 });
}

TEST(InverseMap, IdentityIsExact)
{
  std::mt19937 random(4);
  TSpline spline = RandomTensorProduct({ 3, 3, 3 }, { 3, 3, 3 }, random);
  const auto rule = MakeKnotInsertionRule(spline);
  for (int round = 0; round < 4; ++round)
  {
    rule->Refine(spline, RandomMarks(spline, 8, random));
  }
  const BezierMesh mesh(spline);
  const InverseMap inverse(spline, mesh);
  ASSERT_TRUE(inverse.Affine());
  for (int n = 0; n < 200; ++n)
  {
    const Point x = RandomPoint(spline, random);
    Point u;
    ASSERT_TRUE(inverse.Find(x.data(), u.data()));
    ASSERT_EQ(u, x);
  }
  // Outside by no more than rounding is the boundary.
  Point x = { spline.KnotLines[0].back() + 1e-13, spline.KnotLines[1].front(),
    spline.KnotLines[2].front() - 1e-13 };
  Point u;
  ASSERT_TRUE(inverse.Find(x.data(), u.data()));
  EXPECT_EQ(u[0], spline.KnotLines[0].back());
  EXPECT_EQ(u[2], spline.KnotLines[2].front());
  x[0] += 1e-6;
  EXPECT_FALSE(inverse.Find(x.data(), u.data()));
}

TEST(InverseMap, AffineGeometryIsDetected)
{
  std::mt19937 random(6);
  TSpline spline = RandomTensorProduct({ 2, 2, 2 }, { 3, 3, 3 }, random);
  const auto rule = MakeKnotInsertionRule(spline);
  rule->Refine(spline, RandomMarks(spline, 8, random));
  for (Index i = 0; i < spline.Size(); ++i)
  {
    double* p = spline.ControlPoint(i);
    const Point u = { p[0], p[1], p[2] };
    p[0] = 10.0 + 2.0 * u[0] + 0.3 * u[1];
    p[1] = -4.0 + 0.5 * u[1] - 0.1 * u[2];
    p[2] = 0.2 * u[0] + 3.0 * u[2];
  }
  const BezierMesh mesh(spline);
  const InverseMap inverse(spline, mesh);
  ASSERT_TRUE(inverse.Affine());
  for (int n = 0; n < 200; ++n)
  {
    const Point u = RandomPoint(spline, random);
    const Point x = { 10.0 + 2.0 * u[0] + 0.3 * u[1], -4.0 + 0.5 * u[1] - 0.1 * u[2],
      0.2 * u[0] + 3.0 * u[2] };
    Point found;
    ASSERT_TRUE(inverse.Find(x.data(), found.data()));
    for (int a = 0; a < 3; ++a)
    {
      ASSERT_NEAR(found[a], u[a], 1e-12 * 30.0);
    }
  }

  // One control point moved: no longer affine, and still inverted.
  spline.ControlPoint(spline.Size() / 2)[1] += 1e-3;
  EXPECT_FALSE(InverseMap(spline, mesh).Affine());
  ExpectRoundTrip(spline, random, 100, 1e-10);
}

TEST(InverseMap, FlatGeometryIsNotAffineAndHasNoInverse)
{
  std::mt19937 random(6);
  TSpline spline = RandomTensorProduct({ 2, 2, 2 }, { 0, 0, 0 }, random);
  for (Index i = 0; i < spline.Size(); ++i)
  {
    spline.ControlPoint(i)[2] = 0.0;
  }
  const BezierMesh mesh(spline);
  const InverseMap inverse(spline, mesh);
  EXPECT_FALSE(inverse.Affine());
  const Point x = { 1e9, 0.0, 0.0 };
  Point u;
  EXPECT_FALSE(inverse.Find(x.data(), u.data()));
}

TEST(InverseMap, IsTheSameForAnyThreads)
{
  std::mt19937 random(8);
  TSpline spline = RandomTensorProduct({ 2, 2, 3 }, { 2, 2, 2 }, random);
  TwistAndBend(spline, 2.0, 0.5);
  const BezierMesh mesh(spline);
  const InverseMap inverse(spline, mesh);
  const InverseMap threaded(spline, mesh, ThreadedExecution(3));
  const Index n = 2000;
  std::vector<double> points;
  for (Index i = 0; i < n; ++i)
  {
    points.insert(points.end(),
      { Random(random, -1.5, 2.0), Random(random, -1.5, 1.5), Random(random, 0.0, 4.0) });
  }
  std::vector<double> one(3 * n), many(3 * n);
  std::vector<std::uint8_t> foundOne(n), foundMany(n);
  inverse.Find(n, points.data(), one.data(), foundOne.data());
  threaded.Find(n, points.data(), many.data(), foundMany.data(), ThreadedExecution(4));
  EXPECT_EQ(one, many);
  EXPECT_EQ(foundOne, foundMany);
  EXPECT_GT(std::count(foundOne.begin(), foundOne.end(), 1), n / 10);
}

TEST(InverseMap, RefusesEmptySplines)
{
  TSpline spline;
  spline.Components = 3;
  spline.KnotLines.fill({ 0.0, 1.0 });
  const BezierMesh mesh(spline);
  EXPECT_THROW(InverseMap(spline, mesh), std::invalid_argument);
}
