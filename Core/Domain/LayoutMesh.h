// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * A closed triangle mesh into which paths are cut.
 *
 * Splitting the edges that a path crosses one after the other makes the path's own segments edges
 * of the mesh, because the apex of each next triangle is the path's last point; so one operation is
 * enough. Marked edges are the borders cut so far.
 */
#ifndef trivariate_LayoutMesh_h
#define trivariate_LayoutMesh_h

#include "SurfaceMesh.h"

namespace trivariate
{
class LayoutMesh
{
public:
  explicit LayoutMesh(const SurfaceMesh& mesh);

  Index NumberOfPoints() const { return static_cast<Index>(this->Points.size()); }
  Index NumberOfTriangles() const { return static_cast<Index>(this->Triangles.size()); }

  /// The triangle across side k, which goes from corner k to corner (k + 1) % 3.
  Index Neighbour(Index t, int k) const { return this->Neighbours[t][k]; }
  /// Which side of its neighbour side k of triangle t is.
  int SideAcross(Index t, int k) const
  {
    return this->CornerOf(this->Neighbours[t][k], this->Triangles[t][(k + 1) % 3]);
  }
  int CornerOf(Index t, Index p) const
  {
    const Triangle& c = this->Triangles[t];
    return c[0] == p ? 0 : c[1] == p ? 1 : 2;
  }
  bool HasCorner(Index t, Index p) const
  {
    const Triangle& c = this->Triangles[t];
    return c[0] == p || c[1] == p || c[2] == p;
  }

  /// The triangles around a point are t, Anticlockwise(t, p), ... until t comes again.
  Index TriangleAt(Index p) const { return this->OneTriangle[p]; }
  Index Anticlockwise(Index t, Index p) const
  {
    return this->Neighbours[t][(this->CornerOf(t, p) + 2) % 3];
  }
  Index Clockwise(Index t, Index p) const { return this->Neighbours[t][this->CornerOf(t, p)]; }

  /// The triangle on the left of the edge from p to q, whose corner p begins that side; -1 where
  /// there is no such edge.
  Index TriangleLeftOf(Index p, Index q) const;

  /// The border that side k of triangle t belongs to; -1: none.
  Index Mark(Index t, int k) const { return this->Marks[t][k]; }
  /// Marks an edge from both of its sides.
  void SetMark(Index t, int k, Index mark);

  /**
   * Cuts the edge that is side k of triangle t, and both of its triangles in two, at the fraction
   * `where` (0 to 1) of the way from corner k. Returns the new point. Triangle t keeps corner k;
   * marks and origins are inherited. O(1).
   */
  Index SplitEdge(Index t, int k, double where);

  std::vector<Eigen::Vector3d> Points;
  std::vector<Triangle> Triangles;
  std::vector<Index> Origins; ///< of each triangle: the triangle given at first that it is part of
  std::vector<char> Occupied; ///< of each point: not to be passed, as a corner or part of a border

private:
  std::vector<std::array<Index, 3>> Neighbours, Marks;
  std::vector<Index> OneTriangle;
};
}

#endif
