// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Search/OwnAxes.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace
{
using namespace trivariate;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using Points = std::vector<Vector3d>;

Points Scattered(int count, int seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  Points points(count);
  for (Vector3d& p : points)
  {
    const double x = any(random), y = any(random);
    p = Vector3d(x + 0.3 * x * x, y + 0.4 * x * y * y, any(random) + 0.5 * x * y);
  }
  return points;
}

// With these mean squares along the axes of space, and nothing between them.
Points WithMoments(Points points, const Vector3d& squares)
{
  Vector3d middle = Vector3d::Zero();
  for (const Vector3d& p : points)
  {
    middle += p / double(points.size());
  }
  Matrix3d moment = Matrix3d::Zero();
  for (const Vector3d& p : points)
  {
    moment += (p - middle) * (p - middle).transpose() / double(points.size());
  }
  const Matrix3d whiten = Eigen::SelfAdjointEigenSolver<Matrix3d>(moment).operatorInverseSqrt();
  for (Vector3d& p : points)
  {
    p = squares.cwiseSqrt().asDiagonal() * whiten * (p - middle);
  }
  return points;
}

Points Turned(const Points& points, int seed)
{
  const Matrix3d turn = Eigen::Quaterniond(Scattered(1, seed)[0].x(), 0.3, 0.1 * seed - 0.4, 0.5)
                          .normalized()
                          .toRotationMatrix();
  Points turned;
  for (const Vector3d& p : points)
  {
    turned.push_back(turn * p + Vector3d(3.0, -1.0, 0.5 * seed));
  }
  return turned;
}

// In the frame of their own axes; in order of their coordinates, to 1e-6, if asked for.
Points Posed(const Points& points, bool sorted)
{
  const std::vector<double> weights(points.size(), 1.0);
  const std::optional<OwnAxes> own = FindOwnAxes(weights, points);
  EXPECT_TRUE(own);
  Vector3d middle = Vector3d::Zero();
  for (const Vector3d& p : points)
  {
    middle += p / double(points.size());
  }
  Points posed;
  for (const Vector3d& p : points)
  {
    posed.push_back(own->Frame * (p - middle));
  }
  if (sorted)
  {
    const auto rounded = [](const Vector3d& p) { return (1e6 * p).array().round().matrix(); };
    std::sort(posed.begin(), posed.end(),
      [&](const Vector3d& a, const Vector3d& b)
      {
        const Vector3d x = rounded(a), y = rounded(b);
        return std::lexicographical_compare(x.begin(), x.end(), y.begin(), y.end());
      });
  }
  return posed;
}

void ExpectSamePose(const Points& points, double tolerance, bool sorted = false)
{
  const Points still = Posed(points, sorted);
  for (int seed = 1; seed < 9; ++seed)
  {
    const Points moved = Posed(Turned(points, seed), sorted);
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      ASSERT_LT((moved[i] - still[i]).norm(), tolerance) << seed;
    }
  }
}

TEST(OwnAxes, TurnWithThePointsAlsoWhereMomentsAreEqual)
{
  const Points points = Scattered(300, 7);
  for (const auto& [squares, principal] :
    { std::pair(Vector3d(1, 2, 3), true), std::pair(Vector3d(1, 1, 3), false),
      std::pair(Vector3d(1, 3, 3), false), std::pair(Vector3d(2, 2, 2), false),
      std::pair(Vector3d(2, 2.00001, 3), false), std::pair(Vector3d(2, 2.001, 3), true) })
  {
    SCOPED_TRACE(squares.transpose());
    const Points scaled = WithMoments(points, squares);
    EXPECT_EQ(FindOwnAxes(std::vector<double>(300, 1.0), scaled)->ArePrincipal, principal);
    ExpectSamePose(scaled, 1e-9);
  }
}

TEST(OwnAxes, CountAPointAsOftenAsItWeighs)
{
  for (const Vector3d& squares : { Vector3d(1, 2, 3), Vector3d(1, 1, 3), Vector3d(2, 2, 2) })
  {
    SCOPED_TRACE(squares.transpose());
    // Moments are equal where each point counts as often as it is there.
    Points all = Scattered(100, 3);
    for (int i = 0; i < 100; ++i)
    {
      all.insert(all.end(), i % 4, Points(all)[i]);
    }
    all = WithMoments(all, squares);
    const Points once(all.begin(), all.begin() + 100);
    std::vector<double> weights;
    for (int i = 0; i < 100; ++i)
    {
      weights.push_back(0.1 * (1 + i % 4)); // the unit does not matter
    }
    const std::optional<OwnAxes> weighted = FindOwnAxes(weights, once);
    const std::optional<OwnAxes> repeated = FindOwnAxes(std::vector<double>(all.size(), 1.0), all);
    ASSERT_TRUE(weighted && repeated);
    EXPECT_LT((weighted->Frame - repeated->Frame).norm(), 1e-9);
    EXPECT_NEAR(weighted->Frame.determinant(), 1.0, 1e-12);
  }
}

// Third moments are zero along all axes of an S, which is not the same from both sides.
TEST(OwnAxes, TellTheSidesOfAnS)
{
  Points points;
  for (int i = 0; i <= 200; ++i)
  {
    const double t = 0.01 * i - 1.0;
    points.emplace_back(3.0 * t, std::sin(4.0 * t), 0.0);
  }
  ExpectSamePose(points, 1e-6, true);
}

TEST(OwnAxes, LeaveSymmetricFiguresTheSame)
{
  Points square, cube;
  for (int i = 0; i < 8; ++i)
  {
    const Vector3d p(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
    cube.push_back(p);
    square.emplace_back(p.x(), p.y(), 0.1 * p.z());
  }
  ExpectSamePose(square, 1e-6, true);
  ExpectSamePose(cube, 1e-6, true);
}

// Harmonics of order 3 to 8 are told from round, those of order 9 are not.
TEST(OwnAxes, AreOfPrismsOfUpToEightSides)
{
  for (int sides = 3; sides <= 9; ++sides)
  {
    SCOPED_TRACE(sides);
    Points prism;
    for (int i = 0; i < 2 * sides; ++i)
    {
      const double angle = 2.0 * std::acos(-1.0) * (i / 2) / sides;
      prism.emplace_back(std::cos(angle), std::sin(angle), i % 2 ? 2.0 : -2.0);
    }
    if (sides == 9)
    {
      EXPECT_FALSE(FindOwnAxes(std::vector<double>(prism.size(), 1.0), prism));
    }
    else
    {
      ExpectSamePose(prism, 1e-6, true);
    }
  }
}

TEST(OwnAxes, AreNoneOfWhatIsRound)
{
  Points cylinder, corners;
  for (int i = 0; i < 40; ++i)
  {
    const double angle = 0.05 * std::acos(-1.0) * i;
    cylinder.emplace_back(std::cos(angle), std::sin(angle), i % 2 ? 2.0 : -2.0);
    cylinder.emplace_back(std::cos(angle), std::sin(angle), i % 2 ? -2.0 : 2.0);
  }
  EXPECT_FALSE(FindOwnAxes(std::vector<double>(80, 1.0), cylinder));
  const double golden = 0.5 + std::sqrt(1.25); // an icosahedron has the fourth moments of a ball
  for (int i = 0; i < 4; ++i)
  {
    const double a = i & 1 ? 1.0 : -1.0, b = i & 2 ? golden : -golden;
    corners.insert(corners.end(), { { 0, a, b }, { a, b, 0 }, { b, 0, a } });
  }
  EXPECT_FALSE(FindOwnAxes(std::vector<double>(12, 1.0), corners));
}
}
