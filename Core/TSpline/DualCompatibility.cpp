// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "DualCompatibility.h"

#include <algorithm>
#include <numeric>
#include <sstream>
#include <tuple>

namespace trivariate
{
namespace
{
void Print(std::ostream& out, const BlendingFunction& f)
{
  for (int a = 0; a < 3; ++a)
  {
    out << (a == 0 ? "[" : " x [");
    for (int k = 0; k < 5; ++k)
    {
      out << (k == 0 ? "" : " ") << f[a][k];
    }
    out << "]";
  }
}
}

//------------------------------------------------------------------------------
double BlossomAround(
  const LocalKnots& k, std::int32_t unit, const KnotLine& line, double x1, double x2, double x3)
{
  int span = 3;
  while (k[span] > unit)
  {
    --span;
  }
  return Blossom({ line[k[0]], line[k[1]], line[k[2]], line[k[3]], line[k[4]] }, span, x1, x2, x3);
}

//------------------------------------------------------------------------------
double DualOf(const LocalKnots& a, const LocalKnots& b, std::int32_t unit, const KnotLine& line)
{
  return a == b ? 1.0 : BlossomAround(b, unit, line, line[a[1]], line[a[2]], line[a[3]]);
}

//------------------------------------------------------------------------------
bool DualCompatible(const BlendingFunction& f, const BlendingFunction& g)
{
  for (int a = 0; a < 3; ++a)
  {
    if (f[a] != g[a] && Overlap(f[a], g[a]))
    {
      return true;
    }
  }
  return false;
}

//------------------------------------------------------------------------------
std::string CheckDualCompatibility(const TSpline& spline)
{
  // Sorted by where the supports begin in w, so that the functions that one can meet follow it.
  std::vector<Index> order(spline.Functions.size());
  std::iota(order.begin(), order.end(), Index(0));
  std::sort(order.begin(), order.end(),
    [&spline](Index i, Index j)
    {
      return std::make_pair(spline.Functions[i][2][0], i) <
             std::make_pair(spline.Functions[j][2][0], j);
    });
  std::pair<Index, Index> first{ spline.Size(), spline.Size() };
  for (std::size_t p = 0; p < order.size(); ++p)
  {
    const BlendingFunction& f = spline.Functions[order[p]];
    for (std::size_t q = p + 1; q < order.size(); ++q)
    {
      const BlendingFunction& g = spline.Functions[order[q]];
      if (g[2][0] >= f[2][4])
      {
        break;
      }
      if (SupportsMeet(f[0], g[0]) && SupportsMeet(f[1], g[1]) && !DualCompatible(f, g))
      {
        first = std::min<std::pair<Index, Index>>(first, std::minmax(order[p], order[q]));
      }
    }
  }
  if (first.first == spline.Size())
  {
    return {};
  }
  std::ostringstream message;
  message << "Blending functions " << first.first << " and " << first.second
          << " are not dual-compatible: their knots are ";
  Print(message, spline.Functions[first.first]);
  message << " and ";
  Print(message, spline.Functions[first.second]);
  message << ".";
  return message.str();
}
}
