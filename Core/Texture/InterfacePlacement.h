// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Where segments meet, to the voxel.
 *
 * A window tells which texture there is, but not to the voxel where it ends. Single voxels do: how
 * probable a voxel's grey level is in a segment, and how probable next to the levels of its 26
 * neighbours, is counted in each segment where it is certain, and every voxel near an interface is
 * decided anew. With p_l(i) the share of level i in segment l, and
 *
 *   I_l,e(i, j) = log(p_l,e(i, j) / (p_l(i) p_l(j)))
 *
 * the information that level i has about level j one step e away, the probability q_l(v) that voxel
 * v belongs to l is the fixed point of
 *
 *   q_l(v) ~ exp(log p_l(g(v)) + sum over neighbours u of q_l(u) (I_l,u-v(g(v), g(u)) + beta)),
 *
 * the mean field of a Markov random field: a neighbour gives evidence for a segment only as far as
 * it belongs to it, so that nothing is ever measured across an interface; beta makes interfaces
 * smooth. I is bounded, and the least of all segments' is subtracted from it. Voxels farther than
 * `Reach` from an interface keep their labels.
 */
#ifndef trivariate_InterfacePlacement_h
#define trivariate_InterfacePlacement_h

#include "Execution.h"
#include "LabelComponents.h"

#include <array>
#include <cstdint>
#include <vector>

namespace trivariate
{
struct PlacementOptions
{
  int GreyLevels = 16;
  int Reach = 2;           ///< how far, in voxels, an interface may move
  double Smoothness = 0.2; ///< beta
  int Iterations = 24;
};

/**
 * Moves the interfaces between labels 0 .. segments - 1 of a volume; levels are below GreyLevels, x
 * runs fastest. The result does not depend on the threads.
 * Cost: iterations x segments x 26 for each voxel near an interface; 9 bytes a voxel and 8 bytes x
 * segments for each voxel near an interface; 160 bytes x segments x GreyLevels^2.
 */
void PlaceInterfaces(std::vector<Label>& labels, const std::vector<std::uint8_t>& levels,
  const std::array<Index, 3>& size, int segments, const PlacementOptions& options,
  const Execution& execution);

/// 1 for voxels at most `reach` voxels (along each axis) from a voxel across an interface; 0 else.
std::vector<std::uint8_t> NearInterfaces(const std::vector<Label>& labels,
  const std::array<Index, 3>& size, int reach, const Execution& execution);

/// mask becomes its dilation by a cube of (2 radius + 1)^3 voxels.
void Dilate(std::vector<std::uint8_t>& mask, const std::array<Index, 3>& size, int radius,
  const Execution& execution);
}

#endif
