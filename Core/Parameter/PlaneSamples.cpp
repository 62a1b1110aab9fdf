// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "PlaneSamples.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace trivariate
{
using Eigen::Vector3d;

namespace
{
constexpr double LongestStep = 0.7; // voxels

int StepsFor(double length)
{
  return std::max(1, static_cast<int>(std::ceil(length / LongestStep)));
}

class Sampler
{
public:
  Sampler(const ParameterCells& cells, PlaneSamples& samples)
    : Cells(cells)
    , Result(samples)
  {
  }

  // The middles of n^2 equal parts.
  void AddTriangle(const Vector3d& a, const Vector3d& b, const Vector3d& c, int plane) const
  {
    const Vector3d u = this->Cells.PlaceOf(b) - this->Cells.PlaceOf(a);
    const Vector3d v = this->Cells.PlaceOf(c) - this->Cells.PlaceOf(a);
    const int n = StepsFor(std::max({ u.norm(), v.norm(), (v - u).norm() }));
    const double weight = 0.5 * (b - a).cross(c - a).norm() / (n * n) / this->Cells.Spacing.mean();
    for (int s = 0; s < n; ++s)
    {
      for (int t = 0; s + t < n; ++t)
      {
        for (int upper = 0; upper < (s + t + 1 < n ? 2 : 1); ++upper)
        {
          const double third = (1.0 + upper) / 3.0;
          this->Add(a + ((s + third) * (b - a) + (t + third) * (c - a)) / n, plane, weight);
        }
      }
    }
  }

  void AddLine(const Vector3d& a, const Vector3d& b, int plane) const
  {
    const int n = StepsFor((this->Cells.PlaceOf(b) - this->Cells.PlaceOf(a)).norm());
    for (int s = 0; s < n; ++s)
    {
      this->Add(a + (s + 0.5) / n * (b - a), plane, (b - a).norm() / n);
    }
  }

private:
  const ParameterCells& Cells;
  PlaneSamples& Result;

  void Add(const Vector3d& point, int plane, double weight) const
  {
    PlaneSample sample;
    sample.Cell = this->Cells.CellOf(this->Cells.PlaceOf(point), sample.Local);
    sample.Plane = plane;
    sample.Weight = weight;
    this->Result.Samples.push_back(sample);
  }
};
}

//------------------------------------------------------------------------------
std::array<double, 8> PlaneSample::CornerWeights() const
{
  std::array<double, 8> weights;
  for (int c = 0; c < 8; ++c)
  {
    weights[c] = 1.0;
    for (int a = 0; a < 3; ++a)
    {
      weights[c] *= (c >> a & 1) != 0 ? this->Local[a] : 1.0 - this->Local[a];
    }
  }
  return weights;
}

//------------------------------------------------------------------------------
PlaneSamples SamplePlanes(const ParameterCells& cells, const ParameterSurface& surface, int axis)
{
  PlaneSamples samples;
  std::vector<int>& planes = samples.Coordinates;
  for (const std::vector<LatticePlane>* list : { &surface.Planes, &surface.LinePlanes })
  {
    for (const LatticePlane& plane : *list)
    {
      if (plane.Axis == axis)
      {
        planes.push_back(plane.Coordinate);
      }
    }
  }
  std::sort(planes.begin(), planes.end());
  planes.erase(std::unique(planes.begin(), planes.end()), planes.end());
  if (planes.size() < 2)
  {
    throw std::invalid_argument(std::string("The surface has ") +
                                (planes.empty() ? "no patch" : "patches at one coordinate only") +
                                " along " + "uvw"[axis] + ": both ends of the domain are needed.");
  }
  const auto numberOf = [&planes](const LatticePlane& plane)
  {
    return static_cast<int>(
      std::lower_bound(planes.begin(), planes.end(), plane.Coordinate) - planes.begin());
  };
  const Sampler sampler(cells, samples);
  for (std::size_t t = 0; t < surface.Triangles.size(); ++t)
  {
    if (surface.Planes[t].Axis == axis)
    {
      const Triangle& p = surface.Triangles[t];
      sampler.AddTriangle(surface.Points[p[0]], surface.Points[p[1]], surface.Points[p[2]],
        numberOf(surface.Planes[t]));
    }
  }
  for (std::size_t l = 0; l < surface.Lines.size(); ++l)
  {
    if (surface.LinePlanes[l].Axis == axis)
    {
      sampler.AddLine(surface.Points[surface.Lines[l][0]], surface.Points[surface.Lines[l][1]],
        numberOf(surface.LinePlanes[l]));
    }
  }
  return samples;
}
}
