// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// The faces of a cube in conformal cylinder coordinates: two caps and four sides.
#ifndef trivariate_CylinderCharts_h
#define trivariate_CylinderCharts_h

#include "Domain/ChartRelabelling.h"

namespace trivariate
{
/// The middle of each triangle on the cylinder.
struct CylinderCell
{
  double Height;
  double Angle; ///< [0, 2 pi)
};

/**
 * Labels (2 axis + side) with the largest sum of rewards among the two caps cut off at one height
 * each and the four sides between four angles, in the order +u, +v, -u, -v anticlockwise. A cap has
 * between 2 and 40 % of the area, a side at least a 32nd of the turn. `order`: the cells by height.
 * O(n).
 */
std::vector<ChartLabel> LabelCylinder(const std::vector<CylinderCell>& cells,
  const std::vector<std::size_t>& order, const std::vector<double>& areas,
  const std::vector<std::array<double, 6>>& rewards);

/// The numbers of the cells, lowest first. O(n log n).
std::vector<std::size_t> OrderByHeight(const std::vector<CylinderCell>& cells);
}

#endif
