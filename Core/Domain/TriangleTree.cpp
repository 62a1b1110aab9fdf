// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "TriangleTree.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace trivariate
{
namespace
{
using Eigen::Vector3d;

constexpr Index LeafSize = 8;

Vector3d NearestOfSegment(const Vector3d& p, const Vector3d& a, const Vector3d& b)
{
  const Vector3d side = b - a;
  const double square = side.squaredNorm();
  const double along = square > 0.0 ? (p - a).dot(side) / square : 0.0;
  return a + std::min(std::max(along, 0.0), 1.0) * side;
}
}

//------------------------------------------------------------------------------
Vector3d NearestOfTriangle(
  const Vector3d& p, const Vector3d& a, const Vector3d& b, const Vector3d& c)
{
  const Vector3d u = b - a, v = c - a, w = p - a, normal = u.cross(v);
  const double square = normal.squaredNorm();
  if (square > 0.0)
  {
    const double s = w.cross(v).dot(normal) / square, t = u.cross(w).dot(normal) / square;
    if (s >= 0.0 && t >= 0.0 && s + t <= 1.0)
    {
      return a + s * u + t * v;
    }
  }
  Vector3d best = NearestOfSegment(p, a, b);
  for (const Vector3d& other : { NearestOfSegment(p, b, c), NearestOfSegment(p, c, a) })
  {
    if ((other - p).squaredNorm() < (best - p).squaredNorm())
    {
      best = other;
    }
  }
  return best;
}

//------------------------------------------------------------------------------
TriangleTree::TriangleTree(
  const std::vector<Vector3d>& points, const std::vector<Triangle>& triangles)
  : Points(points)
  , Triangles(triangles)
  , Order(triangles.size())
{
  std::iota(this->Order.begin(), this->Order.end(), Index(0));
  std::vector<Vector3d> middles;
  middles.reserve(triangles.size());
  for (const Triangle& c : triangles)
  {
    middles.push_back((points[c[0]] + points[c[1]] + points[c[2]]) / 3.0);
  }
  this->Split(0, static_cast<Index>(triangles.size()), middles);
}

//------------------------------------------------------------------------------
void TriangleTree::Split(Index begin, Index end, const std::vector<Vector3d>& middles)
{
  const std::size_t node = this->Nodes.size();
  Eigen::AlignedBox3d box, spread;
  for (Index i = begin; i < end; ++i)
  {
    for (const Index corner : this->Triangles[this->Order[i]])
    {
      box.extend(this->Points[corner]);
    }
    spread.extend(middles[this->Order[i]]);
  }
  this->Nodes.push_back({ box, begin, end, -1 });
  if (end - begin <= LeafSize)
  {
    return;
  }
  int axis = 0;
  spread.sizes().maxCoeff(&axis);
  const Index middle = begin + (end - begin) / 2;
  std::nth_element(this->Order.begin() + begin, this->Order.begin() + middle,
    this->Order.begin() + end,
    [&middles, axis](Index a, Index b) { return middles[a][axis] < middles[b][axis]; });
  this->Split(begin, middle, middles);
  this->Nodes[node].Right = static_cast<Index>(this->Nodes.size());
  this->Split(middle, end, middles);
}

//------------------------------------------------------------------------------
void TriangleTree::Search(Index number, const Vector3d& p, Foot& best) const
{
  const Node& node = this->Nodes[number];
  if (node.Right < 0)
  {
    for (Index i = node.Begin; i < node.End; ++i)
    {
      const Triangle& c = this->Triangles[this->Order[i]];
      const Vector3d place =
        NearestOfTriangle(p, this->Points[c[0]], this->Points[c[1]], this->Points[c[2]]);
      const double distance = (place - p).norm();
      if (distance < best.Distance)
      {
        best = { place, distance, this->Order[i] };
      }
    }
    return;
  }
  Index near = number + 1, far = node.Right;
  double nearest = this->Nodes[near].Box.exteriorDistance(p);
  double farther = this->Nodes[far].Box.exteriorDistance(p);
  if (farther < nearest)
  {
    std::swap(near, far);
    std::swap(nearest, farther);
  }
  if (nearest < best.Distance)
  {
    this->Search(near, p, best);
  }
  if (farther < best.Distance)
  {
    this->Search(far, p, best);
  }
}

//------------------------------------------------------------------------------
TriangleTree::Foot TriangleTree::Nearest(const Vector3d& p) const
{
  Foot best{ p, std::numeric_limits<double>::infinity(), -1 };
  this->Search(0, p, best);
  return best;
}
}
