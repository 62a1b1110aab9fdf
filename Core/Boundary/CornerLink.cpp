// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "CornerLink.h"

#include <algorithm>
#include <map>
#include <numeric>

namespace trivariate
{
namespace
{
// How far copies of a corner are moved apart, in voxels, and the nodes of a ball from its centre.
constexpr float Separation = 0.2f;
constexpr float BallRadius = 0.25f;

constexpr int EdgeOctants[4][2] = { { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 } };

// The octants around a half-edge, in the order of EdgeCopies.
std::array<int, 4> OctantsAround(int h)
{
  const int a = h / 2, b = (a + 1) % 3, c = (a + 2) % 3;
  std::array<int, 4> octants;
  for (int k = 0; k < 4; ++k)
  {
    octants[k] = (h % 2) << a | EdgeOctants[k][0] << b | EdgeOctants[k][1] << c;
  }
  return octants;
}

int ArcBetween(int h, int g)
{
  // In the plane of the two, c is the axis that neither has.
  const int c = 3 - h / 2 - g / 2;
  const bool first = h / 2 == (c + 1) % 3;
  return 4 * c + (first ? h % 2 + 2 * (g % 2) : g % 2 + 2 * (h % 2));
}

// The half-edges at the ends of an arc.
std::array<int, 2> EndsOf(int arc)
{
  const int c = arc / 4;
  return { 2 * ((c + 1) % 3) + arc % 2, 2 * ((c + 2) % 3) + arc / 2 % 2 };
}

// The arcs around a half-edge: number k lies between octants k and k + 1.
std::array<int, 4> ArcsAround(int h)
{
  const int b = (h / 2 + 1) % 3, c = (h / 2 + 2) % 3;
  return { ArcBetween(h, 2 * c), ArcBetween(h, 2 * b + 1), ArcBetween(h, 2 * c + 1),
    ArcBetween(h, 2 * b) };
}

// Disjoint sets of 0 .. n-1; a set is named by its least member.
struct Sets
{
  std::vector<int> Parent;
  explicit Sets(int n)
    : Parent(n)
  {
    std::iota(this->Parent.begin(), this->Parent.end(), 0);
  }
  int Find(int i) const
  {
    while (this->Parent[i] != i)
    {
      i = this->Parent[i];
    }
    return i;
  }
  void Join(int i, int j)
  {
    i = this->Find(i);
    j = this->Find(j);
    this->Parent[std::max(i, j)] = std::min(i, j);
  }
};

// The link as a graph on the sphere: node 2 h + copy, arcs, pieces of one label.
class LinkGraph
{
public:
  explicit LinkGraph(const std::array<int, 8>& labels)
    : Labels(labels)
  {
    for (int arc = 0; arc < 12; ++arc)
    {
      const int c = arc / 4, lower = LowerOctant(arc);
      this->IsFace[arc] = labels[lower] != labels[lower | 1 << c];
      if (!this->IsFace[arc])
      {
        this->Pieces.Join(lower, lower | 1 << c);
      }
    }
    for (int h = 0; h < 6; ++h)
    {
      const std::array<int, 4> octants = OctantsAround(h);
      this->Edges[h] = SplitEdge(
        { labels[octants[0]], labels[octants[1]], labels[octants[2]], labels[octants[3]] });
      if (this->Edges[h].Count == 2)
      {
        const int k = this->Edges[h].Octants[0];
        this->Pieces.Join(octants[(k + 1) % 4], octants[(k + 3) % 4]);
      }
    }
    for (int arc = 0; arc < 12; ++arc)
    {
      if (this->IsFace[arc])
      {
        const std::array<int, 2> ends = EndsOf(arc);
        this->Components.Join(this->Node(arc, ends[0]), this->Node(arc, ends[1]));
      }
    }
  }

  static int LowerOctant(int arc)
  {
    const int c = arc / 4;
    return (arc % 2) << ((c + 1) % 3) | (arc / 2 % 2) << ((c + 2) % 3);
  }

