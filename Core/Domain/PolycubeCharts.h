// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// The faces of a polycube unfolded into the plane, and how their planes continue each other.
#ifndef trivariate_PolycubeCharts_h
#define trivariate_PolycubeCharts_h

#include "Polycube.h"

#include <Eigen/Core>

namespace trivariate
{
/// A quarter turn anticlockwise, as often as told.
inline Eigen::Vector2d Turned(const Eigen::Vector2d& v, int quarters)
{
  switch (quarters & 3)
  {
    case 1:
      return { -v.y(), v.x() };
    case 2:
      return -v;
    case 3:
      return { v.y(), -v.x() };
    default:
      return v;
  }
}

/**
 * The chart of a face is its plane seen from outside, with two axes of the lattice as coordinates.
 * Coordinates are lengths: a lattice plane across an axis is a *line*, and where each line is, the
 * user of this class decides. Lines are counted from 0, those of u first, each axis ascending.
 */
class PolycubeCharts
{
public:
  explicit PolycubeCharts(const Polycube& cubes);

  Index NumberOfLines() const { return this->First[3]; }
  /// Whether a line is the lowest of its axis.
  bool IsLowest(Index line) const
  {
    return line == this->First[0] || line == this->First[1] || line == this->First[2];
  }
  int AxisOf(Index line) const { return line < this->First[1] ? 0 : line < this->First[2] ? 1 : 2; }

  /// The axes of the lattice along x and y of a face's chart.
  std::array<int, 2> Axes(Index face) const;

  /// The lines through a point of the lattice, across x and across y of a face's chart.
  std::array<Index, 2> LinesAt(Index face, Index point) const;

  /// The direction of an edge, forwards, in the chart of one of its faces.
  Eigen::Vector2d Direction(Index face, Index edge) const;

  /// The quarter turns from the chart of one face to that of the other, across an edge of both.
  int TurnAcross(Index edge, Index from, Index to) const;

  /// Whether the surface is flat at a corner: four faces meet there.
  bool IsFlat(Index corner) const { return this->Cubes.EdgesAround[corner].size() == 4; }

  const Polycube& Cubes;

private:
  std::array<int, 3> Low;
  std::array<Index, 4> First;
};
}

#endif
