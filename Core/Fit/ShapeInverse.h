// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// The parameters at which a fitted shape passes through given places.
#ifndef trivariate_ShapeInverse_h
#define trivariate_ShapeInverse_h

#include "BlockSpline.h"
#include "Execution.h"
#include "TSpline/BezierMesh.h"

#include <vector>

namespace trivariate
{
struct FoundParameters
{
  std::vector<double> Parameters; ///< (u, v, w) of each place
  Index Inside = 0;               ///< places that the shape passes through (see InverseMap)
  std::vector<Index> Outside;     ///< the others,
  std::vector<double> Distances;  ///< and how far each is from the shape
};

/// `places`: (X, Y, Z) of each. One that the shape does not reach gets the parameters of its
/// nearest point (see InverseMap::FindNearest). `starts`: where each was on a shape much like this,
/// or empty; each is looked for from there first.
FoundParameters FindParametersOnShape(const TSpline& spline, const BezierMesh& mesh,
  const std::vector<double>& places, const std::vector<double>& starts, const Execution& execution);

/// Places that were found outside, up to `reach` away, and the parameters of their nearest points.
struct OutsidePlaces
{
  std::vector<double> Places, Feet;
};
OutsidePlaces OutsideWithin(
  double reach, const FoundParameters& found, const std::vector<double>& places);

/// FindParametersOnShape with each place in the blocks of its own segment, in one of which its
/// parameter of `parameters` is; where these are empty, in any block. Outside and Distances go by
/// segments.
FoundParameters FindParametersOnSegments(const TSpline& spline, const BlockSpline& layout,
  const std::vector<double>& places, const std::vector<double>& parameters,
  const std::vector<double>& starts, const Execution& execution);
}

#endif
