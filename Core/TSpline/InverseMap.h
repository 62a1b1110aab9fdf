// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * From a point in space to its parameters: solves (X, Y, Z)(u, v, w) = x.
 *
 * Where the geometry is affine in the parameters (as in fits of an image's own index space) the
 * solution is in closed form. Otherwise a damped Newton iteration starts in the middle of each cell
 * whose control points' bounding box holds x (weights are positive, so a cell lies in the convex
 * hull of its control points), then in the middles of the cell's octants, until one start arrives.
 * An answer is accepted by its residual only. Cost: about a microsecond a point inside.
 */
#ifndef trivariate_InverseMap_h
#define trivariate_InverseMap_h

#include "BezierMesh.h"
#include "Evaluator.h"
#include "Execution.h"
#include "TSpline.h"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace trivariate
{
class BezierPiece;

class InverseMap
{
public:
  /// The mesh must belong to the spline and outlive this object; it must have at least one cell,
  /// otherwise std::invalid_argument is thrown.
  InverseMap(const TSpline& spline, const BezierMesh& mesh, const Execution& execution = {});

  /// Whether X, Y, Z are one affine map of u, v, w (to 1e-12 of the size of the geometry).
  bool Affine() const { return this->IsAffine; }

  /// Where Affine(): (X, Y, Z) = Offset() + Matrix() (u, v, w), the matrix row by row.
  const std::array<double, 3>& Offset() const { return this->AffineOrigin; }
  const std::array<double, 9>& Matrix() const { return this->AffineMatrix; }

  /**
   * Parameters of a point in space; false (and `parameters` unchanged) when no cell maps there to
   * 1e-10 of the size of the geometry. Where the geometry folds over itself one of the solutions is
   * returned, the same one every time.
   */
  bool Find(const double point[3], double parameters[3]) const;

  /**
   * As Find, and where no cell maps there the parameters of the nearest point of the geometry, if
   * it is less than `reach` away: no other point is nearer by more than a thousandth. Pieces of
   * cells are halved as long as their control points leave that open. False where the geometry is
   * affine and Find is.
   */
  bool FindNearest(const double point[3], double reach, double parameters[3]) const;

  /// Goes from `parameters`, where the point was on a geometry much like this, to those of the
  /// nearest point, wherever it is; true where that is the point itself, as in Find. A good start
  /// spares most of the search.
  bool FindNearestFrom(const double point[3], double parameters[3]) const;

  /// n points, by FindNearest where `reach` is not zero; parameters are zero where found[i] is 0.
  void Find(Index n, const double* points, double* parameters, std::uint8_t* found,
    const Execution& execution = {}, double reach = 0.0) const;

private:
  static constexpr double AcceptedResidual = 1e-10; // of the size of the geometry

  using Vector = std::array<double, 3>;

  // Where a cell can be: a bounding volume hierarchy. A leaf is a cell, -1 - Children[0].
  struct Node
  {
    Vector Low, High;
    std::array<std::int32_t, 2> Children;
  };
  // A place on the way to the solution.
  struct Place
  {
    Vector Parameters, Residual;
    std::array<double, 9> Jacobian;
    double Distance;
  };

  std::vector<Node> MakeLeaves() const;
  bool DetectAffine(const TSpline& spline, const Execution& execution);
  void SetAffine(const double* bezier, const std::array<double, 6>& bounds);
  bool IsAffineCell(const double* bezier, const std::array<double, 6>& bounds) const;
  Vector AffineImage(const Vector& parameters) const;
  std::int32_t BuildTree(std::vector<Node>& leaves, std::size_t first, std::size_t last);
  bool FindAffine(const Vector& point, Vector& parameters) const;
  bool FindBelow(
    std::int32_t node, const Vector& point, int startsAnAxis, Vector& parameters) const;
  bool Evaluate(const Vector& point, Place& place) const;
  void Approach(
    const Vector& point, const std::array<double, 6>& cell, Place here, Place& nearest) const;
  double WorthTheSearch(const Place& nearest) const;
  void NearestIn(const BezierPiece& piece, const std::array<double, 6>& cell, const Vector& point,
    Place& nearest) const;
  void NearestBelow(std::int32_t node, const Vector& point, Place& nearest) const;
  bool Newton(const Vector& point, Vector& parameters) const;
  void ClampToDomain(Vector& parameters) const;

  const BezierMesh* Cells;
  std::optional<Evaluator> Geometry; // none if affine
  std::vector<Node> Tree;
  double Size; // diagonal of the bounding box of the control points
  bool IsAffine = false;
  Vector AffineOrigin{};                // (X, Y, Z) = AffineOrigin + AffineMatrix (u, v, w)
  std::array<double, 9> AffineMatrix{}; // row by row
};
}

#endif
