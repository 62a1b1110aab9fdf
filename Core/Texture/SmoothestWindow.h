// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Smoothing that keeps edges: every voxel takes the mean of the most uniform window around it.
 *
 * Of all windows of (2 r + 1)^3 voxels that contain a voxel, the one in which the values vary least
 * lies on the voxel's own side of an interface; the window that straddles the interface is never
 * taken where another can be. So neither noise nor mixtures are left. After M. Kuwahara et al.,
 * Processing of RI-angiocardiographic images (1976), and M. Nagao, T. Matsuyama, Edge preserving
 * smoothing (1979).
 */
#ifndef trivariate_SmoothestWindow_h
#define trivariate_SmoothestWindow_h

#include "Execution.h"

#include <array>
#include <cstdint>
#include <vector>

namespace trivariate
{
/// field becomes its mean over the window of `radius` around each voxel, cut at the border; x runs
/// fastest. Sums are taken in the same order wherever the box lies in a volume.
void BoxMean(std::vector<float>& field, const std::array<Index, 3>& size, int radius,
  const Execution& execution);

/// For each voxel the one with the least value at most `radius` away along each axis: its index in
/// the box. Of equal ones the nearest, roughly. Throws std::length_error for 2^31 voxels or more.
std::vector<std::int32_t> LeastNearby(const std::vector<float>& values,
  const std::array<Index, 3>& size, int radius, const Execution& execution);
}

#endif
