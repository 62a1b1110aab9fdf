// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "LayoutMesh.h"

#include <numeric>

namespace trivariate
{
//------------------------------------------------------------------------------
LayoutMesh::LayoutMesh(const SurfaceMesh& mesh)
  : Points(mesh.Points)
  , Triangles(mesh.Triangles)
  , Origins(mesh.Triangles.size())
  , Occupied(mesh.Points.size(), 0)
  , Neighbours(mesh.Triangles.size())
  , Marks(mesh.Triangles.size(), { -1, -1, -1 })
  , OneTriangle(mesh.Points.size(), -1)
{
  std::iota(this->Origins.begin(), this->Origins.end(), Index(0));
  for (Index t = 0; t < this->NumberOfTriangles(); ++t)
  {
    for (int k = 0; k < 3; ++k)
    {
      this->Neighbours[t][k] = mesh.Neighbour(t, k);
      this->OneTriangle[this->Triangles[t][k]] = t;
    }
  }
}

//------------------------------------------------------------------------------
Index LayoutMesh::TriangleLeftOf(Index p, Index q) const
{
  const Index first = this->TriangleAt(p);
  Index t = first;
  do
  {
    if (this->Triangles[t][(this->CornerOf(t, p) + 1) % 3] == q)
    {
      return t;
    }
    t = this->Anticlockwise(t, p);
  } while (t != first);
  return -1;
}

//------------------------------------------------------------------------------
void LayoutMesh::SetMark(Index t, int k, Index mark)
{
  const int across = this->SideAcross(t, k);
  this->Marks[t][k] = mark;
  this->Marks[this->Neighbours[t][k]][across] = mark;
}

//------------------------------------------------------------------------------
// Triangle t = (a, b, c) becomes (a, m, c) and (m, b, c); its neighbour u = (b, a, d) becomes
// (m, a, d) and (b, m, d). Sides of t are counted from a, those of u from b.
Index LayoutMesh::SplitEdge(Index t, int k, double where)
{
  const Index u = this->Neighbours[t][k];
  const int j = this->SideAcross(t, k);
  const int k1 = (k + 1) % 3, k2 = (k + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
  const Index a = this->Triangles[t][k], b = this->Triangles[t][k1];
  const Index m = this->NumberOfPoints(), t2 = this->NumberOfTriangles(), u2 = t2 + 1;
  const Index mark = this->Marks[t][k];

  this->Points.push_back((1.0 - where) * this->Points[a] + where * this->Points[b]);
  this->Occupied.push_back(mark >= 0);
  this->OneTriangle.push_back(t);
  this->OneTriangle[b] = t2;
  for (const Index old : { t, u })
  {
    // Copied with all corners in their places, then corrected below.
    this->Triangles.push_back(Triangle(this->Triangles[old]));
    this->Neighbours.push_back(std::array<Index, 3>(this->Neighbours[old]));
    this->Marks.push_back(std::array<Index, 3>(this->Marks[old]));
    this->Origins.push_back(Index(this->Origins[old]));
  }
  const Index acrossT = this->Neighbours[t][k1], acrossU = this->Neighbours[u][j2];
  for (auto [across, old, now] : { std::array<Index, 3>{ acrossT, t, t2 }, { acrossU, u, u2 } })
  {
    // Where the neighbour is one of the four, its side is set below.
    for (Index& neighbour : this->Neighbours[across])
    {
      neighbour = neighbour == old ? now : neighbour;
    }
  }
  this->Triangles[t][k1] = m;
  this->Triangles[t2][k] = m;
  this->Triangles[u][j] = m;
  this->Triangles[u2][j1] = m;

  this->Neighbours[t][k] = u;
  this->Neighbours[t][k1] = t2;
  this->Neighbours[t2][k] = u2;
  this->Neighbours[t2][k2] = t;
  this->Neighbours[u][j] = t;
  this->Neighbours[u][j2] = u2;
  this->Neighbours[u2][j] = t2;
  this->Neighbours[u2][j1] = u;

  this->Marks[t][k1] = this->Marks[t2][k2] = this->Marks[u][j2] = this->Marks[u2][j1] = -1;
  return m;
}
}
