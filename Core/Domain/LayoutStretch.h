// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// How much a surface is stretched when it is laid onto a polycube as well as its corners allow.
#ifndef trivariate_LayoutStretch_h
#define trivariate_LayoutStretch_h

#include "Execution.h"
#include "SurfaceLayout.h"

namespace trivariate
{
/**
 * x / (1 + x) where 1 + x is the energy that RelaxUnfolding leaves with the corners held (s and t
 * as there: x is the mean of (s^2 + 1/s^2 + t^2 + 1/t^2) / 4 - 1): 0 for an isometry, 1 where no
 * map was found. O(n^1.5) a round.
 */
double RelaxedStretch(
  const SurfaceLayout& layout, const Polycube& cubes, const Execution& execution);
}

#endif
