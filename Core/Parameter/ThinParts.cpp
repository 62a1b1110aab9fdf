// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ThinParts.h"

#include <algorithm>

namespace trivariate
{
namespace
{
using Voxel = std::array<Index, 3>;

// The voxels of a ball of diameter 4 around the corner between voxels -1 and 0: those whose middles
// are nearer than 2.
std::vector<Voxel> BallAroundCorner()
{
  std::vector<Voxel> ball;
  for (Index k = -2; k < 2; ++k)
  {
    for (Index j = -2; j < 2; ++j)
    {
      for (Index i = -2; i < 2; ++i)
      {
        const double x = i + 0.5, y = j + 0.5, z = k + 0.5;
        if (x * x + y * y + z * z < 4.0)
        {
          ball.push_back({ i, j, k });
        }
      }
    }
  }
  return ball;
}
}

//------------------------------------------------------------------------------
double ThinShare(const std::vector<std::uint8_t>& mask, const std::array<Index, 3>& size,
  const Execution& execution)
{
  const std::vector<Voxel> ball = BallAroundCorner();
  const auto isIn = [&size](Index i, Index j, Index k)
  { return i >= 0 && j >= 0 && k >= 0 && i < size[0] && j < size[1] && k < size[2]; };
  const auto at = [&size](Index i, Index j, Index k) { return i + size[0] * (j + size[1] * k); };
  std::vector<std::uint8_t> reached(mask.size(), 0);
  for (Index k = 0; k < size[2]; ++k)
  {
    execution.Check(double(k) / static_cast<double>(2 * size[2]));
    for (Index j = 0; j < size[1]; ++j)
    {
      for (Index i = 0; i < size[0]; ++i)
      {
        const auto isInside = [&](const Voxel& v)
        {
          const Index x = i + v[0], y = j + v[1], z = k + v[2];
          return isIn(x, y, z) && mask[at(x, y, z)] != 0;
        };
        if (mask[at(i, j, k)] != 0 && std::all_of(ball.begin(), ball.end(), isInside))
        {
          for (const Voxel& v : ball)
          {
            reached[at(i + v[0], j + v[1], k + v[2])] = 1;
          }
        }
      }
    }
  }
  Index all = 0, thin = 0;
  for (Index k = 0; k < size[2]; ++k)
  {
    execution.Check(0.5 + double(k) / static_cast<double>(2 * size[2]));
    for (Index j = 0; j < size[1]; ++j)
    {
      for (Index i = 0; i < size[0]; ++i)
      {
        if (mask[at(i, j, k)] == 0)
        {
          continue;
        }
        bool isNear = false;
        for (int n = 0; n < 27 && !isNear; ++n)
        {
          const Index x = i + n % 3 - 1, y = j + n / 3 % 3 - 1, z = k + n / 9 - 1;
          isNear = isIn(x, y, z) && reached[at(x, y, z)] != 0;
        }
        ++all;
        thin += isNear ? 0 : 1;
      }
    }
  }
  return all > 0 ? static_cast<double>(thin) / static_cast<double>(all) : 0.0;
}
}
