// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// Splines over blocks at random, and the gaps that they must not have.
#ifndef trivariate_BlockSplines_h
#define trivariate_BlockSplines_h

#include "BlockShapes.h"
#include "Fit/BlockSpline.h"
#include "RandomRefinement.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace trivariate
{
struct NamedComplex
{
  const char* Name;
  BlockComplex Blocks;
};

inline std::vector<NamedComplex> BlockShapes()
{
  return { { "cube", CubesComplex({ { 0, 0, 0 } }) },
    { "two cubes", CubesComplex({ { 0, 0, 0 }, { 1, 0, 0 } }) },
    { "L", CubesComplex({ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } }) },
    { "U", CubesComplex({ { 0, 0, 0 }, { 1, 0, 0 }, { 2, 0, 0 }, { 0, 1, 0 }, { 2, 1, 0 } }) },
    { "layered cube", LayeredCubeComplex() }, { "nested segments", NestedCubeComplex() },
    { "three around an edge", ThreeAroundAnEdge() },
    { "ring", BlockComplex({ { 0, 0, 3, 3, 4, 4, 7, 7 } }, { 0 }, { 0 }, { { 0, 0, 0 } }) } };
}

/// Control points at random, what is shared of them the same.
inline void Scatter(const BlockSpline& layout, TSpline& spline, std::mt19937& random)
{
  for (const Sharing what : { Sharing::Attributes, Sharing::Places })
  {
    const SharedPoints shared = layout.Share(spline, what);
    const int components = what == Sharing::Places ? 3 : spline.Components;
    std::vector<double> values(shared.Count() * components);
    for (double& value : values)
    {
      value = Random(random, -1.0, 1.0);
    }
    for (Index i = 0; i < spline.Size(); ++i)
    {
      std::copy_n(&values[shared.PointOf[i] * components], components, spline.ControlPoint(i));
    }
  }
}

inline Point RandomPointIn(const BlockComplex& blocks, Index b, std::mt19937& random)
{
  Point x;
  for (int a = 0; a < 3; ++a)
  {
    x[a] = blocks.Origins[b][a] + Random(random, 0.0, 1.0);
  }
  return x;
}

/// The largest difference between the two sides of all glued faces, in numerators and denominator;
/// of attributes inside of segments.
inline double LargestGap(const BlockComplex& blocks, const TSpline& spline, std::mt19937& random)
{
  double gap = 0.0;
  for (Index b = 0; b < blocks.Size(); ++b)
  {
    for (int f = 0; f < 6; ++f)
    {
      const BlockFace face{ b, f / 2, f % 2 };
      for (int trial = 0; trial < 4 && blocks.IsGlued(face); ++trial)
      {
        std::array<double, 2> st{ Random(random, 0.0, 1.0), Random(random, 0.0, 1.0) };
        st[0] = trial == 3 ? 0.0 : st[0]; // on an edge
        const FaceTwin& twin = blocks.Twin(face);
        const auto own = HomogeneousValue(spline, PointOn(blocks, face, st));
        const auto other =
          HomogeneousValue(spline, PointOn(blocks, twin.Face, twin.Map<double>(st, 1.0)));
        const bool isInside = blocks.Segments[b] == blocks.Segments[twin.Face.Block];
        for (std::size_t c = 0; c < own.size(); ++c)
        {
          const bool isShared = isInside || c < 3 || c + 1 == own.size();
          gap = isShared ? std::max(gap, std::abs(own[c] - other[c])) : gap;
        }
      }
    }
  }
  return gap;
}

/// Promise 7: the spline is what it was before it was refined, and its functions sum to one.
inline void ExpectSameSpline(
  const BlockComplex& blocks, const TSpline& coarse, const TSpline& spline, std::mt19937& random)
{
  for (Index b = 0; b < blocks.Size(); ++b)
  {
    for (int trial = 0; trial < 10; ++trial)
    {
      const Point x = RandomPointIn(blocks, b, random);
      const auto before = HomogeneousValue(coarse, x), now = HomogeneousValue(spline, x);
      EXPECT_NEAR(now.back(), 1.0, 1e-13);
      for (std::size_t c = 0; c < now.size(); ++c)
      {
        EXPECT_NEAR(now[c], before[c], 1e-12);
      }
    }
  }
}
}

#endif
