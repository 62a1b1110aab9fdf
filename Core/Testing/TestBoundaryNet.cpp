// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Boundary/BoundaryNet.h"
#include "SegmentVolumes.h"
#include "ThreadedExecution.h"
#include "Boundary/TriangleIntersections.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <utility>

using namespace trivariate;

namespace
{
// The faces of one segment, its inside below.
std::vector<std::vector<Index>> FacesOf(const BoundaryNet& net, int segment)
{
  std::vector<std::vector<Index>> faces;
  for (const BoundaryFace& face : net.Faces)
  {
    if (face.Labels[0] == segment || face.Labels[1] == segment)
    {
      faces.emplace_back(face.Vertices.begin(), face.Vertices.begin() + face.Size());
      if (face.Labels[1] == segment)
      {
        std::reverse(faces.back().begin(), faces.back().end());
      }
    }
  }
  return faces;
}

// Every edge has one face on either side, in opposite directions, and the faces around every vertex
// are one fan.
bool IsClosedManifold(const std::vector<std::vector<Index>>& faces)
{
  std::set<std::pair<Index, Index>> edges;
  std::map<Index, std::map<Index, Index>> fans; // of a vertex: from edge to edge
  for (const std::vector<Index>& face : faces)
  {
    const std::size_t n = face.size();
    for (std::size_t i = 0; i < n; ++i)
    {
      const Index a = face[i], b = face[(i + 1) % n], c = face[(i + 2) % n];
      if (a == b || a == c || !edges.insert({ a, b }).second || !fans[b].insert({ a, c }).second)
      {
        return false;
      }
    }
  }
  for (const auto& [a, b] : edges)
  {
    if (edges.count({ b, a }) == 0)
    {
      return false;
    }
  }
  for (const auto& [vertex, fan] : fans)
  {
    std::size_t count = 0;
    Index at = fan.begin()->first;
    do
    {
      const auto next = fan.find(at);
      if (next == fan.end())
      {
        return false;
      }
      at = next->second;
      ++count;
    } while (at != fan.begin()->first && count <= fan.size());
    if (count != fan.size())
    {
      return false;
    }
  }
  return true;
}

int EulerNumber(const std::vector<std::vector<Index>>& faces)
{
  std::set<Index> vertices;
  std::size_t corners = 0;
  for (const std::vector<Index>& face : faces)
  {
    vertices.insert(face.begin(), face.end());
    corners += face.size();
  }
  return static_cast<int>(vertices.size() + faces.size() - corners / 2);
}

int ConnectedSurfaces(const std::vector<std::vector<Index>>& faces)
{
  std::map<Index, Index> parent;
  const auto root = [&parent](Index v)
  {
    for (parent.insert({ v, v }); parent[v] != v; v = parent[v])
    {
    }
    return v;
  };
  for (const std::vector<Index>& face : faces)
  {
    for (Index v : face)
    {
      parent[root(v)] = root(face[0]);
    }
  }
  return static_cast<int>(std::count_if(
    parent.begin(), parent.end(), [](const auto& entry) { return entry.first == entry.second; }));
}

// The number of cells of a dimension (given by their axes) all or any of whose voxels have a label.
int CountCells(const SegmentVolume& volume, int label, int axes, bool all)
{
  int count = 0;
  const LabelVolume view = volume.View();
  for (Index k = 0; k <= volume.Size[2]; ++k)
  {
    for (Index j = 0; j <= volume.Size[1]; ++j)
    {
      for (Index i = 0; i <= volume.Size[0]; ++i)
      {
        bool has = all;
        for (int o = 0; o < 8; ++o)
        {
          if ((o & axes) == 0)
          {
            const bool is = view(i - (o & 1), j - (o >> 1 & 1), k - (o >> 2)) == label;
            has = all ? has && is : has || is;
          }
        }
        count += has;
      }
    }
  }
  return count;
}

// V - E + F - C of the voxels with (closed) or without (open) their common borders.
int EulerNumberOfVoxels(const SegmentVolume& volume, int label, bool closed)
{
  const auto count = [&](int axes) { return CountCells(volume, label, axes, !closed); };
  const int vertices = count(0), edges = count(1) + count(2) + count(4);
  const int faces = count(3) + count(5) + count(6), voxels = count(7);
  return closed ? vertices - edges + faces - voxels : voxels - faces + edges - vertices;
}

// Corners where two voxels of the label touch at the corner only, all else there being another.
int CornerContacts(const SegmentVolume& volume, int label)
{
  int count = 0;
  const LabelVolume view = volume.View();
  for (Index k = 1; k < volume.Size[2]; ++k)
  {
    for (Index j = 1; j < volume.Size[1]; ++j)
    {
      for (Index i = 1; i < volume.Size[0]; ++i)
      {
        int mask = 0;
        for (int o = 0; o < 8; ++o)
        {
          mask |= (view(i - (o & 1), j - (o >> 1 & 1), k - (o >> 2)) == label) << o;
        }
        count += mask == 0x81 || mask == 0x42 || mask == 0x24 || mask == 0x18;
      }
    }
  }
  return count;
}

SegmentVolume Corner(const std::array<int, 8>& labels)
{
  return MakeVolume({ 2, 2, 2 }, [&labels](double x, double y, double z)
    { return labels[static_cast<int>(x + 2 * y + 4 * z)]; });
}
}

