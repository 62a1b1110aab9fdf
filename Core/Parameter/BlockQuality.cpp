// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "BlockQuality.h"

#include "BlockCells.h"
#include "Domain/DomainLayers.h"

#include <algorithm>
#include <numeric>

namespace trivariate
{
CellQuality QualityOf(const BlockMesh& mesh, const Execution& execution)
{
  const BlockCells cells(mesh);
  const std::size_t n = cells.Cells.size();
  std::vector<double> jacobians(n), least(n), volumes(n);
  execution.ParallelFor(static_cast<Index>(n),
    [&](Index begin, Index end)
    {
      for (Index c = begin; c < end; ++c)
      {
        jacobians[c] = ScaledJacobian(mesh.Places, cells.Cells[c]);
        least[c] = LeastDeterminant(mesh.Places, cells.Cells[c]);
        volumes[c] = HexahedronVolume(mesh.Places, cells.Cells[c]);
      }
    });
  std::vector<double> sum(mesh.Sizes.size(), 0.0), count(mesh.Sizes.size(), 0.0);
  for (std::size_t c = 0; c < n; ++c)
  {
    sum[cells.BlockOf[c]] += volumes[c];
    ++count[cells.BlockOf[c]];
  }
  for (std::size_t c = 0; c < n; ++c)
  {
    volumes[c] *= count[cells.BlockOf[c]] / sum[cells.BlockOf[c]];
  }
  std::sort(volumes.begin(), volumes.end());
  CellQuality quality;
  quality.Cells = static_cast<Index>(n);
  quality.InvertedIn.resize(mesh.Sizes.size());
  for (std::size_t c = 0; c < n; ++c)
  {
    quality.InvertedIn[cells.BlockOf[c]] += least[c] > 0.0 ? 0 : 1;
  }
  quality.Inverted =
    std::accumulate(quality.InvertedIn.begin(), quality.InvertedIn.end(), Index(0));
  quality.LeastJacobian = *std::min_element(jacobians.begin(), jacobians.end());
  quality.MeanJacobian = std::accumulate(jacobians.begin(), jacobians.end(), 0.0) / n;
  quality.LowRatio = volumes[n / 100];
  quality.HighRatio = volumes[n - 1 - n / 100];
  return quality;
}
}
