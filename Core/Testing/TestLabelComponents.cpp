// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Texture/LabelComponents.h"

#include "Texture/InterfacePlacement.h"
#include "Texture/KMeans.h"
#include "Boundary/SegmentShells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <numeric>
#include <random>

using namespace trivariate;

namespace
{
using Size3 = std::array<Index, 3>;

std::vector<Label> RandomLabels(const Size3& size, int count, unsigned seed)
{
  std::mt19937 random(seed);
  std::vector<Label> labels(size[0] * size[1] * size[2]);
  std::generate(labels.begin(), labels.end(),
    [&]() { return static_cast<Label>(std::uniform_int_distribution<int>(0, count - 1)(random)); });
  return labels;
}

std::vector<Index> Neighbours(Index id, const Size3& size)
{
  const Index x = id % size[0], y = id / size[0] % size[1], z = id / (size[0] * size[1]);
  std::vector<Index> all;
  for (const auto& [inside, other] :
    { std::pair(x > 0, id - 1), std::pair(x + 1 < size[0], id + 1), std::pair(y > 0, id - size[0]),
      std::pair(y + 1 < size[1], id + size[0]), std::pair(z > 0, id - size[0] * size[1]),
      std::pair(z + 1 < size[2], id + size[0] * size[1]) })
  {
    if (inside)
    {
      all.push_back(other);
    }
  }
  return all;
}

// Layers along x of the given thicknesses.
std::vector<Label> Layers(const Size3& size, const std::vector<std::pair<Label, int>>& layers)
{
  std::vector<Label> row;
  for (const auto& [label, thickness] : layers)
  {
    row.insert(row.end(), thickness, label);
  }
  std::vector<Label> labels;
  for (Index i = 0; i < size[1] * size[2]; ++i)
  {
    labels.insert(labels.end(), row.begin(), row.end());
  }
  return labels;
}
}

//------------------------------------------------------------------------------
// Against a flood from each component's first voxel.
TEST(LabelComponents, AreConnectedAndSeparate)
{
  for (unsigned seed = 0; seed < 10; ++seed)
  {
    const Size3 size = { 7 + seed, 9, 5 };
    const std::vector<Label> labels = RandomLabels(size, 2 + seed % 3, seed);
    const LabelComponents components = FindComponents(labels, size);
    std::vector<int> flooded(labels.size(), -1);
    int count = 0;
    for (std::size_t first = 0; first < labels.size(); ++first)
    {
      if (flooded[first] >= 0)
      {
        continue;
      }
      std::vector<Index> front = { static_cast<Index>(first) };
      flooded[first] = count;
      Index voxels = 0;
      while (!front.empty())
      {
        const Index id = front.back();
        front.pop_back();
        ++voxels;
        for (const Index other : Neighbours(id, size))
        {
          if (flooded[other] < 0 && labels[other] == labels[id])
          {
            flooded[other] = count;
            front.push_back(other);
          }
        }
      }
      ASSERT_EQ(components.Sizes[count], voxels);
      ASSERT_EQ(components.Labels[count], labels[first]);
      ++count;
    }
    ASSERT_EQ(components.Count(), count);
    EXPECT_TRUE(std::equal(flooded.begin(), flooded.end(), components.Component.begin()));
  }
}

TEST(MergeSmallComponents, LeavesNoneThatIsSmall)
{
  for (unsigned seed = 0; seed < 10; ++seed)
  {
    const Size3 size = { 12, 11, 10 };
    const Index minimum = 5 + 20 * seed;
    std::vector<Label> labels = RandomLabels(size, 3, seed);
    EXPECT_GT(MergeSmallComponents(labels, size, minimum), 0);
    const LabelComponents components = FindComponents(labels, size);
    EXPECT_GE(*std::min_element(components.Sizes.begin(), components.Sizes.end()), minimum);
  }
}

TEST(MergeSmallComponents, TakesTheNeighbourWithMostFaces)
{
  // A voxel of label 2 in the face between 0 and 1 touches 0 five times and 1 once.
  const Size3 size = { 8, 5, 5 };
  std::vector<Label> labels = Layers(size, { { 0, 4 }, { 1, 4 } });
  const std::vector<Label> before = labels;
  labels[3 + 8 * (2 + 5 * 2)] = 2;
  EXPECT_EQ(MergeSmallComponents(labels, size, 2), 1);
  EXPECT_EQ(labels, before);
  EXPECT_EQ(MergeSmallComponents(labels, size, 100), 0); // both have 100
  EXPECT_EQ(MergeSmallComponents(labels, size, 101), 1);
  EXPECT_EQ(labels, std::vector<Label>(200, 1)); // the first of equals goes, to its only neighbour
}

