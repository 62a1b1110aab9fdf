// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// A patch of a surface mapped to the unit square and back.
#ifndef trivariate_PatchMap_h
#define trivariate_PatchMap_h

#include "BlockDomain.h"
#include "Execution.h"

namespace trivariate
{
/**
 * Corners 0 to 3 of the patch go to (0, 0), (1, 0), (1, 1), (0, 1), other points to where the
 * domain's parameters have them on their face. Where it has none, or they fold a triangle, sides go
 * to those of the square by length, points inside to the means of their neighbours with mean-value
 * weights: one to one (M. S. Floater, Mean value coordinates, 2003), but for triangles with all
 * points on one side, which become flat.
 */
class PatchMap
{
public:
  /// The domain must outlive the map. Without parameters some sparse solves of as many unknowns as
  /// points.
  PatchMap(const BlockDomain& domain, Index patch, const Execution& execution);

  /// The place on the surface of a point of the square.
  Eigen::Vector3d At(const Eigen::Vector2d& st) const;

  /// The corner of the square of a point of the domain, which must be a corner of the patch.
  Eigen::Vector2d CornerOf(Index point) const;

private:
  void Number();
  bool TakeParameters();
  void MapSides();
  void MapInside(const Execution& execution);
  std::vector<Eigen::Vector2d> Solved(
    const std::vector<double>& divisors, const Execution& execution) const;
  double Stretch(const std::vector<Eigen::Vector2d>& square, std::vector<double>& ofPoints) const;
  void FillBuckets();

  const BlockDomain& Domain;
  const BlockPatch& Patch;
  std::vector<Index> Points;           // of the surface
  std::vector<Triangle> Triangles;     // of those
  std::vector<Eigen::Vector2d> Square; // where they are
  std::vector<char> OnSide;
  int BucketsAlong = 1;
  std::vector<std::vector<Index>> Buckets; // triangles over each cell of a grid of the square
};
}

#endif
