// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * What the faces between labels look like around one corner of a voxel.
 *
 * Eight voxels (octants) meet at a corner. A small sphere around it, the link, is cut by the faces
 * into pieces of one label each: twelve arcs, one a face, end at six nodes, one a voxel edge. The
 * faces' surface is a cone over the arcs, two-manifold for a segment where the segment's part of
 * the link is bounded by circles that do not touch and meet in one vertex no more than one at a
 * time. That is arranged here:
 *
 * - Where two voxels of label A touch at an edge only, A B / C A, A is connected across the edge
 *   and the edge has two copies, one for B and one for C. Of A B / B A the higher label is
 *   connected. (So a label is 18-connected against lower ones and 6-connected against higher ones.)
 * - Connected parts of the cut link get a vertex each: segments that touch at a corner only part.
 * - Where a part still shows the same label twice (three or more labels must meet there), the
 *   corner becomes a small ball, filled with the label that it shows least often, of these with the
 *   highest: a vertex for each node, and a face (patch) for each piece of another label.
 *
 * Octant o = x + 2 y + 4 z with x, y, z in {0, 1}. Half-edge h = 2 axis + (1 if upwards). The arc
 * with index 4 c + s + 2 t lies in the plane normal to axis c, between the half-edges
 * 2 a + s and 2 b + t, where a = (c + 1) % 3 and b = (c + 2) % 3.
 */
#ifndef trivariate_CornerLink_h
#define trivariate_CornerLink_h

#include <array>
#include <cstdint>
#include <vector>

namespace trivariate
{
/// A voxel edge among its four voxels, taken in the order (0,0), (1,0), (1,1), (0,1) of the two
/// other axes (a + 1) % 3, (a + 2) % 3.
struct EdgeCopies
{
  /// Which copy the face between voxel k and voxel k + 1 is at: 0, 1, or -1 where is no face.
  std::array<int, 4> CopyOfFace;
  int Count;                  ///< 0, 1 or 2
  std::array<int, 2> Octants; ///< of two copies: the voxel that the copy belongs to
};
EdgeCopies SplitEdge(const std::array<int, 4>& labels);

/// The directions (-1 or +1 along the two other axes) towards voxel k of the order above.
std::array<int, 2> EdgeOctantDirection(int k);

struct CornerLink
{
  struct Vertex
  {
    std::array<float, 3> Offset; ///< from the corner; not zero where there are several vertices
    std::uint16_t Arcs;          ///< bit set of the arcs, 0 for a vertex of a ball
    bool Alone;                  ///< the only vertex of its corner
  };
  /// A face of a ball, its vertices anticlockwise seen from outside of the ball.
  struct Patch
  {
    std::vector<int> Vertices;
    int Inside, Outside; ///< octants that have the label of the ball and of the piece
  };
  std::vector<Vertex> Vertices;
  std::vector<Patch> Patches;
  /// For each arc the vertices at the ends of its two half-edges; -1 where is no face.
  std::array<std::array<int, 2>, 12> VertexOfArc;
  /// For each half-edge the vertices of its copies, -1 where is none.
  std::array<std::array<int, 2>, 6> VertexOfEdge;
};

CornerLink LinkOfCorner(const std::array<int, 8>& labels);
}

#endif
