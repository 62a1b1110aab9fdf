// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "BorderGuide.h"
#include "CornerPlaces.h"
#include "LayoutBuilder.h"
#include "LayoutCheck.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <string>

namespace trivariate
{
namespace
{
constexpr Index FewTriangles = 20000;   // on which paths are sought first
constexpr double StretchInEdges = 12.0; // of that surface, before all is straightened
constexpr double MostDetour = 4.0;      // against the border that is followed

// Marks them; returns the points of the corners at their ends, -1 for all other corners.
std::vector<Index> CutGivenBorders(
  LayoutMesh& mesh, const Polycube& polycube, const std::vector<GivenBorder>& given)
{
  std::vector<Index> corners(polycube.NumberOfCorners, -1);
  for (const GivenBorder& border : given)
  {
    for (std::size_t i = 0; i < border.Points.size(); ++i)
    {
      mesh.Occupied[border.Points[i]] = 1;
      if (i > 0)
      {
        const Index t = mesh.TriangleLeftOf(border.Points[i - 1], border.Points[i]);
        mesh.SetMark(t, mesh.CornerOf(t, border.Points[i - 1]), border.Edge);
      }
    }
    corners[polycube.Edges[border.Edge].From] = border.Points.front();
    corners[polycube.Edges[border.Edge].To] = border.Points.back();
  }
  return corners;
}

// Edges of a tree that spans what `traced` ones leave apart first, then the others; each group
// shortest first.
std::vector<Index> TracingOrder(const Polycube& polycube,
  const std::vector<Eigen::Vector3d>& corners, const std::vector<char>& traced)
{
  std::vector<Index> order(polycube.Edges.size()), tree, others;
  std::iota(order.begin(), order.end(), Index(0));
  const auto length = [&](Index e)
  { return (corners[polycube.Edges[e].From] - corners[polycube.Edges[e].To]).norm(); };
  std::stable_sort(
    order.begin(), order.end(), [&length](Index a, Index b) { return length(a) < length(b); });
  std::vector<Index> parent(polycube.NumberOfCorners);
  std::iota(parent.begin(), parent.end(), Index(0));
  const auto root = [&parent](Index corner)
  {
    while (parent[corner] != corner)
    {
      corner = parent[corner] = parent[parent[corner]];
    }
    return corner;
  };
  for (const bool cut : { true, false })
  {
    for (const Index e : order)
    {
      if (cut == bool(traced[e]))
      {
        const Index from = root(polycube.Edges[e].From), to = root(polycube.Edges[e].To);
        if (!cut)
        {
          (from == to ? others : tree).push_back(e);
        }
        parent[from] = to;
      }
    }
  }
  tree.insert(tree.end(), others.begin(), others.end());
  return tree;
}

// The sector of a corner's fan where an edge belongs: after the nearest border clockwise.
PathEnd SectorFor(const LayoutBuilder& builder, const Polycube& polycube, Index corner, Index edge,
  const std::vector<char>& traced)
{
  const LayoutMesh& mesh = builder.Mesh;
  const Index point = builder.Corners[corner];
  const std::vector<Index>& around = polycube.EdgesAround[corner];
  const std::size_t place = std::find(around.begin(), around.end(), edge) - around.begin();
  for (std::size_t back = 1; back < around.size(); ++back)
  {
    const Index before = around[(place + around.size() - back) % around.size()];
    if (traced[before])
    {
      Index t = mesh.TriangleAt(point);
      while (mesh.Mark(t, mesh.CornerOf(t, point)) != before)
      {
        t = mesh.Anticlockwise(t, point);
      }
      return SectorWith(mesh, point, t);
    }
  }
  return SectorWith(mesh, point, mesh.TriangleAt(point));
}

LayoutBuilder BuilderFor(const SurfaceMesh& mesh, const Polycube& polycube)
{
  LayoutBuilder builder(mesh);
  for (const Polycube::Face& face : polycube.Faces)
  {
    builder.PatchLabels.push_back(static_cast<ChartLabel>(2 * face.Axis + face.Side));
  }
  for (const Polycube::Edge& edge : polycube.Edges)
  {
    builder.Borders.push_back({ { edge.From, edge.To }, { edge.Left, edge.Right }, {} });
  }
  return builder;
}

// From one waypoint to the next that can be reached without a detour.
void TraceAlong(
  LayoutBuilder& builder, const BorderGuide& guide, Index border, PathEnd from, const PathEnd& to)
{
  double done = 0.0;
  const auto trace = [&](const PathEnd& end, double until)
  {
    const double most = MostDetour * (until - done + guide.Edge());
    return !TracePath(builder.Mesh, from, end, border, most).empty();
  };
  const auto around = [&builder](Index point)
  { return SectorWith(builder.Mesh, point, builder.Mesh.TriangleAt(point)); };
  for (const BorderGuide::Waypoint& waypoint : guide.Along(border))
  {
    if (!builder.Mesh.Occupied[waypoint.Point] && trace(around(waypoint.Point), waypoint.Way))
    {
      from = around(waypoint.Point);
      done = waypoint.Way;
    }
  }
  if (!trace(to, guide.Length(border)))
  {
    throw std::runtime_error("The path makes a detour.");
  }
}

void TraceAll(LayoutBuilder& builder, const Polycube& polycube,
  const std::vector<Eigen::Vector3d>& corners, const std::vector<GivenBorder>& given,
  const BorderGuide* guide, const Execution& execution)
{
  std::vector<char> traced(polycube.Edges.size(), 0);
  for (const GivenBorder& border : given)
  {
    traced[border.Edge] = 1;
    builder.Fixed.insert(border.Edge);
  }
  double done = 0.0;
  for (const Index e : TracingOrder(polycube, corners, traced))
  {
    execution.Check(done++ / double(polycube.Edges.size()));
    const Polycube::Edge& edge = polycube.Edges[e];
    const PathEnd from = SectorFor(builder, polycube, edge.From, e, traced);
    const PathEnd to = SectorFor(builder, polycube, edge.To, e, traced);
    try
    {
      if (guide)
      {
        TraceAlong(builder, *guide, e, from, to);
      }
      else
      {
        TracePath(builder.Mesh, from, to, e);
      }
    }
    catch (const std::runtime_error& error)
    {
      throw std::runtime_error("From " + CornerName(polycube, edge.From) + " to " +
                               CornerName(polycube, edge.To) + ": " + error.what());
    }
    traced[e] = 1;
    if (builder.IsShredded())
    {
      throw std::runtime_error("The paths between corners wind around each other: " +
                               std::to_string(builder.Mesh.NumberOfTriangles()) +
                               " triangles were cut when " + std::to_string(std::lround(done)) +
                               " of " + std::to_string(polycube.Edges.size()) +
                               " were found. Choose other corners, or fewer cubes.");
    }
  }
}

// With paths found on few triangles first; none where that fails.
std::optional<SurfaceLayout> LayoutThroughFew(const SurfaceMesh& mesh, const Polycube& polycube,
  const std::vector<Eigen::Vector3d>& corners, const Execution& execution, double farthest)
{
  LayoutMesh placing(mesh);
  std::vector<Eigen::Vector3d> feet;
  for (const Index point :
    PlaceCorners(placing, polycube, corners, farthest, std::vector<Index>(corners.size(), -1)))
  {
    feet.push_back(placing.Points[point]);
  }
  const ReducedSurface few = Reduce(mesh, FewTriangles, execution.Part(0.0, 0.5));
  try
  {
    const SurfaceLayout guide =
      LayoutFromCorners(few.Mesh, polycube, feet, execution.Part(0.5, 0.6));
    return LayoutAlong(mesh, polycube, few, guide, execution.Part(0.6, 1.0), feet);
  }
  catch (const std::invalid_argument&)
  {
  }
  catch (const std::runtime_error&)
  {
  }
  return std::nullopt;
}
}

//------------------------------------------------------------------------------
SurfaceLayout LayoutFromCorners(const SurfaceMesh& mesh, const Polycube& polycube,
  const std::vector<Eigen::Vector3d>& corners, const Execution& execution, double farthest,
  const std::vector<GivenBorder>& given)
{
  CheckCorners(mesh, polycube, corners);
  if (given.empty() && mesh.NumberOfTriangles() > ManyTriangles)
  {
    if (auto layout = LayoutThroughFew(mesh, polycube, corners, execution, farthest))
    {
      return *std::move(layout);
    }
  }
  LayoutBuilder builder = BuilderFor(mesh, polycube);
  builder.Corners = PlaceCorners(
    builder.Mesh, polycube, corners, farthest, CutGivenBorders(builder.Mesh, polycube, given));
  TraceAll(builder, polycube, corners, given, nullptr, execution.Part(0.0, 0.5));
  builder.Straighten(std::numeric_limits<double>::infinity(), execution.Part(0.5, 1.0));
  return builder.Result();
}

//------------------------------------------------------------------------------
SurfaceLayout LayoutAlong(const SurfaceMesh& mesh, const Polycube& polycube,
  const ReducedSurface& few, const SurfaceLayout& layout, const Execution& execution,
  const std::vector<Eigen::Vector3d>& corners, double stretch)
{
  std::vector<Eigen::Vector3d> places = corners;
  if (places.empty())
  {
    for (const Index corner : layout.Corners)
    {
      places.push_back(layout.Points[corner]);
    }
  }
  const BorderGuide guide(few, layout);
  LayoutBuilder builder = BuilderFor(mesh, polycube);
  builder.Corners = PlaceCorners(builder.Mesh, polycube, places,
    std::numeric_limits<double>::infinity(), std::vector<Index>(places.size(), -1));
  TraceAll(builder, polycube, places, {}, &guide, execution.Part(0.0, 0.5));
  builder.Straighten(std::min(stretch, StretchInEdges) * guide.Edge(), execution.Part(0.5, 0.8));
  if (stretch > StretchInEdges)
  {
    builder.Tighten(execution.Part(0.8, 1.0));
  }
  SurfaceLayout result = builder.Result();
  const std::vector<std::string> messages = CheckLayout(result, polycube);
  if (!messages.empty())
  {
    throw std::runtime_error(messages.front());
  }
  return result;
}
}
