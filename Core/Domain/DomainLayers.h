// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The hexahedral blocks of a domain: its cubes, or cubes with a layer of blocks along the surface.
 */
#ifndef trivariate_DomainLayers_h
#define trivariate_DomainLayers_h

#include "SegmentDomain.h"

namespace trivariate
{
struct DomainBlock
{
  /// Points in VTK's order of a hexahedron, its axes those of the polycube. Of a block that stands
  /// on a face, one axis runs from the surface inwards or back.
  std::array<Index, 8> Points;
  Index Face; ///< of the polycube, on whose patch the block stands; -1: a cube
};

struct DomainBlocks
{
  /// The corners on the surface, in order of the polycube, then all other points.
  std::vector<Eigen::Vector3d> Places;
  std::vector<LatticePoint> Coordinates; ///< of each point, in the polycube
  std::vector<DomainBlock> Blocks;       ///< cubes first, then layers in order of faces
};

/// The cubes as they are, over SegmentDomain::Places.
DomainBlocks CubeBlocks(const SegmentDomain& domain);

/**
 * A block on each patch, around cubes with inner corners of their own, which share the lattice
 * point of the corner above them: 8 + 8 corners and 7 blocks for one cube.
 *
 * From each corner a path goes inwards, away from the surface. The inner corner is where the path
 * is `depth` away from the surface, but not deeper than half of what the path reaches. Where a
 * block would be inverted at one of its corners, its depth is lessened and its inner corners are
 * moved aside, as far as that helps: around a corner of the surface that bends the wrong way, or of
 * a shape bent too much for its cubes, it need not. depth:
 * in the surface's units; 0 or less: 2.5 times the mean length of a triangle's edge. O(n log n).
 */
DomainBlocks LayeredBlocks(const SegmentDomain& domain, double depth, const Execution& execution);

/// Of a cube: the points on a face stay, those across from them become the ones `below` them.
DomainBlock BlockOn(const Polycube& cubes, Index face, const std::vector<Index>& below);

/// The least over the 8 corners of a hexahedron of the determinant of its three edges' unit
/// vectors: at most 1, which a box has.
double ScaledJacobian(
  const std::vector<Eigen::Vector3d>& places, const std::array<Index, 8>& hexahedron);

/**
 * A block on each patch of the outer surface, down to the same patch of the inner one. Points:
 * corners of the outer surface, then of the inner one. Throws std::invalid_argument where the
 * polycubes differ.
 */
DomainBlocks ShellBlocks(const SegmentDomain& outer, const SegmentDomain& inner);
}

#endif
