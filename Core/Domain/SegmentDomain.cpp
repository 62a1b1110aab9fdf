// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "SegmentDomain.h"

#include "DomainMeasures.h"
#include "LayoutCheck.h"
#include "RelaxedLayout.h"

namespace trivariate
{
using Eigen::Vector3d;

//------------------------------------------------------------------------------
SegmentDomain DomainFromCorners(const SurfaceMesh& mesh, const Polycube& polycube,
  const std::vector<Vector3d>& picked, const Execution& execution, double farthest,
  const std::vector<GivenBorder>& given)
{
  SegmentDomain domain{ LayoutFromCorners(mesh, polycube, picked, execution, farthest, given),
    polycube, {}, 0.0 };
  RefuseInvalid(CheckLayout(domain.Layout, polycube));
  MeasureStraight(domain);
  return domain;
}

//------------------------------------------------------------------------------
void RelaxDomain(SegmentDomain& domain, const Execution& execution)
{
  if (Relax(domain.Layout, domain.Cubes, true, execution))
  {
    MeasureStraight(domain);
  }
}
}
