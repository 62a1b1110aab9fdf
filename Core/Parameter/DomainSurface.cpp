// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "DomainSurface.h"

#include <algorithm>
#include <map>

namespace trivariate
{
namespace
{
using Eigen::Vector3d;

constexpr double SharpCosine = 0.643;  // of 50 degrees
constexpr std::size_t MostTested = 40; // points of a border
}

//------------------------------------------------------------------------------
DomainSurface::DomainSurface(const BlockDomain& domain, double scale)
  : Domain(domain)
  , Walk(domain.SurfacePoints, domain.Triangles)
  , Patches(domain.Patches.size())
{
  std::map<std::array<Index, 2>, std::vector<Index>> patchesAt;
  for (std::size_t p = 0; p < domain.Patches.size(); ++p)
  {
    const BlockPatch& patch = domain.Patches[p];
    for (const Index t : patch.Triangles)
    {
      this->Patches[p].Triangles.push_back(domain.Triangles[t]);
    }
    this->Patches[p].Tree =
      std::make_unique<TriangleTree>(domain.SurfacePoints, this->Patches[p].Triangles);
    for (int side = 0; side < 4; ++side)
    {
      const auto [a, b] = std::minmax(patch.Corners[side], patch.Corners[(side + 1) % 4]);
      patchesAt[{ a, b }].push_back(static_cast<Index>(p));
    }
  }
  for (const auto& [ends, patches] : patchesAt)
  {
    if (patches.size() != 2 ||
        this->IsSharp(domain.Border(ends[0], ends[1]), patches[0], patches[1], scale))
    {
      this->HeldBorders.insert(ends);
      this->HeldCorners.insert(ends.begin(), ends.end());
    }
  }
}

bool DomainSurface::IsSharp(
  const std::vector<Index>& border, Index patch, Index other, double scale) const
{
  const std::size_t step = (border.size() + MostTested - 1) / MostTested;
  std::size_t tested = 0, sharp = 0;
  for (std::size_t i = step; i + 1 < border.size(); i += step)
  {
    const auto normalOf = [&](Index of)
    {
      const auto isOf = [this, of](Index t) { return this->Domain.PatchOf[t] == of; };
      return this->Walk.AreaAround(border[i], scale, isOf).normalized().eval();
    };
    ++tested;
    sharp += normalOf(patch).dot(normalOf(other)) < SharpCosine ? 1 : 0;
  }
  return 2 * sharp > tested;
}

//------------------------------------------------------------------------------
bool DomainSurface::IsHeld(Index from, Index to) const
{
  return this->HeldBorders.count({ std::min(from, to), std::max(from, to) }) != 0;
}

SurfaceFoot DomainSurface::NearestOnPatch(Index patch, const Vector3d& place) const
{
  const TriangleTree::Foot foot = this->Patches[patch].Tree->Nearest(place);
  return { this->Domain.Patches[patch].Triangles[foot.Triangle], foot.Place };
}

SurfaceFoot DomainSurface::NearestOnPieceOf(Index patch, const Vector3d& place) const
{
  SurfaceFoot nearest = this->NearestOnPatch(patch, place);
  for (std::size_t other = 0; other < this->Patches.size(); ++other)
  {
    const Index p = static_cast<Index>(other);
    if (p == patch || this->PieceOfPatch(p) != this->PieceOfPatch(patch))
    {
      continue;
    }
    const SurfaceFoot foot = this->NearestOnPatch(p, place);
    if ((foot.Place - place).squaredNorm() < (nearest.Place - place).squaredNorm())
    {
      nearest = foot;
    }
  }
  return nearest;
}
}
