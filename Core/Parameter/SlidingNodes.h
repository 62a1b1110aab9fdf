// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// How far the nodes of a block mesh are free: corners stay, others slide on borders and patches.
#ifndef trivariate_SlidingNodes_h
#define trivariate_SlidingNodes_h

#include "BlockDomain.h"
#include "Domain/TriangleTree.h"
#include "Execution.h"

#include <memory>

namespace trivariate
{
class SlidingNodes
{
public:
  /// `start`: the mesh as StartOfBlockMesh makes it. The domain must outlive this. O(n log n).
  SlidingNodes(const BlockDomain& domain, const BlockMesh& start);

  enum Kind : char
  {
    Free,
    OnPatch,
    OnBorder,
    Fixed
  };

  Kind KindOf(Index node) const { return this->Kinds[node]; }

  /// Where the node started; one on the surface should not go far from there, so that all parts of
  /// the surface keep their nodes.
  const Eigen::Vector3d& Home(Index node) const { return this->Homes[node]; }

  /// The nearest place that the node may take.
  Eigen::Vector3d Allowed(Index node, const Eigen::Vector3d& place) const;

  /// The same, and an orthonormal basis of the directions in which the node may go from there, in
  /// the first columns: none, one, two or all three.
  Eigen::Vector3d Allowed(Index node, const Eigen::Vector3d& place, Eigen::Matrix3d& basis) const;

  /// Puts all nodes of the surface where they started.
  void SendHome(std::vector<Eigen::Vector3d>& places) const;

private:
  struct PatchSurface
  {
    std::vector<Triangle> Triangles;
    std::unique_ptr<TriangleTree> Tree;
  };

  const BlockDomain& Domain;
  std::vector<Eigen::Vector3d> Homes;
  std::vector<Kind> Kinds;    // of each node
  std::vector<Index> Support; // of each node: its patch or border
  std::vector<PatchSurface> Patches;
  std::vector<std::vector<Eigen::Vector3d>> Borders;
};
}

#endif
