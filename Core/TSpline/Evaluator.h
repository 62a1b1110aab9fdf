// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Value, gradient and Hessian of a rational T-spline, at scattered points or on a lattice.
 *
 * Works on the Bezier form of all cells, which it computes once and keeps: 512 bytes a cell and
 * component (and as much for the denominator unless it is one everywhere). Points at a knot take
 * the limit from the right, where nothing lies to the right from the left. No result depends on the
 * number of threads or on what other points are evaluated with it.
 */
#ifndef trivariate_Evaluator_h
#define trivariate_Evaluator_h

#include "BezierMesh.h"
#include "Execution.h"
#include "TSpline.h"

#include <array>
#include <cstdint>
#include <vector>

namespace trivariate
{
/**
 * Where results go; a null pointer is a result not wanted (and not computed). C is the number of
 * the evaluator's components; points in the order given, of a lattice with u fastest, then v, then
 * w.
 */
struct EvaluatorOutput
{
  double* Values = nullptr;       ///< C numbers a point
  double* Gradients = nullptr;    ///< C x 3 a point: d/du, d/dv, d/dw of each component
  double* Hessians = nullptr;     ///< C x 6 a point: uu, vv, ww, uv, vw, uw of each component
  std::uint8_t* Inside = nullptr; ///< 1 a point: 1 in the domain, else 0 and all results are zero
};

class Evaluator
{
public:
  /**
   * Prepares some components (0 to spline.Components - 1; 0, 1, 2 are X, Y, Z) for evaluation. The
   * mesh must belong to the spline and outlive this object; the spline need not.
   * Throws std::invalid_argument for a component that the spline does not have, or none.
   */
  Evaluator(const TSpline& spline, const BezierMesh& mesh, const std::vector<int>& components,
    const Execution& execution = {});

  /// Number of components evaluated.
  int Components() const { return this->ComponentCount; }

  /// False when the denominator is one everywhere (to 1e-13, the rounding of its sum): no division.
  bool Rational() const { return this->HasDenominator; }

  const BezierMesh& Mesh() const { return *this->Cells; }

  /// n points, each (u, v, w). Scattered ones by the hundred thousand are grouped in space first,
  /// with 34 bytes a point for up to a million at a time.
  void Evaluate(Index n, const double* points, const EvaluatorOutput& output,
    const Execution& execution = {}) const;

  /// One point; false outside the domain. For many points the batch is faster.
  bool Evaluate(const double point[3], const EvaluatorOutput& output) const;

  /**
   * The lattice of all (us[i], vs[j], ws[k]); each list ascends (repeats are allowed), otherwise
   * std::invalid_argument is thrown. Sum-factorised over each cell: far faster than point by point.
   */
  void EvaluateLattice(const std::array<std::vector<double>, 3>& coordinates,
    const EvaluatorOutput& output, const Execution& execution = {}) const;

  /// Bernstein coefficients of the cell as in ExtractBezier: the components, then the denominator
  /// if Rational().
  const double* Coefficients(Index cell) const { return &this->Bezier[cell * this->CellStride]; }

private:
  void EvaluateRange(
    Index begin, Index end, const double* points, const EvaluatorOutput& output) const;

  const BezierMesh* Cells;
  int ComponentCount;
  bool HasDenominator;
  Index CellStride; // numbers a cell
  std::vector<double> Bezier;
};

/// Determinant of the Jacobian, from the 3 x 3 gradients of X, Y, Z as Evaluator writes them.
inline double JacobianDeterminant(const double* g)
{
  return g[0] * (g[4] * g[8] - g[5] * g[7]) - g[1] * (g[3] * g[8] - g[5] * g[6]) +
         g[2] * (g[3] * g[7] - g[4] * g[6]);
}
}

#endif
