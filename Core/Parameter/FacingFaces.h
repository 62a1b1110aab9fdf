// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// Whether faces of cells on the surface of a domain see what the surface there sees.
#ifndef trivariate_FacingFaces_h
#define trivariate_FacingFaces_h

#include "SlidingNodes.h"

namespace trivariate
{
/**
 * At the corner of a face, D = (a x b).n of its two edges, each by its wanted length, and the
 * normal of the surface where the node there stands. It is about 1 where the face lies on the
 * surface, and negative where it lies the wrong way round: in a pleat, which covers the surface
 * three times although no cell need be inverted. The energy is the sum of max(0, Least - D)^2.
 * Nodes that borders hold have no normal, and no part in it.
 */
class FacingFaces
{
public:
  static constexpr double Least = 0.1;

  /// targets: of each block, the wanted lengths of its cells. O(n).
  FacingFaces(const SlidingNodes& sliding, const BlockMesh& mesh,
    const std::vector<Eigen::Vector3d>& targets);

  /// A corner when a node moves by d while the normal stays: D + Slope.d.
  struct Term
  {
    double Determinant;
    Eigen::Vector3d Slope;

    /// What D lacks.
    double LackAt(const Eigen::Vector3d& d) const
    {
      return std::max(0.0, Least - this->Determinant - this->Slope.dot(d));
    }
  };

  /// Of all corners that a node is part of.
  void TermsOf(Index node, const std::vector<Eigen::Vector3d>& places, const SlidingNodes& sliding,
    std::vector<Term>& terms) const;

  double Energy(const std::vector<Eigen::Vector3d>& places, const SlidingNodes& sliding) const;

private:
  struct Corner
  {
    std::array<Index, 3> Nodes; // the one there and the next ones, anticlockwise from outside
    std::array<double, 2> Lengths;
  };

  Term TermOf(const Corner& corner, Index node, const std::vector<Eigen::Vector3d>& places,
    const SlidingNodes& sliding) const;

  std::vector<Corner> Corners;
  std::vector<Index> Around, AroundStart; // the corners that each node is part of
};
}

#endif
