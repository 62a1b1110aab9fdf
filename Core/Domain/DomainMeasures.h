// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// What is measured on a layout.
#ifndef trivariate_DomainMeasures_h
#define trivariate_DomainMeasures_h

#include "ClosestRotation.h"
#include "SegmentDomain.h"

#include <Eigen/Geometry>

#include <string>
#include <vector>

namespace trivariate
{
/// -1 for the low end of an axis, 1 for the high one.
inline double SignOf(ChartLabel label)
{
  return label % 2 ? 1.0 : -1.0;
}

/// Twice the area vector of a triangle.
inline Eigen::Vector3d AreaVector(const SurfaceLayout& layout, std::size_t t)
{
  const Triangle& c = layout.Triangles[t];
  const Eigen::Vector3d& origin = layout.Points[c[0]];
  return (layout.Points[c[1]] - origin).cross(layout.Points[c[2]] - origin);
}

/// Area-weighted mean of the cosine between normals and the directions of their patches' axes.
/// `frame` tells the directions (rows) for a triangle of the layout.
template <typename Frame>
double AlignmentOf(const SurfaceLayout& layout, const Frame& frame)
{
  double sum = 0.0, area = 0.0;
  for (std::size_t t = 0; t < layout.Triangles.size(); ++t)
  {
    const Eigen::Vector3d n = AreaVector(layout, t);
    const ChartLabel label = layout.PatchLabels[layout.Patches[t]];
    sum += SignOf(label) * frame(t).row(label / 2).dot(n);
    area += n.norm();
  }
  return sum / area;
}

/// The rotation toward whose rows the normals of the patches point most.
Eigen::Matrix3d BestFrame(const SurfaceLayout& layout);

/// Corners where the layout has them, inner points in the middle of their neighbours.
std::vector<Eigen::Vector3d> PlacesOf(const SurfaceLayout& layout, const Polycube& cubes);

/// Places, and the alignment with the directions that are best for the whole segment.
void MeasureStraight(SegmentDomain& domain);

/// Throws std::runtime_error with the first message, if there is one.
void RefuseInvalid(const std::vector<std::string>& messages);
}

#endif
