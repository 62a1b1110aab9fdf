// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "BlockSplines.h"
#include "TSpline/BezierMesh.h"

#include <gtest/gtest.h>

#include <set>
#include <stdexcept>

namespace
{
using namespace trivariate;

TEST(BlockSpline, SharesThePointsOfCommonFaces)
{
  // One cell a block: 4 x 4 x 4 control points, of which the faces' 4 x 4 are common.
  const auto count = [](const BlockComplex& blocks, Sharing what = Sharing::Attributes)
  {
    const BlockSpline layout(blocks, 3);
    return layout.Share(layout.MakeCoarsest(1, 0), what).Count();
  };
  EXPECT_EQ(count(CubesComplex({ { 0, 0, 0 } })), 64);
  EXPECT_EQ(count(CubesComplex({ { 0, 0, 0 }, { 1, 0, 0 } })), 5 * 4 * 4);
  // All of a square's but those of its one corner that is no part of the L.
  EXPECT_EQ(count(CubesComplex({ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } })), (5 * 5 - 1) * 4);
  // The core, and three more layers of the 56 points on the surface of a 4 x 4 x 4 grid.
  EXPECT_EQ(count(LayeredCubeComplex()), 64 + 3 * 56);
  // The layers another segment: its attributes have the core's surface for themselves.
  EXPECT_EQ(count(NestedCubeComplex()), 64 + 4 * 56);
  EXPECT_EQ(count(NestedCubeComplex(), Sharing::Places), 64 + 3 * 56);
  // Three cells of a hexagon: 3 * 9 + 3 * 3 + 1 points in each of four planes.
  EXPECT_EQ(count(ThreeAroundAnEdge()), 4 * (3 * 9 + 3 * 3 + 1));
  EXPECT_EQ(count(BlockComplex({ { 0, 0, 3, 3, 4, 4, 7, 7 } }, { 0 }, { 0 }, { { 0, 0, 0 } })), 48);
  EXPECT_THROW(BlockSpline(LayeredCubeComplex(), 3).MakeCoarsest(16, 0), std::invalid_argument);
  EXPECT_THROW(BlockSpline(LayeredCubeComplex(), 3).MakeCoarsest(3, 0), std::invalid_argument);
}

// Promise 7 over a domain: after many random refinements the spline is what it was, functions sum
// to one in every block, and there is no gap at any face.
TEST(BlockSpline, StaysWholeUnderRefinement)
{
  for (const NamedComplex& shape : BlockShapes())
  {
    SCOPED_TRACE(shape.Name);
    const BlockComplex& blocks = shape.Blocks;
    const BlockSpline layout(blocks, 4);
    for (unsigned seed = 0; seed < 6; ++seed)
    {
      std::mt19937 random(seed);
      TSpline spline = layout.MakeCoarsest(seed % 2 ? 2 : 1, 1);
      Scatter(layout, spline, random);
      const TSpline coarse = spline;
      const auto rule = MakeBlockRule(layout, spline);
      for (int round = 0; round < 8; ++round)
      {
        const Index b = static_cast<Index>(random() % blocks.Size());
        rule->Refine(spline, RandomMarks(spline, RandomPointIn(blocks, b, random), 6, random));
      }
      ASSERT_EQ(Validate(spline), "");
      EXPECT_GT(spline.Size(), coarse.Size() + 20);
      EXPECT_TRUE(layout.CrossedTraces(spline).empty());
      ExpectSameSpline(blocks, coarse, spline, random);
      EXPECT_LT(LargestGap(blocks, spline, random), 1e-13);
      Scatter(layout, spline, random);
      EXPECT_LT(LargestGap(blocks, spline, random), 1e-14);
    }
  }
}

// What the rule makes equal was equal to rounding: traces and weights come out the same on both
// sides whatever the order of the splits.
TEST(BlockSpline, WeightsAgreeWithoutBeingMadeToAgree)
{
  const BlockComplex blocks = LayeredCubeComplex();
  const BlockSpline layout(blocks, 4);
  for (unsigned seed = 0; seed < 10; ++seed)
  {
    std::mt19937 random(seed);
    TSpline spline = layout.MakeCoarsest(1, 0);
    Scatter(layout, spline, random);
    const auto rule = MakeKnotInsertionRule(spline);
    for (int round = 0; round < 8; ++round)
    {
      const Index b = static_cast<Index>(random() % blocks.Size());
      std::vector<RefinementMark> marks =
        RandomMarks(spline, RandomPointIn(blocks, b, random), 6, random);
      for (; !marks.empty(); marks = layout.CrossedTraces(spline))
      {
        rule->Refine(spline, marks);
      }
    }
    const SharedPoints shared = layout.Share(spline, Sharing::Places);
    EXPECT_LT(shared.Count(), spline.Size());
    for (Index i = 0; i < spline.Size(); ++i)
    {
      const Index first = shared.FirstOf[shared.PointOf[i]];
      EXPECT_NEAR(spline.Weights[i], spline.Weights[first], 1e-14);
      for (int c = 0; c < 3; ++c)
      {
        EXPECT_NEAR(spline.ControlPoint(i)[c], spline.ControlPoint(first)[c], 1e-12);
      }
    }
    EXPECT_LT(LargestGap(blocks, spline, random), 1e-12);
  }
}

