// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "SegmentShells.h"

#include "Texture/InterfacePlacement.h"

#include <algorithm>

namespace trivariate
{
namespace
{
constexpr Label REST = 255; // no part of a thin layer
// At least this share of the faces to other segments must touch the two sides, and of these at
// least that share each of them.
constexpr double SHARE_OF_SIDES = 0.9;
constexpr double SHARE_OF_SIDE = 0.2;
// Between: so far along the line from one side's centre to the other's, and no farther away from
// the line than this share of their distance.
constexpr double LEAST_ALONG = 0.05;
constexpr double MOST_ASIDE = 0.6;

//------------------------------------------------------------------------------
// Labels where a segment is thin, REST elsewhere.
std::vector<Label> ThinParts(const std::vector<Label>& labels, const std::array<Index, 3>& size,
  int segments, int radius, const Execution& execution)
{
  std::vector<Label> thin(labels.size(), REST);
  std::vector<std::uint8_t> mask(labels.size());
  for (int l = 0; l < segments; ++l)
  {
    // Dilate all else, which erodes the segment; dilating what is left opens it. The border of the
    // volume is no border of the segment.
    std::transform(labels.begin(), labels.end(), mask.begin(),
      [l](Label label) { return static_cast<std::uint8_t>(label != l); });
    Dilate(mask, size, radius, execution);
    std::transform(mask.begin(), mask.end(), mask.begin(),
      [](std::uint8_t set) { return static_cast<std::uint8_t>(!set); });
    Dilate(mask, size, radius, execution);
    for (std::size_t id = 0; id < labels.size(); ++id)
    {
      if (labels[id] == l && !mask[id])
      {
        thin[id] = labels[id];
      }
    }
  }
  return thin;
}

bool IsBetween(const double* centre, const double* a, const double* b, int dimensions)
{
  double along = 0.0, length = 0.0, distance = 0.0;
  for (int d = 0; d < dimensions; ++d)
  {
    along += (centre[d] - a[d]) * (b[d] - a[d]);
    length += (b[d] - a[d]) * (b[d] - a[d]);
    distance += (centre[d] - a[d]) * (centre[d] - a[d]);
  }
  if (length <= 0.0)
  {
    return false;
  }
  const double t = along / length;
  return t > LEAST_ALONG && t < 1.0 - LEAST_ALONG &&
         distance / length - t * t < MOST_ASIDE * MOST_ASIDE;
}

//------------------------------------------------------------------------------
// Calls f(voxel, neighbour) for both directions of every face.
template <typename F>
void ForNeighbours(const std::array<Index, 3>& size, Index id, const F& f)
{
  const Index stride[3] = { 1, size[0], size[0] * size[1] };
  const Index p[3] = { id % size[0], id / size[0] % size[1], id / stride[2] };
  for (int a = 0; a < 3; ++a)
  {
    if (p[a] > 0)
    {
      f(id - stride[a]);
    }
    if (p[a] + 1 < size[a])
    {
      f(id + stride[a]);
    }
  }
}
}

//------------------------------------------------------------------------------
Index RemoveShells(std::vector<Label>& labels, const std::array<Index, 3>& size,
  const PointRows& centres, int radius, const Execution& execution)
{
  const int segments = static_cast<int>(centres.Count);
  if (segments < 3)
  {
    return 0; // there are no two others
  }
  const LabelComponents parts =
    FindComponents(ThinParts(labels, size, segments, radius, execution), size);
  std::vector<Index> faces(static_cast<std::size_t>(parts.Count()) * segments, 0);
  for (std::size_t id = 0; id < labels.size(); ++id)
  {
    const std::int32_t part = parts.Component[id];
    if (parts.Labels[part] != REST)
    {
      ForNeighbours(size, static_cast<Index>(id),
        [&](Index other)
        { faces[part * segments + labels[other]] += labels[other] != labels[id]; });
    }
  }

  std::vector<std::array<Label, 2>> sides(parts.Count(), { REST, REST });
  for (int part = 0; part < parts.Count(); ++part)
  {
    if (parts.Labels[part] == REST)
    {
      continue;
    }
    const Index* touched = &faces[static_cast<Index>(part) * segments];
    Index all = 0;
    int first = 0, second = -1; // the labels with most faces
    for (int l = 0; l < segments; ++l)
    {
      all += touched[l];
      first = touched[l] > touched[first] ? l : first;
    }
    for (int l = 0; l < segments; ++l)
    {
      second = l != first && (second < 0 || touched[l] > touched[second]) ? l : second;
    }
    const double both = static_cast<double>(touched[first] + touched[second]);
    if (all > 0 && both >= SHARE_OF_SIDES * static_cast<double>(all) &&
        static_cast<double>(touched[second]) >= SHARE_OF_SIDE * both &&
        IsBetween(centres.Row(parts.Labels[part]), centres.Row(first), centres.Row(second),
          centres.Dimensions))
    {
      sides[part] = { static_cast<Label>(first), static_cast<Label>(second) };
    }
  }

  // Both sides grow into the shell at the same pace: layer by layer, decided by the layer before.
  std::vector<Index> front, next;
  const auto isShell = [&](Index id) { return sides[parts.Component[id]][0] != REST; };
  std::vector<std::uint8_t> done(labels.size(), 0);
  for (std::size_t id = 0; id < labels.size(); ++id)
  {
    done[id] = !isShell(static_cast<Index>(id));
    if (!done[id])
    {
      front.push_back(static_cast<Index>(id));
    }
  }
  const Index count = static_cast<Index>(front.size());
  std::vector<std::pair<Index, Label>> decided;
  do
  {
    decided.clear();
    next.clear();
    for (const Index id : front)
    {
      const std::array<Label, 2>& side = sides[parts.Component[id]];
      int votes[2] = { 0, 0 };
      ForNeighbours(size, id,
        [&](Index other)
        {
          votes[0] += done[other] && labels[other] == side[0];
          votes[1] += done[other] && labels[other] == side[1];
        });
      if (votes[0] + votes[1] > 0)
      {
        decided.push_back({ id, side[votes[1] > votes[0]] });
      }
      else
      {
        next.push_back(id);
      }
    }
    for (const auto& [id, label] : decided)
    {
      labels[id] = label;
      done[id] = 1;
    }
    front.swap(next);
  } while (!decided.empty());
  // What neither side reaches takes the side that it touches most.
  for (const Index id : front)
  {
    labels[id] = sides[parts.Component[id]][0];
  }
  return count;
}
}
