// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "SegmentDomain.h"

#include "ClosestRotation.h"
#include "LayoutCheck.h"

#include <algorithm>
#include <map>
#include <stdexcept>

namespace trivariate
{
namespace
{
using Eigen::Matrix3d;
using Eigen::Vector3d;

double SignOf(ChartLabel label)
{
  return label % 2 ? 1.0 : -1.0;
}

// Twice the area vectors of the layout's triangles.
Vector3d AreaVector(const SurfaceLayout& layout, std::size_t t)
{
  const Triangle& c = layout.Triangles[t];
  const Vector3d& origin = layout.Points[c[0]];
  return (layout.Points[c[1]] - origin).cross(layout.Points[c[2]] - origin);
}

// `frame` tells the directions (rows) for a triangle of the layout.
template <typename Frame>
double AlignmentOf(const SurfaceLayout& layout, const Frame& frame)
{
  double sum = 0.0, area = 0.0;
  for (std::size_t t = 0; t < layout.Triangles.size(); ++t)
  {
    const Vector3d n = AreaVector(layout, t);
    const ChartLabel label = layout.PatchLabels[layout.Patches[t]];
    sum += SignOf(label) * frame(t).row(label / 2).dot(n);
    area += n.norm();
  }
  return sum / area;
}

// The rotation toward whose rows the normals of the patches point most.
Matrix3d BestFrame(const SurfaceLayout& layout)
{
  Matrix3d correlation = Matrix3d::Zero();
  for (std::size_t t = 0; t < layout.Triangles.size(); ++t)
  {
    const ChartLabel label = layout.PatchLabels[layout.Patches[t]];
    correlation.row(label / 2) += SignOf(label) * AreaVector(layout, t).transpose();
  }
  return ClosestRotation(correlation);
}

// Corners where the layout has them, inner points in the middle of their neighbours.
std::vector<Vector3d> PlacesOf(const SurfaceLayout& layout, const Polycube& cubes)
{
  std::vector<Vector3d> places(cubes.Points.size(), Vector3d::Zero());
  for (Index corner = 0; corner < cubes.NumberOfCorners; ++corner)
  {
    places[corner] = layout.Points[layout.Corners[corner]];
  }
  std::map<LatticePoint, Index> numbers;
  for (std::size_t p = 0; p < cubes.Points.size(); ++p)
  {
    numbers[cubes.Points[p]] = static_cast<Index>(p);
  }
  // An inner point has all six neighbours. Gauss-Seidel; lattices are small.
  double change = 1.0;
  for (int round = 0; round < 10000 && change > 0.0; ++round)
  {
    change = 0.0;
    for (std::size_t p = cubes.NumberOfCorners; p < cubes.Points.size(); ++p)
    {
      Vector3d sum = Vector3d::Zero();
      for (int axis = 0; axis < 3; ++axis)
      {
        for (const int step : { -1, 1 })
        {
          LatticePoint neighbour = cubes.Points[p];
          neighbour[axis] += step;
          sum += places[numbers.at(neighbour)];
        }
      }
      change = std::max(change, (sum / 6.0 - places[p]).norm());
      places[p] = sum / 6.0;
    }
  }
  return places;
}

// A layout whose charts are the unit faces of a polycube, put into the polycube's order. `at`: the
// lattice point of each corner.
SurfaceLayout InOrderOf(
  const Polycube& cubes, const SurfaceLayout& charts, const std::vector<LatticePoint>& at)
{
  SurfaceLayout layout = charts;
  std::vector<Index> newCorner(at.size());
  for (std::size_t corner = 0; corner < at.size(); ++corner)
  {
    const auto end = cubes.Points.begin() + cubes.NumberOfCorners;
    newCorner[corner] = std::find(cubes.Points.begin(), end, at[corner]) - cubes.Points.begin();
    layout.Corners.at(newCorner[corner]) = charts.Corners[corner];
  }
  std::vector<Index> newPatch(charts.PatchLabels.size(), -1);
  for (const LayoutBorder& border : charts.Borders)
  {
    const Index from = newCorner[border.Corners[0]], to = newCorner[border.Corners[1]];
    for (std::size_t e = 0; e < cubes.Edges.size(); ++e)
    {
      const Polycube::Edge& edge = cubes.Edges[e];
      if (edge.From == from && edge.To == to)
      {
        layout.Borders[e] = { { from, to }, { edge.Left, edge.Right }, border.Points };
        newPatch[border.Patches[0]] = edge.Left;
        newPatch[border.Patches[1]] = edge.Right;
      }
      else if (edge.From == to && edge.To == from)
      {
        layout.Borders[e] = { { to, from }, { edge.Left, edge.Right },
          std::vector<Index>(border.Points.rbegin(), border.Points.rend()) };
        newPatch[border.Patches[1]] = edge.Left;
        newPatch[border.Patches[0]] = edge.Right;
      }
    }
  }
  for (std::size_t patch = 0; patch < newPatch.size(); ++patch)
  {
    layout.PatchLabels.at(newPatch[patch]) = charts.PatchLabels[patch];
  }
  for (Index& patch : layout.Patches)
  {
    patch = newPatch[patch];
  }
  return layout;
}

void RefuseInvalid(const std::vector<std::string>& messages)
{
  if (!messages.empty())
  {
    throw std::runtime_error("The layout found is not valid: " + messages.front());
  }
}

SegmentDomain OneCube(
  const SurfaceMesh& mesh, const CubeChartOptions& options, const Execution& execution)
{
  const CubeCharts charts = FindCubeCharts(mesh, options, execution.Part(0.0, 0.8));
  const SurfaceLayout layout = LayoutFromCharts(mesh, charts.Labels, execution.Part(0.8, 1.0));
  std::vector<LatticePoint> corners;
  RefuseInvalid(CheckCharts(layout, &corners));
  SegmentDomain domain{ {}, Polycube::FromGrid({ 1, 1, 1 }), {}, 0.0 };
  domain.Layout = InOrderOf(domain.Cubes, layout, corners);
  domain.Places = PlacesOf(domain.Layout, domain.Cubes);
  domain.Alignment = AlignmentOf(domain.Layout,
    [&](std::size_t t) -> const Matrix3d&
    { return charts.Frames[charts.FrameOfTriangle[domain.Layout.Origins[t]]]; });
  RefuseInvalid(CheckLayout(domain.Layout, domain.Cubes));
  return domain;
}
}

//------------------------------------------------------------------------------
SegmentDomain FindDomain(
  const SurfaceMesh& mesh, const DomainOptions& options, const Execution& execution)
{
  return OneCube(mesh, options.Charts, execution);
}

//------------------------------------------------------------------------------
SegmentDomain DomainFromCorners(const SurfaceMesh& mesh, const Polycube& polycube,
  const std::vector<Vector3d>& picked, const Execution& execution, double farthest)
{
  SegmentDomain domain{ LayoutFromCorners(mesh, polycube, picked, execution, farthest), polycube,
    {}, 0.0 };
  RefuseInvalid(CheckLayout(domain.Layout, polycube));
  domain.Places = PlacesOf(domain.Layout, polycube);
  const Matrix3d frame = BestFrame(domain.Layout);
  domain.Alignment =
    AlignmentOf(domain.Layout, [&frame](std::size_t) -> const Matrix3d& { return frame; });
  return domain;
}
}