//------------------------------------------------------------------------------
TEST(RemoveShells, RemovesLayersBetweenTheirSides)
{
  const Size3 size = { 20, 12, 12 };
  const std::vector<double> between = { 0.0, 0.45, 1.0 };
  const PointRows centres = { 3, 1, between.data() };
  for (const int thickness : { 1, 2 })
  {
    std::vector<Label> labels = Layers(size, { { 0, 8 }, { 1, thickness }, { 2, 12 - thickness } });
    EXPECT_EQ(RemoveShells(labels, size, centres, 1, Execution()), thickness * 144);
    EXPECT_EQ(std::count(labels.begin(), labels.end(), 1), 0);
    // Each side gets half.
    EXPECT_EQ(
      labels, Layers(size, { { 0, 8 + (thickness + 1) / 2 }, { 2, 12 - (thickness + 1) / 2 } }));
  }
}

TEST(RemoveShells, KeepsWhatIsMaterial)
{
  const Size3 size = { 20, 12, 12 };
  const std::vector<double> between = { 0.0, 0.5, 1.0 }, dense = { 0.0, 2.0, 1.0 };
  const auto expectKept =
    [&size](std::vector<Label> labels, const std::vector<double>& centres, const char* why)
  {
    const std::vector<Label> before = labels;
    EXPECT_EQ(RemoveShells(labels, size, { 3, 1, centres.data() }, 1, Execution()), 0) << why;
    EXPECT_EQ(labels, before) << why;
  };
  expectKept(Layers(size, { { 0, 8 }, { 1, 3 }, { 2, 9 } }), between, "thick");
  expectKept(Layers(size, { { 0, 8 }, { 1, 2 }, { 2, 10 } }), dense, "denser than both");
  expectKept(Layers(size, { { 0, 8 }, { 1, 2 }, { 0, 10 } }), between, "a wall in one segment");
  expectKept(Layers(size, { { 0, 8 }, { 2, 12 } }), between, "nothing there");
}

//------------------------------------------------------------------------------
// Random dilations against their definition.
TEST(Dilate, IsTheMaximumOverACube)
{
  const Size3 size = { 9, 7, 6 };
  std::vector<std::uint8_t> mask(9 * 7 * 6);
  std::mt19937 random(1);
  for (std::uint8_t& set : mask)
  {
    set = random() % 40 == 0;
  }
  for (int radius = 0; radius <= 3; ++radius)
  {
    std::vector<std::uint8_t> dilated = mask;
    Dilate(dilated, size, radius, Execution());
    for (Index id = 0; id < static_cast<Index>(mask.size()); ++id)
    {
      bool expected = false;
      for (Index other = 0; other < static_cast<Index>(mask.size()); ++other)
      {
        expected = expected || (mask[other] && std::abs(other % 9 - id % 9) <= radius &&
                                 std::abs(other / 9 % 7 - id / 9 % 7) <= radius &&
                                 std::abs(other / 63 - id / 63) <= radius);
      }
      ASSERT_EQ(dilated[id] != 0, expected) << id;
    }
  }
}

// Labels that are off by one or two voxels come back to where the levels change.
TEST(PlaceInterfaces, FindsTheStepOfTheLevels)
{
  const Size3 size = { 24, 16, 16 };
  const std::vector<Label> truth = Layers(size, { { 0, 11 }, { 1, 13 } });
  std::vector<std::uint8_t> levels;
  std::mt19937 random(2);
  for (const Label label : truth)
  {
    levels.push_back(static_cast<std::uint8_t>(4 * label + random() % 6)); // 0..5 and 4..9
  }
  for (const int wrong : { 9, 10, 11, 12, 13 })
  {
    std::vector<Label> labels = Layers(size, { { 0, wrong }, { 1, 24 - wrong } });
    PlacementOptions options;
    options.GreyLevels = 10;
    PlaceInterfaces(labels, levels, size, 2, options, Execution());
    EXPECT_LE(std::inner_product(labels.begin(), labels.end(), truth.begin(), 0, std::plus<>(),
                std::not_equal_to<>()),
      0.2 * 16 * 16)
      << wrong;
  }
}
