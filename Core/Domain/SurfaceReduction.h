// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// A surface of fewer triangles.
#ifndef trivariate_SurfaceReduction_h
#define trivariate_SurfaceReduction_h

#include "Execution.h"
#include "SurfaceMesh.h"

namespace trivariate
{
/**
 * Points are drawn into neighbours, where that changes the surface least [Garland and Heckbert,
 * "Surface simplification using quadric error metrics", 1997], until no more than so many triangles
 * are left or no more can be done. The surface stays closed, two-manifold, and of the same genus;
 * points are some of those given. Long edges are avoided also where the surface is flat.
 * O(n log n); 1e5 triangles: half a second.
 */
SurfaceMesh Reduced(const SurfaceMesh& mesh, Index triangles, const Execution& execution);

/// The same, and what became of what.
struct ReducedSurface
{
  SurfaceMesh Mesh;
  std::vector<Index> Points;      ///< of each of its points: which of the given ones it is
  std::vector<Index> TriangleFor; ///< of each given triangle: one that took its place
};

ReducedSurface Reduce(const SurfaceMesh& mesh, Index triangles, const Execution& execution);
}

#endif
