// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// Pieces of a surface, and the way over one to a point nearest to another.
#ifndef trivariate_SurfaceWalk_h
#define trivariate_SurfaceWalk_h

#include "Domain/SurfaceMesh.h"

#include <Eigen/Geometry>

#include <unordered_set>
#include <vector>

namespace trivariate
{
/// A point of a surface.
struct SurfaceFoot
{
  Index Triangle = -1;
  Eigen::Vector3d Place = Eigen::Vector3d::Zero();
};

/// Triangles over any edges, also such where more than two meet.
class SurfaceWalk
{
public:
  /// Points and triangles are not copied: they must outlive this. O(n log n).
  SurfaceWalk(const std::vector<Eigen::Vector3d>& points, const std::vector<Triangle>& triangles);

  /**
   * From a triangle to the neighbour, over common points, that is nearest to the target, as long as
   * that is nearer: the nearest point within reach, which may be farther than one beyond a gap or
   * on the other side of a thin sheet. Stays in the triangle's piece.
   */
  SurfaceFoot Nearest(Index from, const Eigen::Vector3d& target) const;

  /// Pieces: triangles joined by edges that have exactly two of them.
  Index PieceOf(Index triangle) const { return this->Pieces[triangle]; }

  Eigen::Vector3d Normal(Index triangle) const;

  /// The sum of the area vectors of triangles for which accept(triangle), those that are joined to
  /// a point within a radius of it.
  template <typename Accept>
  Eigen::Vector3d AreaAround(Index point, double radius, const Accept& accept) const;

private:
  void FindPieces();

  const std::vector<Eigen::Vector3d>& Points;
  const std::vector<Triangle>& Triangles;
  std::vector<Index> Pieces;
  std::vector<Index> Fans, FanStart; // the triangles at each point
};

template <typename Accept>
Eigen::Vector3d SurfaceWalk::AreaAround(Index point, double radius, const Accept& accept) const
{
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  std::vector<Index> points{ point };
  std::unordered_set<Index> reached{ point }, taken;
  for (std::size_t next = 0; next < points.size(); ++next)
  {
    for (Index i = this->FanStart[points[next]]; i < this->FanStart[points[next] + 1]; ++i)
    {
      const Index t = this->Fans[i];
      if (!accept(t) || !taken.insert(t).second)
      {
        continue;
      }
      const Triangle& c = this->Triangles[t];
      sum +=
        0.5 *
        (this->Points[c[1]] - this->Points[c[0]]).cross(this->Points[c[2]] - this->Points[c[0]]);
      for (const Index corner : c)
      {
        if ((this->Points[corner] - this->Points[point]).norm() < radius &&
            reached.insert(corner).second)
        {
          points.push_back(corner);
        }
      }
    }
  }
  return sum;
}
}

#endif
