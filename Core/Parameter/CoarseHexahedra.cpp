// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "CoarseHexahedra.h"

#include "BlockCells.h"
#include "BlockMeshing.h"
#include "Domain/DomainLayers.h"
#include "SurfaceDistance.h"

#include <algorithm>
#include <cmath>

namespace trivariate
{
namespace
{
using Eigen::Vector3d;

constexpr double MostCells = 2000.0;
constexpr int Halvings = 24;        // of the range in which the length of cells is sought
constexpr double LayerDepth = 0.05; // in the third root of the volume
constexpr double Freedom = 0.01;    // the same
constexpr double Evenness = 0.35;
constexpr int MostSmoothing = 15; // sweeps

double VolumeInside(const std::vector<Vector3d>& points, const std::vector<Triangle>& triangles)
{
  double volume = 0.0;
  for (const Triangle& t : triangles)
  {
    volume += points[t[0]].dot(points[t[1]].cross(points[t[2]])) / 6.0;
  }
  return volume;
}

// The least with which there are not too many cells, where there is one: blocks have two cells
// along each edge at least.
double CellLength(const BlockDomain& domain, BlockMeshOptions options, double size)
{
  double low = 1e-3 * size, high = size;
  for (int i = 0; i < Halvings; ++i)
  {
    options.CellLength = std::sqrt(low * high);
    (CountCells(SizesOf(domain, options)) > MostCells ? low : high) = options.CellLength;
  }
  return high;
}

double QualityIn(const BlockDomain& blocks, const Execution& execution)
{
  const double size = std::cbrt(VolumeInside(blocks.SurfacePoints, blocks.Triangles));
  BlockMeshOptions options;
  options.CellLength = CellLength(blocks, options, size);
  options.LayerCells = options.CellLength;
  options.Freedom = Freedom * size;
  options.Repair.Evenness = Evenness;
  options.Repair.MostRounds = 1;
  options.Repair.MostSmoothing = MostSmoothing;
  const BlockMesh mesh = MakeBlockMesh(blocks, options, execution);
  const SurfaceDistances distances = DistancesOfFaces(blocks, mesh, execution);
  const double distance = std::max(distances.ToFaces.Mean, distances.FromFaces.Mean);
  return QualityOf(mesh, execution).MeanJacobian / (1.0 + distance * std::cbrt(MostCells) / size);
}
}

//------------------------------------------------------------------------------
double CoarseHexahedra(const SegmentDomain& domain, const Execution& execution)
{
  const double size = std::cbrt(VolumeInside(domain.Layout.Points, domain.Layout.Triangles));
  return QualityIn(
    DomainOfSegment(LayeredBlocks(domain, LayerDepth * size, execution.Part(0.0, 0.1)), domain),
    execution.Part(0.1, 1.0));
}

//------------------------------------------------------------------------------
double CoarseHexahedra(
  const SegmentDomain& outer, const SegmentDomain& inner, const Execution& execution)
{
  return QualityIn(DomainOfSegment(ShellBlocks(outer, inner), outer, &inner), execution);
}
}
