// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "BlockMesh.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <stdexcept>
#include <string>

namespace trivariate
{
namespace
{
using Counts = std::array<int, 3>;

constexpr double MostAlong = 1e5; // cells along an edge, however short they are wanted

// The grid of nodes of a face that blocks see from different sides. Its rows begin at the point of
// least number and lead to the lesser of that one's two neighbours.
struct StoredFace
{
  Index Begin;
  std::array<int, 2> Size;
};

class Numbering
{
public:
  Numbering(const std::vector<BlockPoints>& blocks, Index points)
    : Blocks(blocks)
    , Next(points)
  {
  }

  BlockMesh Number(const std::vector<Counts>& sizes);

private:
  void AddEdges(const BlockPoints& block, const Counts& n);
  void AddFaces(const BlockPoints& block, const Counts& n);
  Index OnEdge(Index from, Index to, int place) const;
  Index OnFace(const std::array<Index, 4>& points, int s, int t, int ns, int nt) const;
  Index NodeOf(const BlockPoints& block, const Counts& n, const std::array<int, 3>& at) const;

  const std::vector<BlockPoints>& Blocks;
  Index Next;
  std::map<std::array<Index, 2>, std::pair<Index, int>> Edges; // where they begin, cells
  std::map<std::array<Index, 4>, StoredFace> Faces;
};

// How the stored face runs: whether its axes are exchanged, which of them run back.
struct FaceView
{
  explicit FaceView(const std::array<Index, 4>& points)
  {
    const int first =
      static_cast<int>(std::min_element(points.begin(), points.end()) - points.begin());
    this->Flipped = { first % 2 == 1, first / 2 == 1 };
    this->Swapped = points[first ^ 2] < points[first ^ 1];
  }

  bool Swapped;
  std::array<bool, 2> Flipped;
};

std::array<Index, 4> KeyOf(std::array<Index, 4> points)
{
  std::sort(points.begin(), points.end());
  return points;
}

void Disagree(int a, int b)
{
  throw std::invalid_argument("Glued blocks have " + std::to_string(a) + " and " +
                              std::to_string(b) + " cells along a common edge.");
}

void Numbering::AddEdges(const BlockPoints& block, const Counts& n)
{
  for (int corner = 0; corner < 8; ++corner)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      std::array<int, 3> ends{ EndOfCorner(corner, 0), EndOfCorner(corner, 1),
        EndOfCorner(corner, 2) };
      if (ends[axis] == 1)
      {
        continue;
      }
      ends[axis] = 1;
      const Index a = block[corner], b = block[CornerAtEnds(ends[0], ends[1], ends[2])];
      const auto [edge, added] =
        this->Edges.emplace(std::array<Index, 2>{ std::min(a, b), std::max(a, b) },
          std::make_pair(this->Next, n[axis]));
      this->Next += added ? n[axis] - 1 : 0;
      if (edge->second.second != n[axis])
      {
        Disagree(edge->second.second, n[axis]);
      }
    }
  }
}

void Numbering::AddFaces(const BlockPoints& block, const Counts& n)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    for (int side = 0; side < 2; ++side)
    {
      const std::array<Index, 4> points = FacePoints(block, axis, side);
      std::array<int, 2> size{ n[axis == 0 ? 1 : 0], n[axis == 2 ? 1 : 2] };
      if (FaceView(points).Swapped)
      {
        std::swap(size[0], size[1]);
      }
      const bool added = this->Faces.emplace(KeyOf(points), StoredFace{ this->Next, size }).second;
      this->Next += added ? (size[0] - 1) * Index(size[1] - 1) : 0;
    }
  }
}

Index Numbering::OnEdge(Index from, Index to, int place) const
{
  const auto& [begin, cells] = this->Edges.at({ std::min(from, to), std::max(from, to) });
  return begin + (from < to ? place : cells - place) - 1;
}

Index Numbering::OnFace(const std::array<Index, 4>& points, int s, int t, int ns, int nt) const
{
  const FaceView view(points);
  s = view.Flipped[0] ? ns - s : s;
  t = view.Flipped[1] ? nt - t : t;
  if (view.Swapped)
  {
    std::swap(s, t);
  }
  const StoredFace& face = this->Faces.at(KeyOf(points));
  return face.Begin + (s - 1) + (face.Size[0] - 1) * Index(t - 1);
}

// Of a node on the boundary of its block.
Index Numbering::NodeOf(
  const BlockPoints& block, const Counts& n, const std::array<int, 3>& at) const
{
  std::array<int, 3> ends{ 0, 0, 0 };
  std::array<int, 3> inside;
  int free = 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    ends[axis] = at[axis] == n[axis];
    if (at[axis] > 0 && at[axis] < n[axis])
    {
      inside[free++] = axis;
    }
  }
  const Index low = block[CornerAtEnds(ends[0], ends[1], ends[2])];
  if (free == 0)
  {
    return low;
  }
  if (free == 1)
  {
    ends[inside[0]] = 1;
    return this->OnEdge(low, block[CornerAtEnds(ends[0], ends[1], ends[2])], at[inside[0]]);
  }
  const int axis = 3 - inside[0] - inside[1];
  return this->OnFace(
    FacePoints(block, axis, ends[axis]), at[inside[0]], at[inside[1]], n[inside[0]], n[inside[1]]);
}

