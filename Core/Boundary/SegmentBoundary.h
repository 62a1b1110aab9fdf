// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The surfaces between the segments of a labelled volume: closed and two-manifold for every
 * segment, shared by neighbours, smooth, and within half a voxel of the voxel faces.
 *
 * The net of voxel faces (BoundaryNet.h) is smoothed without shrinking; where the densities of two
 * segments differ, it settles on the level half-way between them; quadrilaterals are cut into
 * triangles; and where the surface would meet itself, vertices go back towards the net, which does
 * not. Coordinates are in voxels: voxel (i, j, k) is the unit cube around the point (i, j, k).
 */
#ifndef trivariate_SegmentBoundary_h
#define trivariate_SegmentBoundary_h

#include "BoundaryNet.h"
#include "TriangleIntersections.h"

#include <array>
#include <cstdint>
#include <vector>

namespace trivariate
{
struct BoundaryOptions
{
  /// How far steps are smoothed; 0 gives the voxel faces.
  int SmoothingIterations = 60;
  /// One value a voxel for the half-way level, not owned; without it the labels alone count.
  const float* Density = nullptr;
};

struct SegmentBoundary
{
  std::vector<Point> Points;
  std::vector<Triangle> Triangles;
  /// The segments below and above each triangle, ascending; -1 is the outside of the volume.
  std::vector<std::array<std::int32_t, 2>> Labels;
  /// For each point 0 inside a surface, 1 on a curve where three or more segments (or two and the
  /// outside) meet, 2 where such curves meet or end.
  std::vector<std::uint8_t> Junctions;
  Index PulledBack = 0;    ///< vertices that went back towards the net
  Index Intersections = 0; ///< pairs of triangles that are still too close; 0 but for a fault
};

/**
 * Memory: about 600 bytes a face of a voxel between two labels, nothing that grows with the number
 * of voxels.
 */
SegmentBoundary ComputeSegmentBoundary(
  const LabelVolume& labels, const BoundaryOptions& options, const Execution& execution);

/// Unit normals at the points: of the triangles around each, weighted by their angles.
std::vector<Point> PointNormals(const std::vector<Point>& points,
  const std::vector<Triangle>& triangles, const Execution& execution);
}

#endif
