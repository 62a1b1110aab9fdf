// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "PolycubeCharts.h"

#include <algorithm>

namespace trivariate
{
//------------------------------------------------------------------------------
PolycubeCharts::PolycubeCharts(const Polycube& cubes)
  : Cubes(cubes)
  , First{ 0, 0, 0, 0 }
{
  for (int axis = 0; axis < 3; ++axis)
  {
    const auto [low, high] = std::minmax_element(cubes.Points.begin(), cubes.Points.end(),
      [axis](const LatticePoint& a, const LatticePoint& b) { return a[axis] < b[axis]; });
    this->Low[axis] = (*low)[axis];
    this->First[axis + 1] = this->First[axis] + (*high)[axis] - (*low)[axis] + 1;
  }
}

//------------------------------------------------------------------------------
std::array<int, 2> PolycubeCharts::Axes(Index face) const
{
  const Polycube::Face& f = this->Cubes.Faces[face];
  const int next = (f.Axis + 1) % 3, last = (f.Axis + 2) % 3;
  return f.Side ? std::array<int, 2>{ next, last } : std::array<int, 2>{ last, next };
}

//------------------------------------------------------------------------------
std::array<Index, 2> PolycubeCharts::LinesAt(Index face, Index point) const
{
  const std::array<int, 2> axes = this->Axes(face);
  const LatticePoint& p = this->Cubes.Points[point];
  return { this->First[axes[0]] + p[axes[0]] - this->Low[axes[0]],
    this->First[axes[1]] + p[axes[1]] - this->Low[axes[1]] };
}

//------------------------------------------------------------------------------
Eigen::Vector2d PolycubeCharts::Direction(Index face, Index edge) const
{
  const Polycube::Edge& e = this->Cubes.Edges[edge];
  const LatticePoint &from = this->Cubes.Points[e.From], &to = this->Cubes.Points[e.To];
  const std::array<int, 2> axes = this->Axes(face);
  return { double(to[axes[0]] - from[axes[0]]), double(to[axes[1]] - from[axes[1]]) };
}

//------------------------------------------------------------------------------
int PolycubeCharts::TurnAcross(Index edge, Index from, Index to) const
{
  const Eigen::Vector2d before = this->Direction(from, edge), after = this->Direction(to, edge);
  int turn = 0;
  while (Turned(before, turn) != after)
  {
    ++turn;
  }
  return turn;
}
}
