// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// The nearest point of a surface.
#ifndef trivariate_TriangleTree_h
#define trivariate_TriangleTree_h

#include "SurfaceMesh.h"

#include <Eigen/Geometry>

namespace trivariate
{
/// A binary tree of boxes around triangles, split at the median of their middles.
class TriangleTree
{
public:
  struct Foot
  {
    Eigen::Vector3d Place;
    double Distance;
    Index Triangle;
  };

  /// Points and triangles are not copied: they must outlive the tree. At least one triangle.
  /// O(n log n).
  TriangleTree(const std::vector<Eigen::Vector3d>& points, const std::vector<Triangle>& triangles);

  /// O(log n) near the surface.
  Foot Nearest(const Eigen::Vector3d& p) const;

private:
  struct Node
  {
    Eigen::AlignedBox3d Box;
    Index Begin, End; // of Order
    Index Right;      // the second child; the first one comes next; -1: a leaf
  };

  void Split(Index begin, Index end, const std::vector<Eigen::Vector3d>& middles);
  void Search(Index node, const Eigen::Vector3d& p, Foot& best) const;

  const std::vector<Eigen::Vector3d>& Points;
  const std::vector<Triangle>& Triangles;
  std::vector<Index> Order;
  std::vector<Node> Nodes;
};

/// The point of a triangle with corners a, b, c that is nearest to p.
Eigen::Vector3d NearestOfTriangle(const Eigen::Vector3d& p, const Eigen::Vector3d& a,
  const Eigen::Vector3d& b, const Eigen::Vector3d& c);
}

#endif
