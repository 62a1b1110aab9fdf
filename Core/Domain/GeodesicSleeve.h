// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Exact geodesics between two points of a mesh, through a row of triangles.
 *
 * The row is found as the shortest way over the middles of edges, straight across up to four
 * triangles at once, then straightened as in Xin and Wang, "Efficiently determining a locally exact
 * shortest path on polyhedral surfaces", Computer-Aided Design 39 (2007): unfolded, its shortest
 * path bends at points only; where the angle behind such a point is less than pi, the row is led
 * around its other side, until no more is gained. Marked edges are never crossed.
 */
#ifndef trivariate_GeodesicSleeve_h
#define trivariate_GeodesicSleeve_h

#include "LayoutMesh.h"

namespace trivariate
{
/// A triangle and one of its sides, across which a path leaves it: 3 triangle + side.
using Crossing = Index;

/// Where a path begins or ends: at a point, in one sector of its fan. A sector is what lies between
/// two neighbouring marked edges; `Sector` holds all of its triangles.
struct PathEnd
{
  Index Point;
  std::vector<Index> Sector;
};

/// The sector around `point` that contains a triangle; all triangles around it where none of its
/// edges is marked.
PathEnd SectorWith(const LayoutMesh& mesh, Index point, Index triangle);

/**
 * The crossings of a short way from one sector to another; empty where there is none. No triangle
 * may be in both sectors. Cost: a search of the triangles within the ellipsoid of the way's length
 * about the ends, n log n in their number.
 */
std::vector<Crossing> FindSleeve(const LayoutMesh& mesh, const PathEnd& from, const PathEnd& to);

/// Where the straightened path crosses the edges: fractions of the way from the right to the left
/// end of each; 0 and 1 where it bends at that end.
struct Geodesic
{
  std::vector<Crossing> Crossings;
  std::vector<double> Fractions;
  double Length;
};

/// The shortest path homotopic to the sleeve in the surface less marked edges; see above.
Geodesic Straighten(const LayoutMesh& mesh, Index from, Index to, std::vector<Crossing> crossings);
}

#endif
