// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "BlockShapes.h"
#include "Fit/BlockSpline.h"
#include "Fit/GradientJump.h"
#include "ThreadedExecution.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace
{
using namespace trivariate;

// Two cubes beside each other along u, each a group.
BlockComplex TwoGroups(const std::vector<int>& segments)
{
  const Polycube cubes({ { 0, 0, 0 }, { 1, 0, 0 } });
  return BlockComplex(cubes.CubePoints, segments, { 0, 1 }, cubes.Cubes);
}

using Place = std::array<double, 3>;

// The blocks' own coordinates and an attribute, both linear in each block.
TSpline LinearSpline(const BlockSpline& layout,
  const std::function<Place(Index block, const Place& local)>& place,
  const std::function<double(Index block, const Place& x)>& attribute)
{
  TSpline spline = layout.MakeCoarsest(2, 1);
  for (Index i = 0; i < spline.Size(); ++i)
  {
    const Index block = layout.BlockOf(spline.Functions[i]);
    Place local; // the Greville abscissae
    for (int a = 0; a < 3; ++a)
    {
      const Knots5 t = spline.LocalKnotValues(i, a);
      local[a] = (t[1] + t[2] + t[3]) / 3.0 - layout.Blocks().Origins[block][a];
    }
    const Place x = place(block, local);
    std::copy(x.begin(), x.end(), spline.ControlPoint(i));
    spline.ControlPoint(i)[3] = attribute(block, x);
  }
  return spline;
}

GradientJump JumpOf(const BlockComplex& blocks, const TSpline& spline, double unit)
{
  return MeasureGradientJumps(
    blocks, spline, BezierMesh(spline), { unit }, ThreadedExecution(2))[0];
}

// The second block is three times as long and sheared: its coordinates have a kink at the
// face.
Place BentPlace(Index block, const Place& local)
{
  const double along = block == 0 ? local[0] : 1.0 + 3.0 * local[0];
  return { along, 2.0 * local[1] + (block == 0 ? 0.0 : 0.5 * local[0]), local[2] };
}

TEST(GradientJump, IsZeroWhereOnlyTheCoordinatesBend)
{
  const BlockComplex blocks = TwoGroups({ 0, 0 });
  const BlockSpline layout(blocks, 3);
  const TSpline spline = LinearSpline(
    layout, BentPlace, [](Index, const Place& x) { return 2.0 * x[0] - x[1] + 0.5 * x[2]; });
  EXPECT_LT(JumpOf(blocks, spline, 1.0).Maximum, 1e-12);
}

// |x - 1| has slopes -1 and 1.
TEST(GradientJump, IsThatOfAKink)
{
  const BlockComplex blocks = TwoGroups({ 0, 0 });
  const BlockSpline layout(blocks, 3);
  const TSpline spline = LinearSpline(
    layout, BentPlace, [](Index, const Place& x) { return std::abs(x[0] - 1.0) + x[1]; });
  const GradientJump jump = JumpOf(blocks, spline, 0.25);
  EXPECT_NEAR(jump.Rms, 0.5, 1e-12);
  EXPECT_NEAR(jump.Maximum, 0.5, 1e-12);
}

TEST(GradientJump, IsThatOfTurnedBlocks)
{
  // Three prisms of a hexagon, two of them turned; the distance from the middle along the hexagon's
  // spokes has a kink at each of the three faces.
  const BlockComplex blocks = ThreeAroundAnEdge();
  const BlockSpline layout(blocks, 2);
  const auto corner = [](Index point) -> Place
  {
    const double angle = M_PI / 3.0 * static_cast<double>(point % 7 - 1);
    const double r = point % 7 == 0 ? 0.0 : 1.0;
    return { r * std::cos(angle), r * std::sin(angle), point < 7 ? 0.0 : 1.0 };
  };
  const auto place = [&](Index block, const Place& local)
  {
    Place x{ 0.0, 0.0, 0.0 };
    for (int ends = 0; ends < 8; ++ends)
    {
      const Place c = corner(blocks.Blocks[block][HexahedronCorner(ends)]);
      double weight = 1.0;
      for (int a = 0; a < 3; ++a)
      {
        weight *= ends >> a & 1 ? local[a] : 1.0 - local[a];
      }
      for (int a = 0; a < 3; ++a)
      {
        x[a] += weight * c[a];
      }
    }
    return x;
  };
  // In the rhombus between spokes 120 degrees apart, the sum of the coordinates along both: its
  // gradient is two long and along the diagonal between them, 120 degrees from the next one's.
  const auto sum = [](Index block, const Place& x)
  {
    const double angle = M_PI / 3.0 * (1.0 + 2.0 * static_cast<double>(block));
    return 2.0 * (x[0] * std::cos(angle) + x[1] * std::sin(angle));
  };
  const TSpline spline = LinearSpline(layout, place, sum);
  const GradientJump jump = JumpOf(blocks, spline, 1.0);
  EXPECT_NEAR(jump.Rms, 2.0 * std::sqrt(3.0), 1e-12);
  EXPECT_NEAR(jump.Maximum, 2.0 * std::sqrt(3.0), 1e-12);
}

TEST(GradientJump, LeavesOutFacesBetweenSegmentsAndJoinedOnes)
{
  const auto kink = [](Index, const Place& x) { return std::abs(x[0] - 1.0); };
  for (const BlockComplex& blocks :
    { TwoGroups({ 0, 1 }), CubesComplex({ { 0, 0, 0 }, { 1, 0, 0 } }) })
  {
    const BlockSpline layout(blocks, 3);
    EXPECT_EQ(JumpOf(blocks, LinearSpline(layout, BentPlace, kink), 1.0).Rms, 0.0);
  }
}
}
