// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// The surface of a segment with the lattice planes of its patches.
#ifndef LatticeSurface_h
#define LatticeSurface_h

#include "DomainInput.h"
#include "GridSpace.h"
#include "Parameter/VoxelParameter.h"

namespace trivariate
{
/**
 * The triangles of a segment, the planes of their patches, and the borders between patches of one
 * plane as lines, in grid space. Empty where the segment has no lattice: it is a shell, whose two
 * surfaces have the same coordinates. Throws std::invalid_argument, naming the patch, where the
 * corners of one do not lie in a plane.
 */
ParameterSurface LatticeSurfaceOf(
  vtkPolyData* patches, const DomainInput& input, int segment, const GridSpace& space);
}

#endif
