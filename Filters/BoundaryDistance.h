// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * How far the boundary of a segment's T-spline is from the segment's surface.
 */
#ifndef BoundaryDistance_h
#define BoundaryDistance_h

#include "Execution.h"
#include "TSpline/TSpline.h"

#include <vector>

class vtkPolyData;

namespace trivariate
{
class BezierMesh;

/// Points and triangles of a surface.
struct TriangleList
{
  std::vector<double> Points;   ///< x, y, z in turn
  std::vector<Index> Triangles; ///< three points each
};

/**
 * The faces of the Bezier cells that bound the spline: with no cell on the other side, neither in
 * parameter space nor, where blocks are glued, in space: faces of blocks, which are unit boxes in
 * parameter space, are glued where corners and middles are the same to 1e-9 of the spline's size.
 * Each face of a cell is cut into 2 x 4^2 triangles.
 */
TriangleList SplineBoundary(
  const TSpline& spline, const BezierMesh& mesh, const Execution& execution);

/// The triangles of a surface that bound one segment: those whose cell array BoundaryLabels names
/// it, or all without that array.
TriangleList SegmentTriangles(vtkPolyData* surface, int segment);

/**
 * The Hausdorff distance of two surfaces: the largest distance of a corner of a triangle of either
 * from the other surface. NaN where one of them is empty. O(n log n).
 */
double HausdorffDistance(const TriangleList& a, const TriangleList& b, const Execution& execution);
}

#endif
