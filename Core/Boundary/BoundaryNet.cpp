// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "BoundaryNet.h"

#include "CornerLink.h"

#include <algorithm>
#include <numeric>
#include <unordered_map>

namespace trivariate
{
namespace
{
using Corner = std::array<Index, 3>; // the one before voxel (i, j, k), at (i, j, k) - 1/2

constexpr float Separation = 0.2f; // of the copies of an edge's middle, along two axes

// The links of the corners of a volume; equal ones are computed once. One object a thread.
class LinkTable
{
public:
  explicit LinkTable(const LabelVolume& labels)
    : Labels(labels)
  {
  }

  std::array<int, 8> LabelsAround(const Corner& corner) const
  {
    std::array<int, 8> around;
    for (int o = 0; o < 8; ++o)
    {
      around[o] = this->Labels(
        corner[0] - 1 + (o & 1), corner[1] - 1 + (o >> 1 & 1), corner[2] - 1 + (o >> 2));
    }
    return around;
  }

  // Only the order of the labels counts, and where the outside is: that is the key.
  const CornerLink& operator()(const Corner& corner)
  {
    const std::array<int, 8> around = this->LabelsAround(corner);
    std::array<int, 8> sorted = around;
    std::sort(sorted.begin(), sorted.end());
    const auto end = std::unique(sorted.begin(), sorted.end());
    const int outside = sorted[0] < 0 ? 1 : 0;
    std::array<int, 8> ranks;
    std::uint32_t key = 0;
    for (int o = 0; o < 8; ++o)
    {
      ranks[o] =
        static_cast<int>(std::lower_bound(sorted.begin(), end, around[o]) - sorted.begin()) -
        outside;
      key = key << 4 | (ranks[o] + 1);
    }
    const auto found = this->Links.find(key);
    return found != this->Links.end() ? found->second
                                      : this->Links.emplace(key, LinkOfCorner(ranks)).first->second;
  }

private:
  LabelVolume Labels;
  std::unordered_map<std::uint32_t, CornerLink> Links;
};

Corner Next(Corner corner, int axis)
{
  ++corner[axis];
  return corner;
}

// Whether both copies of the edge upwards from the corner have the same two ends, so that only
// vertices in the middle tell them apart.
bool HasMiddles(LinkTable& links, const CornerLink& link, const Corner& corner, int axis)
{
  const std::array<int, 2>& lower = link.VertexOfEdge[2 * axis + 1];
  if (lower[1] < 0 || lower[0] != lower[1])
  {
    return false;
  }
  const std::array<int, 2>& upper = links(Next(corner, axis)).VertexOfEdge[2 * axis];
  return upper[0] == upper[1];
}

// The corners of one layer that have vertices, and the number of their first one.
struct CornerLayer
{
  std::vector<Index> First; // of every corner of the layer, -1 where there is none
  Index Count = 0;
};

// Everything between the corner layers k and k + 1, and on k.
class LayerBuilder
{
public:
  LayerBuilder(const LabelVolume& labels)
    : Labels(labels)
    , Links(labels)
  {
  }

  // Numbers the vertices of a layer from `first`; the vertices themselves on request.
  CornerLayer Vertices(Index k, Index first, std::vector<BoundaryVertex>* vertices)
  {
    const auto& size = this->Labels.Size;
    CornerLayer layer;
    layer.First.assign((size[0] + 1) * (size[1] + 1), -1);
    Index at = 0;
    for (Index j = 0; j <= size[1]; ++j)
    {
      for (Index i = 0; i <= size[0]; ++i, ++at)
      {
        if (this->IsUniform(i, j, k))
        {
          continue;
        }
        const Corner corner = { i, j, k };
        const CornerLink& link = this->Links(corner);
        layer.First[at] = first + layer.Count;
        layer.Count += static_cast<Index>(link.Vertices.size());
        if (vertices)
        {
          this->AddCorner(corner, link, *vertices);
        }
        for (int axis = 0; axis < 3; ++axis)
        {
          if (HasMiddles(this->Links, link, corner, axis))
          {
            layer.Count += 2;
            if (vertices)
            {
              this->AddMiddles(corner, axis, *vertices);
            }
          }
        }
      }
    }
    return layer;
  }

