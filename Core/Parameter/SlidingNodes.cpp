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

constexpr Index NodesBetweenChecks = 4096; // whether to go on: less than a second

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
SlidingNodes::SlidingNodes(const DomainSurface& surface, BlockMesh& mesh, double freedom,
  const Execution& execution, Start start)
  : On(&surface)
  , Most(freedom)
{
  this->FindKinds(mesh);
  const Index nodes = static_cast<Index>(mesh.Places.size());
  for (Index first = 0; first < nodes; first += NodesBetweenChecks)
  {
    execution.Check(double(first) / nodes);
    const auto put = [&, first](Index begin, Index end)
    {
      for (Index node = first + begin; node < first + end; ++node)
      {
        Vector3d& place = mesh.Places[node];
        if (this->Kinds[node] == OnSurface)
        {
          this->Feet[node] = start == InPatches
                               ? surface.NearestOnPatch(this->Support[node], place)
                               : surface.NearestOnPieceOf(this->Support[node], place);
        }
        place = this->Allowed(node, place, this->Feet[node]);
      }
    };
    execution.ParallelFor(std::min(NodesBetweenChecks, nodes - first), put);
  }
}

SlidingNodes::SlidingNodes(BlockMesh& mesh, const BlockMesh& coarse, const SlidingNodes& onCoarse)
  : On(onCoarse.On)
  , Most(onCoarse.Most)
{
  this->FindKinds(mesh);
  const std::vector<PatchFace> faces = PatchFaces(this->On->Domain, mesh);
  const std::vector<PatchFace> coarseFaces = PatchFaces(this->On->Domain, coarse);
  for (std::size_t patch = 0; patch < faces.size(); ++patch)
  {
    const auto [ns, nt] = faces[patch].Cells;
    const auto [ms, mt] = coarseFaces[patch].Cells;
    for (int t = 0; t <= nt; ++t)
    {
      for (int s = 0; s <= ns; ++s)
      {
        const Index node = faces[patch].NodeAt(s, t);
        if (this->Kinds[node] == OnSurface)
        {
          const Index from =
            coarseFaces[patch].NodeAt((s * ms + ns / 2) / ns, (t * mt + nt / 2) / nt);
          const Vector3d& start = coarse.Places[from];
          this->Feet[node] = onCoarse.Kinds[from] == OnSurface
                               ? onCoarse.Feet[from]
                               : this->On->NearestOnPatch(static_cast<Index>(patch), start);
        }
      }
    }
  }
  for (std::size_t node = 0; node < mesh.Places.size(); ++node)
  {
    Vector3d& place = mesh.Places[node];
    place = this->Allowed(static_cast<Index>(node), place, this->Feet[node]);
  }
}

void SlidingNodes::FindKinds(const BlockMesh& mesh)
{
  const BlockDomain& domain = this->On->Domain;
  this->Kinds.assign(mesh.Places.size(), Free);
  this->Support.assign(mesh.Places.size(), -1);
  this->Feet.resize(mesh.Places.size());
  const std::vector<PatchFace> faces = PatchFaces(domain, mesh);
  for (std::size_t patch = 0; patch < faces.size(); ++patch)
  {
    for (const Index node : faces[patch].Nodes)
    {
      this->Kinds[node] = OnSurface;
      this->Support[node] = static_cast<Index>(patch);
    }
  }
  for (std::size_t b = 0; b < domain.Blocks.size(); ++b)
  {
    for (int edge = 0; edge < 12; ++edge)
    {
      const std::vector<Index> nodes =
        mesh.EdgeNodes(static_cast<Index>(b), edge / 4, edge % 2, edge / 2 % 2);
      if (!this->On->IsHeld(nodes.front(), nodes.back()) || this->Kinds[nodes.front()] == Free)
      {
        continue;
      }
      this->Kinds[nodes.front()] = this->Kinds[nodes.back()] = Fixed;
      if (nodes.size() < 3 || this->Kinds[nodes[1]] == OnBorder)
      {
        continue;
      }
      for (std::size_t i = 1; i + 1 < nodes.size(); ++i)
      {
        this->Kinds[nodes[i]] = OnBorder;
        this->Support[nodes[i]] = static_cast<Index>(this->Borders.size());
      }
      std::vector<Vector3d>& line = this->Borders.emplace_back();
      for (const Index point : domain.Border(nodes.front(), nodes.back()))
      {
        line.push_back(domain.SurfacePoints[point]);
      }
    }
  }
}

//------------------------------------------------------------------------------
Vector3d SlidingNodes::Allowed(Index node, const Vector3d& place, SurfaceFoot& foot) const
{
  Vector3d direction = Vector3d::UnitX();
  switch (this->Kinds[node])
  {
    case OnSurface:
    {
      foot = this->On->Walk.Nearest(this->Feet[node].Triangle, place);
      const Vector3d off = place - foot.Place;
      return foot.Place + off * std::min(1.0, this->Most / std::max(off.norm(), 1e-300));
    }
    case OnBorder:
      return NearestOfLine(this->Borders[this->Support[node]], place, direction);
    case Fixed:
      return this->On->Domain.Points[node];
    default:
      return place;
  }
}

Matrix3d SlidingNodes::BasisAt(Index node, const Vector3d& place) const
{
  Matrix3d basis = Matrix3d::Identity();
  if (this->Kinds[node] == OnSurface)
  {
    basis.col(2) = this->On->Walk.Normal(this->Feet[node].Triangle);
    Complete(basis, 2);
  }
  else if (this->Kinds[node] == OnBorder)
  {
    Vector3d direction = Vector3d::UnitX();
    NearestOfLine(this->Borders[this->Support[node]], place, direction);
    basis.col(0) = direction;
    Complete(basis, 0);
  }
  return basis;
}
}
