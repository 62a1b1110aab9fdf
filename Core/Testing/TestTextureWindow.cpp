// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "PlainTexture.h"
#include "Texture/TextureWindow.h"
#include "ThreadedExecution.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <random>
#include <string>
#include <vector>

using namespace trivariate;
using A = TextureAttribute;
using Size3 = std::array<Index, 3>;

namespace
{
struct LevelVolume
{
  Size3 Size;
  std::vector<std::uint8_t> Levels;

  Index Voxels() const { return this->Size[0] * this->Size[1] * this->Size[2]; }
};

// Patches of one level, of two levels and of noise, so that all kinds of windows occur.
LevelVolume RandomVolume(const Size3& size, int levels, unsigned seed)
{
  std::mt19937 random(seed);
  LevelVolume volume{ size, {} };
  std::vector<std::uint8_t> patches(1000);
  for (std::uint8_t& patch : patches)
  {
    patch = random() % 3;
  }
  for (Index z = 0; z < size[2]; ++z)
  {
    for (Index y = 0; y < size[1]; ++y)
    {
      for (Index x = 0; x < size[0]; ++x)
      {
        const int patch = patches[(z / 5 * 10 + y / 5) * 10 + x / 7];
        const int level = patch == 0 ? levels / 2 : random() % (patch == 1 ? 2 : levels);
        volume.Levels.push_back(static_cast<std::uint8_t>(std::min(level, levels - 1)));
      }
    }
  }
  return volume;
}

std::vector<A> AllAttributes()
{
  std::vector<A> all;
  for (int k = 0; k < TextureAttributeCount; ++k)
  {
    all.push_back(static_cast<A>(k));
  }
  return all;
}

template <typename Real>
std::vector<std::vector<Real>> Compute(const LevelVolume& volume, const TextureOptions& options,
  const Size3& begin, const Size3& end, const Execution& execution = {})
{
  const Index voxels = (end[0] - begin[0]) * (end[1] - begin[1]) * (end[2] - begin[2]);
  std::vector<std::vector<Real>> values(
    TextureOutputNames(options).size(), std::vector<Real>(voxels, Real(-1)));
  std::vector<Real*> out;
  for (auto& array : values)
  {
    out.push_back(array.data());
  }
  ComputeTexture(volume.Levels.data(), volume.Size, begin, end, options, out, execution);
  return values;
}

template <typename Real>
std::vector<std::vector<Real>> Compute(
  const LevelVolume& volume, const TextureOptions& options, const Execution& execution = {})
{
  return Compute<Real>(volume, options, { 0, 0, 0 }, volume.Size, execution);
}

// What ComputeTexture says of a voxel, from the definitions.
std::vector<double> PlainOutputs(
  const LevelVolume& volume, const Size3& voxel, const TextureOptions& options)
{
  const VoxelBox window = WindowOf(voxel, volume.Size, options.Radius);
  const std::size_t n = options.Attributes.size();
  CooccurrenceMatrix merged(options.GreyLevels);
  std::vector<std::vector<double>> ofDirections;
  std::vector<PairDirection> directions;
  for (const PairDirection& direction : PairDirections())
  {
    CooccurrenceMatrix matrix(options.GreyLevels);
    AddPairs(volume.Levels.data(), volume.Size, window, direction, matrix);
    AddPairs(volume.Levels.data(), volume.Size, window, direction, merged);
    if (SumsOf(matrix).Pairs > 0)
    {
      ofDirections.push_back(PlainNormalised(matrix, options));
      directions.push_back(direction);
    }
  }
  std::vector<double> means(n), ranges(n), tensors;
  for (std::size_t k = 0; k < n; ++k)
  {
    double low = 1.0, high = 0.0;
    for (const std::vector<double>& values : ofDirections)
    {
      means[k] += values[k] / ofDirections.size();
      low = std::min(low, values[k]);
      high = std::max(high, values[k]);
    }
    ranges[k] = high - low;
    for (const auto& [a, b] : { std::pair(0, 0), { 1, 1 }, { 2, 2 }, { 0, 1 }, { 1, 2 }, { 0, 2 } })
    {
      // The mean weighted by products of the unit vector's components, against the plain mean.
      double weighted = 0.0, total = 0.0, absolute = 0.0, largest = 0.0;
      for (std::size_t d = 0; d < directions.size(); ++d)
      {
        const PairDirection& e = directions[d];
        const double product = 1.0 * e[a] * e[b] / (e[0] * e[0] + e[1] * e[1] + e[2] * e[2]);
        weighted += product * ofDirections[d][k];
        total += product;
        absolute += std::abs(product);
      }
      double value = 0.0;
      if (a != b)
      {
        value = absolute > 0.0 ? weighted / (0.5 * absolute) : 0.0;
      }
      else if (total > 0.0)
      {
        for (const PairDirection& e : directions)
        {
          const double square = e[0] * e[0] + e[1] * e[1] + e[2] * e[2];
          largest += std::max(0.0, e[a] * e[a] / square / total - 1.0 / directions.size());
        }
        value = largest > 1e-12 ? (weighted / total - means[k]) / largest : 0.0;
      }
      tensors.push_back(0.5 + 0.5 * value);
    }
  }
  std::vector<double> outputs = options.Merged ? PlainNormalised(merged, options) : means;
  if (options.Range)
  {
    outputs.insert(outputs.end(), ranges.begin(), ranges.end());
  }
  if (options.DirectionResolved)
  {
    outputs.insert(outputs.end(), tensors.begin(), tensors.end());
  }
  return outputs;
}

void ExpectPlainOutputs(const LevelVolume& volume, const TextureOptions& options)
{
  const std::vector<std::string> names = TextureOutputNames(options);
  const auto values = Compute<double>(volume, options);
  double worst = 0.0;
  std::string where;
  for (Index at = 0; at < volume.Voxels(); ++at)
  {
    const Size3 voxel = { at % volume.Size[0], at / volume.Size[0] % volume.Size[1],
      at / volume.Size[0] / volume.Size[1] };
    const std::vector<double> plain = PlainOutputs(volume, voxel, options);
    for (std::size_t k = 0; k < names.size(); ++k)
    {
      const double error = std::abs(values[k][at] - plain[k]);
      if (!(error <= worst))
      {
        worst = error;
        where = names[k] + " of voxel " + std::to_string(at);
      }
    }
  }
  EXPECT_LE(worst, 1e-12) << where << ", radius " << options.Radius << ", " << options.GreyLevels
                          << " levels, size " << volume.Size[0] << ' ' << volume.Size[1] << ' '
                          << volume.Size[2];
}

TextureOptions Everything(int radius, int levels)
{
  TextureOptions options;
  options.Radius = radius;
  options.GreyLevels = levels;
  options.Attributes = AllAttributes();
  options.Range = options.DirectionResolved = true;
  return options;
}
}

