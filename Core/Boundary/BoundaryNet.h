// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The net of voxel faces between different labels, two-manifold for every label.
 *
 * Voxel (i, j, k) is the unit cube around the point (i, j, k); its corners have half-integer
 * coordinates. Outside of the volume everything has the label -1, so that every label is closed.
 * CornerLink.h says how the net is kept two-manifold: corners and edges where a segment would touch
 * itself have several vertices, moved a fifth of a voxel apart.
 */
#ifndef trivariate_BoundaryNet_h
#define trivariate_BoundaryNet_h

#include "Execution.h"

#include <array>
#include <cstdint>
#include <vector>

namespace trivariate
{
/// Labels >= 0, not owned, first axis fastest.
struct LabelVolume
{
  const std::int32_t* Labels;
  std::array<Index, 3> Size;

  /// Of any voxel; -1 outside.
  std::int32_t operator()(Index i, Index j, Index k) const
  {
    const bool inside =
      i >= 0 && i < this->Size[0] && j >= 0 && j < this->Size[1] && k >= 0 && k < this->Size[2];
    return inside ? this->Labels[i + this->Size[0] * (j + this->Size[1] * k)] : -1;
  }
};

struct BoundaryVertex
{
  std::array<float, 3> Anchor; ///< where the net has it, in voxels
  /// Bit set of the arcs of CornerLink.h: which faces of the corner are its own. 0: not at a
  /// corner.
  std::uint16_t Faces;
  /// Bit a: the vertex lies on the volume's border normal to axis a and stays there.
  std::uint8_t FixedAxes;
  /// The only vertex of its corner, which Anchor is.
  bool Alone;
};

struct BoundaryFace
{
  /// A quadrilateral, or a triangle if the last is -1. Its normal points to the second label.
  std::array<Index, 4> Vertices;
  std::array<std::int32_t, 2> Labels; ///< ascending; the first may be -1

  int Size() const { return this->Vertices[3] < 0 ? 3 : 4; }
};

struct BoundaryNet
{
  std::vector<BoundaryVertex> Vertices;
  std::vector<BoundaryFace> Faces;
};

/// Sorted by the third index of the voxels; O(voxels) time, memory O(faces).
BoundaryNet BuildBoundaryNet(const LabelVolume& labels, const Execution& execution);
}

#endif
