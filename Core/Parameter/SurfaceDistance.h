// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// How far the surface of a domain and the faces of a block mesh on it are from one another.
#ifndef trivariate_SurfaceDistance_h
#define trivariate_SurfaceDistance_h

#include "BlockDomain.h"
#include "Execution.h"

namespace trivariate
{
/// In space.
struct SurfaceDistance
{
  double Mean = 0.0; ///< the root of the mean square over the area, taken at middles of triangles
  double Largest = 0.0; ///< at middles and corners
};

struct SurfaceDistances
{
  SurfaceDistance ToFaces;   ///< from the triangles of the surface
  SurfaceDistance FromFaces; ///< of cells, each cut in two
};

/// O(n log n), the same whatever the number of threads.
SurfaceDistances DistancesOfFaces(
  const BlockDomain& domain, const BlockMesh& mesh, const Execution& execution);
}

#endif
