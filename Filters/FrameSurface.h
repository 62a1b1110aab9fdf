// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// The surfaces that bind the frames of segments, in the voxels of a labelled image.
#ifndef FrameSurface_h
#define FrameSurface_h

#include "Field/SurfaceConstraints.h"

#include <map>
#include <vector>

class vtkPolyData;

namespace trivariate
{
struct LabelledImage;

/// The triangles of each segment.
using FrameSurfaces = std::map<int, std::vector<SurfaceTriangle>>;

/**
 * From the patches of vtkPolycubeDomain (cell arrays PatchAxis, PatchSide and Segment), with the
 * axes and sides that they name; or from the surfaces of vtkSegmentBoundary (cell array
 * BoundaryLabels), with any axis. Throws std::invalid_argument with a sentence for the user: for
 * cells that are no triangles, points that are not finite, neither kind of arrays, values of them
 * that mean nothing.
 */
FrameSurfaces ReadFrameSurfaces(vtkPolyData* input, const LabelledImage& image);

/// The surfaces between the labels themselves, with any axis, as vtkSegmentBoundary makes them
/// without a density.
FrameSurfaces MakeFrameSurfaces(
  const LabelledImage& image, const std::vector<int>& segments, const Execution& execution);
}

#endif
