// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "BlockShapes.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace
{
using namespace trivariate;

constexpr std::array<int, 4> FaceCornersS{ 0, 1, 0, 1 }, FaceCornersT{ 0, 0, 1, 1 };

// Every glued face has the same point where its twin's map says, and is its twin's twin.
void ExpectTwinsToMatch(const BlockComplex& complex)
{
  for (Index b = 0; b < complex.Size(); ++b)
  {
    for (int f = 0; f < 6; ++f)
    {
      const BlockFace face{ b, f / 2, f % 2 };
      const FaceTwin& twin = complex.Twin(face);
      if (!twin.Exists())
      {
        continue;
      }
      const auto own = complex.FacePoints(face), other = complex.FacePoints(twin.Face);
      for (int corner = 0; corner < 4; ++corner)
      {
        const auto st = twin.Map<int>({ FaceCornersS[corner], FaceCornersT[corner] }, 1);
        EXPECT_EQ(own[corner], other[st[0] + 2 * st[1]]);
      }
      const FaceTwin& back = complex.Twin(twin.Face);
      EXPECT_EQ(back.Face.Block, b);
      EXPECT_EQ(2 * back.Face.Axis + back.Face.Side, f);
      const auto there = twin.Map<double>({ 0.2, 0.7 }, 1.0);
      const auto again = back.Map<double>(there, 1.0);
      EXPECT_NEAR(again[0], 0.2, 1e-15);
      EXPECT_NEAR(again[1], 0.7, 1e-15);
    }
  }
}

// Groups are at least one unit apart in some direction, blocks of a group do not overlap.
void ExpectGroupsApart(const BlockComplex& complex)
{
  for (Index b = 0; b < complex.Size(); ++b)
  {
    for (Index c = 0; c < b; ++c)
    {
      int distance = 0;
      for (int a = 0; a < 3; ++a)
      {
        EXPECT_GE(complex.Origins[b][a], 0);
        distance = std::max(distance, std::abs(complex.Origins[b][a] - complex.Origins[c][a]));
      }
      EXPECT_GE(distance, complex.Groups[b] == complex.Groups[c] ? 1 : 2);
    }
    const LatticePoint& o = complex.Origins[b];
    EXPECT_EQ(complex.BlockAt({ o[0] + 0.5, o[1] + 0.25, o[2] + 0.75 }), b);
  }
}

int CountFaces(const BlockComplex& complex, bool (BlockComplex::*is)(const BlockFace&) const)
{
  int count = 0;
  for (Index b = 0; b < complex.Size(); ++b)
  {
    for (int f = 0; f < 6; ++f)
    {
      count += (complex.*is)({ b, f / 2, f % 2 });
    }
  }
  return count;
}

std::string Refusal(const std::vector<std::array<Index, 8>>& blocks, const std::vector<int>& groups,
  const std::vector<LatticePoint>& places, std::vector<int> segments = {})
{
  try
  {
    segments.resize(blocks.size());
    BlockComplex(blocks, segments, groups, places);
  }
  catch (const std::invalid_argument& error)
  {
    return error.what();
  }
  return "";
}

TEST(BlockComplex, JoinsCubesOfOneGroup)
{
  const BlockComplex shape = CubesComplex({ { 2, -1, 0 }, { 3, -1, 0 }, { 2, 0, 0 }, { 3, 0, 0 } });
  ExpectTwinsToMatch(shape);
  ExpectGroupsApart(shape);
  EXPECT_EQ(CountFaces(shape, &BlockComplex::IsJoined), 8);
  EXPECT_EQ(CountFaces(shape, &BlockComplex::IsGlued), 0);
  EXPECT_EQ(shape.Origins[1], (LatticePoint{ 1, 0, 0 }));
  EXPECT_EQ(shape.Extent(), (LatticePoint{ 2, 2, 1 }));
  EXPECT_EQ(shape.BlockAt({ 1.5, 2.5, 0.5 }), -1);
  EXPECT_EQ(shape.BlockAt({ 2.0, 1.0, 1.0 }), 1);
}

TEST(BlockComplex, SetsGroupsApartAndGluesThem)
{
  const BlockComplex ball = LayeredCubeComplex();
  ASSERT_EQ(ball.Size(), 7);
  ExpectTwinsToMatch(ball);
  ExpectGroupsApart(ball);
  EXPECT_EQ(CountFaces(ball, &BlockComplex::IsJoined), 0);
  // The core has 6 glued faces, every layer 5: one inwards, 4 beside it.
  EXPECT_EQ(CountFaces(ball, &BlockComplex::IsGlued), 6 + 6 * 5);
  // Seven boxes in an arrangement of 2 x 2 x 2.
  EXPECT_EQ(ball.Extent(), (LatticePoint{ 3, 3, 3 }));
}

TEST(BlockComplex, FindsAllTurnsOfAFace)
{
  // A second cube on the side u = 1 of the first, turned in all 24 ways.
  const std::array<Index, 8> first{ 0, 1, 2, 3, 4, 5, 6, 7 };
  int flips = 0, swaps = 0;
  for (const std::array<Index, 8>& turned : TurnsOf({ 1, 8, 9, 2, 5, 10, 11, 6 }))
  {
    const BlockComplex two({ first, turned }, { 0, 0 }, { 0, 1 }, { { 0, 0, 0 }, { 0, 0, 0 } });
    ExpectTwinsToMatch(two);
    const FaceTwin& twin = two.Twin({ 0, 0, 1 });
    ASSERT_EQ(twin.Face.Block, 1);
    flips += twin.Flipped[0] + twin.Flipped[1];
    swaps += twin.Swapped;
  }
  EXPECT_EQ(flips, 24);
  EXPECT_EQ(swaps, 12);
}

TEST(BlockComplex, GluesABlockToItself)
{
  const BlockComplex ring({ { 0, 0, 3, 3, 4, 4, 7, 7 } }, { 0 }, { 0 }, { { 0, 0, 0 } });
  const FaceTwin& twin = ring.Twin({ 0, 0, 0 });
  EXPECT_EQ(twin.Face.Block, 0);
  EXPECT_EQ(twin.Face.Axis, 0);
  EXPECT_EQ(twin.Face.Side, 1);
  EXPECT_FALSE(twin.Swapped || twin.Flipped[0] || twin.Flipped[1]);
  EXPECT_FALSE(ring.IsJoined({ 0, 0, 0 }));
  EXPECT_TRUE(ring.IsGlued({ 0, 0, 1 }));
}

TEST(BlockComplex, HasThreeBlocksAroundAnEdge)
{
  const BlockComplex three = ThreeAroundAnEdge();
  ExpectTwinsToMatch(three);
  ExpectGroupsApart(three);
  EXPECT_EQ(CountFaces(three, &BlockComplex::IsGlued), 6);
}

TEST(BlockComplex, SplitsGroupsThatOthersTouch)
{
  // Two cubes of one group and a third one, of another, on top of the first.
  const Polycube cubes({ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 0, 1 } });
  const BlockComplex shape(cubes.CubePoints, { 0, 0, 1 }, { 4, 4, 2 }, cubes.Cubes);
  EXPECT_EQ(shape.Groups, (std::vector<int>{ 5, 6, 2 }));
  EXPECT_EQ(CountFaces(shape, &BlockComplex::IsJoined), 0);
  EXPECT_EQ(CountFaces(shape, &BlockComplex::IsGlued), 4);
  ExpectTwinsToMatch(shape);
  ExpectGroupsApart(shape);
}

