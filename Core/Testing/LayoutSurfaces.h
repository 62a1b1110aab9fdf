// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// Closed surfaces for tests of layouts.
#ifndef trivariate_LayoutSurfaces_h
#define trivariate_LayoutSurfaces_h

#include "Domain/Polycube.h"
#include "Domain/SurfaceLayout.h"
#include "Domain/SurfaceMesh.h"

#include <cmath>
#include <map>
#include <vector>

namespace trivariate_testing
{
using trivariate::Index;
using trivariate::Polycube;
using trivariate::SurfaceMesh;
using trivariate::Triangle;
using Point = Eigen::Vector3d;

/// Where the corners of a polycube are on the lattice.
inline std::vector<Point> LatticeCorners(const Polycube& polycube)
{
  std::vector<Point> corners;
  for (Index i = 0; i < polycube.NumberOfCorners; ++i)
  {
    const trivariate::LatticePoint& p = polycube.Points[i];
    corners.push_back({ double(p[0]), double(p[1]), double(p[2]) });
  }
  return corners;
}

/// Along the border.
inline double LengthOf(
  const trivariate::SurfaceLayout& layout, const trivariate::LayoutBorder& border)
{
  double length = 0.0;
  for (std::size_t i = 0; i + 1 < border.Points.size(); ++i)
  {
    length += (layout.Points[border.Points[i + 1]] - layout.Points[border.Points[i]]).norm();
  }
  return length;
}

/// The boundary of a polycube, each unit face cut into n x n squares and each of these in two.
inline SurfaceMesh SurfaceOf(const Polycube& polycube, int n)
{
  std::map<std::array<int, 3>, Index> numbers;
  std::vector<Point> points;
  std::vector<Triangle> triangles;
  for (const Polycube::Face& face : polycube.Faces)
  {
    const auto number = [&](int i, int j)
    {
      std::array<int, 3> place;
      for (int axis = 0; axis < 3; ++axis)
      {
        const int origin = polycube.Points[face.Corners[0]][axis];
        place[axis] = n * origin + i * (polycube.Points[face.Corners[1]][axis] - origin) +
                      j * (polycube.Points[face.Corners[3]][axis] - origin);
      }
      const auto found = numbers.emplace(place, static_cast<Index>(points.size()));
      if (found.second)
      {
        points.push_back(Point(place[0], place[1], place[2]) / n);
      }
      return found.first->second;
    };
    for (int i = 0; i < n; ++i)
    {
      for (int j = 0; j < n; ++j)
      {
        triangles.push_back({ number(i, j), number(i + 1, j), number(i + 1, j + 1) });
        triangles.push_back({ number(i, j), number(i + 1, j + 1), number(i, j + 1) });
      }
    }
  }
  return SurfaceMesh(points, triangles);
}

/// The same surface with its points moved.
template <typename Map>
SurfaceMesh Moved(const SurfaceMesh& mesh, const Map& map)
{
  std::vector<Point> points;
  for (const Point& point : mesh.Points)
  {
    points.push_back(map(point));
  }
  return SurfaceMesh(points, mesh.Triangles);
}

/// The unit sphere: an icosahedron, each triangle cut in four `levels` times.
inline SurfaceMesh Icosphere(int levels)
{
  const double g = 0.5 * (1.0 + std::sqrt(5.0));
  std::vector<Point> points{ { -1, g, 0 }, { 1, g, 0 }, { -1, -g, 0 }, { 1, -g, 0 }, { 0, -1, g },
    { 0, 1, g }, { 0, -1, -g }, { 0, 1, -g }, { g, 0, -1 }, { g, 0, 1 }, { -g, 0, -1 },
    { -g, 0, 1 } };
  std::vector<Triangle> triangles{ { 0, 11, 5 }, { 0, 5, 1 }, { 0, 1, 7 }, { 0, 7, 10 },
    { 0, 10, 11 }, { 1, 5, 9 }, { 5, 11, 4 }, { 11, 10, 2 }, { 10, 7, 6 }, { 7, 1, 8 }, { 3, 9, 4 },
    { 3, 4, 2 }, { 3, 2, 6 }, { 3, 6, 8 }, { 3, 8, 9 }, { 4, 9, 5 }, { 2, 4, 11 }, { 6, 2, 10 },
    { 8, 6, 7 }, { 9, 8, 1 } };
  for (int level = 0; level < levels; ++level)
  {
    std::map<std::array<Index, 2>, Index> middles;
    const auto middle = [&](Index a, Index b)
    {
      const auto found =
        middles.emplace(std::array<Index, 2>{ std::min(a, b), std::max(a, b) }, points.size());
      if (found.second)
      {
        points.push_back((points[a] + points[b]).eval());
        points.back().normalize();
      }
      return found.first->second;
    };
    std::vector<Triangle> finer;
    for (Point& point : points)
    {
      point.normalize();
    }
    for (const Triangle& c : triangles)
    {
      const Index a = middle(c[0], c[1]), b = middle(c[1], c[2]), d = middle(c[2], c[0]);
      finer.insert(finer.end(), { { c[0], a, d }, { c[1], b, a }, { c[2], d, b }, { a, b, d } });
    }
    triangles = std::move(finer);
  }
  return SurfaceMesh(points, triangles);
}
}

#endif
