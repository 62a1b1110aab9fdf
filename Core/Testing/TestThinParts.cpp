// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Parameter/ThinParts.h"

#include <gtest/gtest.h>

#include <functional>

using namespace trivariate;

namespace
{
constexpr Index N = 24;

double ShareOf(const std::function<bool(Index, Index, Index)>& isInside)
{
  std::vector<std::uint8_t> mask(N * N * N, 0);
  for (Index id = 0; id < N * N * N; ++id)
  {
    mask[id] = isInside(id % N, id / N % N, id / N / N) ? 1 : 0;
  }
  return ThinShare(mask, { N, N, N }, Execution());
}
}

//------------------------------------------------------------------------------
TEST(ThinParts, AreThinnerThanFourVoxels)
{
  for (Index t = 1; t <= 6; ++t)
  {
    EXPECT_EQ(ShareOf([t](Index, Index j, Index) { return j >= 5 && j < 5 + t; }), t < 4 ? 1 : 0);
    const auto rod = [t](Index, Index j, Index k) { return j >= 5 && j < 5 + t && k < t; };
    EXPECT_EQ(ShareOf(rod), t < 4 ? 1 : 0);
  }
}

TEST(ThinParts, AreNotTheEdgesOfABoxOrABall)
{
  EXPECT_EQ(ShareOf([](Index, Index, Index) { return true; }), 0.0);
  EXPECT_EQ(ShareOf([](Index, Index, Index) { return false; }), 0.0);
  EXPECT_EQ(ShareOf([](Index i, Index j, Index k)
              { return (i - 12) * (i - 12) + (j - 12) * (j - 12) + (k - 12) * (k - 12) < 81; }),
    0.0);
}

TEST(ThinParts, AreCounted)
{
  // A box of 10 x 10 x 10 with a fin of 2 x 10 x 8 on it, of which the two lowest layers are near
  // the box: a ball that fits it may bulge into the fin by one.
  const auto isInside = [](Index i, Index j, Index k)
  {
    const bool box = i >= 2 && i < 12 && j >= 2 && j < 12 && k < 10;
    return box || (i >= 6 && i < 8 && j >= 2 && j < 12 && k >= 10 && k < 18);
  };
  EXPECT_DOUBLE_EQ(ShareOf(isInside), 120.0 / 1160.0);
}
