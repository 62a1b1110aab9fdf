// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// The parameter domain of one segment: a polycube, and its faces laid out on the surface.
#ifndef trivariate_SegmentDomain_h
#define trivariate_SegmentDomain_h

#include "Execution.h"
#include "SurfaceLayout.h"

namespace trivariate
{
struct SegmentDomain
{
  /// The surface cut along the borders of its patches. Patches, corners and borders are the faces,
  /// corners and edges of `Cubes`, in its order.
  SurfaceLayout Layout;
  Polycube Cubes;
  /// Where the lattice points of `Cubes` are: corners on the surface, then the inner points, each
  /// in the middle of its neighbours.
  std::vector<Eigen::Vector3d> Places;
  /// Area-weighted mean of the cosine between normals and the directions of their patches' axes.
  /// Directions are the same for the whole segment, or turn along a bent one.
  double Alignment;
};

/**
 * The given polycube with its corners at (or near) the given places, see LayoutFromCorners for what
 * is refused. The directions that Alignment refers to are the rotation that aligns best.
 */
SegmentDomain DomainFromCorners(const SurfaceMesh& mesh, const Polycube& polycube,
  const std::vector<Eigen::Vector3d>& picked, const Execution& execution,
  double farthest = std::numeric_limits<double>::infinity(),
  const std::vector<GivenBorder>& given = {});

/// Moves the borders of a domain from corners, which stay, to where it is stretched least (see
/// RelaxedLayout.h). Leaves it as it is where that cannot be done.
void RelaxDomain(SegmentDomain& domain, const Execution& execution);
}

#endif
