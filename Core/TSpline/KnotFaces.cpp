// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "KnotFaces.h"

#include <algorithm>

namespace trivariate
{
namespace
{
constexpr std::uint8_t InHole = 8;
}

//------------------------------------------------------------------------------
KnotFaces::KnotFaces(const TSpline& spline)
{
  Index count = 1;
  for (int a = 0; a < 3; ++a)
  {
    this->Size[a] = static_cast<Index>(spline.KnotLines[a].size()) - 1;
    this->Step[a] = count;
    count *= this->Size[a];
  }
  this->Bits.assign(count, 0);
  for (const BlendingFunction& f : spline.Functions)
  {
    for (int a = 0; a < 3; ++a)
    {
      for (const std::int32_t knot : f[a])
      {
        this->Insert(f, a, knot);
      }
    }
  }
  for (const IndexBox& hole : spline.Holes)
  {
    for (Index k = hole.Low[2]; k < hole.High[2]; ++k)
    {
      for (Index j = hole.Low[1]; j < hole.High[1]; ++j)
      {
        std::uint8_t* row = &this->Bits[j * this->Step[1] + k * this->Step[2]];
        std::for_each(
          row + hole.Low[0], row + hole.High[0], [](std::uint8_t& bits) { bits |= InHole; });
      }
    }
  }
}

//------------------------------------------------------------------------------
void KnotFaces::Insert(const BlendingFunction& f, int direction, std::int32_t knot)
{
  if (knot <= 0 || knot >= this->Size[direction])
  {
    return; // the domain's own boundary needs no face
  }
  const int b = direction == 0 ? 1 : 0;
  const int c = direction == 2 ? 1 : 2;
  const auto bit = static_cast<std::uint8_t>(1u << direction);
  for (Index k = f[c][0]; k < f[c][4]; ++k)
  {
    std::uint8_t* row = &this->Bits[knot * this->Step[direction] + k * this->Step[c]];
    for (Index j = f[b][0]; j < f[b][4]; ++j)
    {
      row[j * this->Step[b]] |= bit;
    }
  }
}

//------------------------------------------------------------------------------
bool KnotFaces::Crosses(const BlendingFunction& f, int direction, std::int32_t knot) const
{
  const int b = direction == 0 ? 1 : 0;
  const int c = direction == 2 ? 1 : 2;
  const auto bit = static_cast<std::uint8_t>(1u << direction);
  bool isFace = false;
  for (Index k = f[c][0]; k < f[c][4]; ++k)
  {
    const std::uint8_t* row = &this->Bits[knot * this->Step[direction] + k * this->Step[c]];
    for (Index j = f[b][0]; j < f[b][4]; ++j)
    {
      const std::uint8_t bits = row[j * this->Step[b]];
      if (!(bits & (bit | InHole)))
      {
        return false;
      }
      isFace = isFace || !(bits & InHole);
    }
  }
  return isFace;
}

//------------------------------------------------------------------------------
std::int32_t KnotFaces::FindCrossing(const BlendingFunction& f, int& direction) const
{
  for (direction = 0; direction < 3; ++direction)
  {
    const LocalKnots& k = f[direction];
    for (std::int32_t knot = k[0] + 1; knot < k[4]; ++knot)
    {
      if (std::find(k.begin() + 1, k.begin() + 4, knot) == k.begin() + 4 &&
          this->Crosses(f, direction, knot))
      {
        return knot;
      }
    }
  }
  return -1;
}
}
