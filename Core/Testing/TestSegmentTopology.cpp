// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Domain/SegmentTopology.h"
#include "Domain/SimplePoint.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <set>

using namespace trivariate;

namespace
{
struct Solid
{
  std::array<Index, 3> Size;
  std::vector<std::uint8_t> Mask;

  Solid(const std::array<Index, 3>& size, const std::function<bool(double, double, double)>& inside)
    : Size(size)
  {
    for (Index z = 0; z < size[2]; ++z)
    {
      for (Index y = 0; y < size[1]; ++y)
      {
        for (Index x = 0; x < size[0]; ++x)
        {
          this->Mask.push_back(inside(double(x), double(y), double(z)));
        }
      }
    }
  }

  Index Count() const { return std::count(this->Mask.begin(), this->Mask.end(), 1); }

  // V - E + F - C of the closed cubes, by listing all of them.
  Index Euler() const
  {
    std::set<std::array<Index, 3>> elements; // at doubled coordinates
    for (std::size_t i = 0; i < this->Mask.size(); ++i)
    {
      if (this->Mask[i])
      {
        const Index n = static_cast<Index>(i);
        const Index c[3] = { 2 * (n % this->Size[0]) + 1,
          2 * (n / this->Size[0] % this->Size[1]) + 1,
          2 * (n / this->Size[0] / this->Size[1]) + 1 };
        for (int k = 0; k < 27; ++k)
        {
          elements.insert({ c[0] + k % 3 - 1, c[1] + k / 3 % 3 - 1, c[2] + k / 9 - 1 });
        }
      }
    }
    Index sum = 0;
    for (const auto& e : elements)
    {
      sum += (e[0] + e[1] + e[2]) % 2 ? -1 : 1; // an odd number of odd coordinates: edge or cell
    }
    return sum;
  }

  TopologyChanges MakeWhole(const TopologyOptions& options = {})
  {
    const TopologyChanges changes = MakeSegmentWhole(this->Mask, this->Size, options, Execution());
    EXPECT_EQ(changes.EulerCharacteristic, this->Euler());
    return changes;
  }
};

bool InBall(double x, double y, double z, double cx, double cy, double cz, double r)
{
  return std::hypot(x - cx, y - cy, z - cz) <= r;
}
}

TEST(SegmentTopology, SimplePointsLeaveTheEulerCharacteristic)
{
  std::mt19937 random(1);
  int simple = 0;
  for (int trial = 0; trial < 20000; ++trial)
  {
    std::uint32_t object = random() & 0x7ffdfff;
    object = trial % 3 ? object : object & random();
    Solid solid({ 3, 3, 3 },
      [object](double x, double y, double z) { return object >> int(9 * z + 3 * y + x) & 1; });
    if (IsSimple(object))
    {
      const Index before = solid.Euler();
      solid.Mask[13] = 1;
      EXPECT_EQ(before, solid.Euler());
      ++simple;
    }
  }
  EXPECT_GT(simple, 1000);
  EXPECT_FALSE(IsSimple(0)) << "a new piece";
  EXPECT_FALSE(IsSimple(0x7ffdfff)) << "the end of a cavity";
}

TEST(SegmentTopology, LeavesABallAlone)
{
  Solid ball(
    { 30, 28, 26 }, [](double x, double y, double z) { return InBall(x, y, z, 14, 14, 13, 11); });
  const std::vector<std::uint8_t> before = ball.Mask;
  const TopologyChanges changes = ball.MakeWhole();
  EXPECT_EQ(ball.Mask, before);
  EXPECT_EQ(changes.EulerCharacteristic, 1);
  EXPECT_EQ(changes.Cut + changes.Closed + changes.Pieces + changes.Cavities, 0);
}

TEST(SegmentTopology, FillsTheWholeVolume)
{
  Solid all({ 5, 4, 3 }, [](double, double, double) { return true; });
  EXPECT_EQ(all.MakeWhole().EulerCharacteristic, 1);
  EXPECT_EQ(all.Count(), 60);
  Solid none({ 5, 4, 3 }, [](double, double, double) { return false; });
  EXPECT_EQ(none.MakeWhole().EulerCharacteristic, 0);
}

