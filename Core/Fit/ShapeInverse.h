// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// The parameters at which a fitted shape passes through given places.
#ifndef trivariate_ShapeInverse_h
#define trivariate_ShapeInverse_h

#include "BlockFit.h"
#include "TSpline/BezierMesh.h"

#include <vector>

namespace trivariate
{
struct FoundParameters
{
  std::vector<double> Parameters; ///< (u, v, w) of each place
  Index Inside = 0;               ///< places that the shape passes through (see InverseMap)
  std::vector<Index> Outside;     ///< the others
};

/**
 * `places`: (X, Y, Z) of each. One that the shape does not reach gets the parameter of the nearest
 * point of the block of its start, as far as Gauss-Newton steps lead there. `starts`: (u, v, w) of
 * each, or empty, and then that of the nearest of `samples`.
 */
FoundParameters FindParametersOnShape(const TSpline& spline, const BezierMesh& mesh,
  const BlockComplex& blocks, const std::vector<double>& places, const std::vector<double>& starts,
  const ShapeSamples& samples, const Execution& execution);
}

#endif
