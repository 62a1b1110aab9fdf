// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// The core's surfaces between segments as polygonal data.
#ifndef BoundaryPolyData_h
#define BoundaryPolyData_h

#include "Boundary/SegmentBoundary.h"

#include <vector>

class vtkPolyData;

namespace trivariate
{
struct LabelledImage;

/**
 * The triangles of the chosen segments (none: all but 0) in space, with the arrays of
 * vtkSegmentBoundary. The first label is the inner side: the one that was chosen; of two, not 0;
 * else the lower.
 */
void BoundaryToPolyData(const SegmentBoundary& boundary, const LabelledImage& image,
  const std::vector<int>& wanted, vtkPolyData* output);
}

#endif
