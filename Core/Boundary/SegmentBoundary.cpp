// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "SegmentBoundary.h"

#include "DensityLevels.h"
#include "NetSmoothing.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace trivariate
{
namespace
{
using Eigen::Vector3d;

// Triangles closer than this are taken apart; rounding to single precision does not close the gap.
constexpr double Clearance = 1e-3;
// Worse triangles are mended, if that can be done: an angle of less than five degrees or so.
constexpr double LeastQuality = 0.045;

// Mean ratio of a triangle, up to a constant: twice its area over the sum of squared edges.
double Quality(const Vector3d& a, const Vector3d& b, const Vector3d& c)
{
  const double edges = (b - a).squaredNorm() + (c - b).squaredNorm() + (a - c).squaredNorm();
  return edges > 0.0 ? (b - a).cross(c - a).norm() / edges : 0.0;
}

// Cuts quadrilaterals along the diagonal that leaves the better worse triangle.
void Triangulate(const BoundaryNet& net, const Points& points, SegmentBoundary& result)
{
  result.Triangles.reserve(2 * net.Faces.size());
  result.Labels.reserve(2 * net.Faces.size());
  const auto add = [&result](Index a, Index b, Index c, const BoundaryFace& face)
  {
    result.Triangles.push_back({ a, b, c });
    result.Labels.push_back(face.Labels);
  };
  for (const BoundaryFace& face : net.Faces)
  {
    const auto& v = face.Vertices;
    if (face.Size() == 3)
    {
      add(v[0], v[1], v[2], face);
      continue;
    }
    const auto quality = [&](int i, int j, int k)
    { return Quality(points[v[i]], points[v[j]], points[v[k]]); };
    if (std::min(quality(0, 1, 2), quality(0, 2, 3)) >=
        std::min(quality(0, 1, 3), quality(1, 2, 3)))
    {
      add(v[0], v[1], v[2], face);
      add(v[0], v[2], v[3], face);
    }
    else
    {
      add(v[0], v[1], v[3], face);
      add(v[1], v[2], v[3], face);
    }
  }
}

// Halves the way of the vertices of intersecting triangles, and of slivers, from their anchors
// until there are none; after six times a vertex is at its anchor, and there the net does not meet
// itself.
void PullApart(const Points& anchors, SegmentBoundary& result, const Execution& execution)
{
  const auto at = [&result](Index v)
  { return Eigen::Map<const Vector3d>(result.Points[v].data()); };
  std::vector<char> suspect(result.Triangles.size(), 1);
  std::vector<std::uint8_t> halvings(anchors.size(), 0);
  std::vector<char> moved;
  const int most = 40;
  for (int round = 0; round < most; ++round)
  {
    const auto pairs = FindIntersections(result.Points, result.Triangles, suspect, Clearance,
      execution.Part(1.0 - 1.0 / (round + 1), 1.0 - 1.0 / (round + 2)));
    result.Intersections = static_cast<Index>(pairs.size());
    moved.assign(anchors.size(), 0);
    const auto move = [&](Index triangle)
    {
      for (Index v : result.Triangles[triangle])
      {
        moved[v] = 1;
      }
    };
    for (const auto& [s, t] : pairs)
    {
      move(s);
      move(t);
    }
    for (std::size_t t = 0; t < suspect.size(); ++t)
    {
      const Triangle& v = result.Triangles[t];
      const bool canMove =
        std::any_of(v.begin(), v.end(), [&halvings](Index i) { return halvings[i] < 3; });
      if (suspect[t] && canMove && Quality(at(v[0]), at(v[1]), at(v[2])) < LeastQuality)
      {
        move(t);
      }
    }
    if (std::none_of(moved.begin(), moved.end(), [](char m) { return m; }))
    {
      break;
    }
    for (std::size_t v = 0; v < anchors.size(); ++v)
    {
      if (moved[v])
      {
        ++halvings[v];
        const double share = halvings[v] < 6 ? 0.5 : 0.0;
        for (int a = 0; a < 3; ++a)
        {
          result.Points[v][a] = anchors[v][a] + share * (result.Points[v][a] - anchors[v][a]);
        }
      }
    }
    for (std::size_t t = 0; t < suspect.size(); ++t)
    {
      const Triangle& v = result.Triangles[t];
      suspect[t] = moved[v[0]] || moved[v[1]] || moved[v[2]];
    }
  }
  result.PulledBack = std::count_if(halvings.begin(), halvings.end(), [](auto n) { return n > 0; });
}
}

//------------------------------------------------------------------------------
SegmentBoundary ComputeSegmentBoundary(
  const LabelVolume& labels, const BoundaryOptions& options, const Execution& execution)
{
  SegmentBoundary result;
  const BoundaryNet net = BuildBoundaryNet(labels, execution.Part(0.0, 0.3));
  const Points anchors = AnchorsOf(net);
  Points points = anchors;
  {
    const NetTopology topology(net, execution);
    result.Junctions.assign(topology.Kinds.begin(), topology.Kinds.end());
    if (options.SmoothingIterations > 0)
    {
      Smooth(net, topology, options.SmoothingIterations, points, execution.Part(0.35, 0.5));
      RestoreVolumes(net, topology, points, execution.Part(0.5, 0.55));
      if (options.Density)
      {
        const DensityLevels levels(
          labels, options.Density, net, topology, execution.Part(0.55, 0.7));
        for (int round = 0; round < 3; ++round)
        {
          levels.Settle(points, execution);
          Smooth(net, topology, 2, points, execution.Part(0.7, 0.7));
          SmoothTangentially(net, topology, 1, points, execution.Part(0.7, 0.7));
        }
        levels.Settle(points, execution);
        levels.CompensateBlur(points, execution);
      }
      SmoothTangentially(net, topology, 3, points, execution.Part(0.7, 0.75));
    }
  }
  Triangulate(net, points, result);
  result.Points.reserve(points.size());
  for (const Vector3d& p : points)
  {
    result.Points.push_back({ p[0], p[1], p[2] });
  }
  PullApart(anchors, result, execution.Part(0.75, 1.0));
  return result;
}

//------------------------------------------------------------------------------
std::vector<Point> PointNormals(const std::vector<Point>& points,
  const std::vector<Triangle>& triangles, const Execution& execution)
{
  const auto at = [&points](Index v) { return Eigen::Map<const Vector3d>(points[v].data()); };
  // Of every triangle its three shares, which are then summed in the order of the triangles.
  std::vector<std::array<Vector3d, 3>> shares(triangles.size());
  execution.ParallelFor(static_cast<Index>(triangles.size()),
    [&](Index begin, Index end)
    {
      for (Index t = begin; t < end; ++t)
      {
        const Triangle& v = triangles[t];
        const Vector3d normal = (at(v[1]) - at(v[0])).cross(at(v[2]) - at(v[0])).normalized();
        for (int i = 0; i < 3; ++i)
        {
          const Vector3d x = at(v[(i + 1) % 3]) - at(v[i]), y = at(v[(i + 2) % 3]) - at(v[i]);
          shares[t][i] = std::atan2(x.cross(y).norm(), x.dot(y)) * normal;
        }
      }
    });
  std::vector<Point> normals(points.size(), Point{});
  for (std::size_t t = 0; t < triangles.size(); ++t)
  {
    for (int i = 0; i < 3; ++i)
    {
      for (int a = 0; a < 3; ++a)
      {
        normals[triangles[t][i]][a] += shares[t][i][a];
      }
    }
  }
  for (Point& normal : normals)
  {
    const double length = std::hypot(normal[0], normal[1], normal[2]);
    for (double& x : normal)
    {
      x = length > 0.0 ? x / length : 0.0;
    }
  }
  return normals;
}
}
