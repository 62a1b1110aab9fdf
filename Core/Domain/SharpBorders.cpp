// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "SharpBorders.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>

namespace trivariate
{
namespace
{
using Eigen::Vector3d;

constexpr double Radius = 2.5;    // in edges of equilateral triangles of the mean area
constexpr double MostBlunt = 0.1; // of a border's points
const double LeastCosine = std::cos(50.0 / 180.0 * std::acos(-1.0));

Vector3d AreaVector(const LayoutMesh& mesh, Index t)
{
  const Triangle& c = mesh.Triangles[t];
  return 0.5 * (mesh.Points[c[1]] - mesh.Points[c[0]]).cross(mesh.Points[c[2]] - mesh.Points[c[0]]);
}

Vector3d Middle(const LayoutMesh& mesh, Index t)
{
  const Triangle& c = mesh.Triangles[t];
  return (mesh.Points[c[0]] + mesh.Points[c[1]] + mesh.Points[c[2]]) / 3.0;
}
}

//------------------------------------------------------------------------------
std::vector<char> SharpBorders(const SurfaceLayout& layout, const LayoutMesh& mesh)
{
  double area = 0.0;
  for (Index t = 0; t < mesh.NumberOfTriangles(); ++t)
  {
    area += AreaVector(mesh, t).norm();
  }
  const double radius =
    Radius * std::sqrt(4.0 / std::sqrt(3.0) * area / double(mesh.NumberOfTriangles()));
  std::vector<char> sharp;
  std::vector<Index> seenFrom(layout.Triangles.size(), -1), waiting;
  for (const LayoutBorder& border : layout.Borders)
  {
    std::size_t blunt = 0;
    for (const Index p : border.Points)
    {
      // The triangles of both patches that are reached from the point without leaving them.
      std::array<Vector3d, 2> normals{ Vector3d::Zero(), Vector3d::Zero() };
      const auto visit = [&](Index t)
      {
        const bool right = layout.Patches[t] == border.Patches[1];
        if (seenFrom[t] != p && (right || layout.Patches[t] == border.Patches[0]))
        {
          seenFrom[t] = p;
          normals[right ? 1 : 0] += AreaVector(mesh, t);
          waiting.push_back(t);
        }
      };
      const Index first = mesh.TriangleAt(p);
      Index t = first;
      do
      {
        visit(t);
        t = mesh.Anticlockwise(t, p);
      } while (t != first);
      while (!waiting.empty())
      {
        t = waiting.back();
        waiting.pop_back();
        for (int k = 0; k < 3; ++k)
        {
          const Index next = mesh.Neighbour(t, k);
          if (layout.Patches[next] == layout.Patches[t] &&
              (Middle(mesh, next) - layout.Points[p]).norm() < radius)
          {
            visit(next);
          }
        }
      }
      blunt += normals[0].dot(normals[1]) > LeastCosine * normals[0].norm() * normals[1].norm();
    }
    sharp.push_back(double(blunt) < MostBlunt * double(border.Points.size()));
    // At corners seen again from the other borders.
    std::fill(seenFrom.begin(), seenFrom.end(), -1);
  }
  return sharp;
}
}
