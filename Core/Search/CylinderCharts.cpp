// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "CylinderCharts.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace trivariate
{
namespace
{
constexpr double TwoPi = 6.283185307179586;
constexpr int Bins = 64; // of the angle
constexpr int LeastBins = Bins / 32;
constexpr double LeastCap = 0.02, LargestCap = 0.4;
constexpr ChartLabel LowCap = 4, HighCap = 5;
constexpr std::array<ChartLabel, 4> Sides{ 1, 3, 0, 2 }; // +u, +v, -u, -v

int BinOf(double angle)
{
  return std::clamp(static_cast<int>(Bins * angle / TwoPi), 0, Bins - 1);
}

using BinSums = std::array<std::array<double, Bins>, 4>;

// The first bin of each side such that the sides' sums are largest, the first side beginning at
// `first`: dynamic programming over the ends of the sides.
double CutTurn(const BinSums& sums, int first, std::array<int, 4>& begins)
{
  constexpr double never = -std::numeric_limits<double>::infinity();
  std::array<std::array<double, Bins + 1>, 5> best;
  std::array<std::array<int, Bins + 1>, 5> from{};
  for (auto& row : best)
  {
    row.fill(never);
  }
  best[0][0] = 0.0;
  for (int side = 0; side < 4; ++side)
  {
    for (int begin = 0; begin < Bins; ++begin)
    {
      double sum = best[side][begin];
      for (int end = begin + 1; sum > never && end <= Bins; ++end)
      {
        sum += sums[side][(first + end - 1) % Bins];
        if (end - begin >= LeastBins && sum > best[side + 1][end])
        {
          best[side + 1][end] = sum;
          from[side + 1][end] = begin;
        }
      }
    }
  }
  for (int side = 3, end = Bins; side >= 0; --side)
  {
    end = from[side + 1][end];
    begins[side] = (first + end) % Bins;
  }
  return best[4][Bins];
}

std::array<ChartLabel, Bins> LabelTurn(
  const std::vector<CylinderCell>& cells, const std::vector<std::array<double, 6>>& rewards)
{
  BinSums sums{};
  for (std::size_t t = 0; t < cells.size(); ++t)
  {
    for (int side = 0; side < 4; ++side)
    {
      sums[side][BinOf(cells[t].Angle)] += rewards[t][Sides[side]];
    }
  }
  double most = -std::numeric_limits<double>::infinity();
  std::array<int, 4> begins{}, trial{};
  for (int first = 0; first < Bins; ++first)
  {
    const double sum = CutTurn(sums, first, trial);
    if (sum > most)
    {
      most = sum;
      begins = trial;
    }
  }
  std::array<ChartLabel, Bins> label;
  for (int side = 0; side < 4; ++side)
  {
    for (int bin = begins[side]; bin != begins[(side + 1) % 4]; bin = (bin + 1) % Bins)
    {
      label[bin] = Sides[side];
    }
  }
  return label;
}
}

//------------------------------------------------------------------------------
std::vector<std::size_t> OrderByHeight(const std::vector<CylinderCell>& cells)
{
  std::vector<std::size_t> order(cells.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
    [&cells](std::size_t a, std::size_t b) { return cells[a].Height < cells[b].Height; });
  return order;
}

//------------------------------------------------------------------------------
std::vector<ChartLabel> LabelCylinder(const std::vector<CylinderCell>& cells,
  const std::vector<std::size_t>& order, const std::vector<double>& areas,
  const std::vector<std::array<double, 6>>& rewards)
{
  const std::array<ChartLabel, Bins> turn = LabelTurn(cells, rewards);
  std::vector<ChartLabel> labels(cells.size());
  for (std::size_t t = 0; t < cells.size(); ++t)
  {
    labels[t] = turn[BinOf(cells[t].Angle)];
  }
  // From each end inwards, as long as the cap's own rewards exceed those of the sides.
  const double area = std::accumulate(areas.begin(), areas.end(), 0.0);
  const auto cutCap = [&](ChartLabel cap, auto begin, auto end)
  {
    double covered = 0.0, gain = 0.0, most = -std::numeric_limits<double>::infinity();
    auto rim = begin;
    for (auto t = begin; t != end && covered <= LargestCap * area; ++t)
    {
      covered += areas[*t];
      gain += rewards[*t][cap] - rewards[*t][labels[*t]];
      if (covered >= LeastCap * area && gain > most)
      {
        most = gain;
        rim = t + 1;
      }
    }
    return rim;
  };
  const auto low = cutCap(LowCap, order.begin(), order.end());
  const auto high = cutCap(HighCap, order.rbegin(), order.rend());
  std::for_each(order.begin(), low, [&labels](std::size_t t) { labels[t] = LowCap; });
  std::for_each(order.rbegin(), high, [&labels](std::size_t t) { labels[t] = HighCap; });
  return labels;
}
}
