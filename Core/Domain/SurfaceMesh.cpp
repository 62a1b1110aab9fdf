// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "SurfaceMesh.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <stdexcept>
#include <string>

namespace trivariate
{
namespace
{
// An edge from its lower to its higher point, as a side of a triangle.
struct Side
{
  Index Low, High, Triangle;
  int Corner;
  bool Ascending;

  bool SameEdge(const Side& other) const
  {
    return this->Low == other.Low && this->High == other.High;
  }
};
}

//------------------------------------------------------------------------------
SurfaceMesh::SurfaceMesh(std::vector<Eigen::Vector3d> points, std::vector<Triangle> triangles)
  : Points(std::move(points))
  , Triangles(std::move(triangles))
{
  const Index n = this->NumberOfPoints(), m = this->NumberOfTriangles();
  std::vector<Side> sides;
  sides.reserve(3 * m);
  this->FanStart.assign(n + 1, 0);
  for (Index t = 0; t < m; ++t)
  {
    for (int k = 0; k < 3; ++k)
    {
      const Index a = this->Triangles[t][k], b = this->Triangles[t][(k + 1) % 3];
      sides.push_back({ std::min(a, b), std::max(a, b), t, k, a < b });
      ++this->FanStart[a + 1];
    }
  }
  std::sort(sides.begin(), sides.end(),
    [](const Side& a, const Side& b)
    {
      return a.Low != b.Low     ? a.Low < b.Low
             : a.High != b.High ? a.High < b.High
                                : a.Triangle < b.Triangle;
    });
  this->Neighbours.resize(m);
  for (auto side = sides.begin(); side != sides.end();)
  {
    const auto end =
      std::find_if(side, sides.end(), [side](const Side& other) { return !other.SameEdge(*side); });
    if (end - side != 2 || side[0].Ascending == side[1].Ascending)
    {
      throw std::invalid_argument(
        "The surface is not closed, two-manifold and oriented: the edge from point " +
        std::to_string(side->Low) + " to point " + std::to_string(side->High) + " has " +
        std::to_string(end - side) +
        (end - side == 2 ? " triangles of opposite orientations." : " triangle(s)."));
    }
    this->Neighbours[side[0].Triangle][side[0].Corner] = side[1].Triangle;
    this->Neighbours[side[1].Triangle][side[1].Corner] = side[0].Triangle;
    side = end;
  }

  std::vector<Index> first(n, -1);
  for (Index t = m - 1; t >= 0; --t)
  {
    for (const Index p : this->Triangles[t])
    {
      first[p] = t;
    }
  }
  for (Index p = 0; p < n; ++p)
  {
    const Index size = this->FanStart[p + 1];
    this->FanStart[p + 1] += this->FanStart[p];
    Index t = first[p], count = 0;
    while (t >= 0 && (count == 0 || t != first[p]))
    {
      this->Fans.push_back(t);
      ++count;
      t = this->Neighbour(t, (this->CornerOf(t, p) + 2) % 3);
    }
    if (count != size)
    {
      throw std::invalid_argument(
        "The surface is not two-manifold: it touches itself at point " + std::to_string(p) + ".");
    }
  }
}

//------------------------------------------------------------------------------
Eigen::Vector3d SurfaceMesh::AreaVector(Index t) const
{
  const Triangle& c = this->Triangles[t];
  return 0.5 *
         (this->Points[c[1]] - this->Points[c[0]]).cross(this->Points[c[2]] - this->Points[c[0]]);
}

//------------------------------------------------------------------------------
Index SurfaceMesh::EulerCharacteristic() const
{
  Index used = 0;
  for (Index p = 0; p < this->NumberOfPoints(); ++p)
  {
    used += this->FanBegin(p) != this->FanEnd(p);
  }
  return used - this->NumberOfTriangles() / 2;
}

//------------------------------------------------------------------------------
std::vector<Index> SurfaceMesh::Components(Index& count) const
{
  std::vector<Index> component(this->Triangles.size(), -1), waiting;
  count = 0;
  for (Index seed = 0; seed < this->NumberOfTriangles(); ++seed)
  {
    if (component[seed] >= 0)
    {
      continue;
    }
    component[seed] = count;
    waiting.push_back(seed);
    while (!waiting.empty())
    {
      const Index t = waiting.back();
      waiting.pop_back();
      for (const Index next : this->Neighbours[t])
      {
        if (component[next] < 0)
        {
          component[next] = count;
          waiting.push_back(next);
        }
      }
    }
    ++count;
  }
  return component;
}
}
