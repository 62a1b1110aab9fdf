// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// The way from borders on a surface of few triangles to the same borders on the whole surface.
#ifndef trivariate_BorderGuide_h
#define trivariate_BorderGuide_h

#include "SurfaceLayout.h"
#include "SurfaceReduction.h"

namespace trivariate
{
/**
 * Points of both surfaces that borders pass, or nearly so: some edges apart, and only where no
 * other border is near, so that on which side of others a border runs does not depend on them.
 * Between them a path on the whole surface has to be sought in a small neighbourhood only, however
 * the surface is folded.
 */
class BorderGuide
{
public:
  struct Waypoint
  {
    Index Point; // of the whole surface
    double Way;  // from the border's beginning
  };

  BorderGuide(const ReducedSurface& few, const SurfaceLayout& layout);

  std::vector<Waypoint> Along(Index border) const;
  double Length(Index border) const;
  /// The mean length of edges.
  double Edge() const { return this->MeanLength; }

private:
  bool IsBorder(Index point) const { return this->BorderOf[point] != None; }
  bool IsAlone(Index point, Index border, double radius) const;
  Index PointNear(Index point, Index border, double& distance) const;

  static constexpr Index None = -1, Several = -2;
  const ReducedSurface& Few;
  const SurfaceLayout& Layout;
  std::vector<std::vector<Index>> Neighbours; // of points
  std::vector<Index> BorderOf;                // each point
  double MeanLength = 0.0;
};
}

#endif
