// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "TSplineModel.h"

#include <algorithm>
#include <set>

namespace trivariate
{
//------------------------------------------------------------------------------
bool IsTSplineArrayName(const std::string& name)
{
  return std::find(TSplineArrayNames.begin(), TSplineArrayNames.end(), name) !=
         TSplineArrayNames.end();
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
