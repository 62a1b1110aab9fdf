// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Points in parameter space and linear elements between them, cut from the Bezier cells.
 *
 * Every cell is cut equally, so an element never crosses a cell's face. Elements of neighbouring
 * cells share a point wherever both have one at the same parameters. Where a cell meets smaller
 * ones, points of these lie on its elements' edges and faces (hanging nodes): they are evaluated on
 * the spline, so that no volume is biased, and the gap beside them is of second order in the size
 * of the elements; it is zero wherever the map is affine.
 */
#ifndef trivariate_Tessellation_h
#define trivariate_Tessellation_h

#include "BezierMesh.h"
#include "Execution.h"

#include <vector>

namespace trivariate
{
struct Tessellation
{
  std::vector<double> Parameters; ///< u, v, w a point, each point once; w slowest
  std::vector<Index> Elements;    ///< point ids: 8 a hexahedron or 4 a quadrilateral, VTK's order
  std::vector<Index> Cells;       ///< the Bezier cell (or box) of each element, ascending

  Index PointCount() const { return static_cast<Index>(this->Parameters.size() / 3); }
  Index ElementCount() const { return static_cast<Index>(this->Cells.size()); }
};

/**
 * subdivisions^3 hexahedra a cell, subdivisions >= 1. Time O(n log n), memory about 140 bytes an
 * element.
 */
Tessellation TessellateVolume(
  const BezierMesh& mesh, int subdivisions, const Execution& execution = {});

/// Each box as one hexahedron, boxes in knots of the given lines; Cells are their numbers. O(n log
/// n).
Tessellation TessellateBoxes(
  const std::array<KnotLine, 3>& lines, const std::vector<IndexBox>& boxes);

/**
 * The surface on which the parameter of direction 0, 1 or 2 is `value`: subdivisions^2
 * quadrilaterals for each cell that it cuts (at a knot the cells above, at the end those below),
 * counterclockwise seen from higher parameters. Empty outside the domain.
 */
Tessellation TessellateSurface(const BezierMesh& mesh, int direction, double value,
  int subdivisions, const Execution& execution = {});
}

#endif
