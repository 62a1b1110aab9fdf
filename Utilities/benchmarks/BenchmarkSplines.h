// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// What is measured: the hydrogen orbital 4, 2, 0 and its fits.
#ifndef BenchmarkSplines_h
#define BenchmarkSplines_h

#include "Fit/Fit.h"
#include "HydrogenOrbital.h"

#include <map>
#include <tuple>
#include <vector>

namespace trivariate
{
/// The orbital's density on size^3 voxels.
inline const std::vector<double>& OrbitalVolume(Index size)
{
  static std::map<Index, std::vector<double>> volumes;
  std::vector<double>& volume = volumes[size];
  if (volume.empty())
  {
    const HydrogenOrbital orbital(4, 2, 0);
    const double width = HydrogenOrbital::DefaultHalfWidth(4);
    const auto at = [size, width](Index i) { return width * (2.0 * i / (size - 1) - 1.0); };
    for (Index i = 0; i < size * size * size; ++i)
    {
      volume.push_back(orbital.Density(at(i % size), at(i / size % size), at(i / (size * size))));
    }
  }
  return volume;
}

/// The fit of that volume; made once.
inline const TSpline& OrbitalFit(Index size, Refinement rule, Index controlPoints)
{
  static std::map<std::tuple<Index, Refinement, Index>, TSpline> fits;
  TSpline& spline = fits[{ size, rule, controlPoints }];
  if (spline.Functions.empty())
  {
    GridSamples samples;
    samples.Size = { size, size, size };
    samples.Values = OrbitalVolume(size).data();
    FitOptions options;
    options.Rule = rule;
    options.MaximumControlPoints = controlPoints;
    spline = FitGrid(samples, options).Spline;
  }
  return spline;
}
}

#endif
