// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "FrameMatching.h"

#include <algorithm>

namespace trivariate
{
namespace
{
std::array<Frame, 24> MakeRotations()
{
  std::array<Frame, 24> rotations;
  int n = 0;
  std::array<int, 3> rows = { 0, 1, 2 };
  do
  {
    for (int flips = 0; flips < 8; ++flips)
    {
      Frame r = Frame::Zero();
      for (int a = 0; a < 3; ++a)
      {
        r(a, rows[a]) = (flips >> a) & 1 ? -1.0 : 1.0;
      }
      if (r.determinant() > 0.0)
      {
        rotations[n++] = r;
      }
    }
  } while (std::next_permutation(rows.begin(), rows.end()));
  return rotations;
}

int Nearest(const Frame& r)
{
  const std::array<Frame, 24>& rotations = CubeRotations();
  int best = 0;
  double largest = r.trace();
  for (int i = 1; i < 24; ++i)
  {
    const double trace = rotations[i].cwiseProduct(r).sum();
    if (trace > largest)
    {
      largest = trace;
      best = i;
    }
  }
  return best;
}

std::array<std::array<int, 24>, 24> MakeProducts()
{
  std::array<std::array<int, 24>, 24> products;
  for (int a = 0; a < 24; ++a)
  {
    for (int b = 0; b < 24; ++b)
    {
      products[a][b] = Nearest(CubeRotations()[a] * CubeRotations()[b]);
    }
  }
  return products;
}
}

//------------------------------------------------------------------------------
const std::array<Frame, 24>& CubeRotations()
{
  static const std::array<Frame, 24> rotations = MakeRotations();
  return rotations;
}

//------------------------------------------------------------------------------
int ComposeRotations(int a, int b)
{
  static const std::array<std::array<int, 24>, 24> products = MakeProducts();
  return products[a][b];
}

//------------------------------------------------------------------------------
int MatchFrames(const Frame& from, const Frame& to)
{
  const Frame r = to * from.transpose();
  // Closer than 45 degrees to the identity, no other is closer: the usual case, quickly.
  return r.trace() > 1.0 + std::sqrt(2.0) ? 0 : Nearest(r);
}

//------------------------------------------------------------------------------
double HarmonicDistance(const Frame& from, const Frame& to)
{
  const Frame r = from * to.transpose();
  return 5.0 / 3.0 * (3.0 - r.array().square().square().sum());
}

//------------------------------------------------------------------------------
int PlaquetteRotation(const std::array<Frame, 4>& around)
{
  int product = 0;
  for (int i = 0; i < 4; ++i)
  {
    product = ComposeRotations(MatchFrames(around[i], around[(i + 1) % 4]), product);
  }
  return product;
}
}