//------------------------------------------------------------------------------
TEST(BoundaryNet, IsTwoManifoldForEverySegmentOfNoise)
{
  for (unsigned seed = 0; seed < 300; ++seed)
  {
    const int labels = 2 + seed % 7;
    const Index n = 3 + seed % 4;
    const SegmentVolume volume = RandomVolume({ n, n, n + 1 }, labels, seed);
    const BoundaryNet net = BuildBoundaryNet(volume.View(), Execution());
    for (int segment = -1; segment < labels; ++segment)
    {
      EXPECT_TRUE(IsClosedManifold(FacesOf(net, segment))) << "seed " << seed << " " << segment;
    }
  }
}

TEST(BoundaryNet, DoesNotMeetItself)
{
  for (unsigned seed = 0; seed < 300; ++seed)
  {
    const SegmentVolume volume = RandomVolume({ 4, 3, 4 }, 2 + seed % 7, seed);
    const BoundaryNet net = BuildBoundaryNet(volume.View(), Execution());
    std::vector<Point> points;
    for (const BoundaryVertex& vertex : net.Vertices)
    {
      points.push_back({ vertex.Anchor[0], vertex.Anchor[1], vertex.Anchor[2] });
    }
    // Along either diagonal.
    for (int d = 0; d < 2; ++d)
    {
      std::vector<Triangle> triangles;
      for (const BoundaryFace& face : net.Faces)
      {
        const auto& v = face.Vertices;
        if (face.Size() == 3)
        {
          triangles.push_back({ v[0], v[1], v[2] });
          continue;
        }
        triangles.push_back({ v[d], v[d + 1], v[d + 2] });
        triangles.push_back({ v[d], v[d + 2], v[(d + 3) % 4] });
      }
      const std::vector<char> all(triangles.size(), 1);
      EXPECT_TRUE(FindIntersections(points, triangles, all, 1e-3, Execution()).empty())
        << "seed " << seed;
    }
  }
}

// Of two labels the higher is 18-connected, the lower has the complementary connectivity (6, but
// through corners at which the higher only touches itself); the Euler number of a surface is twice
// that of what it bounds.
TEST(BoundaryNet, HasTheEulerNumberOfTheVoxels)
{
  for (unsigned seed = 0; seed < 100; ++seed)
  {
    const SegmentVolume volume = RandomVolume({ 7, 6, 8 }, 2, seed);
    const BoundaryNet net = BuildBoundaryNet(volume.View(), Execution());
    EXPECT_EQ(EulerNumber(FacesOf(net, 1)),
      2 * (EulerNumberOfVoxels(volume, 1, true) + CornerContacts(volume, 1)));
    // Between voxels of the higher label that touch at a corner the lower goes through.
    EXPECT_EQ(EulerNumber(FacesOf(net, 0)),
      2 * (EulerNumberOfVoxels(volume, 0, false) + CornerContacts(volume, 1)));
  }
}

