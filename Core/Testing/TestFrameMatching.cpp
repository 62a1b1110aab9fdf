// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
// Frames as crosses: matchings, distances, and the best place of one between others.
#include "Domain/ClosestRotation.h"
#include "Field/CrossHarmonics.h"
#include "Field/FrameSteps.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace trivariate
{
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace
{
class Frames
{
public:
  explicit Frames(unsigned seed)
    : Random(seed)
  {
  }

  Vector3d Direction()
  {
    std::normal_distribution<double> normal;
    const double x = normal(this->Random), y = normal(this->Random), z = normal(this->Random);
    return Vector3d(x, y, z).normalized();
  }
  Matrix3d Turn(double angle)
  {
    return Eigen::AngleAxisd(angle, this->Direction()).toRotationMatrix();
  }
  Matrix3d Any() { return this->Turn(2.0) * this->Turn(1.0) * this->Turn(3.0); }
  int Label() { return static_cast<int>(this->Random() % 24); }

private:
  std::mt19937 Random;
};

double QuarticSum(const FrameStar& star, const Frame& frame)
{
  double sum = 0.0;
  for (int j = 0; j < star.Count; ++j)
  {
    sum += (frame * star.Neighbours[j].transpose()).array().square().square().sum();
  }
  return sum;
}

// Neighbours within `spread` of a frame, their labels mixed up.
FrameStar MixedStar(Frames& frames, double spread, FrameStar& sorted)
{
  FrameStar star;
  star.Own = frames.Any();
  star.Count = 6;
  sorted = star;
  for (int j = 0; j < 6; ++j)
  {
    sorted.Neighbours[j] = frames.Turn(spread) * star.Own;
    star.Neighbours[j] = CubeRotations()[frames.Label()] * sorted.Neighbours[j];
  }
  return star;
}
}

//------------------------------------------------------------------------------
TEST(FrameMatching, CubeRotationsAreAGroup)
{
  EXPECT_EQ(CubeRotations()[0], Frame::Identity());
  for (int a = 0; a < 24; ++a)
  {
    EXPECT_DOUBLE_EQ(CubeRotations()[a].determinant(), 1.0);
    std::set<int> products;
    for (int b = 0; b < 24; ++b)
    {
      const int product = ComposeRotations(a, b);
      EXPECT_EQ(CubeRotations()[product], CubeRotations()[a] * CubeRotations()[b]);
      products.insert(product);
    }
    EXPECT_EQ(products.size(), 24u);
  }
}

//------------------------------------------------------------------------------
TEST(FrameMatching, FindsTheLabelsUpTo45Degrees)
{
  for (unsigned seed = 0; seed < 200; ++seed)
  {
    Frames frames(seed);
    const Frame from = frames.Any();
    const int label = frames.Label();
    // 0.78 radians are just below 45 degrees.
    const Frame to = CubeRotations()[label] * frames.Turn(0.78 * (seed % 10) / 9.0) * from;
    EXPECT_EQ(MatchFrames(from, to), label) << seed;
  }
}

//------------------------------------------------------------------------------
TEST(FrameMatching, DistanceIsThatOfTheHarmonics)
{
  for (unsigned seed = 0; seed < 100; ++seed)
  {
    Frames frames(seed);
    const Frame a = frames.Any(), b = frames.Any();
    const double distance = HarmonicDistance(a, b);
    EXPECT_NEAR((HarmonicsOf(a) - HarmonicsOf(b)).squaredNorm(), distance, 1e-12);
    EXPECT_NEAR(HarmonicDistance(a, CubeRotations()[frames.Label()] * b), distance, 1e-12);
    EXPECT_NEAR(HarmonicsOf(a).norm(), 1.0, 1e-12);
    EXPECT_NEAR(HarmonicDistance(a, frames.Turn(1e-3) * a), 20.0 / 3.0 * 1e-6, 1e-10);
    EXPECT_LT(HarmonicDistance(ClosestCross(HarmonicsOf(a)), a), 1e-7);
    const AlignedCrosses aligned(a.row(2));
    const CrossVector rest = HarmonicsOf(a) - aligned.Centre;
    EXPECT_NEAR((rest - aligned.Basis * (aligned.Basis.transpose() * rest)).norm(), 0.0, 1e-12);
    EXPECT_NEAR(rest.norm(), std::sqrt(5.0 / 12.0), 1e-12);
  }
}

//------------------------------------------------------------------------------
// A quarter turn shared out among the sides of a plaquette is a singular curve; no turn is none.
TEST(FrameMatching, PlaquetteSeesAQuarterTurn)
{
  Frames frames(1);
  const Frame base = frames.Any();
  for (const int turns : { 0, 1, -1 })
  {
    std::array<Frame, 4> around;
    for (int i = 0; i < 4; ++i)
    {
      const double angle = turns * i * std::acos(0.0) / 4.0;
      around[i] = CubeRotations()[frames.Label()] *
                  Eigen::AngleAxisd(angle, Vector3d::UnitZ()).toRotationMatrix() * base;
    }
    EXPECT_EQ(PlaquetteRotation(around) != 0, turns != 0);
  }
}

//------------------------------------------------------------------------------
TEST(FrameSteps, MeanIsThePolarFactor)
{
  for (unsigned seed = 0; seed < 200; ++seed)
  {
    Frames frames(seed);
    FrameStar star;
    star.Own = frames.Any();
    star.Count = 1 + seed % 6;
    Matrix3d sum = Matrix3d::Zero();
    for (int j = 0; j < star.Count; ++j)
    {
      star.Neighbours[j] = frames.Turn(1.3) * star.Own;
      sum += star.Neighbours[j];
    }
    const Frame best = MeanRotation(star).toRotationMatrix() * star.Own;
    EXPECT_LT((best - ClosestRotation(sum)).norm(), 1e-5) << seed;
  }
}

//------------------------------------------------------------------------------
// As long as all are within 45 degrees, mixed labels change nothing.
TEST(FrameSteps, RegistrationUndoesLabels)
{
  for (unsigned seed = 0; seed < 200; ++seed)
  {
    Frames frames(seed);
    FrameStar sorted;
    const FrameStar star = MixedStar(frames, 0.35, sorted);
    EXPECT_LT(
      (RegistrationRotation(star).toRotationMatrix() - MeanRotation(sorted).toRotationMatrix())
        .norm(),
      2e-3)
      << seed;
  }
}

//------------------------------------------------------------------------------
TEST(FrameSteps, QuarticRisesToAMaximum)
{
  for (unsigned seed = 0; seed < 200; ++seed)
  {
    Frames frames(seed);
    FrameStar sorted;
    FrameStar star = MixedStar(frames, 0.4, sorted);
    const double before = QuarticSum(star, star.Own);
    for (int i = 0; i < 4; ++i)
    {
      star.Own = QuarticRotation(star).toRotationMatrix() * star.Own;
    }
    const double reached = QuarticSum(star, star.Own);
    EXPECT_GE(reached, before);
    for (int i = 0; i < 20; ++i)
    {
      EXPECT_LT(QuarticSum(star, frames.Turn(0.02) * star.Own), reached) << seed;
    }
  }
}

//------------------------------------------------------------------------------
TEST(FrameSteps, AloneNothingChanges)
{
  FrameStar star;
  star.Own = Frames(1).Any();
  for (const Eigen::Quaterniond& q :
    { MeanRotation(star), RegistrationRotation(star), QuarticRotation(star) })
  {
    EXPECT_EQ(q.toRotationMatrix(), Frame::Identity());
  }
}
}