TEST(BlockComplex, KeepsGroupsThatFillNoBox)
{
  const BlockComplex shape = CubesComplex({ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } });
  EXPECT_EQ(shape.Groups, (std::vector<int>{ 0, 0, 0 }));
  EXPECT_EQ(CountFaces(shape, &BlockComplex::IsGlued), 0);
  EXPECT_EQ(CountFaces(shape, &BlockComplex::IsJoined), 4);
  ExpectTwinsToMatch(shape);
  ExpectGroupsApart(shape);
  EXPECT_EQ(shape.BlockAt({ 1.5, 1.5, 0.5 }), -1);
  EXPECT_EQ(shape.BlocksAt({ 1.0, 1.0, 0.5 }), (std::vector<Index>{ 0, 1, 2 }));
  EXPECT_EQ(shape.BlocksAt({ 1.0, 1.5, 0.5 }), (std::vector<Index>{ 2 }));
}

TEST(BlockComplex, RefusesWhatIsNoDomain)
{
  const std::array<Index, 8> first{ 0, 1, 2, 3, 4, 5, 6, 7 }, next{ 1, 8, 9, 2, 5, 10, 11, 6 };
  const LatticePoint zero{ 0, 0, 0 }, one{ 1, 0, 0 };
  EXPECT_NE(Refusal({}, {}, {}).find("at least one block"), std::string::npos);
  EXPECT_NE(Refusal({ first }, { 0 }, {}).find("place for each"), std::string::npos);
  EXPECT_NE(Refusal({ first, next }, { 0, 0 }, { zero, zero }).find("at the place of block 0"),
    std::string::npos);
  EXPECT_NE(
    Refusal({ first, { 20, 8, 9, 2, 5, 10, 11, 6 } }, { 0, 0 }, { zero, one }).find("no face"),
    std::string::npos);
  EXPECT_NE(Refusal({ first, next }, { 0, 0 }, { zero, one }, { 0, 1 }).find("different segments"),
    std::string::npos);
  EXPECT_NE(Refusal({ first, first, first }, { 0, 1, 2 }, { zero, zero, zero }).find("two others"),
    std::string::npos);
  EXPECT_NE(
    Refusal({ { 0, 0, 3, 3, 4, 4, 7, 7 }, { 0, 0, 8, 8, 4, 4, 9, 9 } }, { 0, 1 }, { zero, zero })
      .find("comes twice"),
    std::string::npos);
}
}
