// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "LabelComponents.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <map>
#include <numeric>
#include <queue>
#include <stdexcept>
#include <utility>

namespace trivariate
{
namespace
{
//------------------------------------------------------------------------------
// Disjoint sets of integers; the smallest member stands for its set.
class DisjointSets
{
public:
  explicit DisjointSets(Index count)
    : Parent(count)
  {
    std::iota(this->Parent.begin(), this->Parent.end(), 0);
  }

  std::int32_t Find(std::int32_t i)
  {
    while (this->Parent[i] != i)
    {
      i = this->Parent[i] = this->Parent[this->Parent[i]];
    }
    return i;
  }

  void Unite(std::int32_t a, std::int32_t b)
  {
    a = this->Find(a);
    b = this->Find(b);
    this->Parent[std::max(a, b)] = std::min(a, b);
  }

private:
  std::vector<std::int32_t> Parent;
};

//------------------------------------------------------------------------------
// Calls f(voxel, neighbour) for every face between two voxels.
template <typename F>
void ForFaces(const std::array<Index, 3>& size, const F& f)
{
  const Index row = size[0], slice = size[0] * size[1];
  Index id = 0;
  for (Index z = 0; z < size[2]; ++z)
  {
    for (Index y = 0; y < size[1]; ++y)
    {
      for (Index x = 0; x < size[0]; ++x, ++id)
      {
        if (x > 0)
        {
          f(id, id - 1);
        }
        if (y > 0)
        {
          f(id, id - row);
        }
        if (z > 0)
        {
          f(id, id - slice);
        }
      }
    }
  }
}

//------------------------------------------------------------------------------
// Components as the vertices of a graph, shared faces as the weights of its edges.
class ComponentGraph
{
public:
  ComponentGraph(const LabelComponents& components, const std::array<Index, 3>& size)
    : Sets(components.Count())
    , Labels(components.Labels)
    , Sizes(components.Sizes)
    , Faces(components.Count())
  {
    ForFaces(size,
      [&](Index a, Index b)
      {
        const std::int32_t ca = components.Component[a], cb = components.Component[b];
        if (ca != cb)
        {
          ++this->Faces[ca][cb];
          ++this->Faces[cb][ca];
        }
      });
  }

  Index MergeBelow(Index minimum)
  {
    using Entry = std::pair<Index, std::int32_t>; // size, component
    std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> small;
    for (std::size_t c = 0; c < this->Sizes.size(); ++c)
    {
      if (this->Sizes[c] < minimum)
      {
        small.push({ this->Sizes[c], static_cast<std::int32_t>(c) });
      }
    }
    Index merged = 0;
    while (!small.empty())
    {
      const auto [size, c] = small.top();
      small.pop();
      // Stale when the component has grown or is part of another by now.
      if (this->Sets.Find(c) != c || this->Sizes[c] != size || this->Faces[c].empty())
      {
        continue;
      }
      const std::int32_t whole = this->Relabel(c);
      ++merged;
      if (this->Sizes[whole] < minimum)
      {
        small.push({ this->Sizes[whole], whole });
      }
    }
    return merged;
  }

  Label LabelOf(std::int32_t component) { return this->Labels[this->Sets.Find(component)]; }

private:
  // Gives c the label that most of its faces touch and unites it with all neighbours of that label.
  std::int32_t Relabel(std::int32_t c)
  {
    std::array<Index, 256> faces = {};
    for (const auto& [neighbour, count] : this->Faces[c])
    {
      faces[this->Labels[neighbour]] += count;
    }
    const Label label =
      static_cast<Label>(std::max_element(faces.begin(), faces.end()) - faces.begin());
    std::vector<std::int32_t> same;
    for (const auto& [neighbour, count] : this->Faces[c])
    {
      if (this->Labels[neighbour] == label)
      {
        same.push_back(neighbour);
      }
    }
    for (const std::int32_t neighbour : same)
    {
      c = this->Unite(c, neighbour);
    }
    this->Labels[c] = label;
    return c;
  }

  std::int32_t Unite(std::int32_t a, std::int32_t b)
  {
    const std::int32_t kept = std::min(a, b), gone = std::max(a, b);
    this->Sets.Unite(a, b);
    this->Sizes[kept] += this->Sizes[gone];
    for (const auto& [neighbour, count] : this->Faces[gone])
    {
      this->Faces[neighbour].erase(gone);
      if (neighbour != kept)
      {
        this->Faces[neighbour][kept] += count;
        this->Faces[kept][neighbour] += count;
      }
    }
    this->Faces[gone].clear();
    return kept;
  }

  DisjointSets Sets;
  std::vector<Label> Labels;
  std::vector<Index> Sizes;
  std::vector<std::map<std::int32_t, Index>> Faces; // of a set's smallest member
};
}

//------------------------------------------------------------------------------
LabelComponents FindComponents(const std::vector<Label>& labels, const std::array<Index, 3>& size)
{
  const Index count = size[0] * size[1] * size[2];
  if (count > std::numeric_limits<std::int32_t>::max())
  {
    throw std::length_error("more than 2^31 - 1 voxels");
  }
  DisjointSets sets(count);
  ForFaces(size,
    [&](Index a, Index b)
    {
      if (labels[a] == labels[b])
      {
        sets.Unite(static_cast<std::int32_t>(a), static_cast<std::int32_t>(b));
      }
    });
  LabelComponents result;
  result.Component.resize(count);
  for (Index id = 0; id < count; ++id)
  {
    // The smallest voxel stands for its set and comes first.
    const std::int32_t first = sets.Find(static_cast<std::int32_t>(id));
    if (first == id)
    {
      result.Component[id] = result.Count();
      result.Labels.push_back(labels[id]);
      result.Sizes.push_back(0);
    }
    result.Component[id] = result.Component[first];
    ++result.Sizes[result.Component[id]];
  }
  return result;
}

//------------------------------------------------------------------------------
Index MergeSmallComponents(
  std::vector<Label>& labels, const std::array<Index, 3>& size, Index minimum)
{
  if (minimum <= 1)
  {
    return 0;
  }
  const LabelComponents components = FindComponents(labels, size);
  ComponentGraph graph(components, size);
  const Index merged = graph.MergeBelow(minimum);
  for (std::size_t id = 0; merged > 0 && id < labels.size(); ++id)
  {
    labels[id] = graph.LabelOf(components.Component[id]);
  }
  return merged;
}
}
