// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// A mapped surface cut along what lies on the edges of the polycube.
#ifndef trivariate_LayoutCutting_h
#define trivariate_LayoutCutting_h

#include "LayoutUnfolding.h"

namespace trivariate
{
/**
 * The layout whose borders are the edges of the polycube: straight lines in the charts, from corner
 * to corner, followed from triangle to triangle. A line that passes close to a point moves the
 * point's place onto itself rather than cut a sliver. `layout`: the one unfolded.
 * Origins are handed on, Parameters made.
 *
 * Throws std::runtime_error where a line loses its way or a triangle is folded.
 */
SurfaceLayout CutAlongEdges(const LayoutUnfolding& unfolding, const SurfaceLayout& layout);
}

#endif
