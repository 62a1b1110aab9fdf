// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// Six charts on a surface without handles, as the faces of a cube: the automatic choice.
#ifndef trivariate_CubeCharts_h
#define trivariate_CubeCharts_h

#include "Domain/ChartRelabelling.h"

namespace trivariate
{
struct CubeCharts
{
  std::vector<ChartLabel> Labels;
  /// Rows: the directions of u, v and w in space, right-handed. One, or several along a cube that
  /// is bent.
  std::vector<Eigen::Matrix3d> Frames;
  std::vector<std::int32_t> FrameOfTriangle;
  double Alignment; ///< area-weighted mean of the cosine between normals and labels' directions
};

struct CubeChartOptions
{
  /// Of the borders, see RelabelTowardNormals: smaller follows the normals, larger gives shorter
  /// borders.
  double Stiffness = 0.1;
  int NormalSmoothing = 10; ///< rounds of averaging normals over neighbouring triangles
  int BendingSegments = 24; ///< frames along a bent cube
  /// By how much bent frames must raise the alignment to be preferred to one frame for all.
  double BendingGain = 0.03;
};

/**
 * Tries several axes through the surface, and the two points farthest from each other along it;
 * each gives two poles, conformal cylinder coordinates between them, two caps and four sides, which
 * then follow the normals. The charts with the best alignment are returned. They are discs that
 * touch as the faces of a cube do; throws std::runtime_error where that cannot be had,
 * std::invalid_argument for a surface that is not a sphere's equal. O(n log n) beside one sparse
 * factorisation; 1e5 triangles: about a second.
 */
CubeCharts FindCubeCharts(
  const SurfaceMesh& mesh, const CubeChartOptions& options, const Execution& execution);
}

#endif
