// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// Boxes of knot indices: cells, supports of blending functions, holes.
#ifndef trivariate_IndexBox_h
#define trivariate_IndexBox_h

#include <array>
#include <cstdint>

namespace trivariate
{
/// A vertex of the grid of knot indices, or the unit cell of which it is the low corner.
using GridIndex = std::array<std::int32_t, 3>;

/// From knot Low[a] to knot High[a] of the knot line of each direction a; as integers half open.
struct IndexBox
{
  GridIndex Low, High;

  // Without branches: searches ask this of millions.
  bool Overlaps(const IndexBox& other) const
  {
    int gaps = 0;
    for (int a = 0; a < 3; ++a)
    {
      gaps += (this->Low[a] >= other.High[a]) + (other.Low[a] >= this->High[a]);
    }
    return gaps == 0;
  }
};
}

#endif
