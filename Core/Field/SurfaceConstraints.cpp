// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "SurfaceConstraints.h"

#include <algorithm>
#include <cmath>

namespace trivariate
{
using Eigen::Vector3d;

namespace
{
constexpr double SampleDistance = 0.5; // voxels
constexpr double LeastShare = 0.25;    // of the weight of a voxel's strongest normal
constexpr double LeastLength = 0.1;    // of a sum of normals: below, they cancel
// Triangles between two looks at the user's abort flag.
constexpr std::size_t TrianglesInARow = 4096;

// The normals of one side at one voxel.
struct Share
{
  std::int8_t Side;
  Vector3d Sum;
  double Weight;
};

// A share for this side; where the axis is open, one whose line is within 45 degrees.
Share& ShareOf(std::vector<Share>& shares, std::int8_t side, const Vector3d& normal)
{
  const auto found = std::find_if(shares.begin(), shares.end(),
    [side, &normal](const Share& share)
    {
      return share.Side == side && (side != AnyAxis || std::abs(share.Sum.dot(normal)) >
                                                         std::sqrt(0.5) * share.Sum.norm());
    });
  if (found != shares.end())
  {
    return *found;
  }
  shares.push_back({ side, Vector3d::Zero(), 0.0 });
  return shares.back();
}

// Calls body(point) at the centroids of the n^2 equal parts of a triangle.
template <typename Body>
void ForEachPart(const std::array<Vector3d, 3>& corners, Index n, const Body& body)
{
  const Vector3d u = (corners[1] - corners[0]) / static_cast<double>(n);
  const Vector3d v = (corners[2] - corners[0]) / static_cast<double>(n);
  for (Index i = 0; i < n; ++i)
  {
    for (Index j = 0; i + j < n; ++j)
    {
      const Vector3d corner = corners[0] + static_cast<double>(i) * u + static_cast<double>(j) * v;
      body(Vector3d(corner + (u + v) / 3.0));
      if (i + j + 1 < n)
      {
        body(Vector3d(corner + (u + v) * (2.0 / 3.0)));
      }
    }
  }
}

class Collector
{
public:
  explicit Collector(const FrameVoxels& voxels)
    : Voxels(voxels)
    , Places(voxels.Size[0] * voxels.Size[1] * voxels.Size[2], -1)
  {
    for (Index v = 0; v < voxels.Count(); ++v)
    {
      const std::array<std::int32_t, 6>& neighbours = voxels.Neighbours[v];
      if (std::any_of(neighbours.begin(), neighbours.end(), [](std::int32_t n) { return n < 0; }))
      {
        this->Places[voxels.Ids[v]] = static_cast<std::int32_t>(this->Along.size());
        this->Along.push_back(static_cast<std::int32_t>(v));
      }
    }
    this->Shares.resize(this->Along.size());
  }

  void Add(const SurfaceTriangle& triangle)
  {
    const auto& c = triangle.Corners;
    const Vector3d area = 0.5 * (c[1] - c[0]).cross(c[2] - c[0]);
    const Vector3d normal =
      (this->Voxels.Steps * (c[1] - c[0])).cross(this->Voxels.Steps * (c[2] - c[0])).normalized();
    const double longest = std::sqrt(std::max(
      { (c[1] - c[0]).squaredNorm(), (c[2] - c[1]).squaredNorm(), (c[0] - c[2]).squaredNorm() }));
    this->Area += area.norm();
    const auto& size = this->Voxels.Size;
    if (!(area.norm() > 0.0) || longest > static_cast<double>(size[0] + size[1] + size[2]))
    {
      return; // without extent, or not of this grid
    }
    const Index n = std::max<Index>(1, static_cast<Index>(std::ceil(longest / SampleDistance)));
    const double part = area.norm() / static_cast<double>(n * n);
    ForEachPart(c, n,
      [&](const Vector3d& point)
      {
        if (this->Spread(point, part, normal, triangle.Side))
        {
          this->Reached += part;
        }
      });
  }

  SurfaceConstraints Result() const
  {
    SurfaceConstraints result;
    result.Along = static_cast<Index>(this->Along.size());
    result.Astray = this->Area > 0.0 ? 1.0 - this->Reached / this->Area : 0.0;
    for (std::size_t i = 0; i < this->Along.size(); ++i)
    {
      const std::size_t before = result.Constraints.size();
      double largest = 0.0;
      for (const Share& share : this->Shares[i])
      {
        largest = std::max(largest, share.Weight);
      }
      for (const Share& share : this->Shares[i])
      {
        if (share.Weight >= LeastShare * largest && share.Sum.norm() > LeastLength * share.Weight)
        {
          const Eigen::Vector3f normal = share.Sum.normalized().cast<float>();
          result.Constraints.push_back(
            { this->Along[i], { normal[0], normal[1], normal[2] }, share.Side });
        }
      }
      result.Bound += result.Constraints.size() > before ? 1 : 0;
    }
    return result;
  }

private:
  // Gives the eight voxels around a point their parts; false if none is along the surface.
  bool Spread(const Vector3d& point, double area, const Vector3d& normal, std::int8_t side)
  {
    const Vector3d low = point.array().floor();
    const auto& size = this->Voxels.Size;
    bool reached = false;
    for (int corner = 0; corner < 8; ++corner)
    {
      const Eigen::Array3d at =
        low.array() + Eigen::Array3d(corner & 1, (corner >> 1) & 1, (corner >> 2) & 1);
      const double weight = area * (1.0 - (point.array() - at).abs()).prod();
      if (!(weight > 0.0) || (at < 0.0).any() || at[0] >= static_cast<double>(size[0]) ||
          at[1] >= static_cast<double>(size[1]) || at[2] >= static_cast<double>(size[2]))
      {
        continue;
      }
      const Index id = static_cast<Index>(at[0]) +
                       size[0] * (static_cast<Index>(at[1]) + size[1] * static_cast<Index>(at[2]));
      if (this->Places[id] >= 0)
      {
        Share& share = ShareOf(this->Shares[this->Places[id]], side, normal);
        share.Sum += (side == AnyAxis && share.Sum.dot(normal) < 0.0 ? -weight : weight) * normal;
        share.Weight += weight;
        reached = true;
      }
    }
    return reached;
  }

  const FrameVoxels& Voxels;
  std::vector<std::int32_t> Places; // of each voxel of the grid, in Along
  std::vector<std::int32_t> Along;
  std::vector<std::vector<Share>> Shares;
  double Area = 0.0, Reached = 0.0;
};
}

//------------------------------------------------------------------------------
SurfaceConstraints ConstrainToSurface(const FrameVoxels& voxels,
  const std::vector<SurfaceTriangle>& triangles, const Execution& execution)
{
  Collector collector(voxels);
  for (std::size_t t = 0; t < triangles.size(); ++t)
  {
    if (t % TrianglesInARow == 0)
    {
      execution.Check(static_cast<double>(t) / static_cast<double>(triangles.size()));
    }
    collector.Add(triangles[t]);
  }
  return collector.Result();
}
}
