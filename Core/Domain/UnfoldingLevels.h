// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// An unfolded surface with fewer and fewer points, and the way back.
#ifndef trivariate_UnfoldingLevels_h
#define trivariate_UnfoldingLevels_h

#include "LayoutUnfolding.h"

namespace trivariate
{
/**
 * Points that were on no border of the layout are taken away one by one, the hole filled with
 * triangles from one of its corners, so that none is much turned in space. Neighbours stay until
 * the next sweep. Where points are mapped to does not matter. O(n).
 */
class UnfoldingLevels
{
public:
  using ChartTriangle = LayoutUnfolding::ChartTriangle;

  /// Takes points away until no more than so many triangles are left, or few more can go.
  UnfoldingLevels(LayoutUnfolding& unfolding, Index triangles);

  Index NumberOfLevels() const { return static_cast<Index>(this->Levels.size()); }

  /// Triangles of a level; the last one is the coarsest, 0 is the surface itself.
  const std::vector<ChartTriangle>& Triangles(Index level) const
  {
    return this->Levels[level].Triangles;
  }

  /// Places the points that a level has beside those of the next coarser one where they are in the
  /// middle of their neighbours as in space; where that would fold a triangle, closer to one.
  void PlaceAgain(Index level);

private:
  struct Removal
  {
    Index Point, Face;
    std::vector<Index> Ring; // around it, anticlockwise; the holes's triangles are from the first
  };
  struct Level
  {
    std::vector<ChartTriangle> Triangles;
    std::vector<Removal> Removals; // from this level, in order
  };
  class Sweep;

  static Eigen::Vector2d Improved(Eigen::Vector2d place, const std::vector<Eigen::Vector2d>& flat,
    const std::vector<Eigen::Vector3d>& points, const Removal& removal);

  LayoutUnfolding& Map;
  std::vector<Level> Levels;
};
}

#endif
