// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "SegmentErrors.h"

#include <algorithm>
#include <cmath>

namespace trivariate
{
std::map<int, double> RmsOfSegments(const BlockComplex& blocks, const ScatteredSamples& samples,
  const ScatteredSystem& system, const std::vector<double>& scales)
{
  std::vector<int> segmentOf;
  std::map<int, double> counts, rms;
  for (Index i = 0; i < samples.Count(); ++i)
  {
    const double* p = &samples.Parameters[3 * i];
    segmentOf.push_back(blocks.Segments[blocks.BlockAt({ p[0], p[1], p[2] })]);
    counts[segmentOf.back()] += 1.0;
  }
  for (std::size_t c = 0; c < scales.size(); ++c)
  {
    const std::vector<double> residuals = system.ResidualsOf(static_cast<int>(c));
    std::map<int, double> squares;
    for (std::size_t i = 0; i < residuals.size(); ++i)
    {
      squares[segmentOf[i]] += residuals[i] * residuals[i];
    }
    for (const auto& [segment, sum] : squares)
    {
      rms[segment] = std::max(rms[segment], std::sqrt(sum / counts[segment]) / scales[c]);
    }
  }
  return rms;
}
}
