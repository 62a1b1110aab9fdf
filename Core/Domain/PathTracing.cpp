// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "PathTracing.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <unordered_set>

namespace trivariate
{
namespace
{
constexpr double SnapDistance = 0.05;
constexpr double Clearance = 0.1;

// A point of a path to be: a point of the mesh, or a place on an edge.
struct Station
{
  Index Point; // -1: on the edge from Right to Left
  Index Right, Left;
  double Fraction;
};

std::vector<Station> StationsOf(const LayoutMesh& mesh, const Geodesic& path)
{
  std::vector<Station> stations;
  std::unordered_set<Index> points; // of them
  for (std::size_t i = 0; i < path.Crossings.size(); ++i)
  {
    const Index t = path.Crossings[i] / 3, side = path.Crossings[i] % 3;
    Station station{ -1, mesh.Triangles[t][side], mesh.Triangles[t][(side + 1) % 3],
      path.Fractions[i] };
    const bool nearRight = station.Fraction < SnapDistance;
    const bool nearLeft = station.Fraction > 1.0 - SnapDistance;
    const bool bends = station.Fraction == 0.0 || station.Fraction == 1.0;
    if (nearRight || nearLeft)
    {
      const Index close = nearRight ? station.Right : station.Left;
      const Index far = nearRight ? station.Left : station.Right;
      station.Point = !mesh.Occupied[close] ? close : bends && !mesh.Occupied[far] ? far : -1;
    }
    if (station.Point < 0)
    {
      const double low = mesh.Occupied[station.Right] ? Clearance : SnapDistance;
      const double high = 1.0 - (mesh.Occupied[station.Left] ? Clearance : SnapDistance);
      station.Fraction = std::min(std::max(station.Fraction, low), high);
    }
    if (station.Point >= 0 && !points.insert(station.Point).second)
    {
      // The way from a point back to itself is left out.
      while (stations.back().Point != station.Point)
      {
        points.erase(stations.back().Point);
        stations.pop_back();
      }
      stations.pop_back();
    }
    stations.push_back(station);
  }
  return stations;
}

void MarkPath(LayoutMesh& mesh, const std::vector<Index>& points, Index mark)
{
  for (std::size_t i = 0; i + 1 < points.size(); ++i)
  {
    const Index t = mesh.TriangleLeftOf(points[i], points[i + 1]);
    mesh.SetMark(t, mesh.CornerOf(t, points[i]), mark);
    mesh.Occupied[points[i]] = 1;
  }
}

// Adds the points of the straightened way through a row of triangles, all but its end; false where
// it is not shorter than worthwhile.
bool SplitAlong(LayoutMesh& mesh, Index end, std::vector<Crossing> row, double worthwhile,
  std::vector<Index>& points)
{
  const Geodesic path = Straighten(mesh, points.front(), end, std::move(row));
  if (path.Length >= worthwhile)
  {
    return false;
  }
  for (const Station& station : StationsOf(mesh, path))
  {
    Index point = station.Point;
    if (point < 0)
    {
      const Index t = mesh.TriangleLeftOf(station.Right, station.Left);
      point = mesh.SplitEdge(t, mesh.CornerOf(t, station.Right), station.Fraction);
    }
    points.push_back(point);
  }
  return true;
}

// The triangles on the left of a polyline along edges.
std::vector<Crossing> RowBeside(const LayoutMesh& mesh, const std::vector<Index>& points)
{
  std::vector<Crossing> row;
  Index t = mesh.TriangleLeftOf(points[0], points[1]);
  for (std::size_t i = 1; i + 1 < points.size(); ++i)
  {
    const Index end = mesh.TriangleLeftOf(points[i], points[i + 1]);
    for (; t != end; t = mesh.Clockwise(t, points[i]))
    {
      row.push_back(3 * t + mesh.CornerOf(t, points[i]));
    }
  }
  return row;
}

// Ends with a common triangle are joined by an edge of it. Where that is another border, or leads
// out of the sectors, the triangles in the way are cut in two.
bool JoinedByEdge(LayoutMesh& mesh, PathEnd& from, PathEnd& to)
{
  std::vector<Index> common;
  std::set_intersection(from.Sector.begin(), from.Sector.end(), to.Sector.begin(), to.Sector.end(),
    std::back_inserter(common));
  bool joined = false;
  for (const Index t : common)
  {
    const int corner = mesh.CornerOf(t, from.Point);
    const int side = mesh.CornerOf(t, to.Point) == (corner + 1) % 3 ? corner : (corner + 2) % 3;
    if (mesh.Mark(t, side) < 0)
    {
      joined = true;
    }
    else
    {
      mesh.SplitEdge(t, side, 0.5);
      const Index inFrom = mesh.HasCorner(t, from.Point) ? t : mesh.NumberOfTriangles() - 2;
      const Index inTo = inFrom == t ? mesh.NumberOfTriangles() - 2 : t;
      from = SectorWith(mesh, from.Point, inFrom);
      to = SectorWith(mesh, to.Point, inTo);
      return JoinedByEdge(mesh, from, to);
    }
  }
  return joined;
}
}

//------------------------------------------------------------------------------
std::vector<Index> TracePath(
  LayoutMesh& mesh, PathEnd from, PathEnd to, Index mark, double worthwhile)
{
  if (from.Point == to.Point)
  {
    throw std::invalid_argument(
      "A path begins and ends at the same point " + std::to_string(from.Point) + ".");
  }
  std::vector<Index> points(1, from.Point);
  if (!JoinedByEdge(mesh, from, to))
  {
    std::vector<Crossing> sleeve = FindSleeve(mesh, from, to);
    if (sleeve.empty())
    {
      throw std::runtime_error("There is no path: other borders lie between its ends.");
    }
    if (!SplitAlong(mesh, to.Point, std::move(sleeve), worthwhile, points))
    {
      return {};
    }
  }
  points.push_back(to.Point);
  MarkPath(mesh, points, mark);
  return points;
}

//------------------------------------------------------------------------------
std::vector<Index> TightenPath(
  LayoutMesh& mesh, const std::vector<Index>& points, Index mark, double worthwhile)
{
  std::vector<Crossing> row = RowBeside(mesh, points);
  std::vector<Index> path(1, points.front());
  if (row.empty() || mesh.TriangleLeftOf(points.front(), points.back()) >= 0 ||
      !SplitAlong(mesh, points.back(), std::move(row), worthwhile, path))
  {
    return {};
  }
  path.push_back(points.back());
  MarkPath(mesh, path, mark);
  return path;
}

//------------------------------------------------------------------------------
double PolylineLength(const LayoutMesh& mesh, const std::vector<Index>& points)
{
  double length = 0.0;
  for (std::size_t i = 0; i + 1 < points.size(); ++i)
  {
    length += (mesh.Points[points[i + 1]] - mesh.Points[points[i]]).norm();
  }
  return length;
}
}
