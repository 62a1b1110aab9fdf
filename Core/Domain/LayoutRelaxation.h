// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// Borders of a layout moved to where the map onto the polycube stretches the surface least.
#ifndef trivariate_LayoutRelaxation_h
#define trivariate_LayoutRelaxation_h

#include "Execution.h"
#include "LayoutUnfolding.h"

namespace trivariate
{
struct RelaxationOptions
{
  int MostRounds = 100;    ///< of the coarsest level
  int FinerRounds = 4;     ///< of each other one
  double Tolerance = 3e-3; ///< ends where energy above an isometry's falls by less, as a share
};

struct RelaxationReport
{
  double Before = 0.0; ///< energy, see RelaxUnfolding, of the start on the coarsest level
  double After = 0.0;  ///< at the end, on the surface itself
  int Rounds = 0;
};

/**
 * Lowers the mean over the surface of (s^2 + 1/s^2 + t^2 + 1/t^2) / 4, the symmetric Dirichlet
 * energy, where s and t are the singular values of the map: 1 for an isometry, infinite where a
 * triangle is flat. No triangle is folded, so the map stays one to one.
 *
 * Newton's method (StretchEnergy.h) from few triangles to all of them (UnfoldingLevels.h). Steps go
 * no farther than to where the first triangle becomes flat (J. Smith, S. Schaefer, Bijective
 * parameterization with free boundaries, 2015). A sparse Cholesky factorisation serves as long as
 * it helps conjugate gradients. Throws std::runtime_error where the start is folded by rounding.
 * Does not depend on threads.
 */
RelaxationReport RelaxUnfolding(
  LayoutUnfolding& unfolding, const RelaxationOptions& options, const Execution& execution);
}

#endif
