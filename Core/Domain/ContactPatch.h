// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The disc in which two segments touch, as one patch of the domains of both.
 *
 * Each segment has a domain of its own first. In both, the face that covers the disc best is taken
 * for it. The four corners of these faces meet on the outline of the disc, and both domains are
 * laid out anew, with these corners and the outline between them given.
 */
#ifndef trivariate_ContactPatch_h
#define trivariate_ContactPatch_h

#include "SegmentDomain.h"

namespace trivariate
{
/// The points around a disc of triangles, anticlockwise seen from outside, the least one first.
/// Throws std::invalid_argument where the triangles are no disc, or all of the mesh.
std::vector<Index> OutlineOfDisc(const SurfaceMesh& mesh, const std::vector<Index>& triangles);

struct FaceMatch
{
  Index Face;
  double Overlap; ///< the area that face and disc have in common, in that of both together
};

/// The face of a domain that covers a disc of its surface best.
FaceMatch FaceOver(const SegmentDomain& domain, const std::vector<Index>& triangles);

/// Where a cube and its neighbours lie in a lattice, turned and moved.
struct LatticeMotion
{
  Eigen::Matrix3i Turn = Eigen::Matrix3i::Identity();
  Eigen::Vector3i Shift = Eigen::Vector3i::Zero();

  LatticePoint operator()(const LatticePoint& point) const;
  /// The low corner of where a cube comes to lie.
  LatticePoint OfCube(const LatticePoint& low) const;
};

/// Where the corners of two faces are on the outline of the disc between them.
struct CommonCorners
{
  std::array<Index, 4> Places; ///< in the outline, of the corners of the first face in their order
  /// Corner k of the first face is corner (Shift - k) modulo 4 of the second one.
  Index Shift;
};

/// The places with the least sum of squared distances to the corners of both faces. `outline`:
/// seen from outside of the first one.
CommonCorners MeetCorners(const std::vector<Eigen::Vector3d>& outline,
  const std::array<Eigen::Vector3d, 4>& first, const std::array<Eigen::Vector3d, 4>& second);

/// Moves the second polycube's face onto the first one's, from the other side.
LatticeMotion MotionOnto(
  const Polycube& first, Index firstFace, const Polycube& second, Index secondFace, Index shift);

/// A disc of a mesh that is to be a face of its domain.
struct ContactPatch
{
  Index Face;                   ///< of the domain found without contacts
  std::vector<Index> Triangles; ///< of the mesh
  std::vector<Index> Outline;   ///< see OutlineOfDisc
  std::array<Index, 4> Corners; ///< of the face, in its order: where in the outline
};

struct ContactDomain
{
  SegmentDomain Domain;     ///< its polycube moved
  std::vector<Index> Faces; ///< of each contact, in the order given
};

/**
 * A domain laid out anew, its polycube moved in the lattice, with the given discs as faces. They
 * must have no point in common. All other corners are where they were, but outside of the discs.
 * Throws as DomainFromCorners where that cannot be done.
 */
ContactDomain DomainWithContacts(const SurfaceMesh& mesh, const SegmentDomain& domain,
  const LatticeMotion& motion, const std::vector<ContactPatch>& contacts,
  const Execution& execution);

/// Whether two domains agree on a face that they share: the same triangles, borders, and corners
/// with the same lattice points; one axis, from its two sides. One message for each failure.
std::vector<std::string> CheckContact(
  const SegmentDomain& first, Index firstFace, const SegmentDomain& second, Index secondFace);
}

#endif
