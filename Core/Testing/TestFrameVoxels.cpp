// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
// The levels of a segment's voxels and what constraints on them come to.
#include "Field/FrameStart.h"
#include "FrameShapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace trivariate
{
//------------------------------------------------------------------------------
TEST(FrameVoxels, LevelsKeepNeighbours)
{
  const std::vector<FrameLevel> levels = LevelsOf(RoundBall(28), true);
  ASSERT_GE(levels.size(), 2u);
  for (const FrameLevel& level : levels)
  {
    const FrameVoxels& voxels = level.Voxels;
    for (Index v = 0; v < voxels.Count(); ++v)
    {
      const std::array<Index, 3> p = voxels.Place(v);
      EXPECT_EQ((p[0] + p[1] + p[2]) % 2, v < voxels.Red ? 0 : 1);
      for (int side = 0; side < 6; ++side)
      {
        const std::int32_t n = voxels.Neighbours[v][side];
        if (n >= 0)
        {
          std::array<Index, 3> q = voxels.Place(n);
          q[side / 2] += side % 2 ? -1 : 1;
          EXPECT_EQ(p, q);
          EXPECT_EQ(voxels.Neighbours[n][side ^ 1], v);
        }
      }
    }
  }
  const FrameLevel& fine = levels[0];
  for (Index v = 0; v < fine.Voxels.Count(); ++v)
  {
    const std::array<Index, 3> p = fine.Voxels.Place(v),
                               q = levels[1].Voxels.Place(fine.Parents[v]);
    EXPECT_EQ(q, (std::array<Index, 3>{ p[0] / 2, p[1] / 2, p[2] / 2 }));
  }
}

//------------------------------------------------------------------------------
// Two sheets in one coarse voxel's reach do not become neighbours unless they were.
TEST(FrameVoxels, ACutStaysACut)
{
  std::vector<std::uint8_t> mask(16 * 16 * 16, 1);
  for (int i = 0; i < 16 * 16 * 16; ++i)
  {
    const int y = i / 16 % 16, x = i % 16;
    // A gap one voxel wide between x = 7 and x = 9 that no coarse voxel is empty for.
    mask[i] = x == 8 || (x == 9 && y % 2) ? 0 : 1;
  }
  const std::vector<FrameLevel> levels =
    MakeFrameLevels(CollectVoxels({ 16, 16, 16 }, mask.data()), {}, 100);
  ASSERT_EQ(levels.size(), 2u);
  const FrameVoxels& coarse = levels[1].Voxels;
  EXPECT_EQ(coarse.Count(), 512);
  for (Index v = 0; v < coarse.Count(); ++v)
  {
    if (coarse.Place(v)[0] == 3)
    {
      EXPECT_EQ(coarse.Neighbours[v][1], -1);
    }
  }
}

//------------------------------------------------------------------------------
TEST(FrameVoxels, TwoAxesFixTheFrame)
{
  const std::uint8_t mask[8] = { 1, 1, 1, 1, 1, 1, 1, 1 };
  const FrameVoxels voxels = CollectVoxels({ 2, 2, 2 }, mask);
  const float c = std::cos(0.1f), s = std::sin(0.1f);
  // Normals 0.2 more than a right angle apart: each is missed by 0.1.
  std::vector<FrameLevel> levels =
    MakeFrameLevels(voxels, { { 3, { c, -s, 0 }, 1 }, { 3, { s, -c, 0 }, 2 } });
  ASSERT_EQ(levels[0].Bounds.size(), 1u);
  EXPECT_EQ(levels[0].Bounds[0].What, FrameBound::Kind::Fixed);
  FrameList frames(8, Eigen::Quaternionf::UnitRandom());
  ApplyBounds(levels[0], frames);
  EXPECT_LT((frames[3].toRotationMatrix() - Eigen::Matrix3f::Identity()).norm(), 1e-6f);
  // Normals that nearly agree: the middle of the axes goes there.
  levels = MakeFrameLevels(voxels, { { 3, { c, -s, 0 }, 1 }, { 3, { c, s, 0 }, 3 } });
  EXPECT_EQ(levels[0].Bounds[0].What, FrameBound::Kind::Axis);
  ApplyBounds(levels[0], frames);
  const Eigen::Vector3f there = frames[3] * Eigen::Vector3f::UnitX();
  EXPECT_LT((there - Eigen::Vector3f(1, 1, 0).normalized()).norm(), 1e-6f);
  // Open axes: any of the labels, along both normals.
  levels = MakeFrameLevels(voxels, { { 3, { 1, 0, 0 } }, { 3, { 0, 0, -1 } } });
  EXPECT_EQ(levels[0].Bounds[0].What, FrameBound::Kind::Fixed);
  ApplyBounds(levels[0], frames);
  EXPECT_NEAR(
    HarmonicDistance(frames[3].cast<double>().toRotationMatrix(), Frame::Identity()), 0.0, 1e-5);
}

//------------------------------------------------------------------------------
TEST(FrameVoxels, BadConstraintsAreNamed)
{
  const std::uint8_t mask[8] = { 1, 1, 1, 1, 1, 1, 1, 0 };
  const FrameVoxels voxels = CollectVoxels({ 2, 2, 2 }, mask);
  EXPECT_EQ(voxels.Count(), 7);
  EXPECT_THROW(MakeFrameLevels(voxels, { { 7, { 1, 0, 0 }, 1 } }), std::invalid_argument);
  EXPECT_THROW(MakeFrameLevels(voxels, { { 0, { 0, 0, 0 }, 1 } }), std::invalid_argument);
  EXPECT_THROW(MakeFrameLevels(voxels, { { 0, { NAN, 0, 0 }, 1 } }), std::invalid_argument);
  EXPECT_THROW(MakeFrameLevels(voxels, { { 0, { 1, 0, 0 }, 6 } }), std::invalid_argument);
  const std::vector<FrameLevel> levels = MakeFrameLevels(voxels, { { 0, { 1, 0, 0 }, 1 } });
  EXPECT_THROW(HarmonicCoordinateFrames(levels, 0, Execution()), std::invalid_argument);
  const std::uint8_t none[8] = {};
  const std::vector<FrameLevel> empty = MakeFrameLevels(CollectVoxels({ 2, 2, 2 }, none), {});
  EXPECT_EQ(empty.size(), 1u);
}
}
