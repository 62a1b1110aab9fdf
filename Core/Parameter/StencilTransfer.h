// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * From a grid to the one with twice its spacing and back, trilinearly.
 *
 * The coarse node I lies on the fine node 2 (I - 1) along each axis. It is an unknown where a fine
 * unknown is less than two nodes away, so that the weights of the coarse nodes around a fine
 * unknown always sum to one. Planes are the same on all grids.
 */
#ifndef trivariate_StencilTransfer_h
#define trivariate_StencilTransfer_h

#include "StencilMatrix.h"

namespace trivariate
{
/// P^T A P. Time: about a microsecond for each coarse row that is not common.
StencilMatrix Coarsen(const StencilMatrix& fine, const Execution& execution);

/// b = P^T r, planes included.
void Restrict(const StencilMatrix& fine, const StencilMatrix& coarse, const float* r, float* b,
  const Execution& execution);

/// x += P y, planes included.
void ProlongAdd(const StencilMatrix& fine, const StencilMatrix& coarse, const float* y, float* x,
  const Execution& execution);
}

#endif
