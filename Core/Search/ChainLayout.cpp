// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ChainLayout.h"

#include "Domain/LayoutBuilder.h"

#include <algorithm>
#include <limits>
#include <map>

namespace trivariate
{
namespace
{
constexpr double SnapDistance = 0.05; // of an edge

class ChainCutter
{
public:
  ChainCutter(const SurfaceLayout& cube, int axis, int cubes)
    : Cube(cube)
    , Axis(axis)
    , Length(cubes)
    , Cubes(Chain(axis, cubes))
    , Builder(SurfaceMesh(cube.Points, cube.Triangles))
  {
    for (Index corner = 0; corner < this->Cubes.NumberOfCorners; ++corner)
    {
      this->Numbers[this->Cubes.Points[corner]] = corner;
    }
    this->Builder.Corners.assign(this->Cubes.NumberOfCorners, -1);
    for (const Polycube::Face& face : this->Cubes.Faces)
    {
      this->Builder.PatchLabels.push_back(static_cast<ChartLabel>(2 * face.Axis + face.Side));
    }
    for (const Polycube::Edge& edge : this->Cubes.Edges)
    {
      this->Builder.Borders.push_back({ { edge.From, edge.To }, { edge.Left, edge.Right }, {} });
    }
  }

  SurfaceLayout Run(const Execution& execution)
  {
    this->TakeBorders();
    for (std::size_t e = 0; e < this->Cubes.Edges.size(); ++e)
    {
      const int height = this->Cubes.Points[this->Cubes.Edges[e].From][this->Axis];
      if (this->Cubes.Edges[e].Axis != this->Axis && height > 0 && height < this->Length)
      {
        execution.Check(double(e) / double(this->Cubes.Edges.size()));
        this->TraceAcross(static_cast<Index>(e));
      }
    }
    SurfaceLayout layout = this->Builder.Result();
    for (Index& origin : layout.Origins)
    {
      origin = this->Cube.Origins[origin];
    }
    return layout;
  }

private:
  // The cube's own borders; those along the axis in pieces.
  void TakeBorders()
  {
    const Polycube cube = Polycube::FromGrid({ 1, 1, 1 });
    for (std::size_t b = 0; b < cube.Edges.size(); ++b)
    {
      LatticePoint at = cube.Points[cube.Edges[b].From], end = cube.Points[cube.Edges[b].To];
      at[this->Axis] *= this->Length;
      end[this->Axis] *= this->Length;
      const bool along = cube.Edges[b].Axis == this->Axis;
      for (std::vector<Index>& piece :
        this->Pieces(this->Cube.Borders[b].Points, along ? this->Length : 1))
      {
        LatticePoint next = along ? at : end;
        next[this->Axis] += along;
        this->Take(this->Numbers.at(at), this->Numbers.at(next), piece);
        at = next;
      }
    }
  }

  // A border cut into parts of equal lengths, at new points where it has none there.
  std::vector<std::vector<Index>> Pieces(std::vector<Index> points, int count)
  {
    LayoutMesh& mesh = this->Builder.Mesh;
    const double length = PolylineLength(mesh, points);
    std::vector<std::vector<Index>> pieces(1, { points[0] });
    double passed = 0.0; // up to the last point taken
    // How far the next cut is, in parts of the step to a point; beyond all where there is none.
    const auto cutBefore = [&](Index to)
    {
      const double step = (mesh.Points[to] - mesh.Points[pieces.back().back()]).norm();
      return static_cast<int>(pieces.size()) < count
               ? (length * double(pieces.size()) / count - passed) / std::max(step, 1e-300)
               : std::numeric_limits<double>::infinity();
    };
    const auto take = [&](Index to)
    {
      passed += (mesh.Points[to] - mesh.Points[pieces.back().back()]).norm();
      pieces.back().push_back(to);
    };
    for (std::size_t i = 1; i < points.size(); ++i)
    {
      const bool last = i + 1 == points.size();
      double where = cutBefore(points[i]);
      while (where < (last ? std::numeric_limits<double>::infinity() : 1.0 - SnapDistance))
      {
        const Index from = pieces.back().back(), t = mesh.TriangleLeftOf(from, points[i]);
        take(mesh.SplitEdge(
          t, mesh.CornerOf(t, from), std::clamp(where, SnapDistance, 1.0 - SnapDistance)));
        pieces.push_back({ pieces.back().back() });
        where = cutBefore(points[i]);
      }
      take(points[i]);
      if (where <= 1.0 + SnapDistance && !last)
      {
        pieces.push_back({ points[i] });
      }
    }
    return pieces;
  }

  void Take(Index from, Index to, const std::vector<Index>& points)
  {
    LayoutMesh& mesh = this->Builder.Mesh;
    const auto edge = std::find_if(this->Cubes.Edges.begin(), this->Cubes.Edges.end(),
      [from, to](const Polycube::Edge& e) { return e.From == from && e.To == to; });
    this->Builder.Corners[from] = points.front();
    this->Builder.Corners[to] = points.back();
    for (std::size_t i = 0; i + 1 < points.size(); ++i)
    {
      const Index t = mesh.TriangleLeftOf(points[i], points[i + 1]);
      mesh.SetMark(t, mesh.CornerOf(t, points[i]), edge - this->Cubes.Edges.begin());
      mesh.Occupied[points[i]] = mesh.Occupied[points[i + 1]] = 1;
    }
  }

  void TraceAcross(Index e)
  {
    const Polycube::Edge& edge = this->Cubes.Edges[e];
    const ChartLabel label = this->Builder.PatchLabels[edge.Left];
    TracePath(
      this->Builder.Mesh, this->SectorOf(edge.From, label), this->SectorOf(edge.To, label), e);
  }

  PathEnd SectorOf(Index corner, ChartLabel label) const
  {
    const LayoutMesh& mesh = this->Builder.Mesh;
    const Index point = this->Builder.Corners[corner];
    Index t = mesh.TriangleAt(point);
    while (this->Cube.PatchLabels[this->Cube.Patches[mesh.Origins[t]]] != label)
    {
      t = mesh.Anticlockwise(t, point);
    }
    return SectorWith(mesh, point, t);
  }

  const SurfaceLayout& Cube;
  const int Axis, Length;
  const Polycube Cubes;
  std::map<LatticePoint, Index> Numbers;
  LayoutBuilder Builder;
};
}

//------------------------------------------------------------------------------
Polycube Chain(int axis, int cubes)
{
  std::array<int, 3> size{ 1, 1, 1 };
  size[axis] = cubes;
  return Polycube::FromGrid(size);
}

//------------------------------------------------------------------------------
SurfaceLayout CutIntoChain(
  const SurfaceLayout& cube, int axis, int cubes, const Execution& execution)
{
  return ChainCutter(cube, axis, cubes).Run(execution);
}
}
