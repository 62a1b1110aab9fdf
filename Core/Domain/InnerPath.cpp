// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "InnerPath.h"

#include "TriangleTree.h"

#include <algorithm>
#include <cmath>

namespace trivariate
{
namespace
{
using Eigen::Vector3d;

constexpr double Step = 0.2;          // of an edge
constexpr double Neighbourhood = 2.5; // of an edge, around a corner
constexpr double Turning = 0.15;      // how much of the new direction each step takes on
constexpr int Patience = 12;          // steps without new depth

InnerPath PathFrom(
  const TriangleTree& tree, const Vector3d& corner, Vector3d direction, double step, double deepest)
{
  InnerPath path{ { corner }, { 0.0 } };
  Vector3d place = corner;
  int waited = 0;
  while (path.Reach() < deepest && waited < Patience)
  {
    place += step * direction;
    const TriangleTree::Foot foot = tree.Nearest(place);
    if (foot.Distance > path.Reach())
    {
      path.Places.push_back(place);
      path.Depths.push_back(foot.Distance);
      waited = 0;
    }
    else if (foot.Distance < 0.5 * path.Reach())
    {
      break;
    }
    else
    {
      ++waited;
    }
    if (foot.Distance > 0.0)
    {
      const Vector3d away = (place - foot.Place) / foot.Distance;
      direction = ((1.0 - Turning) * direction + Turning * away).normalized();
    }
  }
  return path;
}
}

//------------------------------------------------------------------------------
double MeanEdge(const SurfaceLayout& layout)
{
  double area = 0.0;
  Index triangles = 0;
  for (std::size_t t = 0; t < layout.Triangles.size(); ++t)
  {
    const Triangle& c = layout.Triangles[t];
    const Vector3d& a = layout.Points[c[0]];
    area += 0.5 * (layout.Points[c[1]] - a).cross(layout.Points[c[2]] - a).norm();
    triangles = std::max(triangles, layout.Origins[t] + 1);
  }
  return std::sqrt(4.0 / std::sqrt(3.0) * area / double(triangles));
}

//------------------------------------------------------------------------------
Vector3d InwardAt(const SurfaceLayout& layout, const Vector3d& corner, double radius)
{
  std::array<Vector3d, 6> normals;
  normals.fill(Vector3d::Zero());
  for (std::size_t t = 0; t < layout.Triangles.size(); ++t)
  {
    const Triangle& c = layout.Triangles[t];
    const Vector3d &p = layout.Points[c[0]], &q = layout.Points[c[1]], &r = layout.Points[c[2]];
    if (((p + q + r) / 3.0 - corner).squaredNorm() < radius * radius)
    {
      normals[layout.PatchLabels[layout.Patches[t]]] += (q - p).cross(r - p);
    }
  }
  Vector3d inward = Vector3d::Zero();
  for (const Vector3d& normal : normals)
  {
    inward -= normal.normalized();
  }
  return inward.normalized();
}

//------------------------------------------------------------------------------
Vector3d InnerPath::At(double depth) const
{
  const auto after = std::lower_bound(this->Depths.begin(), this->Depths.end(), depth);
  if (after == this->Depths.end() || after == this->Depths.begin())
  {
    return after == this->Depths.end() ? this->Places.back() : this->Places.front();
  }
  const std::size_t i = after - this->Depths.begin();
  const double share = (depth - this->Depths[i - 1]) / (this->Depths[i] - this->Depths[i - 1]);
  return (1.0 - share) * this->Places[i - 1] + share * this->Places[i];
}

//------------------------------------------------------------------------------
std::vector<InnerPath> InnerPaths(
  const SurfaceLayout& layout, double edge, double deepest, const Execution& execution)
{
  const TriangleTree tree(layout.Points, layout.Triangles);
  std::vector<InnerPath> paths(layout.Corners.size());
  execution.ParallelFor(static_cast<Index>(paths.size()),
    [&](Index begin, Index end)
    {
      for (Index corner = begin; corner < end; ++corner)
      {
        const Vector3d& place = layout.Points[layout.Corners[corner]];
        paths[corner] = PathFrom(
          tree, place, InwardAt(layout, place, Neighbourhood * edge), Step * edge, deepest);
      }
    });
  execution.Check(1.0);
  return paths;
}
}