TEST(BoundaryNet, ConnectsAcrossEdgesAndPartsAtCorners)
{
  const auto surfaces = [](const std::array<int, 8>& labels, int segment)
  {
    const SegmentVolume volume = Corner(labels);
    const auto faces = FacesOf(BuildBoundaryNet(volume.View(), Execution()), segment);
    EXPECT_TRUE(IsClosedManifold(faces));
    const int count = ConnectedSurfaces(faces);
    EXPECT_EQ(EulerNumber(faces), 2 * count);
    return count;
  };
  // Two voxels at an edge: one piece if the label is the higher or there are two others.
  EXPECT_EQ(surfaces({ 1, 0, 0, 1, 0, 0, 0, 0 }, 1), 1);
  EXPECT_EQ(surfaces({ 0, 1, 1, 0, 1, 1, 1, 1 }, 0), 2);
  EXPECT_EQ(surfaces({ 0, 1, 2, 0, 1, 1, 1, 1 }, 0), 1);
  // At a corner: two pieces.
  EXPECT_EQ(surfaces({ 1, 0, 0, 0, 0, 0, 0, 1 }, 1), 2);
  EXPECT_EQ(surfaces({ 0, 1, 1, 1, 1, 1, 1, 0 }, 0), 2);
  // Also when the others share curves through the corner, which becomes a ball of the label that is
  // there in one piece.
  EXPECT_EQ(surfaces({ 0, 1, 1, 2, 1, 2, 2, 0 }, 0), 2);
  EXPECT_EQ(surfaces({ 2, 0, 0, 1, 0, 1, 1, 2 }, 2), 2);
  // Everything twice: the highest label is connected.
  EXPECT_EQ(surfaces({ 0, 1, 2, 3, 3, 2, 1, 0 }, 3), 1);
  EXPECT_EQ(surfaces({ 0, 1, 2, 3, 3, 2, 1, 0 }, 2), 2);
}

TEST(BoundaryNet, IsTheVoxelFacesWhereNothingIsAmbiguous)
{
  const SegmentVolume volume = MakeVolume({ 6, 5, 4 }, [](double x, double y, double z)
    { return x > 0 && x < 4 && y > 1 && y < 4 && z > 0 && z < 3; });
  const BoundaryNet net = BuildBoundaryNet(volume.View(), Execution());
  const auto faces = FacesOf(net, 1);
  EXPECT_EQ(faces.size(), 2u * (3 * 2 + 2 * 2 + 3 * 2));
  EXPECT_EQ(EulerNumber(faces), 2);
  for (const BoundaryVertex& vertex : net.Vertices)
  {
    EXPECT_TRUE(vertex.Alone);
    for (int a = 0; a < 3; ++a)
    {
      const float x = vertex.Anchor[a];
      EXPECT_EQ(x - 0.5f, std::round(x - 0.5f));
      EXPECT_EQ(vertex.FixedAxes >> a & 1, x == -0.5f || x == volume.Size[a] - 0.5f);
    }
  }
}

TEST(BoundaryNet, DoesNotDependOnThreads)
{
  const SegmentVolume volume = RandomVolume({ 20, 10, 50 }, 4, 7);
  const BoundaryNet one = BuildBoundaryNet(volume.View(), Execution());
  const BoundaryNet three = BuildBoundaryNet(volume.View(), ThreadedExecution(3));
  ASSERT_EQ(one.Faces.size(), three.Faces.size());
  ASSERT_EQ(one.Vertices.size(), three.Vertices.size());
  for (std::size_t f = 0; f < one.Faces.size(); ++f)
  {
    ASSERT_EQ(one.Faces[f].Vertices, three.Faces[f].Vertices);
    ASSERT_EQ(one.Faces[f].Labels, three.Faces[f].Labels);
  }
  for (std::size_t v = 0; v < one.Vertices.size(); ++v)
  {
    ASSERT_EQ(one.Vertices[v].Anchor, three.Vertices[v].Anchor);
  }
}
