// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// Cells of a lattice, full or empty, changed one at a time so that they stay a ball.
#ifndef trivariate_CellShape_h
#define trivariate_CellShape_h

#include "Domain/Polycube.h"

#include <cstdint>

namespace trivariate
{
/**
 * Full cells that are a topological ball, none of which touch at edges or points only. Those to be
 * full are found by adding and taking away cells that change neither (SimplePoint.h), the best
 * first, and pairs of neighbours where no single one helps.
 */
class CellShape
{
public:
  /// gains: of each cell, the first axis fastest, what it is worth to be full rather than empty.
  CellShape(const std::array<int, 3>& size, std::vector<double> gains);

  /// The full cells of the best shape found: grown from the cell with the largest gain, or what is
  /// left of all cells.
  std::vector<LatticePoint> Best();

private:
  double Improve();
  bool CanChange(std::size_t cell) const;
  double Change(std::size_t cell)
  {
    this->Full[cell] ^= 1;
    return this->Full[cell] ? this->Gains[cell] : -this->Gains[cell];
  }
  double GainOf(std::size_t cell) const
  {
    return this->Full[cell] ? -this->Gains[cell] : this->Gains[cell];
  }
  bool ChangePair();

  std::array<int, 3> Size;   // with a margin of one empty cell on all sides
  std::vector<double> Gains; // of margins: 0
  std::vector<std::size_t> Cells;
  std::array<std::ptrdiff_t, 27> Around;
  std::vector<std::uint8_t> Full;
};
}

#endif
