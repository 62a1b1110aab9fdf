// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The inverse of the 3 x 3 matrix of the derivatives of X, Y, Z by u, v, w.
 */
#ifndef trivariate_InverseJacobian_h
#define trivariate_InverseJacobian_h

#include "Evaluator.h"

#include <array>

namespace trivariate
{
struct InverseJacobian
{
  double Determinant;           ///< of the matrix itself
  std::array<double, 9> Matrix; ///< d(u, v, w)/d(X, Y, Z) row by row; zeros when singular

  /// From the gradients of X, Y, Z as Evaluator writes them.
  explicit InverseJacobian(const double* g)
    : Determinant(JacobianDeterminant(g))
    , Matrix{}
  {
    if (this->Determinant == 0.0)
    {
      return;
    }
    for (int i = 0; i < 3; ++i)
    {
      for (int j = 0; j < 3; ++j) // the cofactor of g(j, i)
      {
        const int a = (j + 1) % 3, b = (j + 2) % 3, c = (i + 1) % 3, d = (i + 2) % 3;
        this->Matrix[3 * i + j] =
          (g[3 * a + c] * g[3 * b + d] - g[3 * a + d] * g[3 * b + c]) / this->Determinant;
      }
    }
  }

  /// df/d(X, Y, Z) from df/d(u, v, w).
  std::array<double, 3> Gradient(const double* g) const
  {
    std::array<double, 3> result;
    for (int a = 0; a < 3; ++a)
    {
      result[a] = g[0] * this->Matrix[a] + g[1] * this->Matrix[3 + a] + g[2] * this->Matrix[6 + a];
    }
    return result;
  }

  /// The step in parameters that makes the given step in space.
  std::array<double, 3> Step(const double* step) const
  {
    std::array<double, 3> result;
    for (int i = 0; i < 3; ++i)
    {
      const double* row = &this->Matrix[3 * i];
      result[i] = row[0] * step[0] + row[1] * step[1] + row[2] * step[2];
    }
    return result;
  }
};
}

#endif