  // The copy of half-edge h that the arc ends at.
  int Node(int arc, int h) const
  {
    const std::array<int, 4> arcs = ArcsAround(h);
    const int k = static_cast<int>(std::find(arcs.begin(), arcs.end(), arc) - arcs.begin());
    return 2 * h + this->Edges[h].CopyOfFace[k];
  }

  // The part of the graph to which an arc belongs.
  int ComponentOf(int arc) const { return this->Components.Find(this->Node(arc, EndsOf(arc)[0])); }

  // Walks along the border of the piece of octant `side`, beside the arc: its nodes, anticlockwise
  // about the piece as seen from outside the sphere.
  std::vector<int> Border(int arc, int side) const
  {
    std::vector<int> nodes;
    const std::array<int, 2> ends = EndsOf(arc);
    int at = this->IsLeft(ends, side) ? ends[1] : ends[0];
    const int firstArc = arc, firstSide = side;
    do
    {
      nodes.push_back(this->Node(arc, at));
      const std::array<int, 4> arcs = ArcsAround(at), octants = OctantsAround(at);
      const std::array<int, 4>& copies = this->Edges[at].CopyOfFace;
      const int k = static_cast<int>(std::find(arcs.begin(), arcs.end(), arc) - arcs.begin());
      const int turn = side == octants[k] ? 3 : 1;
      int next = (k + turn) % 4;
      while (copies[next] != copies[k])
      {
        next = (next + turn) % 4;
      }
      arc = arcs[next];
      side = octants[turn == 1 ? next : (next + 1) % 4];
      const std::array<int, 2> newEnds = EndsOf(arc);
      at = newEnds[0] == at ? newEnds[1] : newEnds[0];
    } while (arc != firstArc || side != firstSide);
    return nodes;
  }

