// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// An image, or the piece of it that this process holds, as the core's segmentation wants it.
#ifndef SegmentationInput_h
#define SegmentationInput_h

#include "Texture/TextureSegmentation.h"

#include <array>
#include <exception>
#include <functional>
#include <string>
#include <vector>

class vtkDataArray;
class vtkImageData;
class vtkMultiProcessController;

namespace trivariate
{
/// How densities become grey levels.
struct GreyLevelOptions
{
  int Count = 16;
  bool AutomaticRange = true;
  std::array<double, 2> Range = { 0.0, 1.0 }; ///< unless automatic
};

struct SegmentationInput
{
  SegmentationPiece Piece;
  double Offset = 0.0; ///< the density is Piece.Density + Offset, so that floats keep the digits
  bool Constant = false;
};

/// Everybody's bytes on everybody; `controller` null: only one's own. Throws StoppedElsewhere where
/// another process has given up in RunTogether.
GatherBytes GatherBytesOf(vtkMultiProcessController* controller);

struct StoppedElsewhere : std::exception
{
  const char* what() const noexcept override { return "stopped by another process"; }
};

/**
 * Runs work that gathers bytes on all processes. Where it throws on one of them, that one tells the
 * others instead of what they wait for, so that it ends on all: they throw Aborted where that one
 * did, else StoppedElsewhere.
 */
void RunTogether(vtkMultiProcessController* controller, const std::function<void()>& work);

/**
 * What of the image is wrong for these options; empty if nothing. `array` is null where the image
 * does not have the array `wanted` (null or empty: its active scalars). `own` are the first and
 * last indices of the points that count for this process, `whole` those of the volume; the image
 * has to hold the neighbourhood of `own`. A piece without points has no fault, a volume without
 * has.
 */
std::string SegmentationFault(vtkImageData* image, vtkDataArray* array, const char* wanted,
  const std::array<int, 6>& own, const std::array<int, 6>& whole,
  const SegmentationOptions& options);

/// Reads a sound image. Called by all processes at once.
SegmentationInput ReadSegmentationInput(vtkImageData* image, vtkDataArray* array,
  const std::array<int, 6>& own, const std::array<int, 6>& whole, const GreyLevelOptions& levels,
  const GatherBytes& gather, int process);
}

#endif
