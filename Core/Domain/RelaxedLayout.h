// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// A layout's borders moved to where its map onto the polycube stretches the surface least.
#ifndef trivariate_RelaxedLayout_h
#define trivariate_RelaxedLayout_h

#include "Execution.h"
#include "SurfaceLayout.h"

namespace trivariate
{
/**
 * Maps the surface onto that of the polycube (LayoutUnfolding.h), lowers the stretch of the map
 * (LayoutRelaxation.h), and cuts the surface anew along the edges of the polycube
 * (LayoutCutting.h). Corners at which the polycube is flat move with the map, the others stay; with
 * `fixed` all of them stay. The layout gets Parameters.
 *
 * Returns false, and leaves the layout as it was, where the map cannot be made or the new layout is
 * not valid.
 */
bool Relax(SurfaceLayout& layout, const Polycube& cubes, bool fixed, const Execution& execution);
}

#endif
