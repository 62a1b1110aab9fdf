// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "SimplePoint.h"

#include <array>
#include <cstdlib>

namespace trivariate
{
namespace
{
constexpr std::uint32_t Bit(int i)
{
  return std::uint32_t{ 1 } << i;
}

// Neighbourhoods within the cube of 27 voxels.
struct Neighbourhoods
{
  std::array<std::uint32_t, 27> Six{}, TwentySix{};
  std::uint32_t CentreSix = 0, CentreEighteen = 0, CentreTwentySix = 0;

  Neighbourhoods()
  {
    for (int i = 0; i < 27; ++i)
    {
      for (int j = 0; j < 27; ++j)
      {
        const int x = std::abs(i % 3 - j % 3);
        const int y = std::abs(i / 3 % 3 - j / 3 % 3);
        const int z = std::abs(i / 9 - j / 9);
        this->Six[i] |= x + y + z == 1 ? Bit(j) : 0;
        this->TwentySix[i] |= i != j && x < 2 && y < 2 && z < 2 ? Bit(j) : 0;
        this->CentreEighteen |= i == 13 && i != j && x + y + z < 3 ? Bit(j) : 0;
      }
    }
    this->CentreSix = this->Six[13];
    this->CentreTwentySix = this->TwentySix[13];
  }
};
const Neighbourhoods Around;

// Whether the pieces of `set` that reach `seeds` are exactly one.
bool IsOnePiece(
  std::uint32_t set, std::uint32_t seeds, const std::array<std::uint32_t, 27>& neighbours)
{
  seeds &= set;
  if (!seeds)
  {
    return false;
  }
  std::uint32_t piece = 0, front = seeds & (~seeds + 1);
  while (front)
  {
    piece |= front;
    std::uint32_t next = 0;
    for (; front; front &= front - 1)
    {
      next |= neighbours[__builtin_ctz(front)];
    }
    front = next & set & ~piece;
  }
  return !(seeds & ~piece);
}

// Object and background with 26 and 6 neighbours.
bool IsSimple26(std::uint32_t object, std::uint32_t background)
{
  return IsOnePiece(object & Around.CentreTwentySix, Around.CentreTwentySix, Around.TwentySix) &&
         IsOnePiece(background & Around.CentreEighteen, Around.CentreSix, Around.Six);
}
}

//------------------------------------------------------------------------------
bool IsSimple(std::uint32_t object)
{
  return IsSimple26(object, ~object) && IsSimple26(~object, object);
}
}
