// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "SmoothestWindow.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace trivariate
{
namespace
{
// Calls f(first, n, stride) for every line of voxels along an axis.
template <typename F>
void ForLines(const std::array<Index, 3>& size, int axis, const Execution& execution, const F& f)
{
  const std::array<Index, 3> stride = { 1, size[0], size[0] * size[1] };
  const int a = axis == 0 ? 1 : 0, b = axis == 2 ? 1 : 2;
  execution.ParallelFor(size[b],
    [&](Index begin, Index end)
    {
      for (Index j = begin; j < end; ++j)
      {
        for (Index i = 0; i < size[a]; ++i)
        {
          f(i * stride[a] + j * stride[b], size[axis], stride[axis]);
        }
      }
    });
}
}

//------------------------------------------------------------------------------
void BoxMean(std::vector<float>& field, const std::array<Index, 3>& size, int radius,
  const Execution& execution)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    ForLines(size, axis, execution,
      [&field, radius](Index first, Index n, Index stride)
      {
        thread_local std::vector<float> line;
        line.resize(n);
        for (Index i = 0; i < n; ++i)
        {
          line[i] = field[first + i * stride];
        }
        for (Index i = 0; i < n; ++i)
        {
          const Index low = std::max<Index>(0, i - radius), high = std::min(n - 1, i + radius);
          const double sum = std::accumulate(&line[low], &line[high] + 1, 0.0);
          field[first + i * stride] = static_cast<float>(sum / static_cast<double>(high - low + 1));
        }
      });
  }
}

//------------------------------------------------------------------------------
std::vector<std::int32_t> LeastNearby(const std::vector<float>& values,
  const std::array<Index, 3>& size, int radius, const Execution& execution)
{
  if (values.size() > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()))
  {
    throw std::length_error("more than 2^31 - 1 voxels");
  }
  std::vector<std::int32_t> least(values.size());
  std::iota(least.begin(), least.end(), 0);
  for (int axis = 0; axis < 3; ++axis)
  {
    ForLines(size, axis, execution,
      [&](Index first, Index n, Index stride)
      {
        thread_local std::vector<std::int32_t> line;
        line.resize(n);
        for (Index i = 0; i < n; ++i)
        {
          line[i] = least[first + i * stride];
        }
        for (Index i = 0; i < n; ++i)
        {
          std::int32_t best = line[i];
          for (Index d = 1; d <= radius; ++d)
          {
            for (const Index j : { i - d, i + d })
            {
              if (j >= 0 && j < n && values[line[j]] < values[best])
              {
                best = line[j];
              }
            }
          }
          least[first + i * stride] = best;
        }
      });
  }
  return least;
}
}
