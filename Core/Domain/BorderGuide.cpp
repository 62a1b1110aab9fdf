// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "BorderGuide.h"

#include <functional>
#include <queue>
#include <set>

namespace trivariate
{
namespace
{
constexpr double Spacing = 4.0;  // edges between waypoints
constexpr double Margin = 1.0;   // edges around them without other borders
constexpr double Farthest = 1.5; // edges from a border to a waypoint

// Points of a layout by their distance along edges from one of them, as far as a radius, until
// `visit` says stop.
void VisitNear(const SurfaceLayout& layout, const std::vector<std::vector<Index>>& neighbours,
  Index start, double radius, const std::function<bool(Index, double)>& visit)
{
  using Reached = std::pair<double, Index>;
  std::priority_queue<Reached, std::vector<Reached>, std::greater<Reached>> waiting;
  std::set<Index> done;
  waiting.push({ 0.0, start });
  while (!waiting.empty())
  {
    const auto [distance, point] = waiting.top();
    waiting.pop();
    if (!done.insert(point).second)
    {
      continue;
    }
    if (!visit(point, distance))
    {
      return;
    }
    for (const Index next : neighbours[point])
    {
      const double there = distance + (layout.Points[next] - layout.Points[point]).norm();
      if (there <= radius)
      {
        waiting.push({ there, next });
      }
    }
  }
}
}

//------------------------------------------------------------------------------
BorderGuide::BorderGuide(const ReducedSurface& few, const SurfaceLayout& layout)
  : Few(few)
  , Layout(layout)
  , Neighbours(layout.Points.size())
  , BorderOf(layout.Points.size(), None)
{
  for (const Triangle& c : layout.Triangles)
  {
    for (int k = 0; k < 3; ++k)
    {
      this->Neighbours[c[k]].push_back(c[(k + 1) % 3]);
    }
  }
  for (const Triangle& c : few.Mesh.Triangles)
  {
    for (int k = 0; k < 3; ++k)
    {
      this->MeanLength += (few.Mesh.Points[c[(k + 1) % 3]] - few.Mesh.Points[c[k]]).norm() /
                          (3.0 * double(few.Mesh.NumberOfTriangles()));
    }
  }
  for (std::size_t b = 0; b < layout.Borders.size(); ++b)
  {
    for (const Index p : layout.Borders[b].Points)
    {
      this->BorderOf[p] = this->BorderOf[p] == None ? static_cast<Index>(b) : Several;
    }
  }
}

//------------------------------------------------------------------------------
double BorderGuide::Length(Index border) const
{
  const std::vector<Index>& points = this->Layout.Borders[border].Points;
  double length = 0.0;
  for (std::size_t i = 0; i + 1 < points.size(); ++i)
  {
    length += (this->Layout.Points[points[i + 1]] - this->Layout.Points[points[i]]).norm();
  }
  return length;
}

//------------------------------------------------------------------------------
// Whether there is no other border within the radius.
bool BorderGuide::IsAlone(Index point, Index border, double radius) const
{
  bool alone = true;
  VisitNear(this->Layout, this->Neighbours, point, radius,
    [&](Index p, double)
    {
      alone = !this->IsBorder(p) || this->BorderOf[p] == border;
      return alone;
    });
  return alone;
}

//------------------------------------------------------------------------------
// The nearest point of the surface itself, not made where a border was cut; -1 where there is none.
Index BorderGuide::PointNear(Index point, Index border, double& distance) const
{
  Index found = -1;
  VisitNear(this->Layout, this->Neighbours, point, Farthest * this->MeanLength,
    [&](Index p, double way)
    {
      if (p < this->Few.Mesh.NumberOfPoints() &&
          (!this->IsBorder(p) || this->BorderOf[p] == border))
      {
        found = p;
        distance = way;
      }
      return found < 0;
    });
  return found;
}

//------------------------------------------------------------------------------
std::vector<BorderGuide::Waypoint> BorderGuide::Along(Index border) const
{
  const std::vector<Index>& points = this->Layout.Borders[border].Points;
  const double length = this->Length(border), spacing = Spacing * this->MeanLength;
  std::vector<Waypoint> waypoints;
  double way = 0.0, last = 0.0;
  for (std::size_t i = 1; i + 1 < points.size(); ++i)
  {
    way += (this->Layout.Points[points[i]] - this->Layout.Points[points[i - 1]]).norm();
    if (way - last < spacing || length - way < 0.5 * spacing)
    {
      continue;
    }
    double distance = 0.0;
    const Index near = this->PointNear(points[i], border, distance);
    if (near >= 0 && this->IsAlone(near, border, 2.0 * distance + Margin * this->MeanLength))
    {
      waypoints.push_back({ this->Few.Points[near], way });
      last = way;
    }
  }
  return waypoints;
}
}
