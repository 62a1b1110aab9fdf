// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// Corners that a user picks for several segments.
#ifndef PickedCorners_h
#define PickedCorners_h

#include "SegmentDomains.h"

#include "vtkSmartPointer.h"

#include <functional>
#include <map>
#include <vector>

class vtkMultiProcessController;
class vtkPointSet;
class vtkPolyData;

namespace trivariate
{
/// By segment, each in the order of the points.
using PickedCorners = std::map<int, std::vector<Eigen::Vector3d>>;

/// Point array of picked corners: whose they are.
constexpr const char* CornerSegmentName = "Segment";

/// Whether the points tell whose corners they are.
bool HaveSegments(vtkPointSet* points);

/**
 * Corners of all processes, on process 0: in the order of these, each with its array Segment where
 * all have it. Where all processes have the same ones, as from a source that knows of no pieces,
 * they are taken once. Every process must call it.
 */
vtkSmartPointer<vtkPolyData> GatherCorners(vtkPolyData* own, vtkMultiProcessController* controller);

/**
 * Points by their array Segment. Throws std::invalid_argument where it has more components than
 * one or a segment that is not among `chosen`, or one is not finite.
 */
PickedCorners CornersBySegment(vtkPointSet* points, const std::vector<int>& chosen);

/**
 * Segments with picked corners get domains of their own, the others those of FindDomains. Remarks
 * tell which of the first touch another segment, since nothing is shared there. Throws
 * std::invalid_argument and std::runtime_error with the segment's number as AddDomainFromCorners
 * and `shapeOf`, which gives the cubes of a segment.
 */
DomainSet DomainsFromCorners(const LabelledSurface& surface, const std::vector<int>& chosen,
  const PickedCorners& picked,
  const std::function<Polycube(const SurfaceMesh&, const Execution&)>& shapeOf, double snapLimit,
  const DomainSettings& settings, const Execution& execution);
}

#endif
