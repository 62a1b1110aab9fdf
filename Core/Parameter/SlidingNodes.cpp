// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "SlidingNodes.h"

#include <algorithm>
#include <limits>

namespace trivariate
{
namespace
{
using Eigen::Matrix3d;
using Eigen::Vector3d;

// Any two unit vectors across a third one.
void Complete(Matrix3d& basis, int from)
{
  int least = 0;
  basis.col(from).cwiseAbs().minCoeff(&least);
  const int second = (from + 1) % 3, third = (from + 2) % 3;
  basis.col(second) = basis.col(from).cross(Vector3d::Unit(least)).normalized();
  basis.col(third) = basis.col(from).cross(basis.col(second));
}

// The nearest point of a polyline, and its direction there.
Vector3d NearestOfLine(const std::vector<Vector3d>& line, const Vector3d& p, Vector3d& direction)
{
  Vector3d best = line.front();
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < line.size(); ++i)
  {
    const Vector3d along = line[i] - line[i - 1];
    const double square = along.squaredNorm();
    if (square == 0.0)
    {
      continue;
    }
    const double t = std::clamp((p - line[i - 1]).dot(along) / square, 0.0, 1.0);
    const Vector3d place = line[i - 1] + t * along;
    if ((place - p).squaredNorm() < least)
    {
      least = (place - p).squaredNorm();
      best = place;
      direction = along / std::sqrt(square);
    }
  }
  return best;
}
}

//------------------------------------------------------------------------------
SlidingNodes::SlidingNodes(const BlockDomain& domain, const BlockMesh& mesh)
  : Domain(domain)
  , Homes(mesh.Places)
  , Kinds(mesh.Places.size(), Free)
  , Support(mesh.Places.size(), -1)
  , Patches(domain.Patches.size())
{
  const auto hold = [this](Index node, Kind kind, Index support)
  {
    if (kind > this->Kinds[node])
    {
      this->Kinds[node] = kind;
      this->Support[node] = support;
    }
  };
  for (std::size_t p = 0; p < domain.Patches.size(); ++p)
  {
    for (const Index t : domain.Patches[p].Triangles)
    {
      this->Patches[p].Triangles.push_back(domain.Triangles[t]);
    }
    this->Patches[p].Tree =
      std::make_unique<TriangleTree>(domain.SurfacePoints, this->Patches[p].Triangles);
    for (const Index corner : domain.Patches[p].Corners)
    {
      hold(corner, Fixed, -1);
    }
  }
  for (std::size_t b = 0; b < domain.Blocks.size(); ++b)
  {
    for (int face = 0; face < 6; ++face)
    {
      const Index patch = domain.PatchOn(FacePoints(domain.Blocks[b], face / 2, face % 2));
      if (patch >= 0)
      {
        for (const Index node : mesh.FaceNodes(b, face / 2, face % 2))
        {
          hold(node, OnPatch, patch);
        }
      }
    }
    for (int edge = 0; edge < 12; ++edge)
    {
      const std::vector<Index> nodes = mesh.EdgeNodes(b, edge / 4, edge % 2, edge / 2 % 2);
      const std::vector<Index> border = domain.Border(nodes.front(), nodes.back());
      if (nodes.size() < 3 || border.empty() || this->Kinds[nodes[1]] == OnBorder)
      {
        continue;
      }
      for (std::size_t i = 1; i + 1 < nodes.size(); ++i)
      {
        hold(nodes[i], OnBorder, static_cast<Index>(this->Borders.size()));
      }
      std::vector<Vector3d>& line = this->Borders.emplace_back();
      for (const Index point : border)
      {
        line.push_back(domain.SurfacePoints[point]);
      }
    }
  }
}

//------------------------------------------------------------------------------
Vector3d SlidingNodes::Allowed(Index node, const Vector3d& place) const
{
  Vector3d direction = Vector3d::UnitX();
  switch (this->Kinds[node])
  {
    case OnPatch:
      return this->Patches[this->Support[node]].Tree->Nearest(place).Place;
    case OnBorder:
      return NearestOfLine(this->Borders[this->Support[node]], place, direction);
    case Fixed:
      return this->Domain.Points[node];
    default:
      return place;
  }
}

Vector3d SlidingNodes::Allowed(Index node, const Vector3d& place, Matrix3d& basis) const
{
  basis.setIdentity();
  if (this->Kinds[node] == OnPatch)
  {
    const PatchSurface& patch = this->Patches[this->Support[node]];
    const TriangleTree::Foot foot = patch.Tree->Nearest(place);
    const Triangle& c = patch.Triangles[foot.Triangle];
    const std::vector<Vector3d>& points = this->Domain.SurfacePoints;
    basis.col(2) = (points[c[1]] - points[c[0]]).cross(points[c[2]] - points[c[0]]).normalized();
    Complete(basis, 2);
    return foot.Place;
  }
  if (this->Kinds[node] == OnBorder)
  {
    Vector3d direction = Vector3d::UnitX();
    const Vector3d nearest = NearestOfLine(this->Borders[this->Support[node]], place, direction);
    basis.col(0) = direction;
    Complete(basis, 0);
    return nearest;
  }
  return this->Allowed(node, place);
}

void SlidingNodes::SendHome(std::vector<Vector3d>& places) const
{
  for (std::size_t node = 0; node < places.size(); ++node)
  {
    places[node] = this->Kinds[node] == Free ? places[node] : this->Homes[node];
  }
}
}
