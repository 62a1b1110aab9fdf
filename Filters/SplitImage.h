// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// An image split into segments, the first steps of a reconstruction.
#ifndef SplitImage_h
#define SplitImage_h

#include "ChainStep.h"

#include "vtkSmartPointer.h"

class vtkImageData;

namespace trivariate
{
struct Segmentation
{
  bool HasLabels = false;   ///< the image has the point array Segment already
  int NumberOfSegments = 0; ///< 0 looks for a good number
};

/**
 * The image with the point array Segment, every segment in one piece: by vtkTextureSegmentation of
 * its first array, with the largest window up to the default one that the image has room for, and
 * by vtkSegmentTopology. Takes up the chain's progress to `to`. Throws std::invalid_argument where
 * the image has no room for any window, and as ChainStep does.
 */
vtkSmartPointer<vtkImageData> SplitImage(
  vtkImageData* image, const Segmentation& wanted, Chain& chain, double to);
}

#endif