  // The faces whose corner of least indices is in layer k, with those of balls there.
  // Vertices in the middle of faces are appended to `centers`, counted as -2, -3, ...
  void Faces(Index k, const CornerLayer& lower, const CornerLayer& upper,
    std::vector<BoundaryFace>& faces, std::vector<BoundaryVertex>& centers)
  {
    this->Layers = { &lower, &upper };
    this->Bottom = k;
    const auto& size = this->Labels.Size;
    for (Index j = 0; j <= size[1]; ++j)
    {
      for (Index i = 0; i <= size[0]; ++i)
      {
        if (lower.First[i + (size[0] + 1) * j] < 0)
        {
          continue; // a face needs a vertex at each corner
        }
        const Corner corner = { i, j, k };
        const std::int32_t label = this->Labels(i, j, k);
        for (int c = 0; c < 3; ++c)
        {
          Corner voxel = corner;
          --voxel[c];
          const std::int32_t before = this->Labels(voxel[0], voxel[1], voxel[2]);
          if (before != label)
          {
            this->Polygon(corner, c);
            this->AddPolygon({ before, label }, 4, faces, centers);
          }
        }
        this->AddPatches(corner, faces, centers);
      }
    }
  }

private:
  bool IsUniform(Index i, Index j, Index k) const
  {
    const auto& size = this->Labels.Size;
    if (i == 0 || j == 0 || k == 0 || i == size[0] || j == size[1] || k == size[2])
    {
      return false;
    }
    const std::int32_t* p = this->Labels.Labels + i + size[0] * (j + size[1] * k);
    const Index y = size[0], z = size[0] * size[1];
    const std::int32_t l = *p;
    return p[-1] == l && p[-y] == l && p[-y - 1] == l && p[-z] == l && p[-z - 1] == l &&
           p[-z - y] == l && p[-z - y - 1] == l;
  }

  BoundaryVertex VertexAt(const Corner& corner) const
  {
    BoundaryVertex vertex = { {}, 0, 0, false };
    for (int a = 0; a < 3; ++a)
    {
      vertex.Anchor[a] = corner[a] - 0.5f;
      vertex.FixedAxes |= (corner[a] == 0 || corner[a] == this->Labels.Size[a]) << a;
    }
    return vertex;
  }

  static void Shift(BoundaryVertex& vertex, const std::array<float, 3>& offset)
  {
    for (int a = 0; a < 3; ++a)
    {
      vertex.Anchor[a] += vertex.FixedAxes >> a & 1 ? 0.0f : offset[a];
    }
  }

  void AddCorner(
    const Corner& corner, const CornerLink& link, std::vector<BoundaryVertex>& vertices) const
  {
    for (const CornerLink::Vertex& v : link.Vertices)
    {
      BoundaryVertex vertex = this->VertexAt(corner);
      for (int a = 0; a < 3 && v.Arcs == 0; ++a)
      {
        // A ball on the border is half a ball: the vertices that are not on the border are free.
        vertex.FixedAxes &= ~((v.Offset[a] != 0.0f) << a);
      }
      Shift(vertex, v.Offset);
      vertex.Faces = v.Arcs;
      vertex.Alone = v.Alone;
      vertices.push_back(vertex);
    }
  }

  EdgeCopies CopiesOf(const Corner& corner, int axis) const
  {
    std::array<int, 4> around;
    for (int n = 0; n < 4; ++n)
    {
      const std::array<int, 2> direction = EdgeOctantDirection(n);
      Corner voxel = corner;
      voxel[(axis + 1) % 3] -= direction[0] < 0;
      voxel[(axis + 2) % 3] -= direction[1] < 0;
      around[n] = this->Labels(voxel[0], voxel[1], voxel[2]);
    }
    return SplitEdge(around);
  }

