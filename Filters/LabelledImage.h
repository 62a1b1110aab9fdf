// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * A labelled image as the core wants it: int32 labels, and a density if there is one.
 */
#ifndef LabelledImage_h
#define LabelledImage_h

#include "Boundary/BoundaryNet.h"

#include <array>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

class vtkDataArray;
class vtkImageData;
class vtkMultiProcessController;

namespace trivariate
{
struct LabelledImage
{
  /// First and last index along i, j, k; last < first: no points.
  std::array<int, 6> Extent = { 0, -1, 0, -1, 0, -1 };
  std::array<double, 16> IndexToPhysical = {}; ///< affine, by rows, for the indices of Extent
  std::vector<std::int32_t> Labels;
  std::vector<float> Density; ///< empty: none

  LabelVolume View() const;

  /// The point in space of a point that counts from the first voxel.
  std::array<double, 3> ToPhysical(const std::array<double, 3>& index) const;

  /// Whether the map to space turns left hands into right hands.
  bool IsMirrored() const;
};

/**
 * The array of labels: `chosen` by SetInputArrayToProcess, or where that is null the point array
 * `name`, of a proxy without a choice (null, empty or "Automatic") the one called Segment. Throws
 * std::invalid_argument where there is none.
 */
vtkDataArray* ChosenLabels(vtkImageData* image, vtkDataArray* chosen, const char* name);

/**
 * Copies point arrays of an image; density may be null. Throws std::invalid_argument with a
 * sentence for the user: for more than one component, labels that are not whole numbers
 * from 0 to 2^31 - 1, a density that is not finite, too little memory.
 */
LabelledImage ReadLabels(vtkImageData* image, vtkDataArray* labels, vtkDataArray* density);

/// Collective: process 0 gets the whole, the others nothing. As GatherSamples.
bool GatherLabels(LabelledImage& image, std::string& fault, vtkMultiProcessController* controller);

/// The labels that occur. Throws std::invalid_argument where the image is one voxel thick, or a
/// wanted segment does not occur.
std::set<int> CheckSegments(const LabelledImage& image, const std::vector<int>& wanted);

/// Throws std::invalid_argument where a wanted segment is not among the labels.
void CheckPresent(const std::set<int>& labels, const std::vector<int>& wanted);

/// Throws std::invalid_argument as CheckSegments, and where there is no surface between two
/// segments, or too much of a surface for the memory.
void CheckLabels(const LabelledImage& image, const std::vector<int>& wanted);
}

#endif
