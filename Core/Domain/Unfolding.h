// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// Rows of triangles laid out in the plane, one after the other: what a straight path sees.
#ifndef trivariate_Unfolding_h
#define trivariate_Unfolding_h

#include "GeodesicSleeve.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <limits>

namespace trivariate
{
using Point2 = Eigen::Vector2d;

inline double Cross(const Point2& a, const Point2& b)
{
  return a.x() * b.y() - a.y() * b.x();
}

inline Index LeftOf(const LayoutMesh& mesh, Crossing h)
{
  return mesh.Triangles[h / 3][(h % 3 + 1) % 3];
}

inline Index RightOf(const LayoutMesh& mesh, Crossing h)
{
  return mesh.Triangles[h / 3][h % 3];
}

// A triangle entered through a crossing: its two ways out, and its far corner.
struct Entered
{
  Crossing LeftExit, RightExit;
  Index Apex;
};

inline Entered Enter(const LayoutMesh& mesh, Crossing h)
{
  const Index t = mesh.Neighbour(h / 3, h % 3);
  const int side = mesh.SideAcross(h / 3, h % 3);
  return { 3 * t + (side + 2) % 3, 3 * t + (side + 1) % 3, mesh.Triangles[t][(side + 2) % 3] };
}

// The far corner of the next triangle, unfolded into the plane of the ones before.
inline Point2 Unfold(
  const LayoutMesh& mesh, Crossing h, Index apex, const Point2& left, const Point2& right)
{
  const Eigen::Vector3d& origin = mesh.Points[RightOf(mesh, h)];
  const Eigen::Vector3d edge = mesh.Points[LeftOf(mesh, h)] - origin;
  const Eigen::Vector3d toApex = mesh.Points[apex] - origin;
  const double square = std::max(edge.squaredNorm(), std::numeric_limits<double>::min());
  const Point2 along = left - right, outward(along.y(), -along.x());
  return right + edge.dot(toApex) / square * along + edge.cross(toApex).norm() / square * outward;
}
}

#endif
