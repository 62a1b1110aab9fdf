// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "PointShares.h"

#include <cmath>

namespace trivariate
{
namespace
{
constexpr double ShareByVoxels = 0.1;
}

//------------------------------------------------------------------------------
std::vector<double> PointShares(const std::array<Index, 3>& size, const double* values,
  const std::vector<std::int32_t>& parts, int count, const Execution& execution)
{
  const std::array<Index, 3> step = { 1, size[0], size[0] * size[1] };
  std::vector<double> content(count, 0.0), voxels(count, 0.0);
  double allContent = 0.0;
  for (Index k = 0; k < size[2]; ++k)
  {
    execution.Check(1.0 * k / size[2]);
    for (Index j = 0; j < size[1]; ++j)
    {
      for (Index i = 0; i < size[0]; ++i)
      {
        const std::array<Index, 3> at = { i, j, k };
        const Index v = i + step[1] * j + step[2] * k;
        const std::int32_t part = parts[v];
        voxels[part] += 1.0;
        for (int a = 0; a < 3; ++a)
        {
          const bool inner = at[a] > 0 && at[a] + 1 < size[a];
          if (inner && parts[v - step[a]] == part && parts[v + step[a]] == part)
          {
            const double bend =
              std::abs(values[v] - 0.5 * (values[v - step[a]] + values[v + step[a]]));
            content[part] += bend;
            allContent += bend;
          }
        }
      }
    }
  }
  const double byVoxels = allContent > 0.0 ? ShareByVoxels : 1.0;
  const double total = static_cast<double>(parts.size());
  std::vector<double> shares;
  for (int part = 0; part < count; ++part)
  {
    const double byContent = allContent > 0.0 ? content[part] / allContent : 0.0;
    shares.push_back((1.0 - byVoxels) * byContent + byVoxels * voxels[part] / total);
  }
  return shares;
}
}
