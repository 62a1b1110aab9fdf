// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// Complexes of blocks for tests.
#ifndef trivariate_BlockShapes_h
#define trivariate_BlockShapes_h

#include "Domain/BlockComplex.h"

#include <algorithm>

namespace trivariate
{
/// Cubes of one group, at their places.
inline BlockComplex CubesComplex(const std::vector<LatticePoint>& places)
{
  const Polycube cubes(places);
  const std::vector<int> zeros(cubes.Cubes.size(), 0);
  return BlockComplex(cubes.CubePoints, zeros, zeros, cubes.Cubes);
}

/// VTK's number of the corner at the ends given by the bits of `ends` (u, v, w).
inline int HexahedronCorner(int ends)
{
  return (ends & 2 ? (ends & 1 ? 2 : 3) : ends & 1) + (ends & 4);
}

/**
 * The core cube (block 0) and a block on each of its faces -u, u, -v, v, -w, w, each a group.
 * Points 0-7 are inside, 8-15 outside; the axis along the face's normal runs in the direction of
 * that axis of the core, so that inside is at its high end for -u, -v, -w.
 */
inline BlockComplex LayeredCubeComplex(int segment = 0)
{
  std::vector<std::array<Index, 8>> blocks(7);
  for (int ends = 0; ends < 8; ++ends)
  {
    const int corner = HexahedronCorner(ends);
    blocks[0][corner] = corner;
    for (int f = 0; f < 6; ++f)
    {
      const int axis = f / 2, side = f % 2;
      const int onFace = side ? ends | 1 << axis : ends & ~(1 << axis);
      const bool isInside = (ends >> axis & 1) != side;
      blocks[1 + f][corner] = HexahedronCorner(onFace) + (isInside ? 0 : 8);
    }
  }
  return BlockComplex(blocks, std::vector<int>(7, segment), { 0, 1, 2, 3, 4, 5, 6 },
    std::vector<LatticePoint>(7, LatticePoint{ 0, 0, 0 }));
}

/// The same with segment 0 in the core and segment 1 in the layers.
inline BlockComplex NestedCubeComplex()
{
  BlockComplex blocks = LayeredCubeComplex();
  std::fill(blocks.Segments.begin() + 1, blocks.Segments.end(), 1);
  return blocks;
}

/// The point (s, t) of a face in parameter space.
inline std::array<double, 3> PointOn(
  const BlockComplex& blocks, const BlockFace& face, const std::array<double, 2>& st)
{
  const LatticePoint& o = blocks.Origins[face.Block];
  const auto axes = TangentialAxes(face.Axis);
  std::array<double, 3> x;
  x[face.Axis] = o[face.Axis] + face.Side;
  x[axes[0]] = o[axes[0]] + st[0];
  x[axes[1]] = o[axes[1]] + st[1];
  return x;
}

/// The hexahedron in its 24 turns: the same corners in the order of other right-handed axes.
inline std::vector<std::array<Index, 8>> TurnsOf(const std::array<Index, 8>& block)
{
  std::vector<std::array<Index, 8>> turns;
  std::array<int, 3> axes{ 0, 1, 2 };
  do
  {
    const bool isOdd = (axes[0] > axes[1]) ^ (axes[0] > axes[2]) ^ (axes[1] > axes[2]);
    for (int mirror = 0; mirror < 8; ++mirror)
    {
      if ((((mirror & 1) + (mirror >> 1 & 1) + (mirror >> 2)) % 2 != 0) != isOdd)
      {
        continue; // left-handed
      }
      std::array<Index, 8> turned;
      for (int ends = 0; ends < 8; ++ends)
      {
        int old = 0;
        for (int a = 0; a < 3; ++a)
        {
          old |= ((ends >> a & 1) ^ (mirror >> a & 1)) << axes[a];
        }
        turned[HexahedronCorner(ends)] = block[HexahedronCorner(old)];
      }
      turns.push_back(turned);
    }
  } while (std::next_permutation(axes.begin(), axes.end()));
  return turns;
}

/// Three blocks around one edge (a hexagon cut in three quadrilaterals, times [0, 1]), two of them
/// turned.
inline BlockComplex ThreeAroundAnEdge()
{
  // The middle is 0, the hexagon 1-6; 7 more are the points above.
  const auto prism = [](Index a, Index b, Index c, Index d) {
    return std::array<Index, 8>{ a, b, c, d, a + 7, b + 7, c + 7, d + 7 };
  };
  return BlockComplex(
    { prism(0, 1, 2, 3), TurnsOf(prism(0, 3, 4, 5))[7], TurnsOf(prism(0, 5, 6, 1))[18] },
    { 0, 0, 0 }, { 0, 1, 2 }, std::vector<LatticePoint>(3, LatticePoint{ 0, 0, 0 }));
}
}

#endif
