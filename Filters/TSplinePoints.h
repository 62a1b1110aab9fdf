// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * A T-spline at given points in space, by the inverse of its geometry map.
 *
 * All functions throw Aborted when stopped and std::length_error with a sentence for the user when
 * the output does not fit into memory.
 */
#ifndef TSplinePoints_h
#define TSplinePoints_h

#include "FieldSampler.h"

#include <array>

class vtkDataSet;
class vtkImageData;

namespace trivariate
{
/**
 * Adds the attributes at the points that `output` has. vtkValidPointMask tells which of them lie in
 * the spline, or not farther outside than the view's reach; zeros elsewhere. An image that is
 * aligned with a spline of affine geometry (such as the image that the spline was fitted to) is
 * evaluated as a lattice, without searching.
 */
void FillPoints(const TSplineView& view, vtkDataSet* output, const Execution& execution);

/// Lays an image of the given numbers of points, two or more each, over the spline's bounds: those
/// of the control points of its Bezier cells.
void PlaceImage(const TSplineView& view, const int dimensions[3], vtkImageData* output,
  const Execution& execution);
}

#endif
