// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * A piece of the geometry of a Bezier cell, which lies in the convex hull of its 64 control points:
 * how near it can come to a point, and its halves (de Casteljau).
 */
#ifndef trivariate_BezierPiece_h
#define trivariate_BezierPiece_h

#include <array>

namespace trivariate
{
class BezierPiece
{
public:
  /// Bounds as BezierMesh::Bounds; X, Y, Z of 64 control points each (u fastest), times the
  /// weights that follow them if the piece is rational.
  BezierPiece(const std::array<double, 6>& bounds, const double* coefficients, bool rational);

  const std::array<double, 6>& Bounds() const { return this->Box; }

  /// The place of one of its eight corners, a bit for each direction.
  std::array<double, 3> Corner(int corner) const;
  std::array<double, 3> CornerParameters(int corner) const;

  /// No point of the piece is nearer than that; infinite where its corners are not finite.
  double LeastDistance(const std::array<double, 3>& point) const;

  /// The halves across the direction in which the piece is longest.
  std::array<BezierPiece, 2> Halves() const;

private:
  std::array<double, 6> Box;
  bool IsRational;
  std::array<std::array<double, 64>, 4> Form; // X, Y, Z times the weight, and the weight

  std::array<double, 3> ControlPoint(int n) const;
  int LongestDirection() const;
};
}

#endif
