// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Unit cubes at integer places, glued face to face, and the quadrilaterals of their boundary.
 */
#ifndef trivariate_Polycube_h
#define trivariate_Polycube_h

#include "TSpline/TSpline.h"

#include <array>
#include <string>
#include <vector>

namespace trivariate
{
using LatticePoint = std::array<int, 3>;

class Polycube
{
public:
  /// A unit square between a cube and the outside.
  struct Face
  {
    std::array<Index, 4> Corners; ///< points, anticlockwise seen from outside
    int Axis;                     ///< 0, 1, 2: u, v, w
    int Side;                     ///< 0: the low end of its cube, 1: the high end
    Index Cube;
  };

  /// A unit length between two faces of the boundary, in the direction of its axis.
  struct Edge
  {
    Index From, To;    ///< points
    Index Left, Right; ///< faces, seen from outside
    int Axis;
  };

  /**
   * Cubes by their low corners, in any order. Throws std::invalid_argument, naming the place, when
   * there is none, one comes twice, they are not all joined by faces, or two of them touch at an
   * edge or a point only, so that the boundary is not two-manifold. O(n log n).
   */
  explicit Polycube(std::vector<LatticePoint> cubes);

  /// size[0] x size[1] x size[2] cubes, the first axis fastest; those with zero in `present` are
  /// left out. An empty `present` means all.
  static Polycube FromGrid(
    const std::array<int, 3>& size, const std::vector<unsigned char>& present = {});

  /// V - E + F of the boundary: 2 where it is like a sphere, 0 like a torus, 4 with a cavity, ...
  Index EulerCharacteristic() const
  {
    return this->NumberOfCorners + static_cast<Index>(this->Faces.size()) -
           static_cast<Index>(this->Edges.size());
  }

  std::vector<LatticePoint> Cubes;
  std::vector<LatticePoint> Points; ///< of all cubes: first those on the boundary, then the others;
                                    ///< each in order of w, then v, then u
  Index NumberOfCorners = 0;        ///< how many of the points lie on the boundary
  std::vector<std::array<Index, 8>> CubePoints; ///< of each cube, in VTK's order of a hexahedron
  std::vector<Face> Faces;                      ///< in order of cubes, then axes, then sides
  std::vector<Edge> Edges;                     ///< of the boundary, in order of their first corners
  std::vector<std::vector<Index>> EdgesAround; ///< of each corner, anticlockwise seen from outside

private:
  void FindPointsAndFaces();
  void FindEdges();
  void FindFans();
  void CheckFaceConnected() const;
};

/// "(u, v, w)", for messages.
std::string NameOf(const LatticePoint& point);
}

#endif
