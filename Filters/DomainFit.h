// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The T-spline of one segment over its domain of cubes.
 */
#ifndef DomainFit_h
#define DomainFit_h

#include "SegmentFits.h"

#include "vtkSmartPointer.h"

#include <vector>

class vtkTable;

namespace trivariate
{
struct FittedPart
{
  TSplineModel Model;
  vtkSmartPointer<vtkTable> Rounds;
};

/// How a spline stands for some voxels by its inverse map.
struct PartErrors
{
  double Squares = 0.0;          ///< sum of squared errors of the first array, where it was found
  std::vector<vtkIdType> Missed; ///< voxels that were not found
};

/**
 * Surface, cubes, frames, parameters and fit for the voxels of `label` in the point array Segment,
 * with the defaults of the filters for these steps. Throws as ChainStep does, and
 * std::runtime_error where the block mesh stays folded.
 */
FittedPart FitOverDomain(vtkImageData* image, int label, const SegmentFitOptions& options,
  vtkAlgorithm* chain, double from, double to);

/// The errors of a spline of one segment at voxels of an image.
PartErrors MeasurePart(vtkImageData* image, const std::string& array, const TSplineModel& model,
  const std::vector<vtkIdType>& voxels, vtkAlgorithm* chain, double from, double to);
}

#endif
