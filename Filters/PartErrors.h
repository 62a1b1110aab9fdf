// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// How a spline of one segment stands for voxels by its inverse map.
#ifndef PartErrors_h
#define PartErrors_h

#include "SegmentCut.h"
#include "TSpline/TSplineModel.h"

namespace trivariate
{
struct Chain;

struct PartErrors
{
  /// Of each array of the image the sum of squared errors of the component with the largest one,
  /// over the voxels that were found.
  std::vector<double> Squares;
  std::vector<vtkIdType> Missed; ///< voxels that were not found
};

/// At voxels of an image. Throws Aborted when the chain is stopped.
PartErrors MeasurePart(const SegmentedImage& image, const TSplineModel& model,
  const std::vector<vtkIdType>& voxels, Chain& chain, double from, double to);

/// Of the splines of all parts, in percent of the range of the array for which it is largest. Only
/// voxels that are found count.
double WorstRms(
  const SegmentedImage& image, const std::vector<TSplineModel>& models, Chain& chain, double at);
}

#endif