  void AddMiddles(const Corner& corner, int axis, std::vector<BoundaryVertex>& vertices) const
  {
    const EdgeCopies copies = this->CopiesOf(corner, axis);
    for (int octant : copies.Octants)
    {
      BoundaryVertex vertex = this->VertexAt(corner);
      vertex.FixedAxes &= ~(1 << axis);
      const std::array<int, 2> direction = EdgeOctantDirection(octant);
      std::array<float, 3> offset;
      offset[axis] = 0.5f;
      offset[(axis + 1) % 3] = Separation * direction[0];
      offset[(axis + 2) % 3] = Separation * direction[1];
      Shift(vertex, offset);
      vertices.push_back(vertex);
    }
  }

  Index FirstVertex(const Corner& corner) const
  {
    return this->Layers[corner[2] - this->Bottom]
      ->First[corner[0] + (this->Labels.Size[0] + 1) * corner[1]];
  }

  // The number of the first of the two vertices in the middle of an edge.
  Index FirstMiddle(const Corner& corner, const CornerLink& link, int axis)
  {
    Index number = this->FirstVertex(corner) + static_cast<Index>(link.Vertices.size());
    for (int a = 0; a < axis; ++a)
    {
      number += HasMiddles(this->Links, link, corner, a) ? 2 : 0;
    }
    return number;
  }

  // The vertices around the voxel face normal to axis c, seen from the end of c.
  void Polygon(const Corner& corner, int c)
  {
    const int a = (c + 1) % 3, b = (c + 2) % 3;
    const Corner corners[4] = { corner, Next(corner, a), Next(Next(corner, a), b),
      Next(corner, b) };
    const int ends[4][2] = { { 1, 0 }, { 0, 1 }, { 1, 0 }, { 0, 1 } }; // end towards last, next
    this->Loop.clear();
    this->Around = { 0.0f, 0.0f, 0.0f };
    for (int n = 0; n < 4; ++n)
    {
      const int da = n == 1 || n == 2, db = n >= 2;
      const CornerLink& link = this->Links(corners[n]);
      const std::array<int, 2>& own = link.VertexOfArc[4 * c + (1 - da) + 2 * (1 - db)];
      const Index first = this->FirstVertex(corners[n]);
      this->Loop.push_back(first + own[ends[n][0]]);
      if (own[0] != own[1])
      {
        this->Loop.push_back(first + own[ends[n][1]]);
      }
      // The edge to the next corner runs along a, b, a, b.
      const int axis = n % 2 ? b : a;
      const Corner& start = corners[n < 2 ? n : (n + 1) % 4];
      const CornerLink& startLink = this->Links(start);
      if (HasMiddles(this->Links, startLink, start, axis))
      {
        const EdgeCopies copies = this->CopiesOf(start, axis);
        this->Loop.push_back(this->FirstMiddle(start, startLink, axis) +
                             copies.CopyOfFace[FaceAroundEdge(n, c, axis)]);
      }
    }
    for (int axis = 0; axis < 3; ++axis)
    {
      this->Around[axis] = corner[axis] - (axis == c ? 0.5f : 0.0f);
    }
    this->FixedAxis = corner[c] == 0 || corner[c] == this->Labels.Size[c] ? 1 << c : 0;
  }

  // Which of the four faces around its edge number n the face normal to c is (EdgeCopies' order).
  static int FaceAroundEdge(int n, int c, int axis)
  {
    // Seen from the edge, the face goes up along the third axis at edges 0 and 3, down at 1 and 2.
    const bool up = n == 0 || n == 3;
    return (axis + 1) % 3 == c ? (up ? 2 : 0) : (up ? 1 : 3);
  }

  // Adds the polygon, as triangles about its middle if it has more than `most` vertices.
  void AddPolygon(std::array<std::int32_t, 2> labels, std::size_t most,
    std::vector<BoundaryFace>& faces, std::vector<BoundaryVertex>& centers)
  {
    if (labels[0] > labels[1])
    {
      std::swap(labels[0], labels[1]);
      std::reverse(this->Loop.begin(), this->Loop.end());
    }
    const std::size_t count = this->Loop.size();
    if (count <= most)
    {
      faces.push_back(
        { { this->Loop[0], this->Loop[1], this->Loop[2], count == 4 ? this->Loop[3] : -1 },
          labels });
      return;
    }
    centers.push_back({ this->Around, 0, this->FixedAxis, false });
    const Index center = -1 - static_cast<Index>(centers.size());
    for (std::size_t n = 0; n < count; ++n)
    {
      faces.push_back({ { this->Loop[n], this->Loop[(n + 1) % count], center, -1 }, labels });
    }
  }

