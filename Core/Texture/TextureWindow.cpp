// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "TextureWindow.h"

#include "CooccurrenceSweep.h"
#include "GreyLevels.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <stdexcept>

namespace trivariate
{
namespace
{
using Size3 = std::array<Index, 3>;

// Voxels of a tile, what a thread works on at a time: small enough for its numbers to stay in the
// cache, large enough for the first window of a line and the first line to cost little.
constexpr Size3 TileSize = { 96, 16, 1 };
// The same with eigenproblems, which cost more than all else: work is stopped between tiles.
constexpr Size3 SmallTileSize = { 96, 1, 1 };

// The entries of a direction tensor: its axes, and its name.
struct TensorEntry
{
  int A, B;
  const char* Name;
};
constexpr TensorEntry TensorEntries[] = { { 0, 0, "XX" }, { 1, 1, "YY" }, { 2, 2, "ZZ" },
  { 0, 1, "XY" }, { 1, 2, "YZ" }, { 0, 2, "XZ" } };

Index PairsOfWindow(int radius)
{
  const Index width = 2 * radius + 1;
  return width * width * (width - 1);
}

// Pairs of all directions: of the axes, of the faces' diagonals, of the cube's.
Index PairsOfMergedWindow(int radius)
{
  const Index n = 2 * radius + 1, m = n - 1;
  return 3 * n * n * m + 6 * n * m * m + 4 * m * m * m;
}

// Directions in which the volume has pairs.
std::vector<PairDirection> UsableDirections(const Size3& size)
{
  std::vector<PairDirection> usable;
  for (const PairDirection& direction : PairDirections())
  {
    bool fits = true;
    for (int a = 0; a < 3; ++a)
    {
      fits = fits && std::abs(direction[a]) < size[a];
    }
    if (fits)
    {
      usable.push_back(direction);
    }
  }
  return usable;
}

// The weight of each direction's attribute in an entry of the tensor; sums from -1 to 1 come out
// for attributes from 0 to 1.
std::vector<double> TensorWeights(
  const std::vector<PairDirection>& directions, const TensorEntry& entry)
{
  std::vector<double> weights;
  double total = 0.0;
  for (const PairDirection& e : directions)
  {
    const double square = e[0] * e[0] + e[1] * e[1] + e[2] * e[2];
    weights.push_back(e[entry.A] * e[entry.B] / square);
    total += weights.back();
  }
  double positive = 0.0;
  for (double& weight : weights)
  {
    // Those off the diagonal sum to zero already, all of them in equal parts.
    weight = entry.A == entry.B && total > 0.0 ? weight / total - 1.0 / directions.size() : weight;
    positive += std::max(weight, 0.0);
  }
  for (double& weight : weights)
  {
    weight = positive > 0.0 ? weight / positive : 0.0;
  }
  return weights;
}

void CheckInput(
  const std::uint8_t* levels, const Size3& size, const TextureOptions& options, std::size_t arrays)
{
  if (options.GreyLevels < 1 || options.GreyLevels > MaximumGreyLevels)
  {
    throw std::invalid_argument("There can be 1 to " + std::to_string(MaximumGreyLevels) +
                                " grey levels, not " + std::to_string(options.GreyLevels) + ".");
  }
  const int largest = MaximumTextureRadius(options);
  if (options.Radius < 1 || options.Radius > largest)
  {
    throw std::invalid_argument("The radius of the texture window can be 1 to " +
                                std::to_string(largest) + " voxels, not " +
                                std::to_string(options.Radius) + ".");
  }
  if (arrays != TextureOutputNames(options).size())
  {
    throw std::invalid_argument("There must be one array for each name of the texture outputs.");
  }
  const std::uint8_t* end = levels + size[0] * size[1] * size[2];
  const std::uint8_t* highest = std::max_element(levels, end);
  if (highest != end && *highest >= options.GreyLevels)
  {
    throw std::invalid_argument("There is a voxel of level " + std::to_string(int(*highest)) +
                                ", but only levels 0 to " + std::to_string(options.GreyLevels - 1) +
                                " were announced.");
  }
}

// An attribute that was asked for, with the way from its bounds to [0, 1].
struct ScaledAttribute
{
  int Attribute;
  double Low, Scale;
};

// All that is the same for every voxel.
class Texture
{
public:
  Texture(const std::uint8_t* levels, const Size3& size, const TextureOptions& options)
    : Levels(levels)
    , Size(size)
    , Options(options)
    , Directions(UsableDirections(size))
    , Tables(options.GreyLevels,
        options.Merged ? PairsOfMergedWindow(options.Radius) : PairsOfWindow(options.Radius))
    , WithMaximalCorrelation(std::count(options.Attributes.begin(), options.Attributes.end(),
                               TextureAttribute::MaximalCorrelationCoefficient) > 0)
  {
    for (const TextureAttribute attribute : options.Attributes)
    {
      const auto [low, high] = TextureAttributeBounds(attribute, options.GreyLevels);
      this->ScaledAttributes.push_back(
        { static_cast<int>(attribute), low, high > low ? 1.0 / (high - low) : 0.0 });
    }
    for (const TensorEntry& entry : TensorEntries)
    {
      this->EntryWeights.push_back(TensorWeights(this->Directions, entry));
    }
  }

