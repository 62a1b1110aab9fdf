// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// Where, between two segments, the density is half-way between theirs.
#ifndef trivariate_DensityLevels_h
#define trivariate_DensityLevels_h

#include "NetSmoothing.h"

#include <vector>

namespace trivariate
{
/**
 * For every vertex and every pair of segments that meet there, the level between the pair's
 * densities. A segment's density near a vertex is the mean over its voxels in the 6 x 6 x 6 around
 * the corner all of whose neighbours have the same label (so that partial volume does not count),
 * or over all such voxels of the segment where there are fewer than four. A pair has a level only
 * if the two means differ by more than the sum of the two standard deviations.
 */
class DensityLevels
{
public:
  /// density: one value a voxel, not owned.
  DensityLevels(const LabelVolume& labels, const float* density, const BoundaryNet& net,
    const NetTopology& topology, const Execution& execution);

  /**
   * Moves the vertices along the normals of the surfaces to the nearest point in their cells where
   * the trilinear interpolant of the density crosses the level in the right direction; on curves to
   * where the tangent planes of the surfaces with a level meet, nearest to the vertex. Vertices
   * without a level or a crossing stay.
   */
  void Settle(Points& points, const Execution& execution) const;

  /**
   * Partial volume and interpolation blur the density, which draws a bent level inwards by half the
   * variance times the mean curvature, and triangles cut corners. Moves the vertices outwards by
   * as much; of surfaces with a level only, not of curves.
   */
  void CompensateBlur(Points& points, const Execution& execution) const;

private:
  struct Level
  {
    std::array<std::int32_t, 2> Labels;
    double Value;
    double Sign; ///< of the second segment's density minus the first's
  };
  struct Statistics
  {
    double Count = 0.0, Mean = 0.0, Deviation = 0.0;
  };
  class Sums;

  bool IsInner(Index i, Index j, Index k) const;
  std::vector<std::pair<std::int32_t, Statistics>> SegmentStatistics(
    const Execution& execution) const;
  double Density(const Eigen::Vector3d& point) const;
  bool FindCrossing(const Level& level, const Eigen::Vector3d& point, const Eigen::Vector3d& normal,
    double width, double& t) const;

  LabelVolume Labels;
  const float* Values;
  const BoundaryNet& Net;
  const NetTopology& Topology;
  std::vector<Index> LevelBegin; ///< the levels of vertex v
  std::vector<Level> Levels;
};
}

#endif
