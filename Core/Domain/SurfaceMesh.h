// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * A closed, oriented, two-manifold triangle mesh and its neighbourhoods.
 */
#ifndef trivariate_SurfaceMesh_h
#define trivariate_SurfaceMesh_h

#include "TSpline/TSpline.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <vector>

namespace trivariate
{
using Triangle = std::array<Index, 3>; ///< three points, anticlockwise seen from outside

class SurfaceMesh
{
public:
  /**
   * Throws std::invalid_argument, naming an edge or a point and how many there are, when an edge
   * does not join exactly two triangles of the same orientation, or the triangles at a point are
   * not one fan. O(n log n).
   */
  SurfaceMesh(std::vector<Eigen::Vector3d> points, std::vector<Triangle> triangles);

  Index NumberOfPoints() const { return static_cast<Index>(this->Points.size()); }
  Index NumberOfTriangles() const { return static_cast<Index>(this->Triangles.size()); }

  /// The triangle across the edge from corner k to corner (k + 1) % 3 of triangle t.
  Index Neighbour(Index t, int k) const { return this->Neighbours[t][k]; }

  /// The triangles around a point, anticlockwise.
  const Index* FanBegin(Index p) const { return &this->Fans[this->FanStart[p]]; }
  const Index* FanEnd(Index p) const { return this->Fans.data() + this->FanStart[p + 1]; }

  /// 0, 1 or 2: where point p is in triangle t.
  int CornerOf(Index t, Index p) const
  {
    const Triangle& c = this->Triangles[t];
    return c[0] == p ? 0 : c[1] == p ? 1 : 2;
  }

  /// Half the cross product of two edges: outward, as long as the area.
  Eigen::Vector3d AreaVector(Index t) const;

  /// V - E + F of the triangles: 2 for a sphere, 0 for a torus, ...
  Index EulerCharacteristic() const;

  /// For each triangle the number of its connected component, counted from 0 in order of first
  /// triangles; and how many there are.
  std::vector<Index> Components(Index& count) const;

  std::vector<Eigen::Vector3d> Points;
  std::vector<Triangle> Triangles;

private:
  std::vector<std::array<Index, 3>> Neighbours;
  std::vector<Index> FanStart, Fans;
};
}

#endif
