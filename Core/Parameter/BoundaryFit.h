// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// How near the surface of a domain is to the quadrilaterals of a block mesh that cover it.
#ifndef trivariate_BoundaryFit_h
#define trivariate_BoundaryFit_h

#include "SlidingNodes.h"

namespace trivariate
{
/**
 * The energy: the sum over samples of the surface (middles of triangles x with areas a) of
 * a (d.(x - y))^2 / h^4, where y is the nearest point of the quadrilaterals, d the direction from
 * there, h as long as these are; and the same over the middles of quadrilaterals y and their
 * nearest points x of the surface, where that is farther than a quarter of h. For fixed d and
 * weights of the four nodes in y it is quadratic in them. It pulls nodes out to where the surface
 * is and, between nodes on a curved surface, off it by as much as chords lack; along the surface
 * they slide freely.
 */
class BoundaryFit
{
public:
  /// Each sample belongs to the nearest quadrilateral of its own patch. O(n log n).
  BoundaryFit(const DomainSurface& surface, const BlockMesh& mesh);

  /// The same where the quadrilaterals of `mesh` are those of `coarse`, at another resolution.
  BoundaryFit(const BlockMesh& mesh, const BoundaryFit& coarse);

  /// Finds the nearest points again, from each to neighbours of the quadrilateral as long as those
  /// are nearer. O(n).
  void Assign(const std::vector<Eigen::Vector3d>& places, const Execution& execution);

  /// How the energy changes when one node moves by d: d.Curve d + Slope.d.
  struct Term
  {
    Eigen::Matrix3d Curve = Eigen::Matrix3d::Zero();
    Eigen::Vector3d Slope = Eigen::Vector3d::Zero();

    double At(const Eigen::Vector3d& d) const { return d.dot(this->Curve * d + this->Slope); }
  };
  Term TermOf(Index node, const std::vector<Eigen::Vector3d>& places) const;

  double Energy(const std::vector<Eigen::Vector3d>& places) const;

private:
  struct Quad
  {
    std::array<Index, 4> Nodes; // around it
    Index Patch;
  };

  // A point x of the surface and y of a quadrilateral.
  struct Sample
  {
    Eigen::Vector3d Place;
    double Area; // as far as it counts, by h^4
    Index Quad;
    Eigen::Vector4d Weights = Eigen::Vector4d::Zero();
    Eigen::Vector3d Direction = Eigen::Vector3d::Zero();
  };

  void FindQuads(const BlockMesh& mesh);
  void AssignSample(Sample& sample, const std::vector<Eigen::Vector3d>& places) const;
  void AssignMiddle(Index quad, const std::vector<Eigen::Vector3d>& places);
  double TriangleArea(Index t) const;
  double Residual(const Sample& sample, const std::vector<Eigen::Vector3d>& places) const;

  const DomainSurface* Surface;
  std::vector<PatchFace> Faces;
  std::vector<Index> FirstQuad; // of each patch
  std::vector<Quad> Quads;
  std::vector<Index> Around, AroundStart; // the quads at each node
  std::vector<Sample> Samples;            // of the triangles, those that count in Taken
  std::vector<Sample> Middles;            // of the quadrilaterals
  std::vector<SurfaceFoot> Feet;          // of those
  std::vector<Index> Taken, TakenStart;   // the samples of each quad that count
  double Area = 0.0;                      // of the surface
};
}

#endif
