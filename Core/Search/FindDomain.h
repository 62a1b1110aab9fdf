// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// The domain of a segment, found.
#ifndef trivariate_FindDomain_h
#define trivariate_FindDomain_h

#include "CubeCharts.h"
#include "PosedSurface.h"

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
  /// Surfaces with more triangles are searched on a copy with few. What is found may be another one
  /// of those that are about as good.
  Index MostTriangles = ManyTriangles;
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
 * have, on the surface itself. Only the best is laid out there; a cube from charts is judged again,
 * for charts of the surface itself can be quite others. A surface with too few triangles is
 * cut finer. A surface of more than MostTriangles is reduced to 20000 first, the domain found
 * there and its borders led along on the surface itself (LayoutAlong). Borders of the best one are
 * relaxed if wanted (RelaxedLayout.h).
 *
 * All this is done on the surface as PosedSurface.h turns and sorts it: neither the order of its
 * points and triangles nor a rigid motion changes the result, unless the surface is round. On one
 * with exact symmetries a rotation may lead to another domain that is about as good.
 *
 * Throws std::invalid_argument for a surface of several pieces, std::runtime_error with the reasons
 * (and the place of a handle) where no domain can be laid out. O(n log n): 5 to 25 s
 * for 1e5 to 5e5 triangles.
 */
SegmentDomain FindDomain(
  const SurfaceMesh& mesh, const DomainOptions& options, const Execution& execution);

/// The same, searched in the pose of a surface around it.
SegmentDomain FindDomain(const SurfaceMesh& mesh, const SurfacePose& pose,
  const DomainOptions& options, const Execution& execution);
}

#endif
