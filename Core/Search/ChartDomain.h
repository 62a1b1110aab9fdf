// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// Domains from the six charts of a cube: the cube, and chains of cubes cut from it.
#ifndef trivariate_ChartDomain_h
#define trivariate_ChartDomain_h

#include "CubeCharts.h"
#include "Domain/SegmentDomain.h"

namespace trivariate
{
class ChartDomain
{
public:
  /// Charts of the surface with each triangle cut in four, `level` times; layouts have the
  /// triangles of the surface itself as origins. Throws as FindCubeCharts and LayoutFromCharts, and
  /// std::runtime_error where the charts are not those of a cube.
  ChartDomain(const SurfaceMesh& mesh, int level, const CubeChartOptions& options,
    const Execution& execution);

  SegmentDomain Cube() const { return this->OnSurface(this->OneCube); }

  /// Cut across the axis along which its borders are longest.
  SegmentDomain Chain(Index cubes, const Execution& execution) const;

  /// Gives a domain of this surface its places and alignment. Directions turn along the surface
  /// where those of the charts do, each cube's as a whole.
  void Measure(SegmentDomain& domain) const { this->Finish(domain, this->Level); }

  /// How long it is along that axis against the other two.
  double Length() const { return this->Slenderness; }

private:
  SegmentDomain OnSurface(SegmentDomain domain) const;
  void Finish(SegmentDomain& domain, int level) const;
  void FindLongest();

  CubeCharts Charts;
  int Level;
  SegmentDomain OneCube; // with triangles of the refined surface as origins
  int Axis = 0;
  double Slenderness = 1.0;
};
}

#endif
