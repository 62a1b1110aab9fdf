// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "TSpline/DualCompatibility.h"
#include "RandomRefinement.h"

#include <gtest/gtest.h>

using namespace trivariate;

TEST(DualCompatibility, OverlapMeansRunsOfOneKnotVector)
{
  EXPECT_TRUE(Overlap({ 0, 1, 2, 3, 4 }, { 0, 1, 2, 3, 4 }));
  EXPECT_TRUE(Overlap({ 0, 1, 2, 3, 4 }, { 2, 3, 4, 6, 8 }));
  EXPECT_TRUE(Overlap({ 2, 3, 4, 6, 8 }, { 0, 1, 2, 3, 4 }));
  EXPECT_TRUE(Overlap({ 0, 1, 2, 3, 4 }, { 4, 6, 8, 9, 10 }));
  EXPECT_TRUE(Overlap({ 0, 1, 2, 3, 4 }, { 7, 8, 9, 10, 11 }));
  EXPECT_TRUE(Overlap({ 0, 0, 0, 0, 1 }, { 0, 1, 2, 3, 4 }));
  EXPECT_TRUE(Overlap({ 0, 0, 0, 1, 2 }, { 0, 0, 0, 0, 1 }));
  EXPECT_FALSE(Overlap({ 0, 0, 0, 0, 1 }, { 0, 0, 0, 0, 2 }));
  EXPECT_FALSE(Overlap({ 0, 0, 0, 1, 2 }, { 0, 0, 2, 3, 4 }));
  EXPECT_FALSE(Overlap({ 0, 1, 2, 3, 4 }, { 2, 4, 6, 8, 10 }));
  EXPECT_FALSE(Overlap({ 0, 2, 4, 6, 8 }, { 2, 3, 4, 5, 6 }));
}

TEST(DualCompatibility, HoldsForTensorProducts)
{
  std::mt19937 random(1);
  EXPECT_EQ(CheckDualCompatibility(RandomTensorProduct({ 4, 3, 5 }, { 1, 0, 2 }, random)), "");
}

TEST(DualCompatibility, NamesTheFirstPairThatFails)
{
  std::mt19937 random(1);
  TSpline spline = RandomTensorProduct({ 4, 3, 5 }, { 2, 2, 2 }, random);
  spline.Functions[40] = spline.Functions[11];
  const std::string twins = CheckDualCompatibility(spline);
  EXPECT_NE(twins.find("functions 11 and 40 "), std::string::npos) << twins;
  // A knot more in one function: it disagrees with its neighbours in u, but differs in v or w from
  // all but those on its own line.
  spline = RandomTensorProduct({ 6, 3, 5 }, { 2, 2, 2 }, random);
  ASSERT_EQ(spline.Functions[4][0], (LocalKnots{ 4, 8, 12, 16, 20 }));
  spline.Functions[4][0] = { 8, 10, 12, 14, 16 };
  const std::string graded = CheckDualCompatibility(spline);
  EXPECT_NE(graded.find("functions 2 and 4 "), std::string::npos) << graded;
}
