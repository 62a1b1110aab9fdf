// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "LayoutCutter.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace trivariate
{
namespace
{
using Eigen::Vector2d;

constexpr double Near = 0.1;       // of an edge: where a line does not cut it but takes its end
constexpr double LeastShare = 0.2; // of its area that a triangle must keep then
constexpr double SamePlace = 1e-7; // of the polycube's longest side

double Cross(const Vector2d& a, const Vector2d& b)
{
  return a.x() * b.y() - a.y() * b.x();
}

}

//------------------------------------------------------------------------------
double LayoutCutter::LengthOf(Index edge) const
{
  const Polycube::Edge& e = this->Cubes.Edges[edge];
  return (this->CornerPlace(e.Left, e.To) - this->CornerPlace(e.Left, e.From)).norm();
}

//------------------------------------------------------------------------------
// The quarter turns from a triangle's chart to that of the triangle across a side.
int LayoutCutter::TurnAcross(Index t, int side) const
{
  const Index u = this->Mesh.Neighbour(t, side);
  const int there = this->Mesh.SideAcross(t, side);
  const Vector2d edge = this->Places[t][(side + 1) % 3] - this->Places[t][side];
  const Vector2d edgeThere = this->Places[u][there] - this->Places[u][(there + 1) % 3];
  int turn = 0;
  for (int quarters = 1; quarters < 4; ++quarters)
  {
    turn =
      Turned(edge, quarters).dot(edgeThere) > Turned(edge, turn).dot(edgeThere) ? quarters : turn;
  }
  return turn;
}

//------------------------------------------------------------------------------
// The same line in the chart of the triangle across a side: turned by quarters, and moved.
LineHeading LayoutCutter::Across(const LineHeading& heading, int side) const
{
  const Index t = heading.Triangle, u = this->Mesh.Neighbour(t, side);
  const int turn = this->TurnAcross(t, side), there = this->Mesh.SideAcross(t, side);
  return { u, Turned(heading.Along, turn),
    this->Places[u][(there + 1) % 3] + Turned(heading.End - this->Places[t][side], turn) };
}

//------------------------------------------------------------------------------
LineHeading LayoutCutter::TurnedTo(LineHeading heading, Index point, bool anticlockwise) const
{
  const int corner = this->Mesh.CornerOf(heading.Triangle, point);
  return this->Across(heading, anticlockwise ? (corner + 2) % 3 : corner);
}

//------------------------------------------------------------------------------
// The triangle at the point into which the line goes; not farther than half around.
LineHeading LayoutCutter::Facing(LineHeading heading, Index point) const
{
  int direction = 0;
  for (int steps = 0; steps < 1000; ++steps)
  {
    const int corner = this->Mesh.CornerOf(heading.Triangle, point);
    const TrianglePlaces& places = this->Places[heading.Triangle];
    const Vector2d first = places[(corner + 1) % 3] - places[corner];
    const Vector2d second = places[(corner + 2) % 3] - places[corner];
    const double left = Cross(first, heading.Along), right = Cross(heading.Along, second);
    if (left >= 0.0 && right >= 0.0)
    {
      return heading;
    }
    if (direction == 0)
    {
      direction =
        left >= 0.0 || (right < 0.0 && Cross(first + second, heading.Along) > 0.0) ? 1 : -1;
    }
    heading = this->TurnedTo(heading, point, direction > 0);
  }
  throw std::runtime_error("A border loses its way at point " + std::to_string(point) + ".");
}

//------------------------------------------------------------------------------
// From a border that is there already, at whose side the direction is known; at a corner where the
// polycube is not flat, from where the face on the edge's left begins.
LineHeading LayoutCutter::Start(Index edge, Index corner) const
{
  const std::vector<Index>& around = this->Cubes.EdgesAround[corner];
  const Index point = this->CornerPoints[corner];
  const auto place =
    static_cast<int>(std::find(around.begin(), around.end(), edge) - around.begin());
  const double length = this->LengthOf(edge);
  for (std::size_t i = 0; i < around.size(); ++i)
  {
    const std::vector<Index>& known = this->Borders[around[i]];
    if (known.empty())
    {
      continue;
    }
    const Index next = known.front() == point ? known[1] : known[known.size() - 2];
    LineHeading heading{ this->Mesh.TriangleLeftOf(point, next), Vector2d::Zero(),
      Vector2d::Zero() };
    const auto count = static_cast<int>(around.size());
    const int steps = (place - static_cast<int>(i) + count) % count;
    for (int step = 0; step <= steps; ++step)
    {
      const int own = this->Mesh.CornerOf(heading.Triangle, point);
      const TrianglePlaces& places = this->Places[heading.Triangle];
      if (step == 0)
      {
        const Vector2d along = places[(own + 1) % 3] - places[own];
        heading.Along = std::abs(along.x()) > std::abs(along.y())
                          ? Vector2d(std::copysign(1.0, along.x()), 0.0)
                          : Vector2d(0.0, std::copysign(1.0, along.y()));
      }
      else
      {
        heading.Along = Turned(heading.Along, 1);
        heading = this->Facing(heading, point);
      }
      heading.End = this->Places[heading.Triangle][this->Mesh.CornerOf(heading.Triangle, point)] +
                    length * heading.Along;
    }
    return heading;
  }
  const Polycube::Edge& e = this->Cubes.Edges[edge];
  const bool forwards = e.From == corner;
  const Index face = forwards ? e.Left : e.Right;
  Index t = this->Mesh.TriangleAt(point);
  for (const Index first = t;
       this->Charts[t] != face || this->Charts[this->Mesh.Clockwise(t, point)] == face;)
  {
    t = this->Mesh.Anticlockwise(t, point);
    if (t == first)
    {
      throw std::runtime_error("A corner does not touch its face.");
    }
  }
  const Vector2d along = (forwards ? 1.0 : -1.0) * this->Map.Charts.Direction(face, edge);
  return this->Facing(
    { t, along, this->Places[t][this->Mesh.CornerOf(t, point)] + length * along }, point);
}

//------------------------------------------------------------------------------
Index LayoutCutter::Split(Index t, int side, double where)
{
  const Index u = this->Mesh.Neighbour(t, side);
  const int there = this->Mesh.SideAcross(t, side);
  const int k1 = (side + 1) % 3, j1 = (there + 1) % 3;
  const Vector2d mine = (1.0 - where) * this->Places[t][side] + where * this->Places[t][k1];
  const Vector2d its = (1.0 - where) * this->Places[u][j1] + where * this->Places[u][there];
  const Index point = this->Mesh.SplitEdge(t, side, where);
  for (const Index old : { t, u })
  {
    this->Places.push_back(TrianglePlaces(this->Places[old]));
    this->Charts.push_back(Index(this->Charts[old]));
  }
  const std::size_t t2 = this->Places.size() - 2, u2 = t2 + 1;
  this->Places[t][k1] = this->Places[t2][side] = mine;
  this->Places[u][there] = this->Places[u2][j1] = its;
  return point;
}

//------------------------------------------------------------------------------
// Moves a corner of a triangle to another place in its chart, and in those around it, unless that
// would make one of its triangles much smaller.
bool LayoutCutter::MoveOnto(Index t, int corner, const Vector2d& place)
{
  const Index point = this->Mesh.Triangles[t][corner];
  if (this->Mesh.Occupied[point])
  {
    return false;
  }
  std::vector<std::pair<Index, Vector2d>> moved;
  LineHeading heading{ t, Vector2d::Zero(), place };
  do
  {
    const int own = this->Mesh.CornerOf(heading.Triangle, point);
    const TrianglePlaces& p = this->Places[heading.Triangle];
    const Vector2d &a = p[(own + 1) % 3], &b = p[(own + 2) % 3];
    if (Cross(a - heading.End, b - heading.End) < LeastShare * Cross(a - p[own], b - p[own]))
    {
      return false;
    }
    moved.emplace_back(heading.Triangle, heading.End);
    heading = this->TurnedTo(heading, point, true);
  } while (heading.Triangle != t);
  for (const auto& [triangle, where] : moved)
  {
    this->Places[triangle][this->Mesh.CornerOf(triangle, point)] = where;
  }
  return true;
}

//------------------------------------------------------------------------------
// The end of a line, inside of a triangle, as a point: one of its corners moved there where it is
// close, else a new one.
Index LayoutCutter::EndInside(const LineHeading& heading, Index point, double where, double share)
{
  const Index t = heading.Triangle;
  const TrianglePlaces places = this->Places[t];
  const double area = Cross(places[1] - places[0], places[2] - places[0]);
  for (int corner = 0; corner < 3; ++corner)
  {
    const Vector2d &a = places[(corner + 1) % 3], &b = places[(corner + 2) % 3];
    if (Cross(a - heading.End, b - heading.End) > (1.0 - 2.0 * Near) * area &&
        this->MoveOnto(t, corner, heading.End))
    {
      return this->Mesh.Triangles[t][corner];
    }
  }
  const Index beyond = this->Split(t, (this->Mesh.CornerOf(t, point) + 1) % 3, where);
  const Index left = this->Mesh.TriangleLeftOf(point, beyond);
  return this->Split(left, this->Mesh.CornerOf(left, point), share);
}

//------------------------------------------------------------------------------
// The next point of a line from a point into a triangle.
Index LayoutCutter::NextPoint(LineHeading& heading, Index point, Index& end)
{
  const Index t = heading.Triangle;
  const int own = this->Mesh.CornerOf(t, point), right = (own + 1) % 3, left = (own + 2) % 3;
  const TrianglePlaces places = this->Places[t];
  const double rest = (heading.End - places[own]).dot(heading.Along);
  if (!(rest > 0.0))
  {
    throw std::runtime_error("A border misses its end.");
  }
  for (const int corner : { right, left })
  {
    if (this->Mesh.Triangles[t][corner] == end &&
        (places[corner] - heading.End).norm() < SamePlace * this->Longest)
    {
      return end;
    }
  }
  const double toRight = Cross(heading.Along, places[right] - places[own]);
  const double toLeft = Cross(heading.Along, places[left] - places[own]);
  const double where = std::clamp(-toRight / (toLeft - toRight), 0.0, 1.0);
  const Vector2d exit = (1.0 - where) * places[right] + where * places[left];
  const double way = (exit - places[own]).dot(heading.Along);
  const bool atEnd = end < 0 && std::abs(way - rest) < SamePlace * this->Longest;
  if (end < 0 && way > rest && !atEnd)
  {
    return end = this->EndInside(heading, point, where, rest / way);
  }
  const int close = where < Near ? right : where > 1.0 - Near ? left : -1;
  Index next = -1;
  if (close >= 0 && this->MoveOnto(t, close, exit))
  {
    next = this->Mesh.Triangles[t][close];
  }
  else
  {
    heading = this->Across(heading, right);
    next = this->Split(t, right, where);
  }
  end = atEnd ? next : end;
  return next;
}

//------------------------------------------------------------------------------
void LayoutCutter::Trace(Index edge, Index from)
{
  const Polycube::Edge& e = this->Cubes.Edges[edge];
  Index& end = this->CornerPoints[e.From == from ? e.To : e.From];
  LineHeading heading = this->Start(edge, from);
  std::vector<Index> line(1, this->CornerPoints[from]);
  while (line.back() != end)
  {
    if (line.size() > this->Mesh.Points.size())
    {
      throw std::runtime_error("A border does not end.");
    }
    heading = this->Facing(heading, line.back());
    line.push_back(this->NextPoint(heading, line.back(), end));
    this->Mesh.Occupied[line.back()] = 1;
  }
  if (e.From != from)
  {
    std::reverse(line.begin(), line.end());
  }
  for (std::size_t i = 0; i + 1 < line.size(); ++i)
  {
    const Index t = this->Mesh.TriangleLeftOf(line[i], line[i + 1]);
    if (t < 0)
    {
      throw std::runtime_error("A border is interrupted.");
    }
    this->Mesh.SetMark(t, this->Mesh.CornerOf(t, line[i]), edge);
  }
  this->Borders[edge] = std::move(line);
}

//------------------------------------------------------------------------------
// From corner to corner, beginning at those that are known.
void LayoutCutter::TraceAll()
{
  std::vector<Index> waiting;
  std::vector<char> reached(this->CornerPoints.size(), 0);
  for (std::size_t corner = 0; corner < reached.size(); ++corner)
  {
    if (this->CornerPoints[corner] >= 0)
    {
      reached[corner] = 1;
      waiting.push_back(static_cast<Index>(corner));
    }
  }
  for (std::size_t i = 0; i < waiting.size(); ++i)
  {
    for (const Index edge : this->Cubes.EdgesAround[waiting[i]])
    {
      const Polycube::Edge& e = this->Cubes.Edges[edge];
      const Index other = e.From == waiting[i] ? e.To : e.From;
      if (this->Borders[edge].empty())
      {
        this->Trace(edge, waiting[i]);
      }
      if (!reached[other])
      {
        reached[other] = 1;
        waiting.push_back(other);
      }
    }
  }
}
}
