// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The blocks of a domain and how they are glued, with a place for each in one parameter space.
 *
 * Every block is a unit box at integer Origins. The boxes of one group adjoin as in their lattice,
 * as an L or a U, say, and are one grid of (u, v, w), across whose inner faces a spline is C2.
 * Different groups lie apart, and a spline is joined across their common faces by equal control
 * points (C0).
 */
#ifndef trivariate_BlockComplex_h
#define trivariate_BlockComplex_h

#include "Polycube.h"

#include <array>
#include <map>
#include <utility>
#include <vector>

namespace trivariate
{
struct BlockFace
{
  Index Block;
  int Axis; ///< 0, 1, 2: u, v, w is constant on the face
  int Side; ///< 0: the low end, 1: the high end
};

/// The two axes along a face, ascending: s and t of the face.
constexpr std::array<int, 2> TangentialAxes(int axis)
{
  return axis == 0   ? std::array<int, 2>{ 1, 2 }
         : axis == 1 ? std::array<int, 2>{ 0, 2 }
                     : std::array<int, 2>{ 0, 1 };
}

/// The face that a face is glued to, and how its (s, t) run there.
struct FaceTwin
{
  BlockFace Face{ -1, 0, 0 };                  ///< Block == -1: none, the face is on the boundary
  bool Swapped = false;                        ///< s runs along the twin's t
  std::array<bool, 2> Flipped{ false, false }; ///< the twin's s, t run backwards

  bool Exists() const { return this->Face.Block >= 0; }

  /// (s, t) in [0, one] of the face as (s, t) of the twin.
  template <typename T>
  std::array<T, 2> Map(const std::array<T, 2>& st, T one) const
  {
    const T s = this->Swapped ? st[1] : st[0], t = this->Swapped ? st[0] : st[1];
    return { this->Flipped[0] ? one - s : s, this->Flipped[1] ? one - t : t };
  }
};

class BlockComplex
{
public:
  BlockComplex() = default;

  /**
   * `blocks`: points of each in VTK's order of a hexahedron, its axes u, v, w; faces with the same
   * four points are glued. `places`: the low corner of each block in the lattice of its group.
   *
   * The blocks of a group become groups of their own, with numbers from the largest on, where a
   * face is glued other than in its lattice (the spline cannot be C2 across the group's own faces
   * and match that neighbour too).
   *
   * Throws std::invalid_argument, naming the block: lists of different lengths or empty; two blocks
   * of a group at one place, or neighbours there that do not have a face in common; blocks of one
   * group in different segments; a face of three blocks; a glued face on which a point comes twice.
   * O(n log n).
   */
  BlockComplex(std::vector<std::array<Index, 8>> blocks, std::vector<int> segments,
    std::vector<int> groups, std::vector<LatticePoint> places);

  Index Size() const { return static_cast<Index>(this->Blocks.size()); }

  /// The face with the same four points.
  const FaceTwin& Twin(const BlockFace& face) const
  {
    return this->Twins[face.Block][2 * face.Axis + face.Side];
  }

  /// Whether the spline is C2 across the face: its twin is its neighbour in the same group.
  bool IsJoined(const BlockFace& face) const;

  /// Whether the face is glued to one of another group or place, across which the spline is C0.
  bool IsGlued(const BlockFace& face) const
  {
    return this->Twin(face).Exists() && !this->IsJoined(face);
  }

  /// The block whose closed unit box holds (u, v, w); on a common face the first; -1 outside.
  Index BlockAt(const std::array<double, 3>& parameter) const;

  /// The points of a face at (s, t) = (0, 0), (1, 0), (0, 1), (1, 1).
  std::array<Index, 4> FacePoints(const BlockFace& face) const;

  /// The high end of the boxes of all groups; the low end is the origin.
  LatticePoint Extent() const;

  /// All blocks whose closed unit box holds (u, v, w), ascending.
  std::vector<Index> BlocksAt(const std::array<double, 3>& parameter) const;

  /// The low and the high end of the box of each group; its blocks need not fill it.
  std::map<int, std::pair<LatticePoint, LatticePoint>> GroupBoxes() const;

  std::vector<std::array<Index, 8>> Blocks; ///< points of each
  std::vector<int> Segments;                ///< of each block
  std::vector<int> Groups;                  ///< of each block
  /// The low corner of each block's unit box, none negative. The bounding boxes of two groups are
  /// at least one unit apart.
  std::vector<LatticePoint> Origins;

private:
  void FindTwins();
  void SplitGroups(const std::vector<LatticePoint>& places);
  void Arrange(const std::vector<LatticePoint>& places);

  std::vector<std::array<FaceTwin, 6>> Twins; // [2 axis + side]
  std::map<LatticePoint, Index> BlockOfPlace; // by Origins
};
}

#endif
