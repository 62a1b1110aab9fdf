// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// A cube's layout cut across into a row of cubes.
#ifndef trivariate_ChainLayout_h
#define trivariate_ChainLayout_h

#include "Domain/SurfaceLayout.h"

namespace trivariate
{
/// A row of cubes along an axis.
Polycube Chain(int axis, int cubes);

/**
 * The layout of Chain(axis, cubes) from that of one cube, in the order of Polycube::FromGrid. The
 * four borders along the axis are cut at equal lengths, and corners at the same height joined by
 * geodesics within the four patches between them; nothing else changes.
 */
SurfaceLayout CutIntoChain(
  const SurfaceLayout& cube, int axis, int cubes, const Execution& execution);
}

#endif