  // Calls body(at, value) for windows of these directions: value is an attribute in [0, 1], at its
  // place among [voxels of the tile, attributes].
  template <typename Body>
  void Sweep(
    const VoxelBox& tile, const std::vector<PairDirection>& directions, const Body& body) const
  {
    const Index width = tile.End[0] - tile.Begin[0];
    std::vector<CooccurrenceSums> sums(width);
    std::vector<double> correlations(this->WithMaximalCorrelation ? width : 0);
    CooccurrenceSweep sweep(
      this->Tables, this->Levels, this->Size, this->Options.Radius, directions);
    sweep.Begin(tile);
    TextureAttributeValues values = {};
    std::size_t at = 0;
    for (Index y = tile.Begin[1]; y < tile.End[1]; ++y)
    {
      sweep.NextLine(sums.data(), this->WithMaximalCorrelation ? correlations.data() : nullptr);
      for (Index x = 0; x < width; ++x)
      {
        // Where nothing changes from voxel to voxel, nothing is to be computed.
        if (x == 0 || !(sums[x] == sums[x - 1]))
        {
          ComputeTextureAttributes(sums[x], values);
        }
        if (this->WithMaximalCorrelation)
        {
          values[static_cast<int>(TextureAttribute::MaximalCorrelationCoefficient)] =
            correlations[x];
        }
        for (const ScaledAttribute& scaled : this->ScaledAttributes)
        {
          body(at++, (values[scaled.Attribute] - scaled.Low) * scaled.Scale);
        }
      }
    }
  }

  const std::uint8_t* Levels;
  const Size3& Size;
  const TextureOptions& Options;
  const std::vector<PairDirection> Directions;
  const PairTables Tables;
  const bool WithMaximalCorrelation;
  std::vector<ScaledAttribute> ScaledAttributes;
  std::vector<std::vector<double>> EntryWeights; // [entry][direction]
};

// What the directions' attributes of a tile's voxels sum up to, in the order of the directions.
class TileOutputs
{
public:
  TileOutputs(const Texture& texture, const VoxelBox& tile)
    : Source(texture)
    , Tile(tile)
    , Attributes(texture.Options.Attributes.size())
  {
    const TextureOptions& options = texture.Options;
    const std::size_t n =
      (tile.End[0] - tile.Begin[0]) * (tile.End[1] - tile.Begin[1]) * this->Attributes;
    const bool merged = options.Merged || texture.Directions.empty();
    this->Summands = merged ? 1.0 : static_cast<double>(texture.Directions.size());
    this->Mean.resize(n);
    this->Lowest.resize(options.Range ? n : 0, 1.0);
    this->Highest.resize(options.Range ? n : 0, 0.0);
    this->Tensor.resize(options.DirectionResolved ? n * std::size(TensorEntries) : 0);
    if (merged)
    {
      texture.Sweep(
        tile, texture.Directions, [this](std::size_t at, double value) { this->Mean[at] = value; });
    }
    if (merged && !options.Range && !options.DirectionResolved)
    {
      return;
    }
    for (std::size_t d = 0; d < texture.Directions.size(); ++d)
    {
      texture.Sweep(tile, { texture.Directions[d] },
        [this, merged, d](std::size_t at, double value)
        {
          this->Mean[at] += merged ? 0.0 : value;
          this->AddDirection(at, d, value);
        });
    }
  }

  template <typename Real>
  void Write(const Size3& begin, const Size3& end, const std::vector<Real*>& out) const
  {
    std::size_t at = 0;
    for (Index y = this->Tile.Begin[1]; y < this->Tile.End[1]; ++y)
    {
      const Index row = ((this->Tile.Begin[2] - begin[2]) * (end[1] - begin[1]) + y - begin[1]) *
                          (end[0] - begin[0]) -
                        begin[0];
      for (Index voxel = row + this->Tile.Begin[0]; voxel < row + this->Tile.End[0]; ++voxel)
      {
        for (std::size_t k = 0; k < this->Attributes; ++k, ++at)
        {
          this->WriteAttribute(at, k, voxel, out);
        }
      }
    }
  }

private:
  const Texture& Source;
  const VoxelBox& Tile;
  std::size_t Attributes;
  double Summands; // of a mean
  // [voxel, attribute], the tensor also [entry].
  std::vector<double> Mean, Lowest, Highest, Tensor;

  void AddDirection(std::size_t at, std::size_t direction, double value)
  {
    if (!this->Lowest.empty())
    {
      this->Lowest[at] = std::min(this->Lowest[at], value);
      this->Highest[at] = std::max(this->Highest[at], value);
    }
    if (!this->Tensor.empty())
    {
      for (std::size_t e = 0; e < std::size(TensorEntries); ++e)
      {
        this->Tensor[at * std::size(TensorEntries) + e] +=
          this->Source.EntryWeights[e][direction] * value;
      }
    }
  }

