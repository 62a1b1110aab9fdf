// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The normal equations of a gridded least-squares fit.
 *
 * The sum over a grid of voxels of the product of two blending functions is a product of three
 * univariate sums, so the matrix costs nothing a voxel: A_ij = Gu(i, j) Gv(i, j) Gw(i, j).
 */
#ifndef trivariate_GramMatrix_h
#define trivariate_GramMatrix_h

#include "VoxelMask.h"

namespace trivariate
{
/**
 * Sparse symmetric matrix of the sums over voxels of B_i B_j. Numbers are kept in single precision:
 * the matrix only turns residuals into corrections, and the residuals are computed without it.
 */
class GramMatrix
{
public:
  GramMatrix(const TSpline& spline, const FunctionTable& table, const VoxelMask& mask,
    const Execution& execution);

  /// From the entries of all rows, each with ascending columns and its diagonal: any symmetric
  /// matrix that is positive semidefinite. A zero on the diagonal is a function without a sample.
  GramMatrix(std::vector<Index> rowBegin, std::vector<std::int32_t> columns,
    std::vector<float> entries, const Execution& execution);

  Index Size() const { return static_cast<Index>(this->Diagonal.size()); }

  /// Calls visit(i, j, A_ij) with all entries between functions that have a voxel.
  template <typename Visit>
  void VisitEntries(const Visit& visit) const
  {
    for (Index i = 0; i < this->Size(); ++i)
    {
      for (Index at = this->RowBegin[i]; this->Scale[i] > 0.0 && at < this->RowBegin[i + 1]; ++at)
      {
        const std::int32_t j = this->Columns[at];
        if (this->Scale[j] > 0.0)
        {
          visit(i, j, this->Values[at] / (this->Scale[i] * this->Scale[j]));
        }
      }
    }
  }

  /**
   * Conjugate gradients for A x = b from x = 0, preconditioned by a symmetric Gauss-Seidel sweep
   * within blocks of neighbouring functions, until the residual has fallen by `tolerance` (in the
   * preconditioner's norm) or `maximumIterations` are done. Functions without a voxel keep x = 0.
   * Returns the number of iterations.
   */
  int Solve(const std::vector<double>& b, double tolerance, int maximumIterations,
    std::vector<double>& x, const Execution& execution) const;

private:
  void Allocate(Index n);
  void SetDiagonal(Index i, double value);
  void SetCrossedDiagonal(
    const FunctionTable& table, const VoxelMask& mask, const Execution& execution);
  void SetCrossedEntries(
    const FunctionTable& table, const VoxelMask& mask, const Execution& execution);
  void FindBlock(Index i, Index n);

  /// The sum of Values times x at their columns over the entries [begin, end).
  double Multiply(Index begin, Index end, const std::vector<double>& x) const;

  /// z = the symmetric Gauss-Seidel sweep from zero for A z = r within [begin, end).
  void Relax(const std::vector<double>& r, Index begin, Index end, std::vector<double>& z) const;

  std::vector<Index> RowBegin;
  std::vector<Index> BlockBegin, DiagonalAt, BlockEnd; // the part of a row within its own block
  std::vector<std::int32_t> Columns;
  std::vector<float> Values; // scaled: A_ij / sqrt(A_ii A_jj)
  std::vector<double> Diagonal;
  std::vector<double> Scale; // 1 / sqrt(A_ii), 0 for functions without a voxel
};
}

#endif