BlockMesh Numbering::Number(const std::vector<Counts>& sizes)
{
  for (std::size_t b = 0; b < sizes.size(); ++b)
  {
    this->AddEdges(this->Blocks[b], sizes[b]);
  }
  for (std::size_t b = 0; b < sizes.size(); ++b)
  {
    this->AddFaces(this->Blocks[b], sizes[b]);
  }
  BlockMesh mesh{ sizes, {}, {} };
  for (std::size_t b = 0; b < sizes.size(); ++b)
  {
    const Counts& n = sizes[b];
    std::vector<Index>& nodes = mesh.Nodes.emplace_back();
    nodes.reserve((n[0] + 1) * (n[1] + 1) * std::size_t(n[2] + 1));
    for (int k = 0; k <= n[2]; ++k)
    {
      for (int j = 0; j <= n[1]; ++j)
      {
        for (int i = 0; i <= n[0]; ++i)
        {
          const bool inside = i > 0 && j > 0 && k > 0 && i < n[0] && j < n[1] && k < n[2];
          nodes.push_back(inside ? this->Next++ : this->NodeOf(this->Blocks[b], n, { i, j, k }));
        }
      }
    }
  }
  mesh.Places.assign(this->Next, Eigen::Vector3d::Zero());
  return mesh;
}
}

//------------------------------------------------------------------------------
std::array<Index, 4> FacePoints(const BlockPoints& block, int axis, int side)
{
  std::array<Index, 4> points;
  for (int i = 0; i < 4; ++i)
  {
    std::array<int, 3> ends;
    ends[axis] = side;
    ends[axis == 0 ? 1 : 0] = i % 2;
    ends[axis == 2 ? 1 : 2] = i / 2;
    points[i] = block[CornerAtEnds(ends[0], ends[1], ends[2])];
  }
  return points;
}

//------------------------------------------------------------------------------
Index BlockMesh::NumberOfCells() const
{
  Index cells = 0;
  for (const Counts& n : this->Sizes)
  {
    cells += Index(n[0]) * n[1] * n[2];
  }
  return cells;
}

std::vector<Index> BlockMesh::FaceNodes(Index block, int axis, int side) const
{
  const Counts& n = this->Sizes[block];
  const int first = axis == 0 ? 1 : 0, second = axis == 2 ? 1 : 2;
  std::array<int, 3> at;
  at[axis] = side ? n[axis] : 0;
  std::vector<Index> nodes;
  for (at[second] = 0; at[second] <= n[second]; ++at[second])
  {
    for (at[first] = 0; at[first] <= n[first]; ++at[first])
    {
      nodes.push_back(this->Node(block, at[0], at[1], at[2]));
    }
  }
  return nodes;
}

std::vector<Index> BlockMesh::EdgeNodes(Index block, int axis, int firstEnd, int secondEnd) const
{
  const Counts& n = this->Sizes[block];
  const int first = axis == 0 ? 1 : 0, second = axis == 2 ? 1 : 2;
  std::array<int, 3> at;
  at[first] = firstEnd ? n[first] : 0;
  at[second] = secondEnd ? n[second] : 0;
  std::vector<Index> nodes;
  for (at[axis] = 0; at[axis] <= n[axis]; ++at[axis])
  {
    nodes.push_back(this->Node(block, at[0], at[1], at[2]));
  }
  return nodes;
}

//------------------------------------------------------------------------------
std::vector<Counts> BlockSizes(const std::vector<BlockPoints>& blocks,
  const std::function<double(Index, Index)>& length, double cell, int fewest)
{
  // Axes of blocks, 3 block + axis, joined where they share an edge.
  std::vector<Index> parent(3 * blocks.size());
  std::iota(parent.begin(), parent.end(), Index(0));
  const auto root = [&parent](Index i)
  {
    while (parent[i] != i)
    {
      i = parent[i] = parent[parent[i]];
    }
    return i;
  };
  std::map<std::array<Index, 2>, Index> axisOf;
  for (std::size_t b = 0; b < blocks.size(); ++b)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      for (int i = 0; i < 4; ++i)
      {
        const Index from = FacePoints(blocks[b], axis, 0)[i],
                    to = FacePoints(blocks[b], axis, 1)[i];
        const auto found = axisOf.emplace(
          std::array<Index, 2>{ std::min(from, to), std::max(from, to) }, 3 * b + axis);
        parent[root(3 * b + axis)] = root(found.first->second);
      }
    }
  }
  std::vector<double> sum(parent.size(), 0.0);
  std::vector<int> edges(parent.size(), 0);
  for (const auto& [ends, axis] : axisOf)
  {
    sum[root(axis)] += length(ends[0], ends[1]);
    ++edges[root(axis)];
  }
  std::vector<Counts> sizes(blocks.size());
  for (std::size_t b = 0; b < blocks.size(); ++b)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      const Index r = root(3 * b + axis);
      const double cells = std::min(sum[r] / edges[r] / cell, MostAlong);
      sizes[b][axis] = std::max(fewest, static_cast<int>(std::lround(cells)));
    }
  }
  return sizes;
}

//------------------------------------------------------------------------------
BlockMesh NumberNodes(
  const std::vector<BlockPoints>& blocks, Index points, const std::vector<Counts>& sizes)
{
  for (std::size_t b = 0; b < blocks.size(); ++b)
  {
    for (const Index point : blocks[b])
    {
      if (point < 0 || point >= points)
      {
        throw std::invalid_argument("Block " + std::to_string(b) + " has point " +
                                    std::to_string(point) + " of " + std::to_string(points) + ".");
      }
    }
  }
  return Numbering(blocks, points).Number(sizes);
}
}
