// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// How far the nodes of a block mesh are free on the surface of its domain.
#ifndef trivariate_SlidingNodes_h
#define trivariate_SlidingNodes_h

#include "DomainSurface.h"
#include "Execution.h"

namespace trivariate
{
/**
 * Nodes of patches slide over the whole piece of surface to which the patch belongs, and so do
 * those of borders and corners, except where borders hold them (DomainSurface): there they slide
 * along the border, and corners at its ends stay. Nodes that slide over a piece may leave it
 * to both sides by as much as they are free.
 */
class SlidingNodes
{
public:
  enum Kind : char
  {
    Free,
    OnSurface,
    OnBorder,
    Fixed
  };

  enum Start
  {
    InPatches,    ///< nodes are put on the nearest point of their patch
    WhereTheySlid ///< on that of the piece: those of a mesh that is repaired keep their places
  };

  /**
   * Puts the nodes of a mesh that belong on the surface there. freedom: how far they may leave the
   * surface, in space. The surface must outlive this. O(n log n), times the number of patches for
   * nodes that slid.
   */
  SlidingNodes(const DomainSurface& surface, BlockMesh& mesh, double freedom,
    const Execution& execution, Start start = InPatches);

  /// The same where `mesh` is `coarse` at another resolution: the nearest point within reach from
  /// where the coarse nodes are.
  SlidingNodes(BlockMesh& mesh, const BlockMesh& coarse, const SlidingNodes& onCoarse);

  Kind KindOf(Index node) const { return this->Kinds[node]; }

  /// Where a node gets when it is moved to `place`, and `foot`, where it then is on the surface.
  Eigen::Vector3d Allowed(Index node, const Eigen::Vector3d& place, SurfaceFoot& foot) const;

  const SurfaceFoot& FootOf(Index node) const { return this->Feet[node]; }
  void Step(Index node, const SurfaceFoot& foot) { this->Feet[node] = foot; }

  /// An orthonormal basis of which the first column is along the border of the node, or the last
  /// one normal to the surface.
  Eigen::Matrix3d BasisAt(Index node, const Eigen::Vector3d& place) const;

  double Freedom() const { return this->Most; }
  const DomainSurface& Surface() const { return *this->On; }

private:
  void FindKinds(const BlockMesh& mesh);

  const DomainSurface* On;
  double Most;
  std::vector<Kind> Kinds;       // of each node
  std::vector<Index> Support;    // of each node: a patch, or its border
  std::vector<SurfaceFoot> Feet; // of nodes on the surface
  std::vector<std::vector<Eigen::Vector3d>> Borders;
};
}

#endif
