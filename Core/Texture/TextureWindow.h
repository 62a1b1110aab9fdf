// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Texture attributes of every voxel of a volume, from the (2 r + 1)^3 voxels around it.
 *
 * The window of a voxel is cut at the border of the volume; a pair of neighbours counts if both lie
 * in the window. The window slides along x: a face of pairs comes, a face goes. All that is kept
 * while it slides is integers, so the numbers depend neither on where a sweep began nor on threads.
 *
 * Cost: per voxel and direction O(r^2 + G^2 / 32), with small constants; some 0.2 microseconds for
 * r = 2 and G = 16, and f14 another 12. Working memory: less than a megabyte a thread, and tables
 * of 4 G^2 (G + 13) bytes (20 kB for G = 16, 70 MB for G = 256); nothing per voxel beside the
 * levels and the output.
 */
#ifndef trivariate_TextureWindow_h
#define trivariate_TextureWindow_h

#include "Execution.h"
#include "TextureAttributes.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace trivariate
{
struct TextureOptions
{
  int Radius = 2;      ///< r, 1 to MaximumTextureRadius(options)
  int GreyLevels = 16; ///< G, 1 to MaximumGreyLevels
  std::vector<TextureAttribute> Attributes = DefaultTextureAttributes();
  /// Of one matrix summed over the directions; otherwise the mean of the directions' attributes.
  bool Merged = false;
  /// Also the largest less the smallest of the directions' attributes.
  bool Range = false;
  /**
   * Also how the attributes depend on the direction: the tensor XX, YY, ZZ, XY, YZ, XZ of an
   * attribute a, by which a texture differs from the same texture rotated.
   *
   * Over the directions e (unit vectors), XX is the mean of a weighted by e_x^2 less the plain mean
   * (how much larger a is along x), XY the sum of a e_x e_y divided by that of |e_x e_y| (how much
   * larger a is along the diagonals x = y than along x = -y). Six numbers instead of the 13 that
   * they are made of: less memory, and averages instead of single directions' noise. Layers,
   * fibres and grains are told apart by it however they lie, all but textures that are alike along
   * three perpendicular axes (a cubic lattice, as its tensor is zero).
   */
  bool DirectionResolved = false;
};

/// 15 where the directions are looked at one by one, 6 if merged: the counts have 16 bits.
int MaximumTextureRadius(const TextureOptions& options);

/**
 * The arrays that ComputeTexture writes: the attributes' names, then (Range) these with "Range"
 * appended, then (DirectionResolved) for each attribute its name with XX, YY, ZZ, XY, YZ, XZ.
 */
std::vector<std::string> TextureOutputNames(const TextureOptions& options);

/**
 * levels: below GreyLevels, x fastest, of the box `size`; attributes are computed for its voxels in
 * [begin, end). out: one array an output, each of the voxels [begin, end), x fastest, in [0, 1]: an
 * attribute and its range in parts of the distance between its bounds for G levels, an entry of the
 * tensor 0.5 + (half of it in parts of its bound). Directions without any pair (along an axis that
 * has one voxel only) are left out; without any direction, the values are those of one level.
 *
 * Real is float or double. Throws std::invalid_argument for options or levels out of range;
 * Aborted.
 */
template <typename Real>
void ComputeTexture(const std::uint8_t* levels, const std::array<Index, 3>& size,
  const std::array<Index, 3>& begin, const std::array<Index, 3>& end, const TextureOptions& options,
  const std::vector<Real*>& out, const Execution& execution = {});
}

#endif
