// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "RelaxedLayout.h"

#include "LayoutCheck.h"
#include "LayoutCutting.h"
#include "LayoutRelaxation.h"

#include <stdexcept>

namespace trivariate
{
//------------------------------------------------------------------------------
bool Relax(SurfaceLayout& layout, const Polycube& cubes, bool fixed, const Execution& execution)
{
  try
  {
    LayoutUnfolding unfolding(layout, cubes, fixed);
    RelaxUnfolding(unfolding, RelaxationOptions(), execution);
    SurfaceLayout relaxed = CutAlongEdges(unfolding, layout);
    if (!CheckLayout(relaxed, cubes).empty())
    {
      return false;
    }
    layout = std::move(relaxed);
    return true;
  }
  catch (const std::runtime_error&)
  {
    return false;
  }
}
}
