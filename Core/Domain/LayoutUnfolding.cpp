// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "LayoutUnfolding.h"

#include "SharpBorders.h"

#include <Eigen/Geometry>
#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cmath>

namespace trivariate
{
namespace
{
using Eigen::Vector2d;
using Eigen::Vector3d;

// Cotangents beyond these would leave the mean or hold too fast.
constexpr double LeastCotangent = 0.02, MostCotangent = 50.0;

double LengthOf(const SurfaceLayout& layout, const LayoutBorder& border)
{
  double length = 0.0;
  for (std::size_t i = 1; i < border.Points.size(); ++i)
  {
    length += (layout.Points[border.Points[i]] - layout.Points[border.Points[i - 1]]).norm();
  }
  return length;
}
}

//------------------------------------------------------------------------------
LayoutUnfolding::LayoutUnfolding(const SurfaceLayout& layout, const Polycube& cubes, bool fixed)
  : Mesh(SurfaceMesh(layout.Points, layout.Triangles))
  , Charts(cubes)
  , OnBorder(layout.Points.size(), 0)
{
  for (const LayoutBorder& border : layout.Borders)
  {
    for (const Index point : border.Points)
    {
      this->OnBorder[point] = 1;
    }
  }
  this->Sharp = SharpBorders(layout, this->Mesh);
  std::vector<Index> patches = layout.Patches;
  this->CutChords(patches);
  this->NumberPoints(layout, patches, fixed);
  this->FindTransitions(layout);
  for (std::size_t t = 0; t < patches.size(); ++t)
  {
    this->Triangles.push_back(this->InChart(this->Mesh.Triangles[t], patches[t]));
  }
  this->PlaceLines(layout);
  this->PlaceBorders(layout);
}

//------------------------------------------------------------------------------
void LayoutUnfolding::CutChords(std::vector<Index>& patches)
{
  for (Index t = 0; t < this->Mesh.NumberOfTriangles(); ++t)
  {
    for (int k = 0; k < 3; ++k)
    {
      const Index across = this->Mesh.Neighbour(t, k);
      const Triangle& c = this->Mesh.Triangles[t];
      if (this->OnBorder[c[k]] && this->OnBorder[c[(k + 1) % 3]] && patches[t] == patches[across])
      {
        this->Mesh.SplitEdge(t, k, 0.5);
        this->OnBorder.push_back(0);
        patches.resize(this->Mesh.NumberOfTriangles(), patches[t]);
      }
    }
  }
}

//------------------------------------------------------------------------------
LayoutUnfolding::ChartTriangle LayoutUnfolding::InChart(const Triangle& points, Index face) const
{
  ChartTriangle triangle{ points, face, {} };
  for (int k = 0; k < 3; ++k)
  {
    if (this->Home[points[k]] != face)
    {
      triangle.Transitions[k] = this->Elsewhere.at({ points[k], face });
    }
  }
  return triangle;
}

//------------------------------------------------------------------------------
Index LayoutUnfolding::PivotAt(Index point, Index before, Index after)
{
  Pivot pivot{ this->Charts.LinesAt(before, point), this->Charts.LinesAt(after, point) };
  for (int axis = 0; axis < 2; ++axis)
  {
    pivot.Before[axis] = this->LineVariables[pivot.Before[axis]];
    pivot.After[axis] = this->LineVariables[pivot.After[axis]];
  }
  this->Pivots.push_back(pivot);
  return static_cast<Index>(this->Pivots.size()) - 1;
}

//------------------------------------------------------------------------------
void LayoutUnfolding::NumberPoints(
  const SurfaceLayout& layout, const std::vector<Index>& patches, bool fixed)
{
  const Polycube& cubes = this->Charts.Cubes;
  const std::size_t points = this->Mesh.Points.size();
  this->Own.assign(points, { -1, -1 });
  this->Home.assign(points, -1);
  std::vector<char> tied(points, 0);
  for (std::size_t t = 0; t < patches.size(); ++t)
  {
    for (const Index p : this->Mesh.Triangles[t])
    {
      this->Home[p] = patches[t];
    }
  }
  for (const LayoutBorder& border : layout.Borders)
  {
    for (const Index p : border.Points)
    {
      this->Home[p] = border.Patches[0];
    }
  }
  for (std::size_t corner = 0; corner < layout.Corners.size(); ++corner)
  {
    const Index first = cubes.EdgesAround[corner][0];
    const bool forwards = cubes.Edges[first].From == static_cast<Index>(corner);
    this->Home[layout.Corners[corner]] =
      forwards ? cubes.Edges[first].Left : cubes.Edges[first].Right;
    tied[layout.Corners[corner]] = fixed || !this->Charts.IsFlat(static_cast<Index>(corner));
  }

  for (std::size_t p = 0; p < points; ++p)
  {
    if (!tied[p])
    {
      this->Own[p] = { this->NumberOfFree, this->NumberOfFree + 1 };
      this->NumberOfFree += 2;
    }
  }
  this->NumberLines(layout, tied);
}

//------------------------------------------------------------------------------
// Lines to which no point is tied stay as they are: nothing depends on them.
void LayoutUnfolding::NumberLines(const SurfaceLayout& layout, const std::vector<char>& tied)
{
  const Polycube& cubes = this->Charts.Cubes;
  struct Tie
  {
    Index Point;
    int Axis;
    Index Line;
  };
  std::vector<Tie> ties;
  for (std::size_t corner = 0; corner < layout.Corners.size(); ++corner)
  {
    const Index p = layout.Corners[corner];
    const std::array<Index, 2> at = this->Charts.LinesAt(this->Home[p], static_cast<Index>(corner));
    for (int axis = 0; axis < 2 && tied[p]; ++axis)
    {
      ties.push_back({ p, axis, at[axis] });
    }
  }
  for (std::size_t e = 0; e < layout.Borders.size(); ++e)
  {
    const Index face = cubes.Edges[e].Left;
    const int across = this->Charts.Direction(face, static_cast<Index>(e))[0] == 0.0 ? 0 : 1;
    const Index line = this->Charts.LinesAt(face, cubes.Edges[e].From)[across];
    const std::vector<Index>& points = layout.Borders[e].Points;
    for (std::size_t i = 1; this->Sharp[e] && i + 1 < points.size(); ++i)
    {
      ties.push_back({ points[i], across, line });
    }
  }
  this->FirstLine = this->NumberOfFree;
  this->LineVariables.assign(this->Charts.NumberOfLines(), -1);
  for (const Tie& tie : ties)
  {
    Index& variable = this->LineVariables[tie.Line];
    variable = variable < 0 && !this->Charts.IsLowest(tie.Line) ? this->NumberOfFree++ : variable;
  }
  Index next = this->NumberOfFree;
  for (Index& variable : this->LineVariables)
  {
    variable = variable < 0 ? next++ : variable;
  }
  this->Values.assign(next, 0.0);
  for (const Tie& tie : ties)
  {
    this->Own[tie.Point][tie.Axis] = this->LineVariables[tie.Line];
  }
}

//------------------------------------------------------------------------------
void LayoutUnfolding::SpaceLines(const std::vector<double>& before)
{
  const auto stays = [this](Index line)
  { return this->LineVariables[line] < this->NumberOfFree || this->Charts.IsLowest(line); };
  Index low = 0;
  for (Index line = 0; line < this->Charts.NumberOfLines(); ++line)
  {
    if (!stays(line))
    {
      continue;
    }
    for (Index inner = low + 1; inner < line && !this->Charts.IsLowest(line); ++inner)
    {
      const double whole = before[this->LineVariables[line]] - before[this->LineVariables[low]];
      const double share =
        (before[this->LineVariables[inner]] - before[this->LineVariables[low]]) / whole;
      this->Values[this->LineVariables[inner]] =
        (1.0 - share) * this->LineValue(low) + share * this->LineValue(line);
    }
    low = line;
  }
}

//------------------------------------------------------------------------------
void LayoutUnfolding::FindTransitions(const SurfaceLayout& layout)
{
  const Polycube& cubes = this->Charts.Cubes;
  for (std::size_t e = 0; e < layout.Borders.size(); ++e)
  {
    const Polycube::Edge& edge = cubes.Edges[e];
    Transition transition;
    transition.Turn = this->Charts.TurnAcross(static_cast<Index>(e), edge.Left, edge.Right);
    transition.Pivot = this->PivotAt(edge.From, edge.Left, edge.Right);
    for (std::size_t i = 1; i + 1 < layout.Borders[e].Points.size(); ++i)
    {
      this->Elsewhere[{ layout.Borders[e].Points[i], edge.Right }] = transition;
    }
  }
  for (std::size_t c = 0; c < layout.Corners.size(); ++c)
  {
    const Index p = layout.Corners[c];
    const std::vector<Index>& around = cubes.EdgesAround[c];
    Transition transition;
    Index face = this->Home[p];
    for (std::size_t i = 1; i < around.size(); ++i)
    {
      const Polycube::Edge& edge = cubes.Edges[around[i]];
      const Index next = edge.From == static_cast<Index>(c) ? edge.Left : edge.Right;
      transition.Turn = (transition.Turn + this->Charts.TurnAcross(around[i], face, next)) % 4;
      transition.Pivot = this->PivotAt(static_cast<Index>(c), this->Home[p], next);
      this->Elsewhere[{ p, next }] = transition;
      face = next;
    }
  }
}

//------------------------------------------------------------------------------
void LayoutUnfolding::PlaceLines(const SurfaceLayout& layout)
{
  std::vector<double> length(this->LineVariables.size(), 0.0), count(length.size(), 0.0);
  for (std::size_t e = 0; e < layout.Borders.size(); ++e)
  {
    const Polycube::Edge& edge = this->Charts.Cubes.Edges[e];
    const std::array<Index, 2> at = this->Charts.LinesAt(edge.Left, edge.To);
    const std::array<int, 2> axes = this->Charts.Axes(edge.Left);
    const Index line = at[axes[0] == edge.Axis ? 0 : 1];
    length[line] += LengthOf(layout, layout.Borders[e]);
    count[line] += 1.0;
  }
  for (std::size_t line = 0; line < length.size(); ++line)
  {
    if (!this->Charts.IsLowest(static_cast<Index>(line)))
    {
      this->Values[this->LineVariables[line]] =
        this->Values[this->LineVariables[line - 1]] + length[line] / count[line];
    }
  }
}

//------------------------------------------------------------------------------
void LayoutUnfolding::PlaceBorders(const SurfaceLayout& layout)
{
  const Polycube& cubes = this->Charts.Cubes;
  const auto placeAt = [this](Index face, Index corner)
  {
    const std::array<Index, 2> at = this->Charts.LinesAt(face, corner);
    return Vector2d(
      this->Values[this->LineVariables[at[0]]], this->Values[this->LineVariables[at[1]]]);
  };
  const auto put = [this](Index p, const Vector2d& place)
  {
    this->Values[this->Own[p][0]] = place[0];
    this->Values[this->Own[p][1]] = place[1];
  };
  for (std::size_t corner = 0; corner < layout.Corners.size(); ++corner)
  {
    const Index p = layout.Corners[corner];
    put(p, placeAt(this->Home[p], static_cast<Index>(corner)));
  }
  for (std::size_t e = 0; e < layout.Borders.size(); ++e)
  {
    const std::vector<Index>& points = layout.Borders[e].Points;
    const Vector2d from = placeAt(cubes.Edges[e].Left, cubes.Edges[e].From);
    const Vector2d to = placeAt(cubes.Edges[e].Left, cubes.Edges[e].To);
    const double length = LengthOf(layout, layout.Borders[e]);
    double way = 0.0;
    for (std::size_t i = 1; i + 1 < points.size(); ++i)
    {
      way += (layout.Points[points[i]] - layout.Points[points[i - 1]]).norm();
      put(points[i], from + way / length * (to - from));
    }
  }
}

//------------------------------------------------------------------------------
void LayoutUnfolding::PlaceInside(const std::vector<ChartTriangle>& triangles)
{
  std::vector<Index> unknown(this->OnBorder.size(), -1);
  Index unknowns = 0;
  for (const ChartTriangle& triangle : triangles)
  {
    for (const Index p : triangle.Points)
    {
      unknown[p] = this->OnBorder[p] || unknown[p] >= 0 ? unknown[p] : unknowns++;
    }
  }
  if (unknowns == 0)
  {
    return;
  }
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::MatrixX2d right = Eigen::MatrixX2d::Zero(unknowns, 2);
  for (const ChartTriangle& triangle : triangles)
  {
    for (int k = 0; k < 3; ++k)
    {
      // Weights are the cotangents of opposite angles, but positive.
      const int ends[2] = { (k + 1) % 3, (k + 2) % 3 };
      const Vector3d& at = this->Mesh.Points[triangle.Points[k]];
      const Vector3d a = this->Mesh.Points[triangle.Points[ends[0]]] - at;
      const Vector3d b = this->Mesh.Points[triangle.Points[ends[1]]] - at;
      const double cotangent = a.dot(b) / std::max(a.cross(b).norm(), 1e-300);
      const double weight = std::clamp(cotangent, LeastCotangent, MostCotangent);
      for (const int end : { 0, 1 })
      {
        const Index row = unknown[triangle.Points[ends[end]]];
        const Index column = unknown[triangle.Points[ends[1 - end]]];
        if (row < 0)
        {
          continue;
        }
        entries.emplace_back(row, row, weight);
        if (column >= 0)
        {
          entries.emplace_back(row, column, -weight);
        }
        else
        {
          right.row(row) += weight * this->Place(triangle, ends[1 - end]).transpose();
        }
      }
    }
  }
  Eigen::SparseMatrix<double> matrix(unknowns, unknowns);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors(matrix);
  const Eigen::MatrixX2d solution = factors.solve(right);
  for (std::size_t p = 0; p < unknown.size(); ++p)
  {
    if (unknown[p] >= 0)
    {
      this->Values[this->Own[p][0]] = solution(unknown[p], 0);
      this->Values[this->Own[p][1]] = solution(unknown[p], 1);
    }
  }
}
}
