// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * From a point in space to its parameters: solves (X, Y, Z)(u, v, w) = x.
 *
 * Where the geometry is affine in the parameters (as in fits of an image's own index space) the
 * solution is in closed form. Otherwise the cells whose control points' bounding box holds x are
 * tried in turn (weights are positive, so a cell lies in the convex hull of its control points),
 * each by a damped Newton iteration inside the cell's parameter box.
 */
#ifndef trivariate_InverseMap_h
#define trivariate_InverseMap_h

#include "BezierMesh.h"
#include "Evaluator.h"
#include "Execution.h"
#include "TSpline.h"

#include <array>
#include <cstdint>
#include <vector>

namespace trivariate
{
class InverseMap
{
public:
  /// The mesh must belong to the spline and outlive this object.
  InverseMap(const TSpline& spline, const BezierMesh& mesh, const Execution& execution = {});

  /// Whether X, Y, Z are one affine map of u, v, w (to 1e-12 of the size of the geometry).
  bool Affine() const { return this->IsAffine; }

  /**
   * Parameters of a point in space; false (and `parameters` unchanged) when no cell maps there to
   * 1e-10 of the size of the geometry. Where the geometry folds over itself any one of the
   * solutions is returned, the same one every time.
   */
  bool Find(const double point[3], double parameters[3]) const;

  /// n points; parameters are zero where found[i] is 0.
  void Find(Index n, const double* points, double* parameters, std::uint8_t* found,
    const Execution& execution = {}) const;

private:
  // A bounding volume hierarchy over the cells' control points: see InverseMap.cpp.
  struct Node
  {
    std::array<double, 6> Bounds;
    std::int32_t First, Second; // children, or -1 - cell in First of a leaf
  };

  Evaluator Geometry;
  std::vector<Node> Tree;
  double Size = 0.0; // diagonal of the geometry's bounding box
  bool IsAffine = false;
  std::array<double, 9> AffineInverse{};
  std::array<double, 3> AffineOrigin{};
};
}

#endif
