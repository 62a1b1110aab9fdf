// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "TSpline.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace trivariate
{
namespace
{
const char* const DirectionNames[3] = { "u", "v", "w" };

bool AllFinite(const std::vector<double>& values)
{
  return std::all_of(values.begin(), values.end(), [](double x) { return std::isfinite(x); });
}

// The clamped knot vector 0 0 0 0 s 2s .. n n n n as the local vectors of its functions.
std::vector<LocalKnots> ClampedFunctions(int intervals, int stride)
{
  std::vector<std::int32_t> knots(3, 0);
  for (int k = 0; k <= intervals; k += stride)
  {
    knots.push_back(k);
  }
  knots.insert(knots.end(), 3, intervals);
  std::vector<LocalKnots> functions;
  for (std::size_t i = 0; i + 5 <= knots.size(); ++i)
  {
    functions.push_back({ knots[i], knots[i + 1], knots[i + 2], knots[i + 3], knots[i + 4] });
  }
  return functions;
}
}

//------------------------------------------------------------------------------
std::string Validate(const TSpline& spline)
{
  std::ostringstream fault;
  for (int a = 0; a < 3; ++a)
  {
    const KnotLine& line = spline.KnotLines[a];
    if (line.size() < 2 || !AllFinite(line) ||
        std::adjacent_find(line.begin(), line.end(), std::greater_equal<>()) != line.end())
    {
      fault << "The knot line of direction " << DirectionNames[a]
            << " is not a strictly increasing sequence of at least two finite numbers.";
      return fault.str();
    }
  }
  const std::size_t n = spline.Functions.size();
  if (spline.Components < 3)
  {
    fault << "A control point has " << spline.Components
          << " components; at least X, Y, Z are needed.";
    return fault.str();
  }
  if (spline.Weights.size() != n || spline.ControlPoints.size() != n * spline.Components)
  {
    fault << "There are " << n << " blending functions, but " << spline.Weights.size()
          << " weights and " << spline.ControlPoints.size() << " control point components.";
    return fault.str();
  }
  for (std::size_t i = 0; i < n; ++i)
  {
    for (int a = 0; a < 3; ++a)
    {
      const LocalKnots& k = spline.Functions[i][a];
      const auto last = static_cast<std::int32_t>(spline.KnotLines[a].size()) - 1;
      if (k[0] < 0 || k[4] > last || !std::is_sorted(k.begin(), k.end()) || k[0] == k[4])
      {
        fault << "Blending function " << i << " has no valid local knot vector in direction "
              << DirectionNames[a] << ".";
        return fault.str();
      }
    }
    if (!(spline.Weights[i] > 0.0) || !std::isfinite(spline.Weights[i]))
    {
      fault << "Blending function " << i << " has the weight " << spline.Weights[i]
            << "; it must be positive and finite.";
      return fault.str();
    }
  }
  if (!AllFinite(spline.ControlPoints))
  {
    return "A control point is not finite.";
  }
  for (std::size_t h = 0; h < spline.Holes.size(); ++h)
  {
    for (int a = 0; a < 3; ++a)
    {
      const std::int32_t low = spline.Holes[h].Low[a], high = spline.Holes[h].High[a];
      if (low < 0 || low >= high || high >= static_cast<std::int32_t>(spline.KnotLines[a].size()))
      {
        fault << "Hole " << h << " is no box of knots in direction " << DirectionNames[a] << ".";
        return fault.str();
      }
    }
  }
  return {};
}

//------------------------------------------------------------------------------
bool HasSupportOutside(const std::vector<IndexBox>& holes, const BlendingFunction& f)
{
  const IndexBox support = SupportOf(f);
  const auto volumeIn = [&support](const IndexBox& box)
  {
    Index volume = 1;
    for (int a = 0; a < 3; ++a)
    {
      volume *=
        std::max(0, std::min(support.High[a], box.High[a]) - std::max(support.Low[a], box.Low[a]));
    }
    return volume;
  };
  Index inHoles = 0;
  for (const IndexBox& hole : holes)
  {
    inHoles += volumeIn(hole);
  }
  return inHoles < volumeIn(support);
}

//------------------------------------------------------------------------------
TSpline MakeTensorProduct(
  const std::array<KnotLine, 3>& lines, const std::array<int, 3>& stride, int attributes)
{
  TSpline spline;
  spline.KnotLines = lines;
  spline.Components = 3 + attributes;
  std::array<std::vector<LocalKnots>, 3> local;
  for (int a = 0; a < 3; ++a)
  {
    local[a] = ClampedFunctions(static_cast<int>(lines[a].size()) - 1, stride[a]);
  }
  for (const LocalKnots& w : local[2])
  {
    for (const LocalKnots& v : local[1])
    {
      for (const LocalKnots& u : local[0])
      {
        spline.Functions.push_back({ u, v, w });
      }
    }
  }
  spline.Weights.assign(spline.Functions.size(), 1.0);
  spline.ControlPoints.assign(spline.Functions.size() * spline.Components, 0.0);
  for (Index i = 0; i < spline.Size(); ++i)
  {
    for (int a = 0; a < 3; ++a)
    {
      spline.ControlPoint(i)[a] = Greville(spline.LocalKnotValues(i, a));
    }
  }
  return spline;
}

//------------------------------------------------------------------------------
KnotLine MakeUniformKnotLine(double a, double b, int n)
{
  KnotLine line(n + 1);
  for (int k = 0; k <= n; ++k)
  {
    line[k] = a + (b - a) * k / n;
  }
  return line;
}

//------------------------------------------------------------------------------
void RemoveFunctions(TSpline& spline, const std::vector<char>& removed)
{
  Index kept = 0;
  for (Index i = 0; i < spline.Size(); ++i)
  {
    if (!removed[i])
    {
      spline.Functions[kept] = spline.Functions[i];
      spline.Weights[kept] = spline.Weights[i];
      std::copy_n(spline.ControlPoint(i), spline.Components, spline.ControlPoint(kept));
      ++kept;
    }
  }
  spline.Functions.resize(kept);
  spline.Weights.resize(kept);
  spline.ControlPoints.resize(kept * spline.Components);
}
}
