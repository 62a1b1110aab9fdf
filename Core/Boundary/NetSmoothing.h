// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Moving the vertices of a boundary net: smoothly, in their half-voxel cells, without shrinking.
 */
#ifndef trivariate_NetSmoothing_h
#define trivariate_NetSmoothing_h

#include "BoundaryNet.h"

#include <Eigen/Core>

#include <vector>

namespace trivariate
{
using Points = std::vector<Eigen::Vector3d>;

/// Which faces meet at a vertex, and which vertices it is drawn to.
struct NetTopology
{
  explicit NetTopology(const BoundaryNet& net, const Execution& execution);

  enum VertexKind : std::uint8_t
  {
    SURFACE = 0, ///< two segments (or one and the outside) meet there
    CURVE = 1,   ///< three or more meet along a curve through the vertex
    JUNCTION = 2 ///< such curves meet or end there
  };
  std::vector<VertexKind> Kinds;
  std::vector<Index> FaceBegin, Faces; ///< the faces of vertex v: FaceBegin[v] .. FaceBegin[v+1]
  /// The neighbours along edges; of a vertex on a curve only those on it.
  std::vector<Index> NeighbourBegin, Neighbours;
};

/// Where the net has its vertices.
Points AnchorsOf(const BoundaryNet& net);

/**
 * The nearest allowed place, more or less: at most 0.49 voxels from the vertex's corner along each
 * axis and from the faces that meet there; 0.15 where it is not the only vertex; on the border.
 */
Eigen::Vector3d Constrain(const BoundaryVertex& vertex, Eigen::Vector3d point);

/// Area vector of a face: half the cross product of its diagonals, or of two edges.
Eigen::Vector3d AreaVector(const BoundaryFace& face, const Points& points);

/// Unit normal of the faces at a vertex inside a surface.
Eigen::Vector3d NormalAt(
  const BoundaryNet& net, const NetTopology& topology, Index vertex, const Points& points);

/// Of any vectors at the vertices; the vertex's own where it has no neighbours.
Eigen::Vector3d MeanOfNeighbours(const NetTopology& topology, Index vertex, const Points& points);

/**
 * Flow by the square of the umbrella operator (each vertex minus the mean of its neighbours), a
 * step forwards and one of the same size backwards: the amplitude of a wave with eigenvalue x is
 * multiplied by 1 - x^2 / 4, which damps steps but leaves the size of a ball as it is, to fourth
 * order (Taubin, A signal processing approach to fair surface design, SIGGRAPH 1995).
 */
void Smooth(const BoundaryNet& net, const NetTopology& topology, int iterations, Points& points,
  const Execution& execution);

/// Draws the vertices to their neighbours within the surface or the curve: better triangles.
void SmoothTangentially(const BoundaryNet& net, const NetTopology& topology, int iterations,
  Points& points, const Execution& execution);

/**
 * Moves every connected piece of surface between two segments along its normals such that the
 * volume between it and the voxel faces vanishes: what the one segment gains somewhere it loses
 * elsewhere on the same piece.
 */
void RestoreVolumes(
  const BoundaryNet& net, const NetTopology& topology, Points& points, const Execution& execution);
}

#endif
