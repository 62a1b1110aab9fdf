// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// Where a surface of small triangles meets itself.
#ifndef trivariate_TriangleIntersections_h
#define trivariate_TriangleIntersections_h

#include "Execution.h"

#include <array>
#include <utility>
#include <vector>

namespace trivariate
{
using Point = std::array<double, 3>;
using Triangle = std::array<Index, 3>; ///< three points, anticlockwise seen from outside

/**
 * Pairs of triangles, at least one of them `suspect`, that come closer to each other than
 * `distance` elsewhere than at the vertices they share; of triangles with a common edge those that
 * are folded onto each other (to within a degree). The test errs on the safe side, so triangles
 * that are not named do not intersect, also after all points have moved by up to a tenth of the
 * distance. Meant for triangles of about the size of a unit cube: O(n) time then, threaded by
 * layers of unit height. The order of the pairs does not depend on the threads; a pair may come
 * twice.
 */
std::vector<std::pair<Index, Index>> FindIntersections(const std::vector<Point>& points,
  const std::vector<Triangle>& triangles, const std::vector<char>& suspect, double distance,
  const Execution& execution);
}

#endif
