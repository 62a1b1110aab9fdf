// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// Volumes to fit, and how far a fit is from them by plain sums.
#ifndef trivariate_GridVolumes_h
#define trivariate_GridVolumes_h

#include "Fit/Fit.h"
#include "RandomRefinement.h"

#include <algorithm>
#include <functional>

namespace trivariate
{
/// A volume with one attribute for each function of (u, v, w); further ones can be added.
struct Volume
{
  using Function = std::function<double(const Point&)>;

  std::array<Index, 3> Size;
  std::vector<double> Values;
  std::vector<std::uint8_t> Mask;

  Volume(const std::array<Index, 3>& size, const std::vector<Function>& functions)
    : Size(size)
  {
    for (const Function& f : functions)
    {
      this->Add(f);
    }
  }

  Index Count() const { return this->Size[0] * this->Size[1] * this->Size[2]; }

  Point Voxel(Index i) const
  {
    return { double(i % this->Size[0]), double(i / this->Size[0] % this->Size[1]),
      double(i / this->Size[0] / this->Size[1]) };
  }

  void Add(const Function& f)
  {
    for (Index i = 0; i < this->Count(); ++i)
    {
      this->Values.push_back(f(this->Voxel(i)));
    }
  }

  GridSamples Samples() const
  {
    return { this->Size, static_cast<int>(static_cast<Index>(this->Values.size()) / this->Count()),
      this->Values.data(), this->Mask.empty() ? nullptr : this->Mask.data() };
  }

  /// Counts a ball of random place and size, with some holes in it.
  void CountOnlyABlob(std::mt19937& random)
  {
    Point centre;
    for (int a = 0; a < 3; ++a)
    {
      centre[a] = Random(random, 0.3, 0.7) * static_cast<double>(this->Size[a] - 1);
    }
    const double radius = Random(random, 0.25, 0.4) * static_cast<double>(this->Size[0]);
    this->Mask.resize(this->Count());
    for (Index i = 0; i < this->Count(); ++i)
    {
      const Point x = this->Voxel(i);
      const double r = std::hypot(x[0] - centre[0], x[1] - centre[1], x[2] - centre[2]);
      this->Mask[i] = r < radius && random() % 20 != 0 ? 1 + random() % 255 : 0;
    }
  }
};

/// Values of one component of a spline at all voxels, in the volume's order, from eq. (9).
inline std::vector<double> ValuesAtVoxels(
  const TSpline& spline, int component, const std::array<Index, 3>& size)
{
  std::vector<double> numerator(size[0] * size[1] * size[2], 0.0), denominator = numerator;
  for (Index i = 0; i < spline.Size(); ++i)
  {
    std::array<std::vector<double>, 3> b;
    std::array<Index, 3> first;
    for (int a = 0; a < 3; ++a)
    {
      const Knots5 t = spline.LocalKnotValues(i, a);
      first[a] = static_cast<Index>(std::ceil(t[0]));
      for (Index x = first[a]; x <= std::min<Index>(static_cast<Index>(t[4]), size[a] - 1); ++x)
      {
        b[a].push_back(EvaluateBSpline(t, static_cast<double>(x))[0]);
      }
    }
    const double value = spline.ControlPoint(i)[component];
    for (std::size_t z = 0; z < b[2].size(); ++z)
    {
      for (std::size_t y = 0; y < b[1].size(); ++y)
      {
        const double factor = spline.Weights[i] * b[2][z] * b[1][y];
        const std::size_t row = ((first[2] + z) * size[1] + first[1] + y) * size[0] + first[0];
        for (std::size_t x = 0; x < b[0].size(); ++x)
        {
          numerator[row + x] += factor * b[0][x] * value;
          denominator[row + x] += factor * b[0][x];
        }
      }
    }
  }
  for (std::size_t i = 0; i < numerator.size(); ++i)
  {
    numerator[i] /= denominator[i];
  }
  return numerator;
}

/// Of one attribute over the voxels that count, as shares of its range over them (of its size where
/// it is constant).
struct VoxelError
{
  double Rms, Maximum;
};

inline VoxelError ErrorAtVoxels(const TSpline& spline, const Volume& volume, int attribute = 0,
  const std::vector<std::uint8_t>* mask = nullptr)
{
  mask = mask ? mask : &volume.Mask;
  const std::vector<double> fitted = ValuesAtVoxels(spline, 3 + attribute, volume.Size);
  const double* samples = &volume.Values[attribute * volume.Count()];
  double sum = 0.0, maximum = 0.0, low = 1e300, high = -1e300;
  Index voxels = 0;
  for (Index i = 0; i < volume.Count(); ++i)
  {
    if (mask->empty() || (*mask)[i])
    {
      const double error = std::abs(fitted[i] - samples[i]);
      sum += error * error;
      maximum = std::max(maximum, error);
      low = std::min(low, samples[i]);
      high = std::max(high, samples[i]);
      ++voxels;
    }
  }
  const double range = high > low ? high - low : low != 0.0 ? std::abs(low) : 1.0;
  return { std::sqrt(sum / static_cast<double>(voxels)) / range, maximum / range };
}

/// Uniform in [0, 1], the same on every machine.
inline Volume::Function Noise(unsigned seed)
{
  return [random = std::mt19937(seed)](const Point&) mutable
  { return static_cast<double>(random()) / 4294967295.0; };
}

/// A smooth shell around a point, with a ripple: needs fine functions in some places only.
inline Volume::Function Shell(const std::array<Index, 3>& size)
{
  return [size](const Point& x)
  {
    Point s;
    for (int a = 0; a < 3; ++a)
    {
      s[a] = x[a] / static_cast<double>(std::max<Index>(1, size[a] - 1));
    }
    const double r = std::hypot(s[0] - 0.4, s[1] - 0.55, s[2] - 0.45);
    return std::exp(-200.0 * (r - 0.3) * (r - 0.3)) + 0.1 * std::sin(4.0 * s[0]) * s[1];
  };
}
}

#endif