TEST(TextureWindow, IsThePlainRecomputationOfEveryWindow)
{
  unsigned seed = 0;
  for (int radius = 1; radius <= 3; ++radius)
  {
    for (const bool merged : { false, true })
    {
      TextureOptions options = Everything(radius, 6);
      options.Merged = merged;
      ExpectPlainOutputs(RandomVolume({ 11, 9, 8 }, 6, ++seed), options);
    }
  }
  ExpectPlainOutputs(RandomVolume({ 9, 8, 7 }, 16, ++seed), Everything(2, 16));
}

// Thinner than the window in every direction, down to planes, lines and one voxel.
TEST(TextureWindow, IsPlainOnThinVolumes)
{
  unsigned seed = 100;
  for (const Size3& size :
    { Size3{ 1, 1, 1 }, Size3{ 9, 1, 1 }, Size3{ 1, 9, 1 }, Size3{ 1, 1, 9 }, Size3{ 8, 7, 1 },
      Size3{ 8, 1, 7 }, Size3{ 1, 8, 7 }, Size3{ 2, 3, 9 }, Size3{ 2, 2, 2 }, Size3{ 9, 4, 2 } })
  {
    const LevelVolume volume = RandomVolume(size, 5, ++seed);
    for (const int radius : { 1, 2, 4 })
    {
      TextureOptions options = Everything(radius, 5);
      if (volume.Voxels() > 1)
      {
        ExpectPlainOutputs(volume, options);
        options.Merged = true;
        ExpectPlainOutputs(volume, options);
      }
    }
  }
}

TEST(TextureWindow, OfOneVoxelIsThatOfOneLevel)
{
  const LevelVolume volume{ { 1, 1, 1 }, { 2 } };
  const TextureOptions options = Everything(2, 4);
  const auto values = Compute<double>(volume, options);
  const TextureAttributeValues empty = ComputeTextureAttributes(CooccurrenceMatrix(4));
  const std::size_t n = options.Attributes.size();
  for (std::size_t k = 0; k < n; ++k)
  {
    EXPECT_DOUBLE_EQ(values[k][0], NormalisedTextureAttribute(options.Attributes[k], 4, empty[k]));
    EXPECT_EQ(values[n + k][0], 0.0);
    EXPECT_EQ(values[2 * n + 6 * k][0], 0.5);
  }
}

