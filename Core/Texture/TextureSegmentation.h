// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * A volume as segments of one texture and density each.
 *
 * 1. Texture attributes of every voxel's window, and the density as attributes.
 * 2. A sample of the voxels tells how much the attributes scatter within a region (FeatureSpace).
 * 3. Every voxel takes the mean attributes of the most uniform windows around it
 *    (SmoothestWindow), which lie on its own side of an interface.
 * 4. k-means on the sample, then every voxel to the nearest centre (KMeans).
 * 5. Shells are removed (SegmentShells), interfaces placed (InterfacePlacement), small components
 *    merged (LabelComponents). When that leaves fewer segments than were asked for, steps 2 to 5
 *    once more with the voxels that are well inside the segments so far.
 * 6. Segments are numbered by ascending mean density.
 *
 * Several processes can share the volume. Each holds a box of it with some neighbourhood; samples
 * and labels are gathered on all, so that the result depends neither on them nor on threads.
 */
#ifndef trivariate_TextureSegmentation_h
#define trivariate_TextureSegmentation_h

#include "LabelComponents.h"
#include "TextureWindow.h"

#include <cstring>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace trivariate
{
struct SegmentationOptions
{
  int Segments = 0;             ///< 1 to MaximumSegments; 0 chooses 2 to MaximumAutomaticSegments
  TextureOptions Texture;       ///< without attributes: density and gradient only
  double DensityWeight = 6.0;   ///< against all texture attributes together; 0 leaves it out
  double GradientWeight = 0.0;  ///< of the magnitude of the density's gradient, likewise
  Index MinimumSegmentSize = 0; ///< voxels of a connected part; 0 is the window's (2 r + 1)^3
  bool KeepAttributes = false;
};

constexpr int MaximumSegments = 64;
constexpr int MaximumAutomaticSegments = 8;

/// How many voxels around its own ones a process has to hold.
int SegmentationNeighbourhood(const SegmentationOptions& options);

/// The part of a volume that one process holds, x fastest.
struct SegmentationPiece
{
  std::array<Index, 3> Whole = {};           ///< voxels of the whole volume
  std::array<Index, 3> Low = {};             ///< index in the volume of the first voxel held
  std::array<Index, 3> Size = {};            ///< voxels held
  std::array<Index, 3> Begin = {}, End = {}; ///< its own voxels, counted from Low; half open
  std::array<double, 3> Spacing = { 1.0, 1.0, 1.0 };
  int Process = 0; ///< place of this piece among those that are gathered; own voxels may be shared
  std::vector<float> Density;       ///< finite
  std::vector<std::uint8_t> Levels; ///< below Texture.GreyLevels
};

/// Bytes of all processes, one after the other in the same order on all.
using GatherBytes = std::function<std::vector<std::uint8_t>(const std::vector<std::uint8_t>& mine)>;

/// The same for plain values of any type.
template <typename T>
std::vector<T> GatherAll(const GatherBytes& gather, const std::vector<T>& mine)
{
  std::vector<std::uint8_t> bytes(mine.size() * sizeof(T));
  std::memcpy(bytes.data(), mine.data(), bytes.size());
  bytes = gather(bytes);
  std::vector<T> all(bytes.size() / sizeof(T));
  std::memcpy(all.data(), bytes.data(), all.size() * sizeof(T));
  return all;
}

struct SegmentationResult
{
  int Segments = 0;          ///< fewer than asked for when there are not so many
  std::vector<Label> Labels; ///< of the piece's own voxels
  std::vector<std::string> AttributeNames;
  /// Mean attributes of each segment, one row a segment, in [0, 1] as they are; then, where they
  /// have a weight, the density and the magnitude of its gradient.
  std::vector<double> Centres;
  std::vector<Index> Sizes;          ///< voxels of each segment
  std::vector<double> MeanDensities; ///< of each segment, ascending
  /// Numbers of segments tried, with the simplified silhouette of each (KMeans.h).
  std::vector<std::pair<int, double>> Criterion;
  std::vector<std::vector<float>> Attributes; ///< of the texture, if kept; of the own voxels
};

/**
 * Throws std::invalid_argument, std::length_error (2^31 voxels or more) and Aborted.
 * Cost: that of ComputeTexture, then some 100 operations a voxel and attribute. Memory: 4 bytes a
 * voxel and attribute (8 if kept) and 40 bytes a voxel held, 25 bytes a voxel of the whole volume,
 * 8 bytes a segment for each voxel near an interface.
 */
SegmentationResult SegmentByTexture(const SegmentationPiece& piece,
  const SegmentationOptions& options, const GatherBytes& gather, const Execution& execution);
}

#endif
