// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// The linear system of one parameter: eq. (1) in the norm of eq. (8), on trilinear cells.
#ifndef trivariate_ParameterSystem_h
#define trivariate_ParameterSystem_h

#include "PlaneSamples.h"
#include "StencilMatrix.h"
#include "TargetField.h"

namespace trivariate
{
/**
 * sum over cells and their 2 x 2 x 2 integration points, each weighted by the share of its octant,
 * of grad u^T D grad u, D = I - (1 - epsilon) f f^T / |f|^2, times `energy`; and the penalty
 * `stiffness` (u - c)^2 at the samples. The first plane's c is 0, the others are unknowns.
 */
StencilMatrix AssembleMatrix(const ParameterCells& cells, const PlaneSamples& samples,
  const TargetField& targets, double epsilon, double energy, double stiffness,
  const Execution& execution);

/// The same of grad u^T D f, linear in u.
std::vector<double> AssembleRightHandSide(const ParameterCells& cells, const TargetField& targets,
  double epsilon, Index planes, const Execution& execution);

/// u - c at each sample.
std::vector<double> DeviationsAt(
  const ParameterCells& cells, const PlaneSamples& samples, const std::vector<double>& u);
}

#endif
