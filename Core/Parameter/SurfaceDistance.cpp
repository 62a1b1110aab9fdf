// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "SurfaceDistance.h"

#include "Domain/TriangleTree.h"

#include <algorithm>
#include <cmath>

namespace trivariate
{
using Eigen::Vector3d;

namespace
{
constexpr Index BetweenChecks = 50000; // points

std::vector<Triangle> TrianglesOfFaces(const BlockDomain& domain, const BlockMesh& mesh)
{
  std::vector<Triangle> triangles;
  for (const PatchFace& face : PatchFaces(domain, mesh))
  {
    for (int t = 0; t < face.Cells[1]; ++t)
    {
      for (int s = 0; s < face.Cells[0]; ++s)
      {
        const Index low = face.NodeAt(s, t), high = face.NodeAt(s + 1, t + 1);
        triangles.push_back({ low, face.NodeAt(s + 1, t), high });
        triangles.push_back({ low, high, face.NodeAt(s, t + 1) });
      }
    }
  }
  return triangles;
}

SurfaceDistance DistanceTo(const TriangleTree& tree, const std::vector<Vector3d>& points,
  const std::vector<Triangle>& triangles, const Execution& execution)
{
  std::vector<Vector3d> places = points; // then the middles
  for (const Triangle& t : triangles)
  {
    places.push_back((points[t[0]] + points[t[1]] + points[t[2]]) / 3.0);
  }
  const Index count = static_cast<Index>(places.size());
  std::vector<double> distances(count);
  for (Index from = 0; from < count; from += BetweenChecks)
  {
    execution.Check(double(from) / count);
    execution.ParallelFor(std::min(BetweenChecks, count - from),
      [&](Index begin, Index end)
      {
        for (Index i = from + begin; i < from + end; ++i)
        {
          distances[i] = tree.Nearest(places[i]).Distance;
        }
      });
  }
  SurfaceDistance result;
  double squares = 0.0, whole = 0.0;
  for (std::size_t t = 0; t < triangles.size(); ++t)
  {
    const Triangle& corners = triangles[t];
    const Vector3d& a = points[corners[0]];
    const double area = (points[corners[1]] - a).cross(points[corners[2]] - a).norm();
    const double middle = distances[points.size() + t];
    squares += area * middle * middle;
    whole += area;
    for (const double d :
      { distances[corners[0]], distances[corners[1]], distances[corners[2]], middle })
    {
      result.Largest = std::max(result.Largest, d);
    }
  }
  result.Mean = std::sqrt(squares / whole);
  return result;
}
}

//------------------------------------------------------------------------------
SurfaceDistances DistancesOfFaces(
  const BlockDomain& domain, const BlockMesh& mesh, const Execution& execution)
{
  const std::vector<Triangle> faces = TrianglesOfFaces(domain, mesh);
  const TriangleTree toFaces(mesh.Places, faces);
  const TriangleTree toSurface(domain.SurfacePoints, domain.Triangles);
  return { DistanceTo(toFaces, domain.SurfacePoints, domain.Triangles, execution.Part(0.0, 0.5)),
    DistanceTo(toSurface, mesh.Places, faces, execution.Part(0.5, 1.0)) };
}
}
