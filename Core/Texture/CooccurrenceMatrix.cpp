// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "CooccurrenceMatrix.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <tuple>

namespace trivariate
{
namespace
{
// 2^b, the finest unit in which sums up to `largest` fit into 63 bits; double has no finer ones.
double FinestUnit(double largest)
{
  return std::ldexp(1.0, std::min(52, 61 - std::ilogb(std::max(largest, 1.0))));
}
}

//------------------------------------------------------------------------------
const std::array<PairDirection, 13>& PairDirections()
{
  static const std::array<PairDirection, 13> directions = { { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 },
    { 1, 1, 0 }, { 1, -1, 0 }, { 1, 0, 1 }, { 1, 0, -1 }, { 0, 1, 1 }, { 0, 1, -1 }, { 1, 1, 1 },
    { 1, 1, -1 }, { 1, -1, 1 }, { 1, -1, -1 } } };
  return directions;
}

//------------------------------------------------------------------------------
void AddPairs(const std::uint8_t* levels, const std::array<Index, 3>& size, const VoxelBox& box,
  const PairDirection& direction, CooccurrenceMatrix& matrix, const std::uint8_t* mask)
{
  // The first voxels of the pairs.
  VoxelBox firsts = box;
  for (int a = 0; a < 3; ++a)
  {
    firsts.Begin[a] += std::max(0, -direction[a]);
    firsts.End[a] -= std::max(0, direction[a]);
  }
  const Index step = (direction[2] * size[1] + direction[1]) * size[0] + direction[0];
  for (Index z = firsts.Begin[2]; z < firsts.End[2]; ++z)
  {
    for (Index y = firsts.Begin[1]; y < firsts.End[1]; ++y)
    {
      const Index row = (z * size[1] + y) * size[0];
      for (Index at = row + firsts.Begin[0]; at < row + firsts.End[0]; ++at)
      {
        if (!mask || (mask[at] && mask[at + step]))
        {
          matrix.Add(levels[at], levels[at + step]);
        }
      }
    }
  }
}

//------------------------------------------------------------------------------
CooccurrenceUnits::CooccurrenceUnits(Index pairs)
  : Logarithm(FinestUnit(2.0 * pairs * std::log2(2.0 * std::max<Index>(pairs, 1))))
  , Inverse(FinestUnit(pairs))
{
}

//------------------------------------------------------------------------------
std::int64_t CooccurrenceUnits::NLogN(Index n) const
{
  // More exact than double: differences of the sums are to be exact to the unit.
  const long double exact = n;
  return n > 1 ? std::llround(exact * std::log2(exact) * this->Logarithm) : 0;
}

//------------------------------------------------------------------------------
std::array<std::int64_t, 5> CooccurrenceUnits::InverseWeights(int d, int levels) const
{
  const double part = static_cast<double>(d) / levels;
  const double square = static_cast<double>(d) * d;
  const std::array<double, 5> weights = { 1.0 / (1.0 + d), 1.0 / (1.0 + part), 1.0 / (1.0 + square),
    1.0 / (1.0 + part * part), d > 0 ? 1.0 / square : 0.0 };
  std::array<std::int64_t, 5> integers;
  std::transform(weights.begin(), weights.end(), integers.begin(),
    [this](double weight) { return std::llround(weight * this->Inverse); });
  return integers;
}

//------------------------------------------------------------------------------
bool CooccurrenceSums::operator==(const CooccurrenceSums& other) const
{
  const auto tie = [](const CooccurrenceSums& s)
  {
    return std::tie(s.JointLogarithms, s.SumLogarithms, s.DifferenceLogarithms, s.LevelLogarithms,
      s.TotalLogarithm, s.Squares, s.LargestCount, s.Sums, s.Differences, s.Inverses, s.EqualPairs,
      s.Pairs, s.Units.Logarithm, s.Units.Inverse, s.Levels);
  };
  return tie(*this) == tie(other);
}

//------------------------------------------------------------------------------
CooccurrenceSums SumsOf(const CooccurrenceMatrix& matrix)
{
  const int levels = matrix.Levels;
  CooccurrenceSums sums;
  sums.Levels = levels;
  for (int i = 0; i < levels; ++i)
  {
    sums.EqualPairs += matrix(i, i) / 2;
    for (int j = 0; j < levels; ++j)
    {
      sums.Pairs += matrix(i, j);
    }
  }
  sums.Pairs /= 2;
  sums.Units = CooccurrenceUnits(sums.Pairs);
  sums.TotalLogarithm = sums.Units.NLogN(2 * sums.Pairs);

  std::vector<Index> bySum(2 * levels), byDifference(levels), byLevel(levels);
  for (int i = 0; i < levels; ++i)
  {
    for (int j = 0; j < levels; ++j)
    {
      const Index count = matrix(i, j);
      byLevel[i] += count;
      sums.Squares += count * count;
      sums.LargestCount = std::max(sums.LargestCount, count);
      if (i <= j)
      {
        const Index pairs = i == j ? count / 2 : count;
        sums.JointLogarithms += sums.Units.NLogN(pairs);
        bySum[i + j] += pairs;
        byDifference[j - i] += pairs;
      }
    }
  }
  for (int s = 0; s < 2 * levels; ++s)
  {
    std::int64_t power = bySum[s];
    for (std::int64_t& sum : sums.Sums)
    {
      power *= s + 2; // levels are counted from 1
      sum += power;
    }
    sums.SumLogarithms += sums.Units.NLogN(bySum[s]);
  }
  for (int d = 0; d < levels; ++d)
  {
    sums.Differences[0] += byDifference[d] * d;
    sums.Differences[1] += byDifference[d] * d * d;
    const std::array<std::int64_t, 5> weights = sums.Units.InverseWeights(d, levels);
    for (int k = 0; k < 5; ++k)
    {
      sums.Inverses[k] += byDifference[d] * weights[k];
    }
    sums.DifferenceLogarithms += sums.Units.NLogN(byDifference[d]);
    sums.LevelLogarithms += sums.Units.NLogN(byLevel[d]);
  }
  return sums;
}
}
