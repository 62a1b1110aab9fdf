// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * A symmetric matrix over the nodes of a masked grid, each coupled with its 26 neighbours, and over
 * a few further unknowns, the planes, which are coupled with many nodes but not with each other.
 *
 * Most nodes have the same row, which is even in all three directions and kept once; the others
 * have their own. Nodes that are no unknowns belong to no run; vectors are zero there. The
 * outermost layer of the grid has no unknowns, so that every node has 26 neighbours in memory.
 *
 * Vectors: a number for each node of the grid, x fastest, then one for each plane.
 */
#ifndef trivariate_StencilMatrix_h
#define trivariate_StencilMatrix_h

#include "Execution.h"

#include <array>
#include <cstdint>
#include <vector>

namespace trivariate
{
/// Of the neighbours (dx + 1) + 3 (dy + 1) + 9 (dz + 1).
using StencilRow = std::array<double, 27>;

constexpr std::int32_t CommonRow = -1; ///< in place of a row's number: Common
constexpr std::int32_t NoUnknown = -2; ///< in place of a row's number: not in the matrix

struct StencilMatrix
{
  /// Nodes [Begin, End) of a line along x; their rows are Row, Row + 1, ... or all common.
  struct Run
  {
    std::int32_t Begin, End, Row;
  };
  struct Link
  {
    Index Node;
    std::int32_t Plane;
    double Value;
  };

  std::array<Index, 3> Size = { 0, 0, 0 };
  std::array<double, 8> Common{}; ///< for the neighbours at |dx| + 2 |dy| + 4 |dz|
  std::vector<Index> LineBegin;   ///< the runs of line j + Size[1] k begin there; and the end
  std::vector<Run> Runs;
  std::vector<StencilRow> Rows;
  std::vector<Link> Links; ///< ascending, no pair twice
  std::vector<double> PlaneDiagonal;

  Index Nodes() const { return this->Size[0] * this->Size[1] * this->Size[2]; }
  Index Planes() const { return static_cast<Index>(this->PlaneDiagonal.size()); }
  Index Length() const { return this->Nodes() + this->Planes(); }

  /// Makes lines and runs, and zero rows, from the number of each node's row; rows are numbered in
  /// order of nodes.
  void SetRows(const std::vector<std::int32_t>& rowOf);
  /// The number of each node's row.
  std::vector<std::int32_t> RowOfNodes() const;

  /// Sorts links, and adds up those of one pair.
  void SetLinks(std::vector<Link> links);

  /// The common row in full.
  StencilRow CommonStencil() const;
};

/// Nodes visited at once where each takes some ten nanoseconds.
constexpr Index QuickNodes = 1 << 22;

/**
 * Runs body for every k in [0, count); progress goes on, and the user's abort flag is looked at,
 * whenever about `atOnce` nodes are done, which should take less than half a second. On threads
 * where there are more nodes than a 128th of that, which take longer than threads to start.
 */
void ForEachSlab(const std::array<Index, 3>& size, Index count, const Execution& execution,
  const std::function<void(Index)>& body, Index atOnce = 1 << 19);

/// y = A x; or y = b - A x.
template <typename Real>
void Multiply(const StencilMatrix& a, const Real* x, Real* y, const Execution& execution);
template <typename Real>
void Residual(
  const StencilMatrix& a, const Real* b, const Real* x, Real* r, const Execution& execution);

/**
 * One sweep of Gauss-Seidel over A x = b: lines in four colors, nodes of a line in their order,
 * then the planes, which are taken for 0 before; backward, all the other way round, and the
 * planes' part of A x is taken off b.
 */
template <typename Real>
void RelaxForward(const StencilMatrix& a, const Real* b, Real* x, const Execution& execution);
template <typename Real>
void RelaxBackward(const StencilMatrix& a, Real* b, Real* x, const Execution& execution);
}

#endif
