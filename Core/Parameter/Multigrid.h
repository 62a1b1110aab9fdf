// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Conjugate gradients with geometric multigrid for matrices of stencils.
 *
 * The preconditioner is one symmetric V-cycle in single precision: coarse matrices are P^T A P, on
 * each level a forward sweep goes before and a backward sweep after, the coarsest level is solved
 * directly. Where the matrix is the Laplacian's, rows far from the boundary stay common to all
 * nodes on all levels.
 */
#ifndef trivariate_Multigrid_h
#define trivariate_Multigrid_h

#include "StencilMatrix.h"

#include <Eigen/Cholesky>

namespace trivariate
{
class Multigrid
{
public:
  /// The matrix must be positive definite, and outlive this. Memory: 14 bytes a node, and the
  /// coarse rows that are not common: 216 bytes each.
  Multigrid(const StencilMatrix& matrix, const Execution& execution);

  /// z = M r, M symmetric and close to the inverse of A. Returns r z.
  double Precondition(const double* r, double* z, const Execution& execution);

  Index NumberOfLevels() const { return static_cast<Index>(this->Coarse.size()) + 1; }

private:
  const StencilMatrix& LevelMatrix(std::size_t level) const
  {
    return level == 0 ? this->Finest : this->Coarse[level - 1];
  }
  void Cycle(std::size_t level, const Execution& execution);
  void FactorCoarsest();
  void SolveCoarsest();

  struct Vectors
  {
    std::vector<float> RightHandSide, Solution, Residual;
  };

  const StencilMatrix& Finest;
  std::vector<StencilMatrix> Coarse;
  std::vector<Vectors> Levels;
  std::vector<Index> CoarsestUnknowns;
  Eigen::LDLT<Eigen::MatrixXd> Factor;
};

struct LinearSolve
{
  int Iterations = 0;
  double Residual = 0.0; ///< |b - A x| / |b|
};

/// y = A x. Both of one length, see StencilMatrix.
using LinearOperator = std::function<void(const double* x, double* y, const Execution&)>;

/**
 * Solves A x = b from the x given until the relative residual is below the tolerance. Throws
 * std::runtime_error when it is not after `most` iterations. Memory: three doubles a node.
 */
LinearSolve SolveConjugateGradients(const LinearOperator& a, Multigrid& preconditioner,
  const std::vector<double>& b, double tolerance, int most, std::vector<double>& x,
  const Execution& execution);
}

#endif
