// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "InterfacePlacement.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace trivariate
{
namespace
{
constexpr int DIRECTIONS = 13;
// A segment is measured where it is certain, unless fewer voxels than this are.
constexpr Index ENOUGH_VOXELS = 500;
// Pairs count as if they were expected and seen so often more, and by this share of all pairs more:
// a few stray voxels of another material look alike, which says nothing about the segment.
constexpr double PSEUDO_PAIRS = 10.0;
constexpr double PSEUDO_SHARE = 0.002;
// Of one pair, so that no single pair decides; what is rare is less telling than what is frequent.
constexpr double MOST_INFORMATION = 2.5;
constexpr double MOST_CONTRADICTION = 0.4;
// This share of a segment's voxels has a level near one that was seen, falling by e each 1/16 of
// the range: an unseen level, for example a mixture's, belongs to the segment nearest to it.
constexpr double STRAY_SHARE = 0.1;
constexpr double MOST_EVIDENCE = 4.0; // of one voxel's own level

using Size3 = std::array<Index, 3>;

// One of each pair of opposite neighbours.
constexpr int STEPS[DIRECTIONS][3] = { { 1, 0, 0 }, { -1, 1, 0 }, { 0, 1, 0 }, { 1, 1, 0 },
  { -1, -1, 1 }, { 0, -1, 1 }, { 1, -1, 1 }, { -1, 0, 1 }, { 0, 0, 1 }, { 1, 0, 1 }, { -1, 1, 1 },
  { 0, 1, 1 }, { 1, 1, 1 } };

//------------------------------------------------------------------------------
// A volume whose voxels know their neighbours.
struct Grid
{
  Size3 Size;
  std::array<Index, DIRECTIONS> Offsets;

  explicit Grid(const Size3& size)
    : Size(size)
  {
    for (int d = 0; d < DIRECTIONS; ++d)
    {
      this->Offsets[d] = STEPS[d][0] + size[0] * (STEPS[d][1] + size[1] * STEPS[d][2]);
    }
  }

  Size3 At(Index id) const
  {
    return { id % this->Size[0], id / this->Size[0] % this->Size[1],
      id / (this->Size[0] * this->Size[1]) };
  }

  bool Has(const Size3& p, int direction, int sign) const
  {
    for (int a = 0; a < 3; ++a)
    {
      const Index x = p[a] + sign * STEPS[direction][a];
      if (x < 0 || x >= this->Size[a])
      {
        return false;
      }
    }
    return true;
  }
};

//------------------------------------------------------------------------------
// What is known about each segment: logarithms, one table a segment (and direction).
struct Model
{
  int Levels, Segments;
  std::vector<float> Own;  // [segment][level]
  std::vector<float> Pair; // [segment][direction][level][level of the neighbour]

  const float* PairsOf(int direction, int a, int b, Index& stride) const
  {
    stride = static_cast<Index>(DIRECTIONS) * this->Levels * this->Levels;
    return &this->Pair[(static_cast<Index>(direction) * this->Levels + a) * this->Levels + b];
  }
};

// Integer counts, so that their order does not matter.
struct Counts
{
  std::vector<Index> Own, Pair;
};

Counts Count(const std::vector<Label>& labels, const std::vector<std::uint8_t>& levels,
  const std::vector<std::uint8_t>& certain, const Grid& grid, int levelCount, int segments)
{
  Counts counts;
  counts.Own.assign(segments * levelCount, 0);
  counts.Pair.assign(static_cast<Index>(segments) * DIRECTIONS * levelCount * levelCount, 0);
  Index id = 0;
  for (Index z = 0; z < grid.Size[2]; ++z)
  {
    for (Index y = 0; y < grid.Size[1]; ++y)
    {
      for (Index x = 0; x < grid.Size[0]; ++x, ++id)
      {
        if (!certain[id])
        {
          continue;
        }
        const Index label = labels[id];
        ++counts.Own[label * levelCount + levels[id]];
        for (int d = 0; d < DIRECTIONS; ++d)
        {
          const Index other = id + grid.Offsets[d];
          if (grid.Has({ x, y, z }, d, 1) && certain[other] && labels[other] == label)
          {
            ++counts.Pair[((label * DIRECTIONS + d) * levelCount + levels[id]) * levelCount +
                          levels[other]];
          }
        }
      }
    }
  }
  return counts;
}

//------------------------------------------------------------------------------
Model MakeModel(const Counts& counts, int levels, int segments)
{
  Model model = { levels, segments, std::vector<float>(counts.Own.size()),
    std::vector<float>(counts.Pair.size()) };
  std::vector<double> share(counts.Own.size()), likely(counts.Own.size(), 0.0);
  for (int l = 0; l < segments; ++l)
  {
    const Index* own = &counts.Own[l * levels];
    double total = 0.0;
    for (int i = 0; i < levels; ++i)
    {
      total += static_cast<double>(own[i]);
    }
    for (int i = 0; i < levels; ++i)
    {
      share[l * levels + i] = static_cast<double>(own[i]) / std::max(1.0, total);
    }
    const auto tail = [levels](int i, int j) { return std::exp(-16.0 * std::abs(i - j) / levels); };
    for (int i = 0; i < levels; ++i)
    {
      double norm = 0.0;
      for (int j = 0; j < levels; ++j)
      {
        norm += tail(i, j);
      }
      for (int j = 0; j < levels; ++j)
      {
        likely[l * levels + j] += share[l * levels + i] * ((1.0 - STRAY_SHARE) * (i == j) +
                                                            STRAY_SHARE * tail(i, j) / norm);
      }
    }
  }
  for (int i = 0; i < levels; ++i)
  {
    double most = std::numeric_limits<double>::min();
    for (int l = 0; l < segments; ++l)
    {
      most = std::max(most, likely[l * levels + i]);
    }
    for (int l = 0; l < segments; ++l)
    {
      const double least = most * std::exp(-MOST_EVIDENCE);
      model.Own[l * levels + i] =
        static_cast<float>(std::log(std::max(least, likely[l * levels + i]) / most));
    }
  }
  const Index table = static_cast<Index>(levels) * levels;
  for (Index t = 0; t < static_cast<Index>(segments) * DIRECTIONS; ++t)
  {
    const Index* pair = &counts.Pair[t * table];
    const double* own = &share[t / DIRECTIONS * levels];
    double total = 0.0;
    for (Index i = 0; i < table; ++i)
    {
      total += static_cast<double>(pair[i]);
    }
    for (Index i = 0; i < table; ++i)
    {
      const double expected = total * own[i / levels] * own[i % levels];
      const double pseudo = PSEUDO_PAIRS + PSEUDO_SHARE * total;
      const double information =
        std::log((static_cast<double>(pair[i]) + pseudo) / (expected + pseudo));
      model.Pair[t * table + i] =
        static_cast<float>(std::clamp(information, -MOST_CONTRADICTION, MOST_INFORMATION));
    }
  }
  // A neighbour of the same label never speaks against it: or else labels would alternate where
  // rare pairs are many, as in the ramp from one density to another. So the least information of
  // all segments counts nothing.
  const Index tables = DIRECTIONS * table;
  for (Index i = 0; i < tables; ++i)
  {
    float least = std::numeric_limits<float>::infinity();
    for (int l = 0; l < segments; ++l)
    {
      least = std::min(least, model.Pair[l * tables + i]);
    }
    for (int l = 0; l < segments; ++l)
    {
      model.Pair[l * tables + i] -= least;
    }
  }
  return model;
}

//------------------------------------------------------------------------------
// The voxels near interfaces with the probabilities of their labels.
class MeanField
{
public:
  MeanField(const std::vector<Label>& labels, const std::vector<std::uint8_t>& levels,
    const std::vector<std::uint8_t>& near, const Grid& grid, const Model& model,
    const PlacementOptions& options, const Execution& execution)
    : Labels(labels)
    , Levels(levels)
    , Volume(grid)
    , Likelihood(model)
    , Slot(labels.size(), -1)
  {
    for (std::size_t id = 0; id < near.size(); ++id)
    {
      if (near[id])
      {
        this->Slot[id] = static_cast<std::int32_t>(this->Voxels.size());
        this->Voxels.push_back(static_cast<Index>(id));
      }
    }
    this->StartEven(options.Reach, execution);
  }

  Index Count() const { return static_cast<Index>(this->Voxels.size()); }
  Index Voxel(Index slot) const { return this->Voxels[slot]; }

  Label MostProbable(Index slot) const
  {
    const float* q = &this->Now[slot * this->Likelihood.Segments];
    return static_cast<Label>(std::max_element(q, q + this->Likelihood.Segments) - q);
  }

  // All voxels at once from the probabilities before, half of the way, so that it settles.
  void Step(double smoothness, const Execution& execution)
  {
    execution.ParallelFor(this->Count(),
      [this, smoothness](Index begin, Index end)
      {
        std::vector<double> evidence(this->Likelihood.Segments);
        for (Index slot = begin; slot < end; ++slot)
        {
          this->Update(slot, smoothness, evidence);
        }
      });
    this->Now.swap(this->Next);
  }

private:
  // Every label within reach is equally probable: the evidence decides, not where clustering has
  // put the interface.
  void StartEven(int reach, const Execution& execution)
  {
    const int segments = this->Likelihood.Segments;
    this->Now.assign(this->Count() * segments, 0.0f);
    for (int l = 0; l < segments; ++l)
    {
      std::vector<std::uint8_t> mask(this->Labels.size());
      std::transform(this->Labels.begin(), this->Labels.end(), mask.begin(),
        [l](Label label) { return static_cast<std::uint8_t>(label == l); });
      Dilate(mask, this->Volume.Size, reach, execution);
      for (Index slot = 0; slot < this->Count(); ++slot)
      {
        this->Now[slot * segments + l] = mask[this->Voxels[slot]];
      }
    }
    for (Index slot = 0; slot < this->Count(); ++slot)
    {
      float* q = &this->Now[slot * segments];
      const float sum = static_cast<float>(std::count(q, q + segments, 1.0f));
      std::for_each(q, q + segments, [sum](float& value) { value /= sum; });
    }
    this->Next.resize(this->Now.size());
  }

  void Update(Index slot, double smoothness, std::vector<double>& evidence)
  {
    const int segments = this->Likelihood.Segments;
    const Index id = this->Voxels[slot];
    const Size3 p = this->Volume.At(id);
    std::fill(evidence.begin(), evidence.end(), 0.0);
    int neighbours = 0;
    for (int d = 0; d < DIRECTIONS; ++d)
    {
      for (const int sign : { -1, 1 })
      {
        if (!this->Volume.Has(p, d, sign))
        {
          continue;
        }
        ++neighbours;
        const Index other = id + sign * this->Volume.Offsets[d];
        const int a = this->Levels[sign > 0 ? id : other], b = this->Levels[sign > 0 ? other : id];
        Index stride;
        const float* pairs = this->Likelihood.PairsOf(d, a, b, stride);
        const std::int32_t otherSlot = this->Slot[other];
        if (otherSlot < 0)
        {
          const Label l = this->Labels[other];
          evidence[l] += pairs[l * stride] + smoothness;
          continue;
        }
        const float* q = &this->Now[static_cast<Index>(otherSlot) * segments];
        for (int l = 0; l < segments; ++l)
        {
          evidence[l] += q[l] * (pairs[l * stride] + smoothness);
        }
      }
    }
    // A label that was out of reach stays so. At the border there is less evidence, not weaker.
    const float* now = &this->Now[slot * segments];
    double most = -std::numeric_limits<double>::infinity();
    for (int l = 0; l < segments; ++l)
    {
      evidence[l] = now[l] > 0.0f
                      ? this->Likelihood.Own[l * this->Likelihood.Levels + this->Levels[id]] +
                          evidence[l] * 2.0 * DIRECTIONS / neighbours
                      : -std::numeric_limits<double>::infinity();
      most = std::max(most, evidence[l]);
    }
    double sum = 0.0;
    for (double& e : evidence)
    {
      e = std::exp(e - most);
      sum += e;
    }
    for (int l = 0; l < segments; ++l)
    {
      this->Next[slot * segments + l] = static_cast<float>(0.5 * (now[l] + evidence[l] / sum));
    }
  }

  const std::vector<Label>& Labels;
  const std::vector<std::uint8_t>& Levels;
  const Grid& Volume;
  const Model& Likelihood;
  std::vector<std::int32_t> Slot; // of each voxel; -1: its label is certain
  std::vector<Index> Voxels;      // of each slot
  std::vector<float> Now, Next;   // [slot][segment]
};
}

//------------------------------------------------------------------------------
void Dilate(std::vector<std::uint8_t>& mask, const std::array<Index, 3>& size, int radius,
  const Execution& execution)
{
  const std::array<Index, 3> stride = { 1, size[0], size[0] * size[1] };
  for (int axis = 0; axis < 3; ++axis)
  {
    const int a = axis == 0 ? 1 : 0, b = axis == 2 ? 1 : 2;
    execution.ParallelFor(size[b],
      [&](Index begin, Index end)
      {
        std::vector<std::uint8_t> line(size[axis]);
        for (Index line2 = begin * size[a]; line2 < end * size[a]; ++line2)
        {
          const Index first = line2 % size[a] * stride[a] + line2 / size[a] * stride[b];
          Index last = -radius - 1; // the last voxel so far that is set, then the next one
          for (Index i = 0; i < size[axis]; ++i)
          {
            last = mask[first + i * stride[axis]] ? i : last;
            line[i] = i - last <= radius;
          }
          last = size[axis] + radius + 1;
          for (Index i = size[axis] - 1; i >= 0; --i)
          {
            last = mask[first + i * stride[axis]] ? i : last;
            line[i] |= last - i <= radius;
          }
          for (Index i = 0; i < size[axis]; ++i)
          {
            mask[first + i * stride[axis]] = line[i];
          }
        }
      });
  }
}

//------------------------------------------------------------------------------
std::vector<std::uint8_t> NearInterfaces(const std::vector<Label>& labels,
  const std::array<Index, 3>& size, int reach, const Execution& execution)
{
  std::vector<std::uint8_t> near(labels.size(), 0);
  const std::array<Index, 3> stride = { 1, size[0], size[0] * size[1] };
  Index id = 0;
  for (Index z = 0; z < size[2]; ++z)
  {
    for (Index y = 0; y < size[1]; ++y)
    {
      for (Index x = 0; x < size[0]; ++x, ++id)
      {
        const std::array<Index, 3> p = { x, y, z };
        for (int a = 0; a < 3; ++a)
        {
          if (p[a] > 0 && labels[id] != labels[id - stride[a]])
          {
            near[id] = near[id - stride[a]] = 1;
          }
        }
      }
    }
  }
  Dilate(near, size, reach - 1, execution);
  return near;
}

//------------------------------------------------------------------------------
void PlaceInterfaces(std::vector<Label>& labels, const std::vector<std::uint8_t>& levels,
  const std::array<Index, 3>& size, int segments, const PlacementOptions& options,
  const Execution& execution)
{
  const Grid grid(size);
  const std::vector<std::uint8_t> near = NearInterfaces(labels, size, options.Reach, execution);
  const std::vector<std::uint8_t> touching = NearInterfaces(labels, size, 1, execution);
  std::vector<Index> inside(segments, 0);
  for (std::size_t id = 0; id < labels.size(); ++id)
  {
    inside[labels[id]] += !near[id];
  }
  std::vector<std::uint8_t> certain(labels.size());
  for (std::size_t id = 0; id < labels.size(); ++id)
  {
    certain[id] = inside[labels[id]] > ENOUGH_VOXELS ? !near[id] : !touching[id];
  }
  const Model model = MakeModel(Count(labels, levels, certain, grid, options.GreyLevels, segments),
    options.GreyLevels, segments);
  MeanField field(labels, levels, near, grid, model, options, execution);
  for (int i = 0; i < options.Iterations; ++i)
  {
    execution.Check(static_cast<double>(i) / options.Iterations);
    field.Step(options.Smoothness * std::min(1.0, 2.0 * i / options.Iterations), execution);
  }
  for (Index slot = 0; slot < field.Count(); ++slot)
  {
    labels[field.Voxel(slot)] = field.MostProbable(slot);
  }
}
}