TEST(SegmentTopology, ClosesANarrowTunnel)
{
  Solid solid({ 30, 30, 30 }, [](double x, double y, double z)
    { return InBall(x, y, z, 15, 15, 15, 12) && std::hypot(x - 15, y - 15) > 1.5; });
  EXPECT_EQ(solid.Euler(), 0);
  const TopologyChanges changes = solid.MakeWhole();
  EXPECT_EQ(changes.EulerCharacteristic, 1);
  EXPECT_EQ(changes.Closed, 1);
  EXPECT_LE(changes.ClosedVoxels, 9);
  EXPECT_EQ(changes.Cut, 0);
}

TEST(SegmentTopology, CutsAThinHandle)
{
  // A ball with a bow of two voxels' thickness.
  Solid solid({ 40, 30, 30 },
    [](double x, double y, double z)
    {
      return InBall(x, y, z, 12, 15, 15, 10) ||
             (std::abs(z - 15) <= 1 && std::abs(std::hypot(x - 22, y - 15) - 11) <= 1);
    });
  EXPECT_EQ(solid.Euler(), 0);
  const TopologyChanges changes = solid.MakeWhole();
  EXPECT_EQ(changes.EulerCharacteristic, 1);
  EXPECT_EQ(changes.Cut, 1);
  EXPECT_LE(changes.CutVoxels, 16);
  EXPECT_EQ(changes.Closed, 0);
}

TEST(SegmentTopology, LeavesALargeHandle)
{
  Solid torus({ 44, 44, 20 }, [](double x, double y, double z)
    { return std::hypot(std::hypot(x - 22, y - 22) - 13, z - 10) <= 6; });
  TopologyOptions options;
  options.LargestSheet = 20;
  const std::vector<std::uint8_t> before = torus.Mask;
  EXPECT_EQ(torus.MakeWhole(options).EulerCharacteristic, 0);
  EXPECT_EQ(torus.Mask, before);
  EXPECT_EQ(torus.MakeWhole().EulerCharacteristic, 1);
}

TEST(SegmentTopology, FillsCavitiesUpToTheLimitAndKeepsTheLargestPiece)
{
  Solid solid({ 50, 30, 30 },
    [](double x, double y, double z)
    {
      return (InBall(x, y, z, 15, 15, 15, 13) && !InBall(x, y, z, 15, 15, 15, 4)) ||
             InBall(x, y, z, 42, 15, 15, 5);
    });
  const Index small = Solid(solid.Size,
    [](double x, double y, double z) {
      return InBall(x, y, z, 42, 15, 15, 5);
    }).Count();
  const Index cavity = Solid(solid.Size,
    [](double x, double y, double z) {
      return InBall(x, y, z, 15, 15, 15, 4);
    }).Count();
  TopologyOptions options;
  options.LargestCavity = cavity;
  const TopologyChanges changes = solid.MakeWhole(options);
  EXPECT_EQ(changes.Pieces, small);
  EXPECT_EQ(changes.Cavities, cavity);
  EXPECT_EQ(changes.EulerCharacteristic, 1);
}

TEST(SegmentTopology, CutsTheHandlesOfACavityThatStays)
{
  const auto inTorus = [](double x, double y, double z)
  { return std::hypot(std::hypot(x - 17, y - 17) - 7, z - 17) <= 2.5; };
  Solid solid({ 35, 35, 35 }, [&](double x, double y, double z)
    { return InBall(x, y, z, 17, 17, 17, 15) && !inTorus(x, y, z); });
  EXPECT_EQ(solid.Euler(), 1) << "a handle of the cavity hides the cavity";
  TopologyOptions options;
  options.LargestCavity = 10;
  const Index before = solid.Count();
  EXPECT_EQ(solid.MakeWhole(options).EulerCharacteristic, 2);
  EXPECT_LE(solid.Count() - before, 30) << "one sheet across the torus";
}

TEST(SegmentTopology, MakesNoiseWhole)
{
  for (unsigned seed = 0; seed < 12; ++seed)
  {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    Solid noise({ 17, 14, 19 }, [&](double x, double y, double z)
      { return uniform(random) < (InBall(x, y, z, 8, 7, 9, 6) ? 0.8 : 0.2); });
    TopologyOptions options;
    options.LargestSheet = options.LargestCavity = 1 << 20;
    EXPECT_EQ(noise.MakeWhole(options).EulerCharacteristic, 1) << "seed " << seed;
    EXPECT_GT(noise.Count(), 500);
  }
}
