// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * How well and how compactly a T-spline stands for an image, segment by segment.
 */
#ifndef SegmentReport_h
#define SegmentReport_h

#include "Execution.h"
#include "ImageSamples.h"
#include "TSpline/TSplineModel.h"

#include <map>
#include <string>
#include <vector>

class vtkImageData;
class vtkPolyData;
class vtkTable;

namespace trivariate
{
/// What is compared; pointers that may be null are optional.
struct ReportInput
{
  /// Attributes: the array to compare, then those of Labels, Parameter and ParameterMask that are
  /// there.
  ImageSamples Image;
  /// First block of each in Image.Values; -1: none, which Labels are not where the model has
  /// several segments.
  int Labels = -1, Parameter = -1, Mask = -1;
  int ScalarType = 0;              ///< VTK's, of the array to compare
  vtkImageData* Lattice = nullptr; ///< without arrays: origin, spacing, direction, extent
  TSplineModel Model;              ///< as it would be stored
  int Attribute = 0;               ///< of the model, to compare; one component
  vtkPolyData* Surfaces = nullptr; ///< of segments, or null
  vtkTable* Rounds = nullptr;      ///< of the fit, or null
};

struct ReportRow
{
  std::map<std::string, double> Numbers; ///< NaN where one is not known
  std::string Domain;                    ///< over what was fitted
};

/// The columns of the table, in order: numbers, and last Domain.
const std::vector<std::string>& ReportColumns();

/// One row for each segment of the image, ascending, and one for all.
std::vector<ReportRow> MakeReport(const ReportInput& input, const Execution& execution);
}

#endif
