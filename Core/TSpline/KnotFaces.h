// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The knot faces of a box mesh, as three bits for each unit cell of the knot index grid.
 *
 * Bit a of cell (i, j, k) says that its low side in direction a lies on a face; a fourth one, that
 * the cell is in a hole of the domain, where it does not matter whether there is a face. One byte a
 * unit cell: 17 MB for 256^3.
 */
#ifndef trivariate_KnotFaces_h
#define trivariate_KnotFaces_h

#include "TSpline.h"

namespace trivariate
{
class KnotFaces
{
public:
  /// The faces of all functions: each knot spans its function's support in the other directions.
  explicit KnotFaces(const TSpline& spline);

  /// Adds the face at `knot` in `direction` across the whole support of f.
  void Insert(const BlendingFunction& f, int direction, std::int32_t knot);

  /// Whether the plane `knot` in `direction` carries faces across the whole support of f, as far as
  /// that is in the domain.
  bool Crosses(const BlendingFunction& f, int direction, std::int32_t knot) const;

  /// A knot that crosses f completely but is none of its own, and its direction; -1 if none does.
  std::int32_t FindCrossing(const BlendingFunction& f, int& direction) const;

private:
  std::array<Index, 3> Size; // unit cells
  std::array<Index, 3> Step; // distance of neighbours in Bits
  std::vector<std::uint8_t> Bits;
};
}

#endif
