// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// Labelled volumes for tests of the surfaces between segments.
#ifndef trivariate_SegmentVolumes_h
#define trivariate_SegmentVolumes_h

#include "Boundary/BoundaryNet.h"

#include <array>
#include <cmath>
#include <functional>
#include <random>
#include <vector>

namespace trivariate
{
struct SegmentVolume
{
  std::array<Index, 3> Size;
  std::vector<std::int32_t> Labels;
  std::vector<float> Density;

  LabelVolume View() const { return { this->Labels.data(), this->Size }; }
};

/// Labels by a function of the voxel's centre.
inline SegmentVolume MakeVolume(
  const std::array<Index, 3>& size, const std::function<int(double, double, double)>& label)
{
  SegmentVolume volume = { size, {}, {} };
  for (Index k = 0; k < size[2]; ++k)
  {
    for (Index j = 0; j < size[1]; ++j)
    {
      for (Index i = 0; i < size[0]; ++i)
      {
        volume.Labels.push_back(label(i, j, k));
      }
    }
  }
  return volume;
}

/// Noise: the worst labels there are.
inline SegmentVolume RandomVolume(const std::array<Index, 3>& size, int labels, unsigned seed)
{
  std::mt19937 random(seed);
  return MakeVolume(size, [&](double, double, double) { return random() % labels; });
}

/// Label 1 in a ball around `centre`, density its share of every voxel (by 1000 points).
inline SegmentVolume BallVolume(
  const std::array<Index, 3>& size, const std::array<double, 3>& centre, double radius)
{
  const auto distance = [&](double x, double y, double z)
  { return std::hypot(x - centre[0], y - centre[1], z - centre[2]); };
  SegmentVolume volume =
    MakeVolume(size, [&](double x, double y, double z) { return distance(x, y, z) < radius; });
  for (Index id = 0; id < static_cast<Index>(volume.Labels.size()); ++id)
  {
    const double i = id % size[0], j = id / size[0] % size[1], k = id / (size[0] * size[1]);
    int inside = distance(i, j, k) < radius ? 1000 : 0;
    if (std::abs(distance(i, j, k) - radius) < 1.0)
    {
      inside = 0;
      for (int n = 0; n < 1000; ++n)
      {
        inside += distance(i + (n % 10 - 4.5) / 10, j + (n / 10 % 10 - 4.5) / 10,
                    k + (n / 100 - 4.5) / 10) < radius;
      }
    }
    volume.Density.push_back(inside / 1000.0f);
  }
  return volume;
}
}

#endif
