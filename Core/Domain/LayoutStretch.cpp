// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "LayoutStretch.h"

#include "LayoutRelaxation.h"

#include <stdexcept>

namespace trivariate
{
//------------------------------------------------------------------------------
double RelaxedStretch(
  const SurfaceLayout& layout, const Polycube& cubes, const Execution& execution)
{
  try
  {
    LayoutUnfolding unfolding(layout, cubes, true);
    return 1.0 - 1.0 / RelaxUnfolding(unfolding, RelaxationOptions(), execution).After;
  }
  catch (const std::runtime_error&)
  {
    return 1.0; // patches too narrow for their faces
  }
}
}
