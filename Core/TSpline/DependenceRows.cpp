// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "DependenceRows.h"

#include "BlendingFunctionMap.h"
#include "DualCompatibility.h"
#include "SupportTree.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace trivariate
{
namespace
{
// Coefficients below this are zeros that rounding has blurred; others are at least a power of two
// of the levels between two knots.
constexpr double Zero = 1e-12;

// A unit cell in the support of f: next to its centre in the central round, else anywhere in one of
// its knot spans.
GridIndex PlaceOf(const BlendingFunction& f, unsigned round)
{
  GridIndex place;
  for (int a = 0; a < 3; ++a)
  {
    const LocalKnots& k = f[a];
    if (round == CentralRound)
    {
      place[a] = k[2] < k[4] ? k[2] : k[2] - 1;
      continue;
    }
    const std::array<std::int32_t, 9> key{ f[0][1], f[0][2], f[1][2], f[1][3], f[2][2], f[2][3],
      k[4], static_cast<std::int32_t>(round), a };
    const std::size_t hash = HashKnots(key) >> 16;
    std::size_t span = hash % 4;
    while (k[span] == k[span + 1])
    {
      span = (span + 1) % 4;
    }
    place[a] = k[span] + static_cast<std::int32_t>((hash >> 2) % (k[span + 1] - k[span]));
  }
  return place;
}

// A place, the functions that are active there, and those of them whose rows are taken there.
struct Site
{
  GridIndex Place;
  std::vector<int> Active, Rows;
};

// A site for each function, which is empty for those that another site serves: one with at most
// `share` active functions serves them all.
std::vector<Site> MakeSites(const std::vector<BlendingFunction>& functions, unsigned round,
  std::size_t share, const Execution& execution)
{
  const SupportTree tree(functions);
  std::vector<Site> sites(functions.size());
  execution.ParallelFor(static_cast<Index>(sites.size()),
    [&](Index begin, Index end)
    {
      for (Index i = begin; i < end; ++i)
      {
        Site& site = sites[i];
        const GridIndex& low = site.Place = PlaceOf(functions[i], round);
        tree.Query({ low, { low[0] + 1, low[1] + 1, low[2] + 1 } },
          [&site](Index j) { site.Active.push_back(static_cast<int>(j)); });
      }
    });
  std::vector<char> served(functions.size(), false);
  for (int i = 0; i < static_cast<int>(sites.size()); ++i)
  {
    const auto serve = [&](int j)
    {
      if (!served[j])
      {
        served[j] = true;
        sites[i].Rows.push_back(j);
      }
    };
    if (!served[i])
    {
      serve(i);
      if (sites[i].Active.size() <= share)
      {
        std::for_each(sites[i].Active.begin(), sites[i].Active.end(), serve);
      }
    }
  }
  return sites;
}

// One row for each function i: coefficient(i, j, place) for all j that are active at i's place,
// without the zeros.
template <typename Coefficient>
DependenceRows MakeRows(const TSpline& spline, const std::vector<Index>& functions, unsigned round,
  std::size_t share, const Execution& execution, const Coefficient& coefficient)
{
  std::vector<BlendingFunction> knots;
  for (const Index i : functions)
  {
    knots.push_back(spline.Functions[i]);
  }
  const std::vector<Site> sites = MakeSites(knots, round, share, execution);
  DependenceRows rows(knots.size());
  execution.ParallelFor(static_cast<Index>(sites.size()),
    [&](Index begin, Index end)
    {
      for (Index s = begin; s < end; ++s)
      {
        for (const int i : sites[s].Rows)
        {
          for (const int j : sites[s].Active)
          {
            const double value = coefficient(knots[i], knots[j], sites[s].Place);
            if (value != 0.0)
            {
              rows[i].push_back({ j, value });
            }
          }
        }
      }
    });
  return rows;
}
}

//------------------------------------------------------------------------------
DependenceRows MakeDependenceRows(const TSpline& spline, const std::vector<Index>& functions,
  unsigned round, const Execution& execution)
{
  // Of all functions there are 64 or more at each place. Where it is 64, their rows make a block of
  // its own; later, when a few are left of the functions at each place, rows from many places are
  // worth more.
  const std::size_t share = round == FirstSearchRound ? 64 : 1;
  return MakeRows(spline, functions, round, share, execution,
    [&spline](const BlendingFunction& f, const BlendingFunction& g, const GridIndex& place)
    {
      double value = DualCompatible(f, g) ? 0.0 : 1.0;
      for (int a = 0; a < 3 && value != 0.0; ++a)
      {
        value *= DualOf(f[a], g[a], place[a], spline.KnotLines[a]);
      }
      return std::abs(value) < Zero ? 0.0 : value;
    });
}

//------------------------------------------------------------------------------
DependenceRows MakeValueRows(const TSpline& spline, const std::vector<Index>& functions,
  unsigned round, const Execution& execution)
{
  // Where in its unit cell a point lies: elsewhere in each round, as a polynomial of degree three
  // takes four places in a direction to tell from zero.
  const std::array<double, 3> inUnit = { std::fmod(0.3 + 0.754877666 * round, 1.0),
    std::fmod(0.6 + 0.569840291 * round, 1.0), std::fmod(0.4 + 0.430159709 * round, 1.0) };
  return MakeRows(spline, functions, round, 1, execution,
    [&](const BlendingFunction&, const BlendingFunction& g, const GridIndex& place)
    {
      double value = 1.0;
      for (int a = 0; a < 3; ++a)
      {
        const KnotLine& line = spline.KnotLines[a];
        const double low = line[place[a]], high = line[place[a] + 1];
        const double x = low + inUnit[a] * (high - low);
        value *= BlossomAround(g[a], place[a], line, x, x, x);
      }
      return value;
    });
}

//------------------------------------------------------------------------------
std::vector<std::vector<int>> SolvableBlocks(const DependenceRows& rows)
{
  struct Visit
  {
    int Row;
    std::size_t Next; // entry to follow
  };
  constexpr int Unseen = -1;
  std::vector<int> number(rows.size(), Unseen), lowest(rows.size());
  std::vector<char> waits(rows.size(), false); // on `path`, in no block yet
  std::vector<int> path;
  std::vector<Visit> visits;
  std::vector<std::vector<int>> blocks;
  int count = 0;
  const auto enter = [&](int row)
  {
    number[row] = lowest[row] = count++;
    path.push_back(row);
    waits[row] = true;
    visits.push_back({ row, 0 });
  };
  for (int root = 0; root < static_cast<int>(rows.size()); ++root)
  {
    if (number[root] == Unseen)
    {
      enter(root);
    }
    while (!visits.empty())
    {
      const int row = visits.back().Row;
      if (visits.back().Next < rows[row].size())
      {
        const int column = rows[row][visits.back().Next++].Column;
        if (number[column] == Unseen)
        {
          enter(column);
        }
        else if (waits[column])
        {
          lowest[row] = std::min(lowest[row], number[column]);
        }
        continue;
      }
      visits.pop_back();
      if (!visits.empty())
      {
        const int parent = visits.back().Row;
        lowest[parent] = std::min(lowest[parent], lowest[row]);
      }
      if (lowest[row] == number[row])
      {
        const auto first = std::find(path.rbegin(), path.rend(), row).base() - 1;
        blocks.emplace_back(first, path.end());
        path.erase(first, path.end());
        for (const int member : blocks.back())
        {
          waits[member] = false;
        }
      }
    }
  }
  return blocks;
}
}
