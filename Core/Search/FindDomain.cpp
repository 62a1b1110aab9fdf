// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "FindDomain.h"

#include "Domain/DomainMeasures.h"
#include "Domain/RelaxedLayout.h"
#include "DomainSearch.h"

#include <stdexcept>

namespace trivariate
{
namespace
{
constexpr Index FewTriangles = 20000;
constexpr double StretchInEdges = 3.0; // so far borders of charts are straightened

// One found on a reduced surface, on the surface itself: with the same borders or, where these
// cannot be followed, others between its corners.
SegmentDomain OnSurface(const SurfaceMesh& mesh, const ReducedSurface& few,
  const SegmentDomain& found, double stretch, const Execution& execution)
{
  try
  {
    return { LayoutAlong(mesh, found.Cubes, few, found.Layout, execution, {}, stretch), found.Cubes,
      {}, 0.0 };
  }
  catch (const std::runtime_error&)
  {
  }
  return DomainFromCorners(mesh, found.Cubes,
    { found.Places.begin(), found.Places.begin() + found.Cubes.NumberOfCorners }, execution);
}

SegmentDomain FindOnFew(
  const PosedSurface& posed, const DomainOptions& options, const Execution& execution)
{
  const SurfaceMesh& mesh = posed.Mesh;
  const ReducedSurface few = Reduce(mesh, FewTriangles, execution.Part(0.0, 0.2));
  const Execution run = execution.Part(0.2, 0.8);
  DomainSearch search(few.Mesh, posed, options, run);
  const SegmentDomain found = search.Best();
  const double stretch =
    search.FoundCharts() ? StretchInEdges : std::numeric_limits<double>::infinity();
  SegmentDomain domain = OnSurface(mesh, few, found, stretch, execution.Part(0.8, 0.9));
  const auto measure = [&]()
  {
    // By directions on the reduced surface.
    const std::vector<Index> origins = domain.Layout.Origins;
    for (Index& origin : domain.Layout.Origins)
    {
      origin = few.TriangleFor[origin];
    }
    search.Measure(domain);
    domain.Layout.Origins = origins;
  };
  measure();
  if (options.Relax && Relax(domain.Layout, domain.Cubes, false, execution.Part(0.9, 1.0)))
  {
    measure();
  }
  return domain;
}

SegmentDomain FindPosed(
  const PosedSurface& posed, const DomainOptions& options, const Execution& execution)
{
  if (posed.Mesh.NumberOfTriangles() > options.MostTriangles)
  {
    return FindOnFew(posed, options, execution);
  }
  DomainSearch search(posed.Mesh, posed, options, execution);
  SegmentDomain domain = search.Best();
  if (options.Relax && Relax(domain.Layout, domain.Cubes, false, execution.Part(0.85, 1.0)))
  {
    search.Measure(domain);
  }
  return domain;
}
}

//------------------------------------------------------------------------------
SegmentDomain FindDomain(
  const SurfaceMesh& mesh, const DomainOptions& options, const Execution& execution)
{
  return FindDomain(mesh, SurfacePose(mesh), options, execution);
}

//------------------------------------------------------------------------------
SegmentDomain FindDomain(const SurfaceMesh& mesh, const SurfacePose& pose,
  const DomainOptions& options, const Execution& execution)
{
  Index pieces = 0;
  mesh.Components(pieces);
  if (pieces != 1)
  {
    throw std::invalid_argument(
      "The surface has " + std::to_string(pieces) + " pieces; a domain is for one.");
  }
  const PosedSurface posed(mesh, pose);
  return posed.ToGiven(mesh, FindPosed(posed, options, execution));
}
}
