// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "DomainMeasures.h"

#include <algorithm>
#include <map>
#include <stdexcept>

namespace trivariate
{
using Eigen::Matrix3d;
using Eigen::Vector3d;

//------------------------------------------------------------------------------
Matrix3d BestFrame(const SurfaceLayout& layout)
{
  Matrix3d correlation = Matrix3d::Zero();
  for (std::size_t t = 0; t < layout.Triangles.size(); ++t)
  {
    const ChartLabel label = layout.PatchLabels[layout.Patches[t]];
    correlation.row(label / 2) += SignOf(label) * AreaVector(layout, t).transpose();
  }
  return ClosestRotation(correlation);
}

//------------------------------------------------------------------------------
std::vector<Vector3d> PlacesOf(const SurfaceLayout& layout, const Polycube& cubes)
{
  std::vector<Vector3d> places(cubes.Points.size(), Vector3d::Zero());
  for (Index corner = 0; corner < cubes.NumberOfCorners; ++corner)
  {
    places[corner] = layout.Points[layout.Corners[corner]];
  }
  std::map<LatticePoint, Index> numbers;
  for (std::size_t p = 0; p < cubes.Points.size(); ++p)
  {
    numbers[cubes.Points[p]] = static_cast<Index>(p);
  }
  // An inner point has all six neighbours. Gauss-Seidel; lattices are small.
  double change = 1.0;
  for (int round = 0; round < 10000 && change > 0.0; ++round)
  {
    change = 0.0;
    for (std::size_t p = cubes.NumberOfCorners; p < cubes.Points.size(); ++p)
    {
      Vector3d sum = Vector3d::Zero();
      for (int axis = 0; axis < 3; ++axis)
      {
        for (const int step : { -1, 1 })
        {
          LatticePoint neighbour = cubes.Points[p];
          neighbour[axis] += step;
          sum += places[numbers.at(neighbour)];
        }
      }
      change = std::max(change, (sum / 6.0 - places[p]).norm());
      places[p] = sum / 6.0;
    }
  }
  return places;
}

//------------------------------------------------------------------------------
void MeasureStraight(SegmentDomain& domain)
{
  domain.Places = PlacesOf(domain.Layout, domain.Cubes);
  const Matrix3d frame = BestFrame(domain.Layout);
  domain.Alignment =
    AlignmentOf(domain.Layout, [&frame](std::size_t) -> const Matrix3d& { return frame; });
}

//------------------------------------------------------------------------------
void RefuseInvalid(const std::vector<std::string>& messages)
{
  if (!messages.empty())
  {
    throw std::runtime_error("The layout found is not valid: " + messages.front());
  }
}
}
