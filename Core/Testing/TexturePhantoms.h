// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// Volumes of known materials, and how near a segmentation comes to them.
#ifndef trivariate_TexturePhantoms_h
#define trivariate_TexturePhantoms_h

#include "Texture/TextureSegmentation.h"

#include "Texture/GreyLevels.h"
#include "Texture/KMeans.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <vector>

namespace trivariate
{
using Size3 = std::array<Index, 3>;
using Floats = std::vector<float>;

inline Floats WhiteNoise(Index count, unsigned seed)
{
  std::mt19937 random(seed);
  std::normal_distribution<float> normal;
  Floats noise(count);
  std::generate(noise.begin(), noise.end(), [&]() { return normal(random); });
  return noise;
}

template <typename F>
void ForVoxels(const Size3& size, const F& f)
{
  Index id = 0;
  for (Index z = 0; z < size[2]; ++z)
  {
    for (Index y = 0; y < size[1]; ++y)
    {
      for (Index x = 0; x < size[0]; ++x, ++id)
      {
        f(id, Size3{ x, y, z });
      }
    }
  }
}

/// Noise summed over `widths` voxels along each axis, of mean 0 and variance 1: normally
/// distributed with the correlation 1 - d / width at the distance d. Widths 1 and 2 have the same
/// distribution of central differences, as values two voxels apart are independent in both.
inline Floats Noise(const Size3& size, const Size3& widths, unsigned seed)
{
  Floats field = WhiteNoise(size[0] * size[1] * size[2], seed);
  Index stride = 1;
  for (int a = 0; a < 3; ++a)
  {
    Floats sum(field.size());
    ForVoxels(size,
      [&](Index id, const Size3& p)
      {
        for (Index d = 0; d < widths[a]; ++d)
        {
          sum[id] += field[id + ((p[a] + d) % size[a] - p[a]) * stride];
        }
        sum[id] /= std::sqrt(static_cast<float>(widths[a]));
      });
    field.swap(sum);
    stride *= size[a];
  }
  return field;
}

/// A texture of mean 0 and variance near 1. "checkered", "columns" and "layered" (with an axis)
/// have all central differences 0 but for noise.
inline Floats Texture(const std::string& kind, const Size3& size, unsigned seed)
{
  if (kind == "fine noise")
  {
    return Noise(size, { 1, 1, 1 }, seed);
  }
  if (kind == "coarse noise" || kind == "grain")
  {
    return Noise(size, { 2, 2, 2 }, seed);
  }
  if (kind == "fibre z")
  {
    return Noise(size, { 2, 2, 8 }, seed);
  }
  Floats field = WhiteNoise(size[0] * size[1] * size[2], seed);
  ForVoxels(size,
    [&](Index id, const Size3& p)
    {
      const Index parity = kind == "checkered"   ? p[0] + p[1] + p[2]
                           : kind == "columns"   ? p[0] + p[1]
                           : kind == "layered x" ? p[0]
                                                 : p[2];
      field[id] = 0.2f * field[id] + (parity % 2 ? 1.0f : -1.0f);
    });
  return field;
}

struct Material
{
  double Mean;
  std::string Kind = ""; ///< of its texture; none: constant
};

struct Phantom
{
  Size3 Size;
  Floats Density;
  std::vector<int> Truth;
};

using Region = std::function<int(double x, double y, double z)>; ///< of -1 .. 1, skew to the grid

inline Phantom MakePhantom(Index n, const Region& region, const std::vector<Material>& materials,
  double noise, unsigned seed)
{
  Phantom phantom = { { n, n, n }, WhiteNoise(n * n * n, 1000 + seed),
    std::vector<int>(n * n * n) };
  std::vector<Floats> textures;
  for (std::size_t m = 0; m < materials.size(); ++m)
  {
    textures.push_back(materials[m].Kind.empty()
                         ? Floats(phantom.Density.size(), 0.0f)
                         : Texture(materials[m].Kind, phantom.Size, 100 * seed + m));
  }
  const double half = 0.5 * static_cast<double>(n);
  ForVoxels(phantom.Size,
    [&](Index id, const Size3& p)
    {
      const int m =
        region((p[0] - half + 0.8) / half, (p[1] - half + 0.3) / half, (p[2] - half + 0.6) / half);
      phantom.Truth[id] = m;
      phantom.Density[id] =
        static_cast<float>(materials[m].Mean + textures[m][id] + noise * phantom.Density[id]);
    });
  return phantom;
}

inline int Ball(double x, double y, double z)
{
  return x * x + y * y + z * z < 0.62 * 0.62;
}

inline int BoxRegion(double x, double y, double z)
{
  return std::abs(x) < 0.55 && std::abs(y) < 0.45 && std::abs(z) < 0.6;
}

/// Three materials that meet along a line.
inline int Three(double x, double y, double z)
{
  return x > 0.2 ? 2 : (y + 0.4 * z > 0.0 ? 1 : 0);
}

//------------------------------------------------------------------------------
inline SegmentationPiece WholePiece(const Phantom& phantom, int greyLevels)
{
  SegmentationPiece piece;
  piece.Whole = piece.Size = piece.End = phantom.Size;
  piece.Density = phantom.Density;
  const Index n = static_cast<Index>(phantom.Density.size());
  ValueRange range;
  range.Add(phantom.Density.data(), n);
  ValueHistogram histogram(range);
  histogram.Add(phantom.Density.data(), n);
  piece.Levels.resize(n);
  Discretise(
    phantom.Density.data(), n, AutomaticGreyLevels(histogram, greyLevels), piece.Levels.data());
  return piece;
}

inline std::vector<std::uint8_t> OneProcess(const std::vector<std::uint8_t>& mine)
{
  return mine;
}

inline SegmentationResult Segment(const Phantom& phantom, const SegmentationOptions& options)
{
  return SegmentByTexture(
    WholePiece(phantom, options.Texture.GreyLevels), options, OneProcess, Execution());
}

//------------------------------------------------------------------------------
/// L. Hubert, P. Arabie. Comparing partitions. J. Classification 2, 1985: 1 for equal partitions, 0
/// on average for independent ones.
template <typename A, typename B>
double AdjustedRandIndex(const std::vector<A>& a, const std::vector<B>& b)
{
  std::vector<double> both(256 * 256, 0.0), first(256, 0.0), second(256, 0.0);
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    both[256 * static_cast<int>(a[i]) + static_cast<int>(b[i])] += 1.0;
    first[static_cast<int>(a[i])] += 1.0;
    second[static_cast<int>(b[i])] += 1.0;
  }
  const auto pairs = [](const std::vector<double>& counts)
  {
    double sum = 0.0;
    for (const double n : counts)
    {
      sum += 0.5 * n * (n - 1.0);
    }
    return sum;
  };
  const double n = static_cast<double>(a.size());
  const double x = pairs(first), y = pairs(second), expected = x * y / (0.5 * n * (n - 1.0));
  return (pairs(both) - expected) / (0.5 * (x + y) - expected);
}

