// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "SegmentTopology.h"

#include "SimplePoint.h"

#include <algorithm>
#include <deque>
#include <iterator>
#include <limits>

namespace trivariate
{
namespace
{
// The volume with two layers of background around it, so that no neighbour is ever missing and the
// background is one piece there.
class Field
{
public:
  Field(const std::vector<std::uint8_t>& mask, const std::array<Index, 3>& size)
    : Inner(size)
    , Step{ 1, size[0] + 2 * Margin, (size[0] + 2 * Margin) * (size[1] + 2 * Margin) }
    , Object(this->Step[2] * (size[2] + 2 * Margin), 0)
  {
    for (int i = 0; i < 27; ++i)
    {
      this->Offset[i] = (i % 3 - 1) + (i / 3 % 3 - 1) * this->Step[1] + (i / 9 - 1) * this->Step[2];
    }
    for (Index at = 0; at < static_cast<Index>(this->Object.size()); ++at)
    {
      this->Object[at] = this->IsMargin(at, 1) ? Rim : 0;
    }
    this->Visit([&](Index inner, Index at) { this->Object[at] = mask[inner] != 0; });
  }

  void Store(std::vector<std::uint8_t>& mask)
  {
    this->Visit([&](Index inner, Index at) { mask[inner] = this->Object[at]; });
  }

  // Whether a voxel is outside of the volume.
  bool IsMargin(Index at, Index layers = Margin) const
  {
    for (int a = 0; a < 3; ++a)
    {
      const Index count = this->Inner[a] + 2 * Margin;
      const Index i = at / this->Step[a] % count;
      if (i < layers || i >= count - layers)
      {
        return true;
      }
    }
    return false;
  }

