// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// The errors of a fit over blocks in each segment.
#ifndef trivariate_SegmentErrors_h
#define trivariate_SegmentErrors_h

#include "ScatteredSystem.h"

#include <map>
#include <vector>

namespace trivariate
{
/// The root mean square of the residuals in parts of `scales` over the samples in the blocks of
/// each segment; of several components the worst.
std::map<int, double> RmsOfSegments(const BlockComplex& blocks, const ScatteredSamples& samples,
  const ScatteredSystem& system, const std::vector<double>& scales);
}

#endif