  std::array<int, 8> Labels;
  std::array<bool, 12> IsFace;
  std::array<EdgeCopies, 6> Edges;
  Sets Components{ 12 };
  Sets Pieces{ 8 };

private:
  // Whether the octant lies left of the way from the first end of an arc to the second.
  static bool IsLeft(const std::array<int, 2>& ends, int octant)
  {
    const int a = ends[0] / 2, b = ends[1] / 2, c = 3 - a - b;
    const int orientation = (a + 1) % 3 == b ? 1 : -1;
    const int sign = (ends[0] % 2 ? 1 : -1) * (ends[1] % 2 ? 1 : -1) * (octant >> c & 1 ? 1 : -1);
    return orientation * sign > 0;
  }
};

// One arc and the octant beside it for every piece that borders on a component.
std::map<int, std::array<int, 2>> PiecesAround(const LinkGraph& graph, int component)
{
  std::map<int, std::array<int, 2>> pieces;
  for (int arc = 0; arc < 12; ++arc)
  {
    if (graph.IsFace[arc] && graph.ComponentOf(arc) == component)
    {
      const int lower = LinkGraph::LowerOctant(arc);
      for (int octant : { lower, lower | 1 << arc / 4 })
      {
        pieces.insert({ graph.Pieces.Find(octant), { arc, octant } });
      }
    }
  }
  return pieces;
}

// Moves a vertex towards the middle of its arcs: away from the other vertices of the corner.
std::array<float, 3> OffsetOf(std::uint16_t arcs)
{
  std::array<float, 3> sum = {};
  for (int arc = 0; arc < 12; ++arc)
  {
    if (arcs >> arc & 1)
    {
      for (int h : EndsOf(arc))
      {
        sum[h / 2] += h % 2 ? 0.5f : -0.5f;
      }
    }
  }
  for (float& x : sum)
  {
    x = Separation * std::clamp(x, -1.0f, 1.0f);
  }
  return sum;
}

// The vertex of a ball at copy `node` % 2 of a half-edge.
std::array<float, 3> BallOffset(const LinkGraph& graph, int node)
{
  const int h = node / 2, a = h / 2;
  std::array<float, 3> offset = {};
  offset[a] = h % 2 ? BallRadius : -BallRadius;
  if (graph.Edges[h].Count == 2)
  {
    const std::array<int, 2> away = EdgeOctantDirection(graph.Edges[h].Octants[node % 2]);
    offset[(a + 1) % 3] = 0.5f * Separation * away[0];
    offset[(a + 2) % 3] = 0.5f * Separation * away[1];
  }
  return offset;
}
}

//------------------------------------------------------------------------------
EdgeCopies SplitEdge(const std::array<int, 4>& l)
{
  EdgeCopies edge = { { -1, -1, -1, -1 }, 0, { -1, -1 } };
  for (int k = 0; k < 4; ++k)
  {
    if (l[k] != l[(k + 1) % 4])
    {
      edge.CopyOfFace[k] = 0;
      edge.Count = 1;
    }
  }
  const bool everywhere = l[0] != l[1] && l[1] != l[2] && l[2] != l[3] && l[3] != l[0];
  const bool even = everywhere && l[0] == l[2], odd = everywhere && l[1] == l[3];
  if (even || odd)
  {
    const int first = even && (!odd || l[0] > l[1]) ? 1 : 0; // a voxel that is cut off
    edge.Count = 2;
    edge.Octants = { first, first + 2 };
    for (int k = 0; k < 4; ++k)
    {
      edge.CopyOfFace[k] = k == first || (k + 1) % 4 == first ? 0 : 1;
    }
  }
  return edge;
}

std::array<int, 2> EdgeOctantDirection(int k)
{
  return { 2 * EdgeOctants[k][0] - 1, 2 * EdgeOctants[k][1] - 1 };
}

//------------------------------------------------------------------------------
CornerLink LinkOfCorner(const std::array<int, 8>& labels)
{
  const LinkGraph graph(labels);
  CornerLink link;
  std::array<int, 12> vertexOfNode;
  vertexOfNode.fill(-1);

  std::map<int, std::uint16_t> components;
  for (int arc = 0; arc < 12; ++arc)
  {
    if (graph.IsFace[arc])
    {
      components[graph.ComponentOf(arc)] |= 1 << arc;
    }
  }
  for (const auto& [component, arcs] : components)
  {
    const std::map<int, std::array<int, 2>> pieces = PiecesAround(graph, component);
    std::map<int, int> count; // of pieces of a label
    for (const auto& piece : pieces)
    {
      ++count[labels[piece.first]];
    }
    const auto most = std::max_element(
      count.begin(), count.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
    const bool isBall = most->second > 1;
    for (int node = 0; node < 12; ++node)
    {
      const EdgeCopies& edge = graph.Edges[node / 2];
      if (node % 2 >= edge.Count || graph.Components.Find(node) != component)
      {
        continue;
      }
      if (isBall)
      {
        vertexOfNode[node] = static_cast<int>(link.Vertices.size());
        link.Vertices.push_back({ BallOffset(graph, node), 0, false });
      }
      else
      {
        vertexOfNode[node] = static_cast<int>(link.Vertices.size());
      }
    }
    if (!isBall)
    {
      const bool alone = components.size() == 1;
      link.Vertices.push_back({ alone ? std::array<float, 3>{} : OffsetOf(arcs), arcs, alone });
      continue;
    }
    // A negative label is the outside of the image, which stays there.
    auto filling = count.end();
    for (auto it = count.begin(); it != count.end(); ++it)
    {
      if (it->first >= 0 && (filling == count.end() || it->second <= filling->second))
      {
        filling = it;
      }
    }
    int inside = 0;
    while (labels[inside] != filling->first)
    {
      ++inside;
    }
    for (const auto& [piece, start] : pieces)
    {
      if (labels[piece] != filling->first)
      {
        CornerLink::Patch patch = { graph.Border(start[0], start[1]), inside, piece };
        for (int& vertex : patch.Vertices)
        {
          vertex = vertexOfNode[vertex];
        }
        link.Patches.push_back(patch);
      }
    }
  }

  for (int arc = 0; arc < 12; ++arc)
  {
    for (int end = 0; end < 2; ++end)
    {
      link.VertexOfArc[arc][end] =
        graph.IsFace[arc] ? vertexOfNode[graph.Node(arc, EndsOf(arc)[end])] : -1;
    }
  }
  for (int h = 0; h < 6; ++h)
  {
    link.VertexOfEdge[h] = { vertexOfNode[2 * h], vertexOfNode[2 * h + 1] };
  }
  return link;
}
}