  static constexpr Index Margin = 2;
  static constexpr std::uint8_t Rim = 2; // in the outermost layer, which nothing ever changes
  std::array<Index, 3> Inner;
  std::array<Index, 3> Step;
  std::array<Index, 27> Offset;
  std::vector<std::uint8_t> Object; // 0, 1 or Rim

private:
  template <typename Body>
  void Visit(const Body& body)
  {
    Index inner = 0;
    for (Index z = 0; z < this->Inner[2]; ++z)
    {
      for (Index y = 0; y < this->Inner[1]; ++y)
      {
        Index at = Margin + (y + Margin) * this->Step[1] + (z + Margin) * this->Step[2];
        for (Index x = 0; x < this->Inner[0]; ++x)
        {
          body(inner++, at++);
        }
      }
    }
  }
};

constexpr std::array<int, 6> FaceNeighbours{ 4, 10, 12, 14, 16, 22 };

// Connected parts (by faces) of the voxels with set[at] == value, largest first.
std::vector<std::vector<Index>> Parts(
  const Field& field, const std::vector<std::uint8_t>& set, std::uint8_t value)
{
  std::vector<std::uint8_t> seen(set.size(), 0);
  std::vector<std::vector<Index>> parts;
  for (Index seed = 0; seed < static_cast<Index>(set.size()); ++seed)
  {
    if (seen[seed] || set[seed] != value)
    {
      continue;
    }
    std::vector<Index> part{ seed };
    seen[seed] = 1;
    for (std::size_t next = 0; next < part.size(); ++next)
    {
      for (const int n : FaceNeighbours)
      {
        const Index other = part[next] + field.Offset[n];
        if (!seen[other] && set[other] == value)
        {
          seen[other] = 1;
          part.push_back(other);
        }
      }
    }
    parts.push_back(std::move(part));
  }
  std::stable_sort(
    parts.begin(), parts.end(), [](const auto& a, const auto& b) { return a.size() > b.size(); });
  return parts;
}

// Distance from the voxels outside of the set, three a face step (the chamfer 3-4-5).
std::vector<std::uint16_t> Depths(const Field& field, std::uint8_t value)
{
  constexpr std::array<int, 4> cost{ 0, 3, 4, 5 };
  const Index n = static_cast<Index>(field.Object.size());
  std::vector<std::uint16_t> depth(n, 0);
  for (const bool forward : { true, false })
  {
    for (Index step = 0; step < n; ++step)
    {
      const Index at = forward ? step : n - 1 - step;
      if (field.Object[at] != value)
      {
        continue;
      }
      int least = forward ? std::numeric_limits<std::uint16_t>::max() : depth[at];
      for (int i = 0; i < 13; ++i)
      {
        const int k = forward ? i : 26 - i;
        const int steps = (k % 3 != 1) + (k / 3 % 3 != 1) + (k / 9 != 1);
        least = std::min(least, depth[at + field.Offset[k]] + cost[steps]);
      }
      depth[at] =
        static_cast<std::uint16_t>(std::min<int>(least, std::numeric_limits<std::uint16_t>::max()));
    }
  }
  return depth;
}

// Grows a ball within the voxels of `value`, deep ones first: from the deepest voxel, or from the
// rim where `fromRim`. Returns which voxels of `value` it could not take.
std::vector<std::uint8_t> Leftover(
  const Field& field, std::uint8_t value, bool fromRim, const Execution& execution)
{
  const Index n = static_cast<Index>(field.Object.size());
  std::vector<std::uint16_t> depth = Depths(field, value);
  std::vector<std::uint8_t> ball(n, 0);
  // First come, first served among voxels of one depth, so that fronts meet in flat sheets.
  std::vector<std::deque<Index>> waiting(1);
  const auto enqueue = [&](Index at)
  {
    if (!ball[at] && field.Object[at] == value)
    {
      waiting.resize(std::max<std::size_t>(waiting.size(), depth[at] + 1));
      waiting[depth[at]].push_back(at);
    }
  };
  const auto take = [&](Index at)
  {
    ball[at] = 1;
    for (int k = 0; k < 27; ++k)
    {
      enqueue(at + field.Offset[k]);
    }
  };
  if (fromRim)
  {
    for (Index at = 0; at < n; ++at)
    {
      ball[at] = field.IsMargin(at);
    }
    for (Index at = 0; at < n; ++at)
    {
      if (ball[at] && field.Object[at] != Field::Rim)
      {
        take(at);
      }
    }
  }
  else
  {
    take(std::max_element(depth.begin(), depth.end()) - depth.begin());
  }
  Index taken = 0;
  while (!waiting.empty())
  {
    if (waiting.back().empty())
    {
      waiting.pop_back();
      continue;
    }
    const Index at = waiting.back().front();
    waiting.back().pop_front();
    if (ball[at])
    {
      continue;
    }
    std::uint32_t around = 0;
    for (int k = 0; k < 27; ++k)
    {
      around |= static_cast<std::uint32_t>(ball[at + field.Offset[k]]) << k;
    }
    if (!IsSimple(around))
    {
      continue; // asked again when a neighbour is taken
    }
    if (++taken % 65536 == 0)
    {
      execution.Check(0.0);
    }
    take(at);
  }
  std::vector<std::uint8_t> left(n, 0);
  for (Index at = 0; at < n; ++at)
  {
    left[at] = field.Object[at] == value && !ball[at];
  }
  return left;
}

// Gives the sheets of at most `largest` voxels to the other side.
void ChangeSheets(Field& field, std::uint8_t value, Index largest, Index& sheets, Index& voxels,
  const Execution& execution)
{
  for (const std::vector<Index>& part :
    Parts(field, Leftover(field, value, value == 0, execution), 1))
  {
    if (static_cast<Index>(part.size()) <= largest)
    {
      ++sheets;
      voxels += static_cast<Index>(part.size());
      for (const Index at : part)
      {
        field.Object[at] = !value;
      }
    }
  }
}

// What is left of a cavity when its own handles are cut, which fills their sheets.
std::vector<Index> CutHandles(const Field& field, const std::vector<Index>& cavity,
  const TopologyOptions& options, TopologyChanges& changes, const Execution& execution)
{
  Field hollow = field;
  for (std::uint8_t& voxel : hollow.Object)
  {
    voxel = voxel == Field::Rim ? Field::Rim : 0;
  }
  for (const Index at : cavity)
  {
    hollow.Object[at] = 1;
  }
  ChangeSheets(hollow, 1, options.LargestSheet, changes.Closed, changes.ClosedVoxels, execution);
  std::vector<Index> left;
  std::copy_if(cavity.begin(), cavity.end(), std::back_inserter(left),
    [&hollow](Index at) { return hollow.Object[at] == 1; });
  return left;
}

// Vertices - edges + faces - cells of the closed voxels.
Index Euler(const Field& field)
{
  // Every vertex, edge, face and cell belongs to the voxel at its high end: counted there if any
  // voxel around it is in the object.
  Index sum = 0;
  const Index n = static_cast<Index>(field.Object.size());
  for (Index at = 0; at < n; ++at)
  {
    if (field.Object[at] == Field::Rim)
    {
      continue;
    }
    for (int element = 0; element < 8; ++element)
    {
      bool any = false;
      for (int corner = 0; corner < 8; ++corner)
      {
        if ((corner & element) == corner)
        {
          any |=
            field.Object[at - (corner & 1 ? field.Step[0] : 0) - (corner & 2 ? field.Step[1] : 0) -
                         (corner & 4 ? field.Step[2] : 0)] == 1;
        }
      }
      const int shared = __builtin_popcount(element); // directions shared with the neighbours
      sum += any ? (shared % 2 ? 1 : -1) : 0;
    }
  }
  return sum;
}
}

//------------------------------------------------------------------------------
TopologyChanges MakeSegmentWhole(std::vector<std::uint8_t>& mask, const std::array<Index, 3>& size,
  const TopologyOptions& options, const Execution& execution)
{
  Field field(mask, size);
  TopologyChanges changes;
  const std::vector<std::vector<Index>> pieces = Parts(field, field.Object, 1);
  for (std::size_t i = 1; i < pieces.size(); ++i)
  {
    changes.Pieces += static_cast<Index>(pieces[i].size());
    for (const Index at : pieces[i])
    {
      field.Object[at] = 0;
    }
  }
  if (pieces.empty())
  {
    return changes;
  }
  // Cavities that stay count as filled meanwhile: a way out of them would be no better.
  std::vector<Index> hollow;
  for (const std::vector<Index>& part : Parts(field, field.Object, 0))
  {
    // The background around everything begins at the first voxel inside the rim.
    const Index outside = 1 + field.Step[1] + field.Step[2];
    if (part.front() == outside)
    {
      continue;
    }
    if (static_cast<Index>(part.size()) <= options.LargestCavity)
    {
      changes.Cavities += static_cast<Index>(part.size());
    }
    else
    {
      const std::vector<Index> whole = CutHandles(field, part, options, changes, execution);
      hollow.insert(hollow.end(), whole.begin(), whole.end());
    }
    for (const Index at : part)
    {
      field.Object[at] = 1;
    }
  }
  for (Index largest = 4; Euler(field) != 1; largest *= 4)
  {
    largest = std::min(largest, options.LargestSheet);
    ChangeSheets(field, 0, largest, changes.Closed, changes.ClosedVoxels, execution);
    // Cutting comes last: what remains is the ball that was grown.
    ChangeSheets(field, 1, largest, changes.Cut, changes.CutVoxels, execution);
    if (largest == options.LargestSheet)
    {
      break;
    }
  }
  for (const Index at : hollow)
  {
    field.Object[at] = 0;
  }
  changes.EulerCharacteristic = Euler(field);
  field.Store(mask);
  return changes;
}
}
