// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// Connected components of a labelled image; voxels are connected through their faces.
#ifndef trivariate_LabelComponents_h
#define trivariate_LabelComponents_h

#include "TSpline/TSpline.h"

#include <array>
#include <cstdint>
#include <vector>

namespace trivariate
{
using Label = std::uint8_t;

struct LabelComponents
{
  std::vector<std::int32_t> Component; ///< of each voxel: 0, 1, ..., in the order of first voxels
  std::vector<Label> Labels;           ///< of each component
  std::vector<Index> Sizes;            ///< voxels of each component

  int Count() const { return static_cast<int>(this->Sizes.size()); }
};

/// x runs fastest. Linear time; 4 bytes a voxel. Throws std::length_error for 2^31 voxels or more.
LabelComponents FindComponents(const std::vector<Label>& labels, const std::array<Index, 3>& size);

/**
 * Gives every component with fewer than `minimum` voxels the label of the neighbours with which it
 * shares most faces (of equals the smallest label), the smallest components first, until none is
 * left or the whole image is one. Returns the number of components that were merged.
 */
Index MergeSmallComponents(
  std::vector<Label>& labels, const std::array<Index, 3>& size, Index minimum);
}

#endif
