// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "LayoutCutting.h"

#include "LayoutCutter.h"

#include <stdexcept>
#include <string>

namespace trivariate
{
using Eigen::Vector2d;
using Eigen::Vector3d;

//------------------------------------------------------------------------------
Vector2d LayoutCutter::CornerPlace(Index face, Index corner) const
{
  const std::array<Index, 2> at = this->Map.Charts.LinesAt(face, corner);
  return { this->Map.LineValue(at[0]), this->Map.LineValue(at[1]) };
}

//------------------------------------------------------------------------------
// A triangle on the left of a border in the chart of the face there.
void LayoutCutter::Claim(Index edge, bool forwards, std::vector<Index>& waiting)
{
  const Polycube::Edge& e = this->Cubes.Edges[edge];
  const Index face = forwards ? e.Left : e.Right;
  const std::vector<Index>& line = this->Borders[edge];
  const Index from = forwards ? line[0] : line.back();
  const Index to = forwards ? line[1] : line[line.size() - 2];
  const Index t = this->Mesh.TriangleLeftOf(from, to);
  if (this->Faces[t] >= 0)
  {
    return;
  }
  const int own = this->Mesh.CornerOf(t, from);
  const Vector2d along = this->Places[t][(own + 1) % 3] - this->Places[t][own];
  const Vector2d direction = (forwards ? 1.0 : -1.0) * this->Map.Charts.Direction(face, edge);
  int& turn = this->Turns[t];
  while (turn < 3 && Turned(along, turn).dot(direction) < 0.9 * along.norm())
  {
    ++turn;
  }
  this->Faces[t] = face;
  this->Shifts[t] =
    this->CornerPlace(face, forwards ? e.From : e.To) - Turned(this->Places[t][own], turn);
  waiting.push_back(t);
}

//------------------------------------------------------------------------------
// Fills the faces from their borders, and tells the way from each triangle's chart to its face's.
void LayoutCutter::FillFaces()
{
  const std::size_t count = this->Places.size();
  this->Faces.assign(count, -1);
  this->Turns.assign(count, 0);
  this->Shifts.assign(count, Vector2d::Zero());
  std::vector<Index> waiting;
  for (std::size_t e = 0; e < this->Borders.size(); ++e)
  {
    this->Claim(static_cast<Index>(e), true, waiting);
    this->Claim(static_cast<Index>(e), false, waiting);
  }
  while (!waiting.empty())
  {
    const Index t = waiting.back();
    waiting.pop_back();
    for (int k = 0; k < 3; ++k)
    {
      const Index u = this->Mesh.Neighbour(t, k);
      if (this->Mesh.Mark(t, k) >= 0)
      {
        continue;
      }
      if (this->Faces[u] < 0)
      {
        const int there = (this->Mesh.SideAcross(t, k) + 1) % 3;
        this->Faces[u] = this->Faces[t];
        this->Turns[u] = (this->Turns[t] + 4 - this->TurnAcross(t, k)) % 4;
        this->Shifts[u] = this->InFace(t, k) - Turned(this->Places[u][there], this->Turns[u]);
        waiting.push_back(u);
      }
      else if (this->Faces[u] != this->Faces[t])
      {
        throw std::runtime_error("Two faces are not separated by borders.");
      }
    }
  }
}

//------------------------------------------------------------------------------
// The lattice's coordinates of all points, those of borders from their lengths in the charts.
std::vector<Vector3d> LayoutCutter::Parameters() const
{
  std::vector<Vector3d> parameters(this->Mesh.Points.size());
  const auto lattice = [this](Index corner)
  {
    const LatticePoint& p = this->Cubes.Points[corner];
    return Vector3d(p[0], p[1], p[2]);
  };
  for (std::size_t t = 0; t < this->Faces.size(); ++t)
  {
    const Polycube::Face& face = this->Cubes.Faces[this->Faces[t]];
    const std::array<int, 2> axes = this->Map.Charts.Axes(this->Faces[t]);
    const Vector2d low = this->CornerPlace(this->Faces[t], face.Corners[0]);
    const Vector2d high = this->CornerPlace(this->Faces[t], face.Corners[2]);
    const Vector3d first = lattice(face.Corners[0]), last = lattice(face.Corners[2]);
    for (int k = 0; k < 3; ++k)
    {
      const Vector2d share =
        (this->InFace(static_cast<Index>(t), k) - low).cwiseQuotient(high - low);
      Vector3d& place = parameters[this->Mesh.Triangles[t][k]];
      place = first;
      for (const int j : { 0, 1 })
      {
        place[axes[j]] += share[j] * (last[axes[j]] - first[axes[j]]);
      }
    }
  }
  for (std::size_t e = 0; e < this->Borders.size(); ++e)
  {
    const std::vector<Index>& line = this->Borders[e];
    std::vector<double> ways(1, 0.0);
    for (std::size_t i = 0; i + 1 < line.size(); ++i)
    {
      const Index t = this->Mesh.TriangleLeftOf(line[i], line[i + 1]);
      const int own = this->Mesh.CornerOf(t, line[i]);
      ways.push_back(ways.back() + (this->Places[t][(own + 1) % 3] - this->Places[t][own]).norm());
    }
    const Vector3d from = lattice(this->Cubes.Edges[e].From), to = lattice(this->Cubes.Edges[e].To);
    for (std::size_t i = 0; i < line.size(); ++i)
    {
      parameters[line[i]] = from + ways[i] / ways.back() * (to - from);
    }
  }
  return parameters;
}

//------------------------------------------------------------------------------
SurfaceLayout LayoutCutter::Result()
{
  this->TraceAll();
  this->FillFaces();
  SurfaceLayout layout{ this->Mesh.Points, this->Mesh.Triangles, {}, this->Faces,
    this->Old.PatchLabels, this->CornerPoints, this->Old.Borders, this->Parameters() };
  for (const Index origin : this->Mesh.Origins)
  {
    layout.Origins.push_back(this->Old.Origins[origin]);
  }
  for (std::size_t e = 0; e < this->Borders.size(); ++e)
  {
    layout.Borders[e].Points = this->Borders[e];
  }
  for (std::size_t t = 0; t < layout.Triangles.size(); ++t)
  {
    const Triangle& c = layout.Triangles[t];
    const std::array<int, 2> axes = this->Map.Charts.Axes(layout.Patches[t]);
    const Vector3d a = layout.Parameters[c[1]] - layout.Parameters[c[0]];
    const Vector3d b = layout.Parameters[c[2]] - layout.Parameters[c[0]];
    if (!(a[axes[0]] * b[axes[1]] - a[axes[1]] * b[axes[0]] > 0.0))
    {
      throw std::runtime_error(
        "A triangle is folded in face " + std::to_string(layout.Patches[t]) + ".");
    }
  }
  return layout;
}

//------------------------------------------------------------------------------
SurfaceLayout CutAlongEdges(const LayoutUnfolding& unfolding, const SurfaceLayout& layout)
{
  return LayoutCutter(unfolding, layout).Result();
}
}
