// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The T-splines of segments over their domains of cubes.
 */
#ifndef DomainFit_h
#define DomainFit_h

#include "FittedPart.h"

#include <set>
#include <string>
#include <vector>

namespace trivariate
{
/// Sets of two or more segments, from `lowest` on and without folds, whose blocks have faces in
/// common.
std::vector<std::set<int>> TouchingSegments(const FilledDomains& domains, int lowest);

/**
 * Segments over their blocks alone. `image` has the arrays to fit, Parameter and ParameterMask of
 * the domains, and a mask of the voxels that count; its Parameter is changed to that of the blocks
 * alone. Throws as ChainStep does, and std::runtime_error where a segment is folded.
 */
FittedPart FitOverDomain(const FilledDomains& domains, vtkImageData* image, const char* mask,
  const std::set<int>& segments, const SegmentFitOptions& options, Chain& chain, double from,
  double to);

/// How a spline stands for some voxels by its inverse map.
struct PartErrors
{
  double Squares = 0.0;          ///< sum of squared errors of the first array, where it was found
  std::vector<vtkIdType> Missed; ///< voxels that were not found
};

/// The errors of a spline of one segment at voxels of an image.
PartErrors MeasurePart(vtkImageData* image, const std::string& array, const TSplineModel& model,
  const std::vector<vtkIdType>& voxels, Chain& chain, double from, double to);
}

#endif
