// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The segments of a labelled image, and images of some of them alone.
 */
#ifndef SegmentCut_h
#define SegmentCut_h

#include "Execution.h"

#include "vtkImageData.h"
#include "vtkSmartPointer.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

class vtkDataArray;

namespace trivariate
{
/// A segment, or several: where it is, and how its values range.
struct Part
{
  std::int32_t Label; ///< of several the first
  std::array<int, 6> Box;
  double Low, High;                             ///< of the first array
  std::vector<std::array<double, 2>> Further{}; ///< the ranges of those beside it
};

/// Segments by their numbers, in ascending order of their labels.
using PartNumbers = std::vector<std::int32_t>;

/// An image by the labels in its point array Segment.
struct SegmentedImage
{
  /// The first of `arrays` is the one whose range counts.
  SegmentedImage(vtkImageData* image, std::vector<std::string> arrays);

  vtkDataArray* Values() const; ///< the first array

  PartNumbers AllParts() const;
  std::vector<double> WholeRanges() const; ///< of each array, as in Part

  /// A tolerance, in parts of the range over the whole image, in parts of that in a segment: of the
  /// array for which it is least. 0 where all are constant in the segment.
  double ToleranceIn(const Part& part, double tolerance) const;

  /// Makes a voxel one of the first part.
  void GiveToFirst(vtkIdType voxel);

  vtkImageData* Image;
  std::vector<std::string> Arrays; ///< names of point arrays
  std::vector<Part> Parts;         ///< by ascending label
  PartNumbers PartOf;              ///< of each voxel

private:
  void Widen(Part& part, vtkIdType voxel, const std::array<int, 3>& at) const;
};

/// The share of the control points that each part should have, by PointShares.
std::vector<double> FindShares(const SegmentedImage& image, const Execution& execution);

/// Some parts as one.
Part UniteParts(const std::vector<Part>& parts, const PartNumbers& numbers);

/// Adds what an array has in a box of the image to the image that is the box.
void AddCropped(vtkImageData* image, vtkDataArray* whole, vtkImageData* box);

/// The point array of a cut that tells its own voxels.
constexpr const char* CutMaskName = "vtkSegmentMask";

/// Parts with the voxels that are their own.
struct Cut
{
  vtkSmartPointer<vtkImageData> Image; ///< the box with the arrays, and the mask
  std::vector<vtkIdType> Voxels;       ///< of the whole image
};

/// Some parts.
Cut CutOut(const SegmentedImage& image, const PartNumbers& numbers);
}

#endif
