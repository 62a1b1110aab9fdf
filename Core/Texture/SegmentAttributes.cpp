// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "SegmentAttributes.h"

#include "SmoothestWindow.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>

namespace trivariate
{
namespace
{
// k-means sees so many voxels of a large volume; about so many, as each is in or out on its own.
constexpr double SAMPLES = 16384.0;

// Whether a voxel of the volume is sampled: a hash of its index, the same on every process (the
// finaliser of MurmurHash3, A. Appleby).
bool IsSampled(Index key, double share)
{
  std::uint64_t h = static_cast<std::uint64_t>(key) + 0x9e3779b97f4a7c15u;
  h = (h ^ (h >> 33)) * 0xff51afd7ed558ccdu;
  h = (h ^ (h >> 33)) * 0xc4ceb9fe1a85ec53u;
  return static_cast<double>((h ^ (h >> 33)) >> 11) * 0x1p-53 < share;
}

//------------------------------------------------------------------------------
// The mean density of the most uniform 3 x 3 x 3 voxels around each voxel.
std::vector<float> SmoothDensity(
  const std::vector<float>& density, const std::array<Index, 3>& size, const Execution& execution)
{
  std::vector<float> mean(density.size()), variance(density.size());
  execution.ParallelFor(size[2],
    [&](Index begin, Index end)
    {
      std::vector<double> window;
      for (Index id = begin * size[0] * size[1]; id < end * size[0] * size[1]; ++id)
      {
        const Index x = id % size[0], y = id / size[0] % size[1], z = id / (size[0] * size[1]);
        window.clear();
        for (Index k = std::max<Index>(0, z - 1); k <= std::min(size[2] - 1, z + 1); ++k)
        {
          for (Index j = std::max<Index>(0, y - 1); j <= std::min(size[1] - 1, y + 1); ++j)
          {
            const float* row = &density[size[0] * (j + size[1] * k)];
            window.insert(window.end(), row + std::max<Index>(0, x - 1),
              row + std::min(size[0] - 1, x + 1) + 1);
          }
        }
        const double n = static_cast<double>(window.size());
        const double m = std::accumulate(window.begin(), window.end(), 0.0) / n;
        double sum = 0.0;
        for (const double value : window)
        {
          sum += (value - m) * (value - m);
        }
        mean[id] = static_cast<float>(m);
        variance[id] = static_cast<float>(sum / n);
      }
    });
  const std::vector<std::int32_t> least = LeastNearby(variance, size, 1, execution);
  for (std::size_t i = 0; i < density.size(); ++i)
  {
    variance[i] = mean[least[i]];
  }
  return variance;
}

// Central differences; one-sided at the border of the box.
std::vector<float> GradientMagnitude(const SegmentationPiece& piece)
{
  const std::array<Index, 3>& size = piece.Size;
  const std::array<Index, 3> stride = { 1, size[0], size[0] * size[1] };
  std::vector<float> magnitude(piece.Density.size());
  for (Index id = 0; id < static_cast<Index>(magnitude.size()); ++id)
  {
    const std::array<Index, 3> p = { id % size[0], id / stride[1] % size[1], id / stride[2] };
    double sum = 0.0;
    for (int a = 0; a < 3; ++a)
    {
      const Index low = std::max<Index>(0, p[a] - 1), high = std::min(size[a] - 1, p[a] + 1);
      const double difference = static_cast<double>(piece.Density[id + (high - p[a]) * stride[a]]) -
                                piece.Density[id + (low - p[a]) * stride[a]];
      const double slope =
        high > low ? difference / (static_cast<double>(high - low) * piece.Spacing[a]) : 0.0;
      sum += slope * slope;
    }
    magnitude[id] = static_cast<float>(std::sqrt(sum));
  }
  return magnitude;
}

std::vector<float> Cut(const std::vector<float>& field, const std::array<Index, 3>& size,
  const std::array<Index, 3>& first, const std::array<Index, 3>& box)
{
  std::vector<float> part;
  part.reserve(box[0] * box[1] * box[2]);
  for (Index k = 0; k < box[2]; ++k)
  {
    for (Index j = 0; j < box[1]; ++j)
    {
      const float* row = &field[first[0] + size[0] * (first[1] + j + size[1] * (first[2] + k))];
      part.insert(part.end(), row, row + box[0]);
    }
  }
  return part;
}
}

//------------------------------------------------------------------------------
SegmentAttributes::SegmentAttributes(
  const SegmentationPiece& piece, const SegmentationOptions& options, const Execution& execution)
  : Piece(piece)
  , Radius(options.Texture.Radius)
{
  // A window's width around the own voxels: as far as Sample looks; Smooth looks two radii far.
  const Index reach = Lag(options.Texture);
  std::array<Index, 3> end;
  for (int a = 0; a < 3; ++a)
  {
    this->First[a] = std::max<Index>(0, piece.Begin[a] - reach);
    end[a] = std::min(piece.Size[a], piece.End[a] + reach);
    this->Box[a] = std::max<Index>(0, end[a] - this->First[a]);
  }
  const Index count = this->Box[0] * this->Box[1] * this->Box[2];
  if (!options.Texture.Attributes.empty())
  {
    this->FieldNames = TextureOutputNames(options.Texture);
    this->Textures = static_cast<int>(this->FieldNames.size());
  }
  for (int t = 0; t < this->Textures; ++t)
  {
    this->Fields.emplace_back(count);
  }
  if (count > 0 && this->Textures > 0)
  {
    std::vector<float*> out;
    for (std::vector<float>& field : this->Fields)
    {
      out.push_back(field.data());
    }
    ComputeTexture(
      piece.Levels.data(), piece.Size, this->First, end, options.Texture, out, execution);
  }
  execution.Check(1.0);
  if (options.DensityWeight > 0.0)
  {
    this->FieldNames.push_back("Density");
    this->OtherWeights.push_back(options.DensityWeight);
    this->Fields.push_back(
      Cut(SmoothDensity(piece.Density, piece.Size, execution), piece.Size, this->First, this->Box));
  }
  execution.Check(1.0);
  if (options.GradientWeight > 0.0)
  {
    this->FieldNames.push_back("GradientMagnitude");
    this->OtherWeights.push_back(options.GradientWeight);
    this->Fields.push_back(Cut(GradientMagnitude(piece), piece.Size, this->First, this->Box));
  }
}

//------------------------------------------------------------------------------
Index SegmentAttributes::OwnToBox(Index i, Index j, Index k) const
{
  return (i + this->Piece.Begin[0] - this->First[0]) +
         this->Box[0] * ((j + this->Piece.Begin[1] - this->First[1]) +
                          this->Box[1] * (k + this->Piece.Begin[2] - this->First[2]));
}

std::vector<std::vector<float>> SegmentAttributes::OwnTexture() const
{
  std::array<Index, 3> first, size;
  for (int a = 0; a < 3; ++a)
  {
    first[a] = this->Piece.Begin[a] - this->First[a];
    size[a] = this->Piece.End[a] - this->Piece.Begin[a];
  }
  std::vector<std::vector<float>> own;
  for (int t = 0; t < this->Textures; ++t)
  {
    own.push_back(Cut(this->Fields[t], this->Box, first, size));
  }
  return own;
}

void SegmentAttributes::Row(Index i, Index j, Index k, double* row) const
{
  const Index id = this->OwnToBox(i, j, k);
  const Index texture = this->Best.empty() ? id : this->Best[id];
  for (int t = 0; t < this->Textures; ++t)
  {
    row[t] = this->Fields[t][texture];
  }
  for (int a = this->Textures; a < this->Count(); ++a)
  {
    row[a] = this->Fields[a][id];
  }
}

//------------------------------------------------------------------------------
AttributeSample SegmentAttributes::Sample(bool withPartners, const GatherBytes& gather) const
{
  const std::array<Index, 3>& whole = this->Piece.Whole;
  const double share = SAMPLES / (static_cast<double>(whole[0]) * static_cast<double>(whole[1]) *
                                   static_cast<double>(whole[2]));
  const int rows = withPartners ? 4 : 1;
  const std::size_t rowBytes = sizeof(double) * rows * this->Count();
  const std::size_t recordBytes = sizeof(Index) + rowBytes;
  std::vector<double> row(rows * this->Count());
  std::vector<std::uint8_t> mine;
  std::array<Index, 3> own;
  for (int a = 0; a < 3; ++a)
  {
    own[a] = this->Piece.End[a] - this->Piece.Begin[a];
  }
  for (Index k = 0; k < own[2]; ++k)
  {
    for (Index j = 0; j < own[1]; ++j)
    {
      for (Index i = 0; i < own[0]; ++i)
      {
        const std::array<Index, 3> p = { i + this->Piece.Begin[0] + this->Piece.Low[0],
          j + this->Piece.Begin[1] + this->Piece.Low[1],
          k + this->Piece.Begin[2] + this->Piece.Low[2] };
        const Index key = p[0] + whole[0] * (p[1] + whole[1] * p[2]);
        if (!IsSampled(key, share))
        {
          continue;
        }
        this->Row(i, j, k, row.data());
        for (int axis = 0; axis + 1 < rows; ++axis)
        {
          const Index lag = 2 * this->Radius + 1;
          double* partner = &row[(axis + 1) * this->Count()];
          if (p[axis] + lag < whole[axis])
          {
            this->Row(i + (axis == 0) * lag, j + (axis == 1) * lag, k + (axis == 2) * lag, partner);
          }
          else
          {
            std::fill_n(partner, this->Count(), std::numeric_limits<double>::quiet_NaN());
          }
        }
        const std::size_t at = mine.size();
        mine.resize(at + recordBytes);
        std::memcpy(&mine[at], &key, sizeof(Index));
        std::memcpy(&mine[at + sizeof(Index)], row.data(), rowBytes);
      }
    }
  }
  // Pieces may share voxels: each counts once.
  const std::vector<std::uint8_t> all = gather(mine);
  std::vector<std::pair<Index, std::size_t>> order; // key, place
  for (std::size_t at = 0; at + recordBytes <= all.size(); at += recordBytes)
  {
    Index key;
    std::memcpy(&key, &all[at], sizeof(Index));
    order.push_back({ key, at + sizeof(Index) });
  }
  std::sort(order.begin(), order.end());
  AttributeSample sample;
  for (const auto& [key, at] : order)
  {
    if (sample.Keys.empty() || sample.Keys.back() != key)
    {
      sample.Keys.push_back(key);
      sample.Rows.resize(sample.Rows.size() + row.size());
      std::memcpy(sample.Rows.data() + sample.Rows.size() - row.size(), &all[at], rowBytes);
    }
  }
  return sample;
}

//------------------------------------------------------------------------------
// The variance of the coordinates in a window, summed over them, is the mean of |z|^2 less |mean of
// z|^2, and the mean of z is the map of the attributes' means.
void SegmentAttributes::Smooth(const FeatureSpace& space, const Execution& execution)
{
  const Index count = this->Box[0] * this->Box[1] * this->Box[2];
  if (this->Textures == 0 || count == 0)
  {
    return;
  }
  // |z|^2 of the texture's part of the row.
  const auto squares = [&](std::vector<float>& out, bool subtract)
  {
    execution.ParallelFor(count,
      [&](Index begin, Index end)
      {
        std::vector<double> row(this->Count()), coordinates(space.Dimensions);
        std::copy(space.Mean.begin(), space.Mean.end(), row.begin());
        for (Index id = begin; id < end; ++id)
        {
          for (int t = 0; t < this->Textures; ++t)
          {
            row[t] = this->Fields[t][id];
          }
          space.Apply(row.data(), coordinates.data());
          double sum = 0.0;
          for (const double c : coordinates)
          {
            sum += c * c;
          }
          out[id] = static_cast<float>(subtract ? out[id] - sum : sum);
        }
      });
  };
  std::vector<float> variance(count);
  squares(variance, false);
  BoxMean(variance, this->Box, this->Radius, execution);
  for (int t = 0; t < this->Textures; ++t)
  {
    execution.Check(static_cast<double>(t) / this->Textures);
    BoxMean(this->Fields[t], this->Box, this->Radius, execution);
  }
  squares(variance, true);
  this->Best = LeastNearby(variance, this->Box, this->Radius, execution);
}
}
