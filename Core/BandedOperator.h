// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Banded matrices that act along one direction of a three-dimensional array.
 *
 * Everything that the gridded fit does to a volume (sampling B-splines, their moments, Gram
 * matrices, subdivision and its adjoint) is a tensor product of three of these.
 */
#ifndef trivariate_BandedOperator_h
#define trivariate_BandedOperator_h

#include "Execution.h"

#include <array>
#include <vector>

namespace trivariate
{
/// A matrix whose row r has `Width` numbers from column First[r] on (zeros where it is narrower).
struct BandedOperator
{
  Index Rows = 0;
  Index Columns = 0;
  int Width = 0;
  std::vector<std::int32_t> First;
  std::vector<double> Coefficients; ///< Rows x Width

  /// Builds from rows of (first column, coefficients).
  static BandedOperator FromRows(
    Index columns, const std::vector<std::pair<std::int32_t, std::vector<double>>>& rows);

  BandedOperator Transposed() const;
};

/// A dense array of Size[0] x Size[1] x Size[2] numbers, the first index fastest.
struct Array3
{
  std::array<Index, 3> Size{ 0, 0, 0 };
  std::vector<double> Values;

  Array3() = default;
  explicit Array3(const std::array<Index, 3>& size)
    : Size(size)
    , Values(size[0] * size[1] * size[2], 0.0)
  {
  }
  bool Empty() const { return this->Values.empty(); }
};

/// out = op applied along direction a of in. `in` must have op.Columns entries in that direction.
Array3 Apply(const BandedOperator& op, int a, const Array3& in, const Execution& execution);
}

#endif
