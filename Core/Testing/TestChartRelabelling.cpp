// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Search/FindDomain.h"
#include "SegmentSurfaces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace
{
using namespace trivariate;
using trivariate_testing::Icosphere;

// Half a ball in one piece, the other half in crumbs far from any large piece.
TEST(ChartRelabelling, GivesCrumbsToLargePieces)
{
  const SurfaceMesh ball = Icosphere(5);
  std::mt19937 random(1);
  std::vector<ChartLabel> labels;
  for (const Triangle& c : ball.Triangles)
  {
    labels.push_back(ball.Points[c[0]].z() > 0.0 ? 0 : static_cast<ChartLabel>(random() % 6));
  }
  KeepLargestPieces(ball, labels);
  std::vector<ChartLabel> again = labels;
  KeepLargestPieces(ball, again);
  EXPECT_EQ(labels, again);
  EXPECT_LE(*std::max_element(labels.begin(), labels.end()), 5);
  EXPECT_GT(std::count(labels.begin(), labels.end(), 0), ball.NumberOfTriangles() / 2);
}
}
