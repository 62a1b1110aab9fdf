// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "TSplineModel.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>

namespace trivariate
{
//------------------------------------------------------------------------------
bool IsTSplineArrayName(const std::string& name)
{
  return std::find(TSplineArrayNames.begin(), TSplineArrayNames.end(), name) !=
         TSplineArrayNames.end();
}

namespace
{
// Numbers of knots on one line as those on another that has all of its knots.
void Renumber(const KnotLine& from, const KnotLine& to, int direction, TSpline& spline)
{
  std::vector<std::int32_t> number;
  for (const double knot : from)
  {
    number.push_back(
      static_cast<std::int32_t>(std::lower_bound(to.begin(), to.end(), knot) - to.begin()));
  }
  for (BlendingFunction& f : spline.Functions)
  {
    for (std::int32_t& knot : f[direction])
    {
      knot = number[knot];
    }
  }
  for (IndexBox& hole : spline.Holes)
  {
    hole.Low[direction] = number[hole.Low[direction]];
    hole.High[direction] = number[hole.High[direction]];
  }
}

// Holes that no function reaches are those of other parts.
void DropForeignHoles(TSpline& spline)
{
  const auto isForeign = [&spline](const IndexBox& hole)
  {
    return std::none_of(spline.Functions.begin(), spline.Functions.end(),
      [&hole](const BlendingFunction& f) { return SupportOf(f).Overlaps(hole); });
  };
  spline.Holes.erase(
    std::remove_if(spline.Holes.begin(), spline.Holes.end(), isForeign), spline.Holes.end());
}

// Cuts the lines to the knots between the first and the last that functions use: the part's domain.
void TrimKnotLines(TSpline& spline)
{
  for (int a = 0; a < 3; ++a)
  {
    KnotLine& line = spline.KnotLines[a];
    std::int32_t low = static_cast<std::int32_t>(line.size()), high = -1;
    for (const BlendingFunction& f : spline.Functions)
    {
      low = std::min(low, f[a].front());
      high = std::max(high, f[a].back());
    }
    for (BlendingFunction& f : spline.Functions)
    {
      for (std::int32_t& knot : f[a])
      {
        knot -= low;
      }
    }
    for (IndexBox& hole : spline.Holes)
    {
      hole.Low[a] = std::max(hole.Low[a] - low, 0);
      hole.High[a] = std::min(hole.High[a], high) - low;
    }
    line = high < 0 ? line : KnotLine(line.begin() + low, line.begin() + high + 1);
  }
}
}

//------------------------------------------------------------------------------
std::vector<std::int32_t> SegmentsOf(const TSplineModel& model)
{
  const std::set<std::int32_t> segments(model.Segment.begin(), model.Segment.end());
  return { segments.begin(), segments.end() };
}

//------------------------------------------------------------------------------
TSplineModel SegmentPart(const TSplineModel& model, std::int32_t segment)
{
  std::vector<char> removed;
  removed.reserve(model.Segment.size());
  for (const std::int32_t s : model.Segment)
  {
    removed.push_back(s != segment);
  }
  TSplineModel part = model;
  RemoveFunctions(part.Spline, removed);
  DropForeignHoles(part.Spline);
  TrimKnotLines(part.Spline);
  part.RootCells = part.Spline.Size() == model.Spline.Size()
                     ? model.RootCells
                     : std::array<std::int32_t, 3>{ 0, 0, 0 };
  part.Segment.assign(part.Spline.Size(), segment);
  part.Block.clear();
  for (std::size_t i = 0; i < removed.size(); ++i)
  {
    if (!removed[i])
    {
      part.Block.push_back(model.Block[i]);
    }
  }
  return part;
}

//------------------------------------------------------------------------------
TSplineModel JoinParts(const TSplineModel& first, const TSplineModel& second)
{
  if (first.Spline.Size() == 0 || second.Spline.Size() == 0)
  {
    return first.Spline.Size() == 0 ? second : first;
  }
  TSplineModel whole = first;
  TSplineModel part = second;
  const double shift =
    std::floor(first.Spline.KnotLines[0].back() - second.Spline.KnotLines[0].front()) + 2.0;
  for (double& knot : part.Spline.KnotLines[0])
  {
    knot += shift;
  }
  for (int a = 0; a < 3; ++a)
  {
    const KnotLine &one = first.Spline.KnotLines[a], &other = part.Spline.KnotLines[a];
    KnotLine& line = whole.Spline.KnotLines[a];
    line.clear();
    std::set_union(one.begin(), one.end(), other.begin(), other.end(), std::back_inserter(line));
    Renumber(one, line, a, whole.Spline);
    Renumber(other, line, a, part.Spline);
  }
  const auto append = [](auto& to, const auto& from)
  { to.insert(to.end(), from.begin(), from.end()); };
  append(whole.Spline.Functions, part.Spline.Functions);
  append(whole.Spline.Weights, part.Spline.Weights);
  append(whole.Spline.ControlPoints, part.Spline.ControlPoints);
  append(whole.Spline.Holes, part.Spline.Holes);
  append(whole.Segment, part.Segment);
  const std::int32_t blocks = 1 + *std::max_element(first.Block.begin(), first.Block.end());
  for (const std::int32_t block : part.Block)
  {
    whole.Block.push_back(blocks + block);
  }
  whole.RootCells = { 0, 0, 0 };
  return whole;
}

//------------------------------------------------------------------------------
TSplineModel AttributePart(const TSplineModel& model, int attribute)
{
  int first = 3;
  for (int a = 0; a < attribute; ++a)
  {
    first += model.Attributes[a].Components;
  }
  TSplineModel part = model;
  part.Attributes = { model.Attributes[attribute] };
  part.Spline.Components = 3 + part.Attributes[0].Components;
  part.Spline.ControlPoints.clear();
  for (Index i = 0; i < model.Spline.Size(); ++i)
  {
    const double* p = model.Spline.ControlPoint(i);
    auto& points = part.Spline.ControlPoints;
    points.insert(points.end(), p, p + 3);
    points.insert(points.end(), p + first, p + first + part.Attributes[0].Components);
  }
  return part;
}

//------------------------------------------------------------------------------
std::string Validate(const TSplineModel& model)
{
  Index components = 3;
  std::set<std::string> names;
  for (const TSplineAttribute& attribute : model.Attributes)
  {
    if (attribute.Name.empty())
    {
      return "An attribute has no name.";
    }
    if (IsTSplineArrayName(attribute.Name) || !names.insert(attribute.Name).second)
    {
      return "The attribute name \"" + attribute.Name + "\" is taken; choose another one.";
    }
    if (attribute.Components < 1)
    {
      return "The attribute \"" + attribute.Name + "\" has no components.";
    }
    components += attribute.Components;
  }
  if (components != model.Spline.Components)
  {
    return "X, Y, Z and the attributes are " + std::to_string(components) +
           " numbers, but a control point has " + std::to_string(model.Spline.Components) + ".";
  }
  const std::size_t n = model.Spline.Functions.size();
  if (model.Segment.size() != n || model.Block.size() != n)
  {
    return "There are " + std::to_string(n) + " blending functions, but " +
           std::to_string(model.Segment.size()) + " segments and " +
           std::to_string(model.Block.size()) + " blocks.";
  }
  if (std::any_of(model.RootCells.begin(), model.RootCells.end(), [](auto c) { return c < 0; }))
  {
    return "The numbers of root cells are negative.";
  }
  return Validate(model.Spline);
}
}