// Wider than a tile in x and y, with the numbers of levels that fill and overflow blocks of a
// table.
TEST(TextureWindow, IsPlainAcrossTilesAndForAnyNumberOfLevels)
{
  TextureOptions options;
  options.Range = true;
  for (const int levels : { 1, 2, 15, 17, 64 })
  {
    options.GreyLevels = levels;
    ExpectPlainOutputs(
      RandomVolume({ levels == 15 ? 200 : 7, levels == 17 ? 40 : 4, 2 }, levels, levels), options);
  }
}

TEST(TextureWindow, IsPlainForTheMostLevels)
{
  TextureOptions options;
  options.GreyLevels = 256;
  options.Radius = 1;
  ExpectPlainOutputs(RandomVolume({ 4, 2, 1 }, 256, 1), options);
}

// The largest windows: no count overflows.
TEST(TextureWindow, IsPlainForTheLargestRadius)
{
  for (const bool merged : { false, true })
  {
    TextureOptions options;
    options.Merged = merged;
    options.GreyLevels = 3;
    options.Radius = MaximumTextureRadius(options);
    EXPECT_EQ(options.Radius, merged ? 6 : 15);
    LevelVolume volume = RandomVolume({ 33, 33, 32 }, 3, 7);
    // Nearly all of one level: the largest counts.
    for (std::size_t at = 0; at < volume.Levels.size(); ++at)
    {
      volume.Levels[at] = at % 1001 == 0 ? volume.Levels[at] : 2;
    }
    const auto values = Compute<double>(volume, options, { 15, 15, 14 }, { 18, 17, 16 });
    const Size3 voxel = { 16, 16, 15 };
    const std::vector<double> plain = PlainOutputs(volume, voxel, options);
    for (std::size_t k = 0; k < plain.size(); ++k)
    {
      EXPECT_NEAR(values[k][6 + 3 + 1], plain[k], 1e-12)
        << TextureAttributeName(options.Attributes[k]);
    }
  }
}

// What distributed runs rely on: a part of the volume with a layer of ghosts around it.
TEST(TextureWindow, OfABlockWithGhostsIsThatOfTheWhole)
{
  const LevelVolume whole = RandomVolume({ 23, 20, 19 }, 8, 5);
  const TextureOptions options = Everything(2, 8);
  const auto values = Compute<float>(whole, options);
  const Size3 begin = { 7, 0, 11 }, end = { 15, 9, 19 };
  Size3 low, high;
  for (int a = 0; a < 3; ++a)
  {
    low[a] = std::max<Index>(0, begin[a] - options.Radius);
    high[a] = std::min(whole.Size[a], end[a] + options.Radius);
  }
  LevelVolume block{ { high[0] - low[0], high[1] - low[1], high[2] - low[2] }, {} };
  for (Index z = low[2]; z < high[2]; ++z)
  {
    for (Index y = low[1]; y < high[1]; ++y)
    {
      for (Index x = low[0]; x < high[0]; ++x)
      {
        block.Levels.push_back(whole.Levels[(z * 20 + y) * 23 + x]);
      }
    }
  }
  Size3 from, to;
  for (int a = 0; a < 3; ++a)
  {
    from[a] = begin[a] - low[a];
    to[a] = end[a] - low[a];
  }
  const auto ofBlock = Compute<float>(block, options, from, to);
  for (std::size_t k = 0; k < values.size(); ++k)
  {
    Index at = 0;
    for (Index z = begin[2]; z < end[2]; ++z)
    {
      for (Index y = begin[1]; y < end[1]; ++y)
      {
        for (Index x = begin[0]; x < end[0]; ++x, ++at)
        {
          ASSERT_EQ(ofBlock[k][at], values[k][(z * 20 + y) * 23 + x])
            << TextureOutputNames(options)[k];
        }
      }
    }
  }
}

TEST(TextureWindow, IsTheSameOnAnyNumberOfThreads)
{
  const LevelVolume volume = RandomVolume({ 120, 37, 9 }, 16, 6);
  TextureOptions options;
  options.Range = options.DirectionResolved = true;
  const auto one = Compute<float>(volume, options);
  for (const int threads : { 2, 3, 7 })
  {
    EXPECT_EQ(Compute<float>(volume, options, ThreadedExecution(threads)), one) << threads;
  }
}

