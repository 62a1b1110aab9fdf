// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// The attributes by which the voxels of a piece are clustered, before and after smoothing.
#ifndef trivariate_SegmentAttributes_h
#define trivariate_SegmentAttributes_h

#include "FeatureSpace.h"
#include "TextureSegmentation.h"

namespace trivariate
{
/// Rows of the sampled voxels of the whole volume, the same on every process.
struct AttributeSample
{
  std::vector<Index> Keys;  ///< index of the voxel in the volume, ascending
  std::vector<double> Rows; ///< one row of attributes a key
};

class SegmentAttributes
{
public:
  /// Computes all attributes of the piece's own voxels and of some around them.
  SegmentAttributes(
    const SegmentationPiece& piece, const SegmentationOptions& options, const Execution& execution);

  int Count() const { return static_cast<int>(this->Fields.size()); }
  const std::vector<std::string>& Names() const { return this->FieldNames; }
  /// Weights of the last attributes, those that are no texture.
  const std::vector<double>& Weights() const { return this->OtherWeights; }

  /// Texture attributes of the own voxels, as they are before Smooth.
  std::vector<std::vector<float>> OwnTexture() const;

  /// The sampled voxels' rows; each followed by those of the voxels a window farther along x, y, z
  /// (NaN outside the volume) if wanted.
  AttributeSample Sample(bool withPartners, const GatherBytes& gather) const;

  /// Every voxel takes the mean texture of the most uniform windows around it.
  void Smooth(const FeatureSpace& space, const Execution& execution);

  /// Row of the own voxel (i, j, k), counted from the first.
  void Row(Index i, Index j, Index k, double* row) const;

  /// Distance of the partners of a sample: a window's width. It is odd, so that layers one voxel
  /// thick, which every second window sees alike, show as the noise that they are.
  static int Lag(const TextureOptions& options) { return 2 * options.Radius + 1; }

private:
  Index OwnToBox(Index i, Index j, Index k) const;

  const SegmentationPiece& Piece;
  std::array<Index, 3> First, Box; // of the voxels with attributes, counted from the piece's first
  int Radius;
  int Textures = 0;
  std::vector<std::string> FieldNames;
  std::vector<double> OtherWeights;
  std::vector<std::vector<float>> Fields;
  std::vector<std::int32_t> Best; // whose mean texture a voxel takes; empty before Smooth
};
}

#endif