// A split along a face goes to the other side and on from there; one across it does not.
TEST(BlockSpline, SplitsBothSidesAlongAFaceOnly)
{
  const BlockComplex blocks = LayeredCubeComplex();
  const BlockSpline layout(blocks, 3);
  TSpline spline = layout.MakeCoarsest(1, 0);
  const auto rule = MakeBlockRule(layout, spline);
  const auto sizeOf = [&](Index b)
  {
    return std::count_if(spline.Functions.begin(), spline.Functions.end(),
      [&](const BlendingFunction& f) { return layout.BlockOf(f) == b; });
  };
  // The first function of the block on +w: clamped at the low ends, a corner of the core's face.
  const Index top = 6;
  const auto first = std::find_if(spline.Functions.begin(), spline.Functions.end(),
    [&](const BlendingFunction& f) { return layout.BlockOf(f) == top; });
  const auto mark = [&](int direction)
  {
    return RefinementMark{ first - spline.Functions.begin(), direction,
      blocks.Origins[top][direction] * 8 + 4 };
  };
  rule->Refine(spline, { mark(2) });
  // The depth of a layer is that of its four neighbours, and theirs that of the last one.
  EXPECT_EQ(sizeOf(0), 64);
  for (Index b = 1; b < 7; ++b)
  {
    EXPECT_EQ(sizeOf(b), 4 * 4 * 5);
  }
}

// Where blocks do not fill a box: cells tile the blocks and nothing else, and one cubic polynomial
// over all of them is reproduced, across the faces between them and up to those of the hole.
TEST(BlockSpline, LeavesHolesOut)
{
  for (const auto& places : { std::vector<LatticePoint>{ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } },
         { { 0, 0, 0 }, { 1, 0, 0 }, { 2, 0, 0 }, { 0, 1, 0 }, { 2, 1, 0 } },
         { { 0, 0, 1 }, { 1, 0, 1 }, { 0, 1, 1 }, { 0, 0, 0 }, { 0, 0, 2 } } })
  {
    const BlockComplex blocks = CubesComplex(places);
    const BlockSpline layout(blocks, 4);
    for (unsigned seed = 0; seed < 4; ++seed)
    {
      std::mt19937 random(seed);
      TSpline spline = layout.MakeCoarsest(seed % 2 ? 2 : 1, 0);
      const TricubicPolynomial polynomial(random);
      for (Index i = 0; i < spline.Size(); ++i)
      {
        spline.ControlPoint(i)[0] = polynomial.Coefficient(spline, i);
      }
      const auto rule = MakeBlockRule(layout, spline);
      for (int round = 0; round < 8; ++round)
      {
        const Index b = static_cast<Index>(random() % blocks.Size());
        rule->Refine(spline, RandomMarks(spline, RandomPointIn(blocks, b, random), 6, random));
      }
      const BezierMesh mesh(spline);
      double volume = 0.0;
      for (Index cell = 0; cell < mesh.Size(); ++cell)
      {
        const auto b = mesh.Bounds(cell);
        volume += (b[1] - b[0]) * (b[3] - b[2]) * (b[5] - b[4]);
        EXPECT_GE(
          blocks.BlockAt({ 0.5 * (b[0] + b[1]), 0.5 * (b[2] + b[3]), 0.5 * (b[4] + b[5]) }), 0);
      }
      EXPECT_NEAR(volume, static_cast<double>(blocks.Size()), 1e-12);
      const LatticePoint extent = blocks.Extent();
      for (int trial = 0; trial < 200; ++trial)
      {
        Point x;
        for (int a = 0; a < 3; ++a)
        {
          x[a] = Random(random, 0.0, extent[a]);
        }
        x[trial % 3] = trial % 2 ? std::round(x[trial % 3]) : x[trial % 3]; // on a face
        const bool isInside = blocks.BlockAt(x) >= 0;
        EXPECT_EQ(mesh.FindCell(x[0], x[1], x[2]) >= 0, isInside);
        if (isInside)
        {
          const auto value = HomogeneousValue(spline, x);
          EXPECT_NEAR(value[0], polynomial(x), 1e-10 * (1.0 + std::abs(polynomial(x))));
          EXPECT_NEAR(value.back(), 1.0, 1e-12);
        }
      }
      for (const BlendingFunction& f : spline.Functions)
      {
        EXPECT_TRUE(HasSupportOutside(spline.Holes, f));
      }
    }
  }
}
}
