// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Layers that are no material of their own.
 *
 * A window that straddles two materials has attributes between theirs, and so has the density of a
 * voxel that both share. A clustering may call that a third segment and lay a shell of it around
 * everything. Such a shell is thin, lies between two other segments, and its attributes lie between
 * theirs; a thin wall with attributes of its own, or with the same segment on both sides, is none.
 */
#ifndef trivariate_SegmentShells_h
#define trivariate_SegmentShells_h

#include "Texture/KMeans.h"
#include "Texture/LabelComponents.h"

namespace trivariate
{
/**
 * Gives the voxels of shells the label of the nearer of the two segments between which they lie.
 *
 * `centres`: one row a label, the coordinates by which the segments differ. Only parts of a segment
 * that are nowhere thicker than 2 radius voxels are looked at (what an opening by a cube of
 * (2 radius + 1)^3 voxels takes away). Returns the number of voxels that were relabelled.
 * Cost: linear; 10 bytes a voxel.
 */
Index RemoveShells(std::vector<Label>& labels, const std::array<Index, 3>& size,
  const PointRows& centres, int radius, const Execution& execution);
}

#endif
