// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * A T-spline of several segments at given points in space.
 *
 * Segments overlap in space where their splines reach beyond their boundaries, so it has to be said
 * whose spline counts at a point.
 */
#ifndef SegmentPoints_h
#define SegmentPoints_h

#include "FieldSampler.h"

class vtkDataArray;
class vtkDataSet;

namespace trivariate
{
constexpr double LabelReach = 1.5; ///< in voxels, of the longest side

/// That of an image in space; 0 of other points.
double ReachIn(vtkDataSet* points);

/// Whether splines stand for the points of their segments alone: several do, and where points have
/// labels also one of a segment that is not 0, which it was fitted over the domain of. A spline of
/// segment 0, as of a fit without domain, stands for all points.
bool GoBySegments(const TSplineModel& model, bool labelled);

/**
 * As FillPoints, but every point by the spline of its own segment, which `labels` tells; without
 * labels (null) by that of the highest segment that holds it. Points of an image that have a label
 * and lie up to LabelReach voxels outside of the spline take its value at the nearest point: a
 * smooth surface does not go around every voxel. Throws std::invalid_argument with a
 * sentence for the user when the labels are not one number a point.
 */
void FillPointsOfSegments(
  const TSplineView& view, vtkDataArray* labels, vtkDataSet* output, const Execution& execution);
}

#endif
