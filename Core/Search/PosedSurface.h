// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * A surface in a frame and an order of its own.
 *
 * What is searched on a surface depends, through ties and rounding, on how it lies in space and on
 * the order of its triangles: on a bent and branched one quite other cubes may come out. So it is
 * searched where its own axes (OwnAxes.h) are the axes of space or, where moments tell principal
 * axes apart, askew to these, with coordinates rounded to a millionth of its size or less and
 * points and triangles sorted by them, which is the same surface to the last bit whatever rigid
 * motion and whatever order it came in. Where it has no axes of its own, as a ball or a round
 * cylinder, it keeps its directions; where it has symmetries, it may lie in another one of the
 * poses in which it is the same.
 */
#ifndef trivariate_PosedSurface_h
#define trivariate_PosedSurface_h

#include "Domain/SegmentDomain.h"

namespace trivariate
{
/// A frame, and a unit of coordinates in it.
struct SurfacePose
{
  /// O(n).
  explicit SurfacePose(const SurfaceMesh& surface);

  Eigen::Vector3d ToGiven(const Eigen::Vector3d& place) const;

  /// In whole units.
  Eigen::Vector3d ToPosed(const Eigen::Vector3d& place) const;

  /// A domain with all of its places moved.
  SegmentDomain ToPosed(SegmentDomain domain) const;

  Eigen::Vector3d Middle; ///< of the surface's area
  Eigen::Matrix3d Frame;  ///< rows: its axes in the space of the surface
  double Unit;
};

struct PosedSurface : SurfacePose
{
  /// In its own pose, or that of one around it. O(n log n).
  explicit PosedSurface(const SurfaceMesh& given);
  PosedSurface(const SurfaceMesh& given, const SurfacePose& pose);

  using SurfacePose::ToGiven;

  /// A domain of Mesh as one of `given`, with the points of that one.
  SegmentDomain ToGiven(const SurfaceMesh& given, SegmentDomain domain) const;

  std::vector<Index> Points, Triangles; ///< of each of Mesh: which of the given ones it is
  SurfaceMesh Mesh;

private:
  SurfaceMesh Sorted(const SurfaceMesh& given);
};
}

#endif