  void AddPatches(
    const Corner& corner, std::vector<BoundaryFace>& faces, std::vector<BoundaryVertex>& centers)
  {
    const CornerLink& link = this->Links(corner);
    if (link.Patches.empty())
    {
      return;
    }
    const std::array<int, 8> around = this->Links.LabelsAround(corner);
    for (const CornerLink::Patch& patch : link.Patches)
    {
      const BoundaryVertex middle = this->VertexAt(corner);
      this->Loop.clear();
      this->Around = middle.Anchor;
      this->FixedAxis = around[patch.Outside] < 0 ? middle.FixedAxes : 0;
      for (int v : patch.Vertices)
      {
        this->Loop.push_back(this->FirstVertex(corner) + v);
        const std::array<float, 3>& offset = link.Vertices[v].Offset;
        for (int a = 0; a < 3; ++a)
        {
          this->Around[a] += offset[a] / patch.Vertices.size();
        }
      }
      this->AddPolygon({ around[patch.Inside], around[patch.Outside] }, 3, faces, centers);
    }
  }

  LabelVolume Labels;
  LinkTable Links;
  std::array<const CornerLayer*, 2> Layers = {};
  Index Bottom = 0;
  // The polygon in the making: its vertices, its middle, whether that is on the border.
  std::vector<Index> Loop;
  std::array<float, 3> Around = {};
  std::uint8_t FixedAxis = 0;
};
}
//------------------------------------------------------------------------------
BoundaryNet BuildBoundaryNet(const LabelVolume& labels, const Execution& execution)
{
  const Index layers = labels.Size[2] + 1;
  const Index block = 16; // layers between two looks at the abort button
  std::vector<Index> first(layers + 1, 0);
  for (Index start = 0; start < layers; start += block)
  {
    execution.Check(0.5 * start / layers);
    execution.ParallelFor(std::min(block, layers - start),
      [&](Index begin, Index end)
      {
        LayerBuilder builder(labels);
        for (Index k = start + begin; k < start + end; ++k)
        {
          first[k + 1] = builder.Vertices(k, 0, nullptr).Count;
        }
      });
  }
  std::partial_sum(first.begin(), first.end(), first.begin());

  BoundaryNet net;
  net.Vertices.resize(first[layers]);
  std::vector<std::vector<BoundaryFace>> faces(layers);
  std::vector<std::vector<BoundaryVertex>> centers(layers);
  for (Index start = 0; start < layers; start += block)
  {
    execution.Check(0.5 + 0.5 * start / layers);
    execution.ParallelFor(std::min(block, layers - start),
      [&](Index begin, Index end)
      {
        LayerBuilder builder(labels);
        std::vector<BoundaryVertex> vertices;
        for (Index k = start + begin; k < start + end; ++k)
        {
          vertices.clear();
          const CornerLayer lower = builder.Vertices(k, first[k], &vertices);
          const CornerLayer upper =
            k + 1 < layers ? builder.Vertices(k + 1, first[k + 1], nullptr) : CornerLayer();
          std::copy(vertices.begin(), vertices.end(), net.Vertices.begin() + first[k]);
          builder.Faces(k, lower, upper, faces[k], centers[k]);
        }
      });
  }
  for (Index k = 0; k < layers; ++k)
  {
    const Index center = static_cast<Index>(net.Vertices.size());
    net.Vertices.insert(net.Vertices.end(), centers[k].begin(), centers[k].end());
    for (BoundaryFace& face : faces[k])
    {
      if (face.Size() == 3 && face.Vertices[2] < 0)
      {
        face.Vertices[2] = center - 2 - face.Vertices[2];
      }
    }
    net.Faces.insert(net.Faces.end(), faces[k].begin(), faces[k].end());
    std::vector<BoundaryFace>().swap(faces[k]);
  }
  return net;
}
}
