// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Charts of a surface, labelled by the faces of a cube, moved toward the normals one triangle at a
 * time without ever changing how they lie to one another.
 */
#ifndef trivariate_ChartRelabelling_h
#define trivariate_ChartRelabelling_h

#include "Execution.h"
#include "SurfaceMesh.h"

namespace trivariate
{
/// 2 axis + side: side 0 is the low end (-u, -v, -w), 1 the high end.
using ChartLabel = std::int8_t;

/// What each triangle is worth to each chart: its area times the cosine between its normal and the
/// label's direction.
using ChartRewards = std::vector<std::array<double, 6>>;

/**
 * Moves chart borders until no single triangle would raise the sum of rewards less `stiffness`
 * times the mean side times the length of all borders. A triangle changes only if both charts stay
 * whole, opposite labels do not come to touch and every point keeps at most three labels, each in
 * one run; so discs stay discs, and corners stay. Returns the number of changes. The largest gain
 * is taken first, so the order of the triangles does not matter (but for equal gains). O(n log n).
 */
Index RelabelTowardNormals(const SurfaceMesh& mesh, const ChartRewards& rewards, double stiffness,
  std::vector<ChartLabel>& labels, const Execution& execution);

/// Whether around every point there are at most three labels, each in one run, no two opposite, and
/// whether each of the six labels is on one connected piece.
bool AreCubeCharts(const SurfaceMesh& mesh, const std::vector<ChartLabel>& labels);

/// Leaves each label its largest connected piece; the others go to their neighbours. O(n) a round.
void KeepLargestPieces(const SurfaceMesh& mesh, std::vector<ChartLabel>& labels);
}

#endif
