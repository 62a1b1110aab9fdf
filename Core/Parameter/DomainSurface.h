// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// The surface of a domain as nodes slide on it: pieces, patches and the borders that hold them.
#ifndef trivariate_DomainSurface_h
#define trivariate_DomainSurface_h

#include "BlockDomain.h"
#include "Domain/TriangleTree.h"
#include "SurfaceWalk.h"

#include <memory>
#include <set>

namespace trivariate
{
class DomainSurface
{
public:
  /**
   * A border holds nodes where more than two patches meet at it, and where the surface is sharp
   * there as seen at a scale, a length in space: where the mean normals of both sides within it
   * differ by more than 50 degrees along most of the border. The domain must outlive this.
   * O(n log n).
   */
  DomainSurface(const BlockDomain& domain, double scale);

  /// By the two points of the domain where the border ends, in any order.
  bool IsHeld(Index from, Index to) const;

  /// Whether a border that holds nodes ends at this point of the domain.
  bool IsHeld(Index corner) const { return this->HeldCorners.count(corner) != 0; }

  /// The point of a patch that is nearest, anywhere on it.
  SurfaceFoot NearestOnPatch(Index patch, const Eigen::Vector3d& place) const;

  /// The nearest point of all patches of its piece of surface.
  SurfaceFoot NearestOnPieceOf(Index patch, const Eigen::Vector3d& place) const;

  Index PieceOfPatch(Index patch) const
  {
    return this->Walk.PieceOf(this->Domain.Patches[patch].Triangles.front());
  }

  const BlockDomain& Domain;
  const SurfaceWalk Walk;

private:
  bool IsSharp(const std::vector<Index>& border, Index patch, Index other, double scale) const;

  struct PatchTriangles
  {
    std::vector<Triangle> Triangles;
    std::unique_ptr<TriangleTree> Tree;
  };

  std::vector<PatchTriangles> Patches;
  std::set<std::array<Index, 2>> HeldBorders; // from the lesser point
  std::set<Index> HeldCorners;
};
}

#endif
