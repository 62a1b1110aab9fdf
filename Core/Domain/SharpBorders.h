// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// Which borders of a layout are edges of the surface.
#ifndef trivariate_SharpBorders_h
#define trivariate_SharpBorders_h

#include "LayoutMesh.h"
#include "SurfaceLayout.h"

namespace trivariate
{
/**
 * Of each border: 1 where at nine of ten of its points the mean normals of both sides, over the
 * triangles within two and a half edges, differ by more than 50 degrees. So bends with a radius of
 * some edges are not sharp. `mesh`: the layout's.
 */
std::vector<char> SharpBorders(const SurfaceLayout& layout, const LayoutMesh& mesh);
}

#endif
