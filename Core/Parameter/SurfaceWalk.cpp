// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "SurfaceWalk.h"

#include "Domain/TriangleTree.h"

#include <algorithm>
#include <limits>
#include <map>

namespace trivariate
{
using Eigen::Vector3d;

//------------------------------------------------------------------------------
SurfaceWalk::SurfaceWalk(
  const std::vector<Vector3d>& points, const std::vector<Triangle>& triangles)
  : Points(points)
  , Triangles(triangles)
  , Pieces(triangles.size(), -1)
  , FanStart(points.size() + 1, 0)
{
  for (const Triangle& c : triangles)
  {
    for (const Index corner : c)
    {
      ++this->FanStart[corner + 1];
    }
  }
  for (std::size_t p = 0; p < points.size(); ++p)
  {
    this->FanStart[p + 1] += this->FanStart[p];
  }
  this->Fans.resize(3 * triangles.size());
  std::vector<Index> end(this->FanStart.begin(), this->FanStart.end() - 1);
  for (std::size_t t = 0; t < triangles.size(); ++t)
  {
    for (const Index corner : triangles[t])
    {
      this->Fans[end[corner]++] = static_cast<Index>(t);
    }
  }
  this->FindPieces();
}

void SurfaceWalk::FindPieces()
{
  std::map<std::array<Index, 2>, std::vector<Index>> edges;
  for (std::size_t t = 0; t < this->Triangles.size(); ++t)
  {
    const Triangle& c = this->Triangles[t];
    for (int k = 0; k < 3; ++k)
    {
      const auto [a, b] = std::minmax(c[k], c[(k + 1) % 3]);
      edges[{ a, b }].push_back(static_cast<Index>(t));
    }
  }
  Index pieces = 0;
  for (std::size_t first = 0; first < this->Triangles.size(); ++first)
  {
    if (this->Pieces[first] >= 0)
    {
      continue;
    }
    std::vector<Index> stack{ static_cast<Index>(first) };
    this->Pieces[first] = pieces;
    while (!stack.empty())
    {
      const Triangle c = this->Triangles[stack.back()];
      stack.pop_back();
      for (int k = 0; k < 3; ++k)
      {
        const auto [a, b] = std::minmax(c[k], c[(k + 1) % 3]);
        const std::vector<Index>& sharing = edges.at({ a, b });
        for (const Index t : sharing)
        {
          if (sharing.size() == 2 && this->Pieces[t] < 0)
          {
            this->Pieces[t] = pieces;
            stack.push_back(t);
          }
        }
      }
    }
    ++pieces;
  }
}

//------------------------------------------------------------------------------
SurfaceFoot SurfaceWalk::Nearest(Index from, const Vector3d& target) const
{
  const auto footOn = [&](Index t)
  {
    const Triangle& c = this->Triangles[t];
    return NearestOfTriangle(target, this->Points[c[0]], this->Points[c[1]], this->Points[c[2]]);
  };
  SurfaceFoot best{ from, footOn(from) };
  double least = (best.Place - target).squaredNorm();
  for (Index at = -1; at != best.Triangle;)
  {
    at = best.Triangle;
    const Vector3d off = target - best.Place, normal = this->Normal(at);
    if (off.cross(normal).squaredNorm() <= 1e-18 * off.squaredNorm())
    {
      break; // not on the edge of the triangle
    }
    for (const Index corner : this->Triangles[at])
    {
      for (Index i = this->FanStart[corner]; i < this->FanStart[corner + 1]; ++i)
      {
        const Index t = this->Fans[i];
        if (this->Pieces[t] != this->Pieces[from])
        {
          continue;
        }
        const Vector3d place = footOn(t);
        if ((place - target).squaredNorm() < least)
        {
          least = (place - target).squaredNorm();
          best = { t, place };
        }
      }
    }
  }
  return best;
}

Vector3d SurfaceWalk::Normal(Index triangle) const
{
  const Triangle& c = this->Triangles[triangle];
  const Vector3d& p = this->Points[c[0]];
  return (this->Points[c[1]] - p).cross(this->Points[c[2]] - p).normalized();
}
}
