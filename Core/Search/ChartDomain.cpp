// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ChartDomain.h"

#include "ChainLayout.h"
#include "Domain/DomainMeasures.h"
#include "Domain/LayoutCheck.h"

#include <algorithm>

namespace trivariate
{
namespace
{
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double StretchInEdges = 3.0; // so far chart borders are straightened

double MeanEdgeLength(const SurfaceMesh& mesh)
{
  double sum = 0.0;
  for (const Triangle& c : mesh.Triangles)
  {
    for (int k = 0; k < 3; ++k)
    {
      sum += (mesh.Points[c[(k + 1) % 3]] - mesh.Points[c[k]]).norm();
    }
  }
  return sum / (3.0 * double(mesh.Triangles.size()));
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

// Triangle t becomes 4 t to 4 t + 3; points keep their numbers.
SurfaceMesh CutInFour(const SurfaceMesh& mesh)
{
  std::vector<Vector3d> points = mesh.Points;
  std::vector<std::array<Index, 3>> middles(mesh.Triangles.size());
  std::vector<Triangle> triangles;
  for (Index t = 0; t < mesh.NumberOfTriangles(); ++t)
  {
    const Triangle& c = mesh.Triangles[t];
    for (int k = 0; k < 3; ++k)
    {
      const Index across = mesh.Neighbour(t, k);
      if (across > t)
      {
        middles[t][k] = static_cast<Index>(points.size());
        points.push_back(0.5 * (mesh.Points[c[k]] + mesh.Points[c[(k + 1) % 3]]));
      }
      else
      {
        middles[t][k] = middles[across][mesh.CornerOf(across, c[(k + 1) % 3])];
      }
    }
    const std::array<Index, 3>& m = middles[t];
    triangles.insert(triangles.end(),
      { { c[0], m[0], m[2] }, { c[1], m[1], m[0] }, { c[2], m[2], m[1] }, { m[0], m[1], m[2] } });
  }
  return SurfaceMesh(std::move(points), std::move(triangles));
}

SurfaceMesh CutInFour(SurfaceMesh mesh, int times)
{
  for (int i = 0; i < times; ++i)
  {
    mesh = CutInFour(mesh);
  }
  return mesh;
}
}

//------------------------------------------------------------------------------
ChartDomain::ChartDomain(
  const SurfaceMesh& mesh, int level, const CubeChartOptions& options, const Execution& execution)
  : Level(level)
  , OneCube{ {}, trivariate::Chain(0, 1), {}, 0.0 }
{
  const SurfaceMesh refined = CutInFour(mesh, level);
  this->Charts = FindCubeCharts(refined, options, execution.Part(0.0, 0.9));
  const SurfaceLayout layout = LayoutFromCharts(refined, this->Charts.Labels,
    execution.Part(0.9, 1.0), StretchInEdges * MeanEdgeLength(refined));
  std::vector<LatticePoint> corners;
  RefuseInvalid(CheckCharts(layout, &corners));
  this->OneCube.Layout = InOrderOf(this->OneCube.Cubes, layout, corners);
  this->FindLongest();
  this->Finish(this->OneCube, 0);
}

//------------------------------------------------------------------------------
SegmentDomain ChartDomain::OnSurface(SegmentDomain domain) const
{
  for (Index& origin : domain.Layout.Origins)
  {
    origin >>= 2 * this->Level;
  }
  return domain;
}

//------------------------------------------------------------------------------
SegmentDomain ChartDomain::Chain(Index cubes, const Execution& execution) const
{
  const int count = static_cast<int>(cubes);
  SegmentDomain chain{ CutIntoChain(this->OneCube.Layout, this->Axis, count, execution),
    trivariate::Chain(this->Axis, count), {}, 0.0 };
  this->Finish(chain, 0);
  return this->OnSurface(std::move(chain));
}

//------------------------------------------------------------------------------
// Places and alignment, by the charts' directions, each cube's turned as a whole toward its own
// normals. `level`: how often each triangle that a layout's come from was cut for the charts.
void ChartDomain::Finish(SegmentDomain& domain, int level) const
{
  domain.Places = PlacesOf(domain.Layout, domain.Cubes);
  const auto charted = [&](std::size_t t) -> const Matrix3d&
  {
    return this->Charts.Frames[this->Charts.FrameOfTriangle[domain.Layout.Origins[t] << 2 * level]];
  };
  const auto cubeOf = [&domain](std::size_t t)
  { return domain.Cubes.Faces[domain.Layout.Patches[t]].Cube; };
  std::vector<Matrix3d> turns(domain.Cubes.Cubes.size(), Matrix3d::Zero());
  for (std::size_t t = 0; t < domain.Layout.Triangles.size(); ++t)
  {
    const ChartLabel label = domain.Layout.PatchLabels[domain.Layout.Patches[t]];
    turns[cubeOf(t)].row(label / 2) +=
      SignOf(label) * (charted(t) * AreaVector(domain.Layout, t)).transpose();
  }
  std::transform(turns.begin(), turns.end(), turns.begin(), ClosestRotation);
  domain.Alignment = AlignmentOf(
    domain.Layout, [&](std::size_t t) -> Matrix3d { return turns[cubeOf(t)] * charted(t); });
}

//------------------------------------------------------------------------------
void ChartDomain::FindLongest()
{
  const SurfaceLayout& cube = this->OneCube.Layout;
  Vector3d lengths = Vector3d::Zero();
  for (const LayoutBorder& border : cube.Borders)
  {
    const int axis =
      3 - cube.PatchLabels[border.Patches[0]] / 2 - cube.PatchLabels[border.Patches[1]] / 2;
    for (std::size_t i = 0; i + 1 < border.Points.size(); ++i)
    {
      lengths[axis] += (cube.Points[border.Points[i + 1]] - cube.Points[border.Points[i]]).norm();
    }
  }
  const double length = lengths.maxCoeff(&this->Axis);
  this->Slenderness = 2.0 * length / (lengths.sum() - length);
}
}
