// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "WholeSegments.h"

#include <algorithm>
#include <map>

namespace trivariate
{
namespace
{
constexpr int Rounds = 3;
constexpr std::int32_t Open = -1;

// Gives open voxels the label of most of their neighbours, layer by layer from the labelled ones.
void LabelOpenVoxels(
  std::vector<std::int32_t>& labels, const std::array<Index, 3>& size, std::vector<Index> open)
{
  const std::array<Index, 3> step{ 1, size[0], size[0] * size[1] };
  while (!open.empty())
  {
    std::vector<std::pair<Index, std::int32_t>> found;
    std::vector<Index> left;
    for (const Index at : open)
    {
      std::map<std::int32_t, int> votes;
      for (int a = 0; a < 3; ++a)
      {
        const Index i = at / step[a] % size[a];
        if (i > 0 && labels[at - step[a]] != Open)
        {
          ++votes[labels[at - step[a]]];
        }
        if (i + 1 < size[a] && labels[at + step[a]] != Open)
        {
          ++votes[labels[at + step[a]]];
        }
      }
      if (votes.empty())
      {
        left.push_back(at);
        continue;
      }
      const auto most = std::max_element(votes.begin(), votes.end(),
        [](const auto& a, const auto& b) { return a.second < b.second; });
      found.emplace_back(at, most->first);
    }
    for (const auto& [at, label] : found)
    {
      labels[at] = label;
    }
    if (found.empty())
    {
      for (const Index at : left)
      {
        labels[at] = 0; // nothing else is there
      }
      return;
    }
    open = std::move(left);
  }
}

TopologyChanges MakeOneWhole(std::vector<std::int32_t>& labels, const std::array<Index, 3>& size,
  std::int32_t segment, const TopologyOptions& options, const Execution& execution)
{
  std::vector<std::uint8_t> mask(labels.size());
  std::transform(labels.begin(), labels.end(), mask.begin(),
    [segment](std::int32_t label) { return label == segment; });
  const TopologyChanges changes = MakeSegmentWhole(mask, size, options, execution);
  std::vector<Index> open;
  for (Index at = 0; at < static_cast<Index>(labels.size()); ++at)
  {
    if (mask[at])
    {
      labels[at] = segment;
    }
    else if (labels[at] == segment)
    {
      labels[at] = Open;
      open.push_back(at);
    }
  }
  // The segment itself must not take back what it lost.
  for (std::size_t at = 0; at < labels.size(); ++at)
  {
    labels[at] = labels[at] == segment ? Open : labels[at];
  }
  LabelOpenVoxels(labels, size, std::move(open));
  for (std::size_t at = 0; at < labels.size(); ++at)
  {
    labels[at] = mask[at] ? segment : labels[at];
  }
  return changes;
}
}

//------------------------------------------------------------------------------
std::vector<SegmentChanges> MakeSegmentsWhole(std::vector<std::int32_t>& labels,
  const std::array<Index, 3>& size, const std::vector<std::int32_t>& segments,
  const TopologyOptions& options, const Execution& execution)
{
  std::vector<SegmentChanges> all(segments.size());
  for (int round = 0; round < Rounds; ++round)
  {
    bool changed = false;
    for (std::size_t i = 0; i < segments.size(); ++i)
    {
      const double done = double(round * segments.size() + i) / double(Rounds * segments.size());
      execution.Check(done);
      const TopologyChanges now =
        MakeOneWhole(labels, size, segments[i], options, execution.Part(done, done));
      SegmentChanges& sum = all[i];
      sum.Segment = segments[i];
      sum.Pieces += now.Pieces;
      sum.Cavities += now.Cavities;
      sum.Cut += now.Cut;
      sum.CutVoxels += now.CutVoxels;
      sum.Closed += now.Closed;
      sum.ClosedVoxels += now.ClosedVoxels;
      sum.EulerCharacteristic = now.EulerCharacteristic;
      changed |= now.Pieces + now.Cavities + now.CutVoxels + now.ClosedVoxels > 0;
    }
    if (!changed || segments.size() == 1)
    {
      break;
    }
  }
  for (SegmentChanges& changes : all)
  {
    changes.Voxels = std::count(labels.begin(), labels.end(), changes.Segment);
  }
  return all;
}
}