/// Of k-means on one number a voxel, what segmentation without texture can do at best.
inline double RandIndexOfKMeans(const Phantom& phantom, const Floats& values, int clusters)
{
  const std::vector<double> points(values.begin(), values.end());
  const PointRows rows = { static_cast<Index>(points.size()), 1, points.data() };
  const KMeansResult result = KMeans(rows, clusters, { 2, 50, 1 }, Execution());
  std::vector<int> labels;
  for (const double& point : points)
  {
    labels.push_back(NearestCentre(&point, 1, result.Centres));
  }
  return AdjustedRandIndex(phantom.Truth, labels);
}

inline Floats CentralGradients(const Phantom& phantom)
{
  Floats magnitude(phantom.Density.size());
  ForVoxels(phantom.Size,
    [&](Index id, const Size3& p)
    {
      double sum = 0.0;
      Index stride = 1;
      for (int a = 0; a < 3; ++a)
      {
        if (p[a] > 0 && p[a] + 1 < phantom.Size[a])
        {
          sum += std::pow(0.5 * (phantom.Density[id + stride] - phantom.Density[id - stride]), 2);
        }
        stride *= phantom.Size[a];
      }
      magnitude[id] = static_cast<float>(std::sqrt(sum));
    });
  return magnitude;
}

//------------------------------------------------------------------------------
/// Distances, in voxels, of the faces between labels from the nearest such faces of other labels.
struct InterfaceDistance
{
  double Mean, Percentile95, Maximum;
};

template <typename A, typename B>
InterfaceDistance DistanceOfInterfaces(
  const std::vector<A>& from, const std::vector<B>& to, const Size3& size)
{
  constexpr Index REACH = 6;
  const std::array<Index, 3> stride = { 1, size[0], size[0] * size[1] };
  std::vector<double> distances;
  ForVoxels(size,
    [&](Index id, const Size3& p)
    {
      for (int a = 0; a < 3; ++a)
      {
        if (p[a] + 1 >= size[a] || from[id] == from[id + stride[a]])
        {
          continue;
        }
        double least = REACH * REACH;
        Size3 q;
        for (q[2] = std::max<Index>(0, p[2] - REACH); q[2] < std::min(size[2], p[2] + REACH);
             ++q[2])
        {
          for (q[1] = std::max<Index>(0, p[1] - REACH); q[1] < std::min(size[1], p[1] + REACH);
               ++q[1])
          {
            for (q[0] = std::max<Index>(0, p[0] - REACH); q[0] < std::min(size[0], p[0] + REACH);
                 ++q[0])
            {
              const Index other = q[0] + stride[1] * q[1] + stride[2] * q[2];
              for (int b = 0; b < 3; ++b)
              {
                if (q[b] + 1 < size[b] && to[other] != to[other + stride[b]])
                {
                  double sum = 0.0;
                  for (int c = 0; c < 3; ++c)
                  {
                    sum += std::pow(p[c] + 0.5 * (c == a) - q[c] - 0.5 * (c == b), 2);
                  }
                  least = std::min(least, sum);
                }
              }
            }
          }
        }
        distances.push_back(std::sqrt(least));
      }
    });
  if (distances.empty())
  {
    return { 1e9, 1e9, 1e9 };
  }
  std::sort(distances.begin(), distances.end());
  double sum = 0.0;
  for (const double d : distances)
  {
    sum += d;
  }
  return { sum / distances.size(), distances[distances.size() * 95 / 100], distances.back() };
}
}

#endif
