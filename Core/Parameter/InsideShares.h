// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// How much of each part of a grid lies inside a closed surface.
#ifndef trivariate_InsideShares_h
#define trivariate_InsideShares_h

#include "Domain/SurfaceMesh.h"
#include "Execution.h"

namespace trivariate
{
/// What of the eight octants of a cell, x + 2 y + 4 z, each 0 at the low half, lies inside.
struct CellOctants
{
  std::array<float, 8> Shares; ///< in [0, 1]
  /// The middle of that part, in the cell, [0, 1]; of an octant outside its own middle.
  std::array<std::array<float, 3>, 8> Middles;
};

/**
 * The winding number of the surface, measured along lines through the cells of a grid: 4 x 4 lines
 * along x through each cell, on them exactly. Lines that meet an edge or a point count as moved off
 * it, all in the same direction, so that none leaks through a closed surface.
 */
class InsideShares
{
public:
  /// Points are in units of the grid: cell (i, j, k) of `cells` is [i, i+1] x [j, j+1] x [k, k+1].
  /// The surface lies within the grid.
  InsideShares(const std::vector<Eigen::Vector3d>& points, const std::vector<Triangle>& triangles,
    const std::array<Index, 3>& cells);

  /// The cells of row j + cells[1] k.
  void Row(Index row, std::vector<CellOctants>& octants) const;

private:
  struct Crossing
  {
    double X;
    std::int8_t Y, Z; ///< lines, counted in the cell
    std::int8_t Step; ///< of the winding number as x grows
  };

  std::array<Index, 3> Cells;
  std::vector<Index> RowBegin;
  std::vector<Crossing> Crossings;
};
}

#endif
