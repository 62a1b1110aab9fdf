// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// Surfaces of segments, moved and shuffled, for tests of domains.
#ifndef trivariate_SegmentSurfaces_h
#define trivariate_SegmentSurfaces_h

#include "Domain/Polycube.h"
#include "LayoutSurfaces.h"
#include "Boundary/SegmentBoundary.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <numeric>
#include <random>

namespace trivariate_testing
{
using Eigen::Vector3d;
using trivariate::BoundaryOptions;
using trivariate::Execution;
using trivariate::LatticePoint;
using trivariate::SegmentBoundary;

/// Points and triangles in another order, each triangle beginning with another corner.
inline SurfaceMesh Shuffled(const SurfaceMesh& mesh, int seed)
{
  std::mt19937 random(seed);
  std::vector<Index> number(mesh.Points.size());
  std::iota(number.begin(), number.end(), Index(0));
  std::shuffle(number.begin(), number.end(), random);
  std::vector<Vector3d> points(mesh.Points.size());
  for (std::size_t p = 0; p < points.size(); ++p)
  {
    points[number[p]] = mesh.Points[p];
  }
  std::vector<Triangle> triangles = mesh.Triangles;
  std::shuffle(triangles.begin(), triangles.end(), random);
  for (Triangle& c : triangles)
  {
    c = { number[c[0]], number[c[1]], number[c[2]] };
    std::rotate(c.begin(), c.begin() + random() % 3, c.end());
  }
  return SurfaceMesh(points, triangles);
}

inline SurfaceMesh Turned(const SurfaceMesh& mesh, int seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  const double x = any(random), y = any(random), z = any(random), angle = 3.0 * any(random);
  const Eigen::Matrix3d turn =
    Eigen::AngleAxisd(angle, Vector3d(x, y, z).normalized()).toRotationMatrix();
  return Moved(
    mesh, [&turn](const Vector3d& p) { return Vector3d(turn * p + Vector3d(5.0, -3.0, 2.0)); });
}

/// The closed surface of a segment, from those of a volume.
inline SurfaceMesh SurfaceOfSegment(const SegmentBoundary& boundary, std::int32_t segment)
{
  std::vector<Index> number(boundary.Points.size(), -1);
  std::vector<Vector3d> points;
  std::vector<Triangle> triangles;
  for (std::size_t t = 0; t < boundary.Triangles.size(); ++t)
  {
    const auto& labels = boundary.Labels[t];
    if (labels[0] != segment && labels[1] != segment)
    {
      continue;
    }
    Triangle triangle;
    for (int k = 0; k < 3; ++k)
    {
      const Index p = boundary.Triangles[t][k];
      if (number[p] < 0)
      {
        number[p] = static_cast<Index>(points.size());
        points.push_back({ boundary.Points[p][0], boundary.Points[p][1], boundary.Points[p][2] });
      }
      // Normals point from the first label to the second.
      triangle[labels[1] == segment ? 2 - k : k] = number[p];
    }
    triangles.push_back(triangle);
  }
  return SurfaceMesh(points, triangles);
}

template <typename Label>
SegmentBoundary BoundaryOf(const std::array<Index, 3>& size, const Label& label)
{
  std::vector<std::int32_t> labels;
  for (Index k = 0; k < size[2]; ++k)
  {
    for (Index j = 0; j < size[1]; ++j)
    {
      for (Index i = 0; i < size[0]; ++i)
      {
        labels.push_back(label(static_cast<int>(i), static_cast<int>(j), static_cast<int>(k)));
      }
    }
  }
  return ComputeSegmentBoundary({ labels.data(), size }, BoundaryOptions(), Execution());
}

/// Each cube n voxels long, edges rounded as surfaces of segments have them.
inline SurfaceMesh RoundedSurfaceOf(const Polycube& polycube, int n)
{
  constexpr int margin = 3;
  const auto inside = [&](int i, int j, int k)
  {
    const auto cell = [n](int x) { return x < margin ? -1 : (x - margin) / n; };
    const LatticePoint cube{ cell(i), cell(j), cell(k) };
    return std::count(polycube.Cubes.begin(), polycube.Cubes.end(), cube) > 0 ? 1 : 0;
  };
  std::array<Index, 3> size{ 0, 0, 0 };
  for (const LatticePoint& p : polycube.Points)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      size[axis] = std::max<Index>(size[axis], p[axis] * n + 2 * margin);
    }
  }
  return SurfaceOfSegment(BoundaryOf(size, inside), 1);
}
}

#endif
