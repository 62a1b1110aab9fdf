// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * A surface cut along geodesics between corners into patches, one for each face of a polycube.
 */
#ifndef trivariate_SurfaceLayout_h
#define trivariate_SurfaceLayout_h

#include "ChartRelabelling.h"
#include "Polycube.h"
#include "SurfaceReduction.h"

#include <limits>

namespace trivariate
{
struct LayoutBorder
{
  std::array<Index, 2> Corners; ///< where it begins and ends, counted in SurfaceLayout::Corners
  std::array<Index, 2> Patches; ///< on its left and on its right, seen from outside
  std::vector<Index> Points;    ///< the polyline, both corners included
};

struct SurfaceLayout
{
  std::vector<Eigen::Vector3d> Points; ///< those of the surface first, with their numbers
  std::vector<Triangle> Triangles;     ///< anticlockwise seen from outside
  std::vector<Index> Origins;          ///< of each triangle: the one of the surface it is part of
  std::vector<Index> Patches;          ///< of each triangle
  std::vector<ChartLabel> PatchLabels; ///< of each patch: 2 axis + side
  std::vector<Index> Corners;          ///< points
  std::vector<LayoutBorder> Borders;
  /// Of each point: where it is mapped to on the polycube's surface, in coordinates of the lattice,
  /// one to one; empty where no such map was made (LayoutRelaxation.h).
  std::vector<Eigen::Vector3d> Parameters = {};
};

/**
 * From charts: labels of triangles, 2 axis + side. Each connected chart becomes a patch; corners
 * are the points where three charts meet, in order of points. Each border is replaced by the
 * geodesic between its corners within the union of its two charts, again while that still shortens
 * the sum by more than 0.1 percent, at most three times. With a finite `stretch` geodesics replace
 * no more than so long a part of a border at once: steps are smoothed, but borders stay where they
 * are.
 *
 * Throws std::invalid_argument, naming the chart or point, when labels do not make a layout of
 * discs: a chart with a hole or without corners, four charts at a point, a chart that touches
 * itself. Whether the charts are those of a polycube, CheckCharts says (LayoutCheck.h).
 */
SurfaceLayout LayoutFromCharts(const SurfaceMesh& mesh, const std::vector<ChartLabel>& labels,
  const Execution& execution, double stretch = std::numeric_limits<double>::infinity());

/// A border whose course is given.
struct GivenBorder
{
  Index Edge;                ///< of the polycube
  std::vector<Index> Points; ///< along edges of the mesh, from where the edge begins to its end
};

/**
 * From one place for each corner of a polycube, which is moved to the nearest point of the surface.
 * Patches are the faces of the polycube, borders its edges, in its order. Borders that are given
 * stay as they are, and their ends are the corners there; they must be disjoint but for corners,
 * and leave no other corner between them and a face that they close.
 *
 * First a spanning tree of the edges is traced, shortest first, then the other edges, shortest
 * first, each in its place in the cyclic order around its corners. On a surface without handles
 * every edge finds its way, wherever the corners are, and every face is a disc. Then each border is
 * straightened as for charts.
 *
 * On more than ManyTriangles, unless borders are given, all this is done on a surface of few
 * triangles, borders are led along those found there (LayoutAlong) and made locally shortest within
 * the rows of triangles that they pass; where that fails, as above.
 *
 * Throws std::invalid_argument when there are more or fewer places than corners, one is farther
 * than `farthest` from the surface, two fall on one point, the places are those of a mirrored
 * polycube, or surface and polycube differ in their numbers of components or handles;
 * std::runtime_error, naming the patch, where the borders around a handle do not bound discs,
 * naming two corners, where others leave no path between them around a handle, and where paths
 * have to wind around each other so much that they cut the surface to shreds.
 */
SurfaceLayout LayoutFromCorners(const SurfaceMesh& mesh, const Polycube& polycube,
  const std::vector<Eigen::Vector3d>& corners, const Execution& execution,
  double farthest = std::numeric_limits<double>::infinity(),
  const std::vector<GivenBorder>& given = {});

/// Surfaces with more triangles are not searched and not laid out as they are.
constexpr Index ManyTriangles = 200000;

/**
 * A layout of a reduced surface taken to the surface itself: paths between points that both have
 * near the borders (BorderGuide.h), straightened over `stretch` mean edges of the reduced surface,
 * or, if infinite, made locally shortest as a whole. Corners at the given places, or where the
 * reduced surface has them. O(n), and for each border the area within a few edges of it.
 *
 * Throws std::runtime_error where a border cannot follow, and where CheckLayout finds something.
 */
SurfaceLayout LayoutAlong(const SurfaceMesh& mesh, const Polycube& polycube,
  const ReducedSurface& few, const SurfaceLayout& layout, const Execution& execution,
  const std::vector<Eigen::Vector3d>& corners = {},
  double stretch = std::numeric_limits<double>::infinity());
}

#endif
