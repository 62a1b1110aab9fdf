// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * What the surface of a segment demands of the frames of the voxels along it.
 *
 * A voxel is along the surface when one of its six faces is not shared with another voxel of the
 * segment. Its normals are the means of those of the triangles around it, by their area and by
 * trilinear weights of its distance along each axis of the grid (none from one voxel on), so that
 * the surface acts where it is, however its triangles lie, and on this segment's side only.
 */
#ifndef trivariate_SurfaceConstraints_h
#define trivariate_SurfaceConstraints_h

#include "Execution.h"
#include "FrameVoxels.h"

namespace trivariate
{
/// A triangle of the surface of a segment.
struct SurfaceTriangle
{
  /// In voxels: grid coordinates. In space they run against the clock, seen from outside.
  std::array<Eigen::Vector3d, 3> Corners;
  std::int8_t Side = AnyAxis; ///< as in FrameConstraint
};

struct SurfaceConstraints
{
  /// For each voxel, one a side; where the axis is open, one for all normals within 45 degrees of
  /// one line. What weighs less than a quarter of the voxel's largest is left out: beside a border
  /// of patches on a smooth surface the frame belongs to the patch on which it stands.
  std::vector<FrameConstraint> Constraints;
  Index Along = 0;     ///< voxels along the surface
  Index Bound = 0;     ///< those of them that have constraints
  double Astray = 0.0; ///< share of the surface's area (in voxels) that is at no such voxel
};

/**
 * Constraints from triangles, which need not be connected nor cover all of the surface. Time:
 * linear in the triangles, or in their area where that is larger. Memory: 4 bytes a voxel of the
 * grid and about 300 a voxel along the surface.
 */
SurfaceConstraints ConstrainToSurface(const FrameVoxels& voxels,
  const std::vector<SurfaceTriangle>& triangles, const Execution& execution);
}

#endif
