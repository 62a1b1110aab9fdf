// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "CellShape.h"

#include "Domain/SimplePoint.h"

#include <algorithm>

namespace trivariate
{
namespace
{
// Whether of eight cells around a point, first axis fastest, some that are full touch at an edge or
// at the point only, or some that are empty do.
bool AreWellComposed(unsigned full)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    const int a = 1 << axis, b = 1 << (axis + 1) % 3, c = 1 << (axis + 2) % 3;
    for (const int layer : { 0, c })
    {
      const auto isFull = [full, layer](int cell) { return full >> (layer + cell) & 1u; };
      if (isFull(0) == isFull(a + b) && isFull(a) == isFull(b) && isFull(0) != isFull(a))
      {
        return false;
      }
    }
  }
  for (int cell = 0; cell < 4; ++cell)
  {
    const unsigned pair = 1u << cell | 1u << (7 - cell);
    if (full == pair || full == (~pair & 255u))
    {
      return false;
    }
  }
  return true;
}
}

//------------------------------------------------------------------------------
CellShape::CellShape(const std::array<int, 3>& size, std::vector<double> gains)
  : Size{ size[0] + 2, size[1] + 2, size[2] + 2 }
  , Gains(std::size_t(this->Size[0]) * this->Size[1] * this->Size[2], 0.0)
  , Full(this->Gains.size(), 0)
{
  const std::ptrdiff_t row = this->Size[0], layer = row * this->Size[1];
  std::size_t given = 0;
  for (int k = 1; k <= size[2]; ++k)
  {
    for (int j = 1; j <= size[1]; ++j)
    {
      for (int i = 1; i <= size[0]; ++i)
      {
        this->Cells.push_back(i + row * j + layer * k);
        this->Gains[this->Cells.back()] = gains[given++];
      }
    }
  }
  for (int i = 0; i < 27; ++i)
  {
    this->Around[i] = i % 3 - 1 + row * (i / 3 % 3 - 1) + layer * (i / 9 - 1);
  }
}

//------------------------------------------------------------------------------
bool CellShape::CanChange(std::size_t cell) const
{
  std::uint32_t object = 0;
  for (int i = 0; i < 27; ++i)
  {
    object |= std::uint32_t(this->Full[cell + this->Around[i]]) << i;
  }
  if (!IsSimple(object))
  {
    return false;
  }
  object ^= 1u << 13;
  for (int corner = 0; corner < 8; ++corner)
  {
    unsigned eight = 0;
    for (int i = 0; i < 8; ++i)
    {
      const int place =
        corner % 2 + i % 2 + 3 * (corner / 2 % 2 + i / 2 % 2) + 9 * (corner / 4 + i / 4);
      eight |= (object >> place & 1u) << i;
    }
    if (!AreWellComposed(eight))
    {
      return false;
    }
  }
  return true;
}

//------------------------------------------------------------------------------
bool CellShape::ChangePair()
{
  double most = 0.0;
  std::array<std::size_t, 2> best{ 0, 0 };
  for (const std::size_t first : this->Cells)
  {
    if (!this->CanChange(first))
    {
      continue;
    }
    const double gain = this->Change(first);
    for (const std::ptrdiff_t step : this->Around)
    {
      const std::size_t second = first + step;
      if (this->Gains[second] != 0.0 && gain + this->GainOf(second) > most &&
          this->CanChange(second))
      {
        most = gain + this->GainOf(second);
        best = { first, second };
      }
    }
    this->Change(first);
  }
  if (most > 0.0)
  {
    this->Change(best[0]);
    this->Change(best[1]);
  }
  return most > 0.0;
}

//------------------------------------------------------------------------------
// Returns the sum of the gains of full cells. Each change raises it.
double CellShape::Improve()
{
  std::vector<std::size_t> order = this->Cells;
  const auto better = [this](std::size_t a, std::size_t b)
  { return std::abs(this->Gains[a]) > std::abs(this->Gains[b]); };
  std::stable_sort(order.begin(), order.end(), better);
  const auto changeOne = [this, &order]()
  {
    const auto cell = std::find_if(order.begin(), order.end(),
      [this](std::size_t c) { return this->GainOf(c) > 0.0 && this->CanChange(c); });
    if (cell != order.end())
    {
      this->Change(*cell);
    }
    return cell != order.end();
  };
  while (changeOne() || this->ChangePair())
  {
  }
  double sum = 0.0;
  for (const std::size_t cell : this->Cells)
  {
    sum += this->Full[cell] ? this->Gains[cell] : 0.0;
  }
  return sum;
}

//------------------------------------------------------------------------------
std::vector<LatticePoint> CellShape::Best()
{
  const auto seed = std::max_element(this->Cells.begin(), this->Cells.end(),
    [this](std::size_t a, std::size_t b) { return this->Gains[a] < this->Gains[b]; });
  std::fill(this->Full.begin(), this->Full.end(), 0);
  this->Full[*seed] = 1;
  const double grown = this->Improve();
  const std::vector<std::uint8_t> first = this->Full;
  for (const std::size_t cell : this->Cells)
  {
    this->Full[cell] = 1;
  }
  if (this->Improve() <= grown)
  {
    this->Full = first;
  }
  std::vector<LatticePoint> full;
  for (const std::size_t cell : this->Cells)
  {
    if (this->Full[cell])
    {
      const int place = static_cast<int>(cell);
      full.push_back({ place % this->Size[0] - 1, place / this->Size[0] % this->Size[1] - 1,
        place / this->Size[0] / this->Size[1] - 1 });
    }
  }
  return full;
}
}
