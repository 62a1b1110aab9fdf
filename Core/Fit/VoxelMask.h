// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Which voxels of a grid count, and sums over those that do.
 *
 * A row of voxels along x is a few runs that count, so with the running sums of a univariate
 * product a row costs as many differences as it has runs, however long they are.
 */
#ifndef trivariate_VoxelMask_h
#define trivariate_VoxelMask_h

#include "FunctionTable.h"

#include <array>

namespace trivariate
{
struct VoxelMask
{
  std::array<Index, 3> Size;
  const std::uint8_t* Values = nullptr; ///< null: all

  /// Voxels that count in all boxes from the origin: (x, y, z) exclusive; (Size + 1)^3 numbers.
  std::vector<std::int32_t> Counts;
  /// The runs [first, last) in x of voxels that count, ascending; those of the row (y, z) begin at
  /// RowBegin[z * Size[1] + y].
  std::vector<std::array<std::int32_t, 2>> Runs;
  std::vector<Index> RowBegin;
  void Prepare(const Execution& execution);

  /// Voxels that count in the box from begin to end (exclusive).
  Index CountIn(const std::array<Index, 3>& begin, const std::array<Index, 3>& end) const;
};

/// How many of the voxels that the supports of functions i and j share count.
enum class Part
{
  None,
  Some,
  All
};
Part PartThatCounts(const VoxelMask& mask, const FunctionTable& table, Index i, Index j);

/// Indices of two blending functions.
using FunctionPair = std::array<std::int32_t, 2>;

/**
 * For each pair of functions the sum of their product over the voxels that count. Pairs with the
 * same factors in x share the sums along x, which are the most of the work.
 */
std::vector<double> MaskedProducts(const VoxelMask& mask, const FunctionTable& table,
  const std::vector<FunctionPair>& pairs, const Execution& execution);
}

#endif
