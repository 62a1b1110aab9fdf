// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * A surface in a frame and an order of its own.
 *
 * What is searched on a surface depends, through ties and rounding, on how it lies in space and on
 * the order of its triangles: on a bent and branched one quite other cubes may come out. So it is
 * searched where its principal axes are the axes of space, with coordinates rounded to a millionth
 * of its size or less and points and triangles sorted by them, which is the same surface to the
 * last bit whatever rigid motion and whatever order it came in. Where principal axes are not
 * unique, as of a ball or a cube, it keeps its directions.
 */
#ifndef trivariate_PosedSurface_h
#define trivariate_PosedSurface_h

#include "Domain/SegmentDomain.h"

namespace trivariate
{
struct PosedSurface
{
  /// O(n log n).
  explicit PosedSurface(const SurfaceMesh& given);

  Eigen::Vector3d ToGiven(const Eigen::Vector3d& place) const;

  /// A domain of Mesh as one of `given`, with the points of that one.
  SegmentDomain ToGiven(const SurfaceMesh& given, SegmentDomain domain) const;

  Eigen::Matrix3d Frame;                ///< rows: its axes in the space of the given one
  Eigen::Vector3d Middle;               ///< of its area
  std::vector<Index> Points, Triangles; ///< of each of Mesh: which of the given ones it is
  SurfaceMesh Mesh;

private:
  SurfaceMesh Sorted(const SurfaceMesh& given);
};

/// A surface of fewer triangles (SurfaceReduction.h) that does not depend on pose and order either.
SurfaceMesh ReducedAsPosed(const SurfaceMesh& given, Index triangles, const Execution& execution);
}

#endif
