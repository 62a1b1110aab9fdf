// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// The parameter domain of one segment: a polycube, and its faces laid out on the surface.
#ifndef trivariate_SegmentDomain_h
#define trivariate_SegmentDomain_h

#include "CubeCharts.h"
#include "SurfaceLayout.h"

namespace trivariate
{
struct DomainOptions
{
  CubeChartOptions Charts;
  /// How much one more corner must bring: in what CoarseHexahedra.h measures, and for chains thrice
  /// as much in alignment (see SegmentDomain). 0: as many cubes as are best; 1: one cube wherever
  /// one will do.
  double CornerCost = 0.0005;
  /// Domains with more cubes are not looked at.
  Index MostCubes = 64;
  /// Whether borders go to where the map onto the cubes stretches the surface least
  /// (RelaxedLayout.h), also where that aligns them less.
  bool Relax = false;
};

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
 * The domain whose hexahedra become best (CoarseHexahedra.h), less the cost of its corners.
 * CheckLayout finds nothing in it. Tried are one cube; chains of cubes cut from it where it is
 * long, or so bent that it is inverted, which have its hexahedra and are chosen by alignment (less
 * 0.05 where a cube, straight between its corners, is inverted); on a surface with flat parts
 * (FlatPolycube.h) their polycube, if sound, the only one that may have handles; and, where these
 * have hexahedra below 0.83, polycubes that fill the solid about as well as so few cubes can
 * (CoarsePolycube.h). Those must be better by 0.035, lest what is only rough gets cubes; between
 * cubes with hexahedra closer than that, alignment decides.
 *
 * Candidates are found and judged on a surface of few triangles; a cube whose charts it does not
 * have, on the surface itself. Only the best is laid out there. A surface with too few triangles is
 * cut finer. Borders of the best one are relaxed if wanted (RelaxedLayout.h).
 *
 * Throws std::invalid_argument for a surface of several pieces, std::runtime_error with the reasons
 * (and the place of a handle) where no domain can be laid out. O(n log n) beside one sparse
 * Cholesky factorisation.
 */
SegmentDomain FindDomain(
  const SurfaceMesh& mesh, const DomainOptions& options, const Execution& execution);

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
