// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "FindDomain.h"

#include "DomainSearch.h"

#include <stdexcept>

namespace trivariate
{
//------------------------------------------------------------------------------
SegmentDomain FindDomain(
  const SurfaceMesh& mesh, const DomainOptions& options, const Execution& execution)
{
  Index pieces = 0;
  mesh.Components(pieces);
  if (pieces != 1)
  {
    throw std::invalid_argument(
      "The surface has " + std::to_string(pieces) + " pieces; a domain is for one.");
  }
  return DomainSearch(mesh, options, execution).Best();
}
}