  template <typename Real>
  void WriteAttribute(
    std::size_t at, std::size_t attribute, Index voxel, const std::vector<Real*>& out) const
  {
    const auto clamped = [](double value)
    { return static_cast<Real>(std::min(std::max(value, 0.0), 1.0)); };
    out[attribute][voxel] = clamped(this->Mean[at] / this->Summands);
    std::size_t first = this->Attributes;
    if (!this->Lowest.empty())
    {
      out[first + attribute][voxel] = clamped(this->Highest[at] - this->Lowest[at]);
      first += this->Attributes;
    }
    const std::size_t entries = this->Tensor.empty() ? 0 : std::size(TensorEntries);
    for (std::size_t e = 0; e < entries; ++e)
    {
      out[first + attribute * entries + e][voxel] =
        clamped(0.5 + 0.5 * this->Tensor[at * entries + e]);
    }
  }
};

// [begin, end) cut into tiles.
struct Tiling
{
  Size3 Begin, End, Tiles, Count;

  Tiling(const Size3& begin, const Size3& end, const Size3& tileSize)
    : Begin(begin)
    , End(end)
    , Tiles(tileSize)
  {
    for (int a = 0; a < 3; ++a)
    {
      this->Count[a] = std::max<Index>(0, end[a] - begin[a] + tileSize[a] - 1) / tileSize[a];
    }
  }

  Index Size() const { return this->Count[0] * this->Count[1] * this->Count[2]; }

  VoxelBox Tile(Index i) const
  {
    const Size3 place = { i % this->Count[0], i / this->Count[0] % this->Count[1],
      i / this->Count[0] / this->Count[1] };
    VoxelBox tile;
    for (int a = 0; a < 3; ++a)
    {
      tile.Begin[a] = this->Begin[a] + place[a] * this->Tiles[a];
      tile.End[a] = std::min(this->End[a], tile.Begin[a] + this->Tiles[a]);
    }
    return tile;
  }
};
}

//------------------------------------------------------------------------------
int MaximumTextureRadius(const TextureOptions& options)
{
  int radius = 1;
  while (
    (options.Merged ? PairsOfMergedWindow(radius + 1) : PairsOfWindow(radius + 1)) <= MostPairs)
  {
    ++radius;
  }
  return radius;
}

//------------------------------------------------------------------------------
std::vector<std::string> TextureOutputNames(const TextureOptions& options)
{
  std::vector<std::string> names, ranges, tensors;
  for (const TextureAttribute attribute : options.Attributes)
  {
    const std::string name = TextureAttributeName(attribute);
    names.push_back(name);
    ranges.push_back(name + "Range");
    for (const TensorEntry& entry : TensorEntries)
    {
      tensors.push_back(name + entry.Name);
    }
  }
  if (options.Range)
  {
    names.insert(names.end(), ranges.begin(), ranges.end());
  }
  if (options.DirectionResolved)
  {
    names.insert(names.end(), tensors.begin(), tensors.end());
  }
  return names;
}

//------------------------------------------------------------------------------
template <typename Real>
void ComputeTexture(const std::uint8_t* levels, const std::array<Index, 3>& size,
  const std::array<Index, 3>& begin, const std::array<Index, 3>& end, const TextureOptions& options,
  const std::vector<Real*>& out, const Execution& execution)
{
  CheckInput(levels, size, options, out.size());
  const Texture texture(levels, size, options);
  const Tiling tiling(begin, end, texture.WithMaximalCorrelation ? SmallTileSize : TileSize);
  const Index count = tiling.Size();
  // How many tiles take a few tenths of a second depends on the options.
  constexpr double longest = 0.3;
  Index batch = 1;
  for (Index first = 0; first < count;)
  {
    execution.Check(static_cast<double>(first) / count);
    const auto start = std::chrono::steady_clock::now();
    batch = std::min(batch, count - first);
    execution.ParallelFor(batch,
      [&texture, &tiling, &out, first](Index from, Index to)
      {
        for (Index i = first + from; i < first + to; ++i)
        {
          const VoxelBox tile = tiling.Tile(i);
          TileOutputs(texture, tile).Write(tiling.Begin, tiling.End, out);
        }
      });
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
    first += batch;
    batch = std::max<Index>(1, std::min(2.0 * batch, batch * longest / passed.count()));
  }
}

template void ComputeTexture(const std::uint8_t*, const std::array<Index, 3>&,
  const std::array<Index, 3>&, const std::array<Index, 3>&, const TextureOptions&,
  const std::vector<float*>&, const Execution&);
template void ComputeTexture(const std::uint8_t*, const std::array<Index, 3>&,
  const std::array<Index, 3>&, const std::array<Index, 3>&, const TextureOptions&,
  const std::vector<double*>&, const Execution&);
}
