// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "HandleLoop.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <queue>

namespace trivariate
{
namespace
{
// Of an edge, counted from the one of its triangles with the lower number.
struct Closing
{
  double Length; // of the loop along the tree and over the edge
  Index Triangle;
  int Side;
};

struct Tree
{
  std::vector<double> Way;
  std::vector<Index> Parents;
};

Tree ShortestWays(const SurfaceMesh& mesh, Index root)
{
  Tree tree{ std::vector<double>(mesh.Points.size(), std::numeric_limits<double>::infinity()),
    std::vector<Index>(mesh.Points.size(), -1) };
  using Entry = std::pair<double, Index>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> front;
  tree.Way[root] = 0.0;
  front.push({ 0.0, root });
  while (!front.empty())
  {
    const auto [length, p] = front.top();
    front.pop();
    if (length > tree.Way[p])
    {
      continue;
    }
    for (const Index* t = mesh.FanBegin(p); t != mesh.FanEnd(p); ++t)
    {
      const Index q = mesh.Triangles[*t][(mesh.CornerOf(*t, p) + 1) % 3];
      const double sum = length + (mesh.Points[q] - mesh.Points[p]).norm();
      if (sum < tree.Way[q])
      {
        tree.Way[q] = sum;
        tree.Parents[q] = p;
        front.push({ sum, q });
      }
    }
  }
  return tree;
}

// The edge that closes the shortest loop through the root that is no boundary of a disc: cut open
// along the tree and all edges but those of a tree of triangles, long loops first, the surface
// would be a disc.
Closing ShortestLoop(const SurfaceMesh& mesh, const Tree& tree)
{
  std::vector<Closing> edges;
  for (Index t = 0; t < mesh.NumberOfTriangles(); ++t)
  {
    for (int k = 0; k < 3; ++k)
    {
      const Index p = mesh.Triangles[t][k], q = mesh.Triangles[t][(k + 1) % 3];
      if (mesh.Neighbour(t, k) > t && tree.Parents[p] != q && tree.Parents[q] != p)
      {
        edges.push_back(
          { tree.Way[p] + tree.Way[q] + (mesh.Points[p] - mesh.Points[q]).norm(), t, k });
      }
    }
  }
  std::sort(edges.begin(), edges.end(),
    [](const Closing& a, const Closing& b) { return a.Length > b.Length; });
  std::vector<Index> above(mesh.Triangles.size());
  std::iota(above.begin(), above.end(), Index(0));
  const auto root = [&above](Index t)
  {
    while (above[t] != t)
    {
      t = above[t] = above[above[t]];
    }
    return t;
  };
  Closing shortest{ std::numeric_limits<double>::infinity(), -1, 0 };
  for (const Closing& edge : edges)
  {
    const Index a = root(edge.Triangle), b = root(mesh.Neighbour(edge.Triangle, edge.Side));
    if (a != b)
    {
      above[a] = b;
    }
    else
    {
      shortest = edge; // they come in descending order
    }
  }
  return shortest;
}
}

//------------------------------------------------------------------------------
HandleLoop FindHandle(const SurfaceMesh& mesh)
{
  HandleLoop handle{ Eigen::Vector3d::Zero(), 0.0 };
  for (Index root = 0;;)
  {
    const Closing loop = ShortestLoop(mesh, ShortestWays(mesh, root));
    if (loop.Triangle < 0 || (handle.Length > 0.0 && loop.Length >= handle.Length))
    {
      return handle;
    }
    root = mesh.Triangles[loop.Triangle][loop.Side];
    handle = { mesh.Points[root], loop.Length };
  }
}
}
