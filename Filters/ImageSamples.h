// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Point arrays of an image as the core's samples.
 */
#ifndef ImageSamples_h
#define ImageSamples_h

#include "Fit/Fit.h"
#include "TSpline/TSplineModel.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

class vtkDataArray;
class vtkImageData;

namespace trivariate
{
struct ImageSamples
{
  /// First and last index along i, j, k; last < first: no points.
  std::array<int, 6> Extent = { 0, -1, 0, -1, 0, -1 };
  std::array<double, 16> IndexToPhysical = {}; ///< affine, by rows, for the indices of Extent
  std::vector<TSplineAttribute> Attributes;
  std::vector<double> Values;     ///< one block of all points a component, i runs fastest
  std::vector<std::uint8_t> Mask; ///< empty: all points count

  Index Points(int axis) const { return this->Extent[2 * axis + 1] - this->Extent[2 * axis] + 1; }
  Index Count() const;
  int Components() const;

  /// Without a copy; valid as long as this object is and stays as it is.
  GridSamples View() const;

  /// The point in space of the parameter (u, v, w), which counts from the first index.
  std::array<double, 3> ToPhysical(const double* parameter) const;
};

/// Copies point arrays of an image, under their own names. Throws std::invalid_argument with a
/// sentence for the user: an array of another length, too little memory.
ImageSamples ReadArrays(vtkImageData* image, const std::vector<vtkDataArray*>& arrays);

/**
 * Copies the point arrays of an image: the chosen one and those with further names, each once, and
 * the mask unless its name is empty or "None". An array without a name is called ImageScalars.
 * Throws std::invalid_argument with a sentence for the user.
 */
ImageSamples ReadSamples(vtkImageData* image, vtkDataArray* chosen,
  const std::vector<std::string>& further, const std::string& maskName);

/// Throws std::invalid_argument when there are no points or fewer than two along an axis.
void CheckExtent(const ImageSamples& samples);
}

#endif