// Layers of one profile, across x, y, z and diagonals: the means agree, the tensor does not.
TEST(TextureWindow, TensorTellsATextureFromItsRotation)
{
  TextureOptions options;
  options.GreyLevels = 4;
  options.Radius = 3;
  options.DirectionResolved = true;
  options.Attributes = { A::Contrast };
  const auto tensor = [&options](const std::array<int, 3>& normal)
  {
    LevelVolume volume{ { 15, 15, 15 }, {} };
    for (int at = 0; at < 15 * 15 * 15; ++at)
    {
      const int x = at % 15 - 7, y = at / 15 % 15 - 7, z = at / 225 - 7;
      volume.Levels.push_back((normal[0] * x + normal[1] * y + normal[2] * z + 400) % 4);
    }
    const auto values = Compute<double>(volume, options, { 7, 7, 7 }, { 8, 8, 8 });
    std::array<double, 7> result;
    std::transform(
      values.begin(), values.end(), result.begin(), [](const auto& array) { return array[0]; });
    return result;
  };
  const auto x = tensor({ 1, 0, 0 }), y = tensor({ 0, 1, 0 }), z = tensor({ 0, 0, 1 });
  EXPECT_NEAR(x[0], y[0], 1e-12);
  EXPECT_NEAR(x[0], z[0], 1e-12);
  // More contrast across the layers than along; the other axes are alike.
  EXPECT_GT(x[1], 0.6);
  EXPECT_LT(x[2], 0.45);
  EXPECT_NEAR(x[2], x[3], 1e-12);
  for (int e = 0; e < 3; ++e)
  {
    EXPECT_NEAR(y[1 + e], x[1 + (e + 2) % 3], 1e-12);
    EXPECT_NEAR(z[1 + e], x[1 + (e + 1) % 3], 1e-12);
    EXPECT_NEAR(x[4 + e], 0.5, 1e-12);
  }
  // The two diagonals of a face differ only off the tensor's diagonal.
  const auto plus = tensor({ 1, 1, 0 }), minus = tensor({ 1, -1, 0 });
  for (int e = 0; e < 4; ++e)
  {
    EXPECT_NEAR(plus[e], minus[e], 1e-12);
  }
  EXPECT_NEAR(plus[4] + minus[4], 1.0, 1e-12);
  EXPECT_GT(std::abs(plus[4] - minus[4]), 0.2);
}

TEST(TextureWindow, OutputNames)
{
  TextureOptions options;
  options.Attributes = { A::Contrast, A::SumEntropy };
  options.Range = options.DirectionResolved = true;
  const std::vector<std::string> names = { "Contrast", "SumEntropy", "ContrastRange",
    "SumEntropyRange", "ContrastXX", "ContrastYY", "ContrastZZ", "ContrastXY", "ContrastYZ",
    "ContrastXZ", "SumEntropyXX", "SumEntropyYY", "SumEntropyZZ", "SumEntropyXY", "SumEntropyYZ",
    "SumEntropyXZ" };
  EXPECT_EQ(TextureOutputNames(options), names);
}

TEST(TextureWindow, RefusesOptionsOutOfRange)
{
  const LevelVolume volume = RandomVolume({ 4, 4, 4 }, 2, 1);
  TextureOptions options;
  options.Radius = 0;
  EXPECT_THROW(Compute<float>(volume, options), std::invalid_argument);
  options.Radius = 16;
  EXPECT_THROW(Compute<float>(volume, options), std::invalid_argument);
  options.Radius = 2;
  options.GreyLevels = 257;
  EXPECT_THROW(Compute<float>(volume, options), std::invalid_argument);
  options.GreyLevels = 16;
  LevelVolume tooHigh = volume;
  tooHigh.Levels[17] = 16;
  EXPECT_THROW(Compute<float>(tooHigh, options), std::invalid_argument);
  std::vector<float*> tooFew;
  EXPECT_THROW(ComputeTexture(volume.Levels.data(), volume.Size, { 0, 0, 0 }, volume.Size,
                 TextureOptions(), tooFew),
    std::invalid_argument);
}

TEST(TextureWindow, StopsAndReportsProgress)
{
  const LevelVolume volume = RandomVolume({ 100, 60, 30 }, 8, 9);
  Execution execution;
  std::vector<double> reported;
  execution.Continue = [&reported](double done)
  {
    reported.push_back(done);
    return reported.size() < 3;
  };
  EXPECT_THROW(Compute<float>(volume, TextureOptions(), execution), Aborted);
  ASSERT_EQ(reported.size(), 3u);
  EXPECT_EQ(reported[0], 0.0);
  EXPECT_GT(reported[2], reported[1]);
  EXPECT_LT(reported[2], 0.5);
}
