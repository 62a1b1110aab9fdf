// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// Solids with known parameters: images of the unit cube.
#ifndef trivariate_ParameterShapes_h
#define trivariate_ParameterShapes_h

#include "Parameter/VoxelParameter.h"

#include <cmath>
#include <functional>
#include <map>
#include <vector>

namespace trivariate
{
/// A map of the unit cube to a grid of n^3 voxels, its inverse, and wanted gradients in space.
struct ParameterShape
{
  Index Size = 0;
  std::function<Eigen::Vector3d(const Eigen::Vector3d&)> Point;
  std::function<Eigen::Vector3d(const Eigen::Vector3d&)> Place;
  std::function<Eigen::Matrix3d(const Eigen::Vector3d&)> Frame;
  std::array<int, 3> Cubes = { 1, 1, 1 };

  /// The parameter in lattice units.
  Eigen::Vector3d Parameter(const Eigen::Vector3d& x) const
  {
    return this->Place(x).cwiseProduct(
      Eigen::Vector3d(this->Cubes[0], this->Cubes[1], this->Cubes[2]));
  }
};

inline Eigen::Matrix3d RowsOf(
  const Eigen::Vector3d& u, const Eigen::Vector3d& v, const Eigen::Vector3d& w)
{
  Eigen::Matrix3d rows;
  rows << u.transpose(), v.transpose(), w.transpose();
  return rows;
}

/// A parallelepiped, no side along the grid. Frames are its gradients, so it is solved exactly.
inline ParameterShape SlantedBox(Index n)
{
  Eigen::Matrix3d edges;
  edges << 0.6, 0.1, -0.15, -0.12, 0.55, 0.1, 0.1, -0.13, 0.5;
  edges *= static_cast<double>(n);
  const Eigen::Matrix3d inverse = edges.inverse();
  const Eigen::Vector3d middle(0.5 * n - 0.49, 0.5 * n - 0.48, 0.5 * n - 0.47);
  return { n,
    [edges, middle](const Eigen::Vector3d& p) -> Eigen::Vector3d
    { return middle + edges * (p.array() - 0.5).matrix(); },
    [inverse, middle](const Eigen::Vector3d& x) -> Eigen::Vector3d
    { return (inverse * (x - middle)).array() + 0.5; },
    [inverse](const Eigen::Vector3d&) -> Eigen::Matrix3d { return inverse; } };
}

/// Radius, angle from 0 to 90 degrees, height, with unit frames: lengths are solved for.
inline ParameterShape QuarterTube(Index n, double inner, double thick, double height)
{
  const double right = std::acos(0.0);
  const Eigen::Vector3d origin(0.51, 0.52, 3.3);
  return { n,
    [=](const Eigen::Vector3d& p) -> Eigen::Vector3d
    {
      const double r = inner + thick * p[0], t = right * p[1];
      return origin + Eigen::Vector3d(r * std::cos(t), r * std::sin(t), height * p[2]);
    },
    [=](const Eigen::Vector3d& x) -> Eigen::Vector3d
    {
      const Eigen::Vector3d d = x - origin;
      return { (std::hypot(d[0], d[1]) - inner) / thick, std::atan2(d[1], d[0]) / right,
        d[2] / height };
    },
    [=](const Eigen::Vector3d& x) -> Eigen::Matrix3d
    {
      const Eigen::Vector3d r =
        Eigen::Vector3d(x[0] - origin[0], x[1] - origin[1], 0.0).normalized();
      return RowsOf(r, Eigen::Vector3d::UnitZ().cross(r), Eigen::Vector3d::UnitZ());
    } };
}

inline ParameterShape UnitAnnulus(Index n)
{
  return QuarterTube(n, 0.35 * n, 0.55 * n, 0.4 * n);
}

/// A square bar along z that turns by `turn` radians over its length; frames are its gradients.
inline ParameterShape TwistedBar(Index n, double turn)
{
  const double wide = 0.5 * n, deep = 0.4 * n, high = 0.85 * n;
  const Eigen::Vector3d origin(0.5 * n - 0.49, 0.5 * n - 0.48, 0.07 * n);
  const auto turned = [turn](double w) -> Eigen::Matrix3d
  { return Eigen::AngleAxisd(turn * w, Eigen::Vector3d::UnitZ()).toRotationMatrix(); };
  return { n,
    [=](const Eigen::Vector3d& p) -> Eigen::Vector3d
    {
      return origin +
             turned(p[2]) * Eigen::Vector3d(wide * (p[0] - 0.5), deep * (p[1] - 0.5), high * p[2]);
    },
    [=](const Eigen::Vector3d& x) -> Eigen::Vector3d
    {
      const Eigen::Vector3d d = turned((x[2] - origin[2]) / high).transpose() * (x - origin);
      return { d[0] / wide + 0.5, d[1] / deep + 0.5, d[2] / high };
    },
    [=](const Eigen::Vector3d& x) -> Eigen::Matrix3d
    {
      const Eigen::Matrix3d r = turned((x[2] - origin[2]) / high);
      const Eigen::Vector3d d = r.transpose() * (x - origin);
      const double rate = turn / high;
      return RowsOf((r.col(0) + rate * d[1] * Eigen::Vector3d::UnitZ()) / wide,
        (r.col(1) - rate * d[0] * Eigen::Vector3d::UnitZ()) / deep,
        Eigen::Vector3d::UnitZ() / high);
    } };
}

/// Radius, polar angle, azimuth of a spherical shell; frames are its gradients.
inline ParameterShape ShellSector(Index n)
{
  const double inner = 0.5 * n, thick = 0.4 * n, polar = 0.9, azimuth = 1.1;
  const Eigen::Vector3d origin(0.51, 0.52, -0.1 * n);
  const auto anglesOf = [=](const Eigen::Vector3d& d) -> Eigen::Vector3d {
    return { d.norm(), std::acos(d[2] / d.norm()), std::atan2(d[1], d[0]) };
  };
  return { n,
    [=](const Eigen::Vector3d& p) -> Eigen::Vector3d
    {
      const double r = inner + thick * p[0], t = 0.35 + polar * p[1], f = 0.2 + azimuth * p[2];
      return origin +
             r * Eigen::Vector3d(std::sin(t) * std::cos(f), std::sin(t) * std::sin(f), std::cos(t));
    },
    [=](const Eigen::Vector3d& x) -> Eigen::Vector3d
    {
      const Eigen::Vector3d a = anglesOf(x - origin);
      return { (a[0] - inner) / thick, (a[1] - 0.35) / polar, (a[2] - 0.2) / azimuth };
    },
    [=](const Eigen::Vector3d& x) -> Eigen::Matrix3d
    {
      const Eigen::Vector3d a = anglesOf(x - origin);
      const double t = a[1], f = a[2];
      return RowsOf((x - origin).normalized() / thick,
        Eigen::Vector3d(std::cos(t) * std::cos(f), std::cos(t) * std::sin(f), -std::sin(t)) /
          (a[0] * polar),
        Eigen::Vector3d(-std::sin(f), std::cos(f), 0.0) / (a[0] * std::sin(t) * azimuth));
    } };
}

/// The boundary of the unit cube, m x m squares on each of its sides, mapped; and the lines where
/// its cubes meet.
inline ParameterSurface SurfaceOf(const ParameterShape& shape, int m)
{
  ParameterSurface surface;
  std::map<std::array<int, 3>, Index> numbers;
  const auto pointAt = [&](const std::array<int, 3>& p)
  {
    const auto [at, fresh] = numbers.emplace(p, static_cast<Index>(surface.Points.size()));
    if (fresh)
    {
      surface.Points.push_back(shape.Point(Eigen::Vector3d(p[0], p[1], p[2]) / m));
    }
    return at->second;
  };
  for (int axis = 0; axis < 3; ++axis)
  {
    for (int side = 0; side < 2; ++side)
    {
      for (int s = 0; s < m; ++s)
      {
        for (int t = 0; t < m; ++t)
        {
          const auto corner = [&](int ds, int dt)
          {
            std::array<int, 3> p;
            p[axis] = side * m;
            p[(axis + 1) % 3] = s + ds;
            p[(axis + 2) % 3] = t + dt;
            return pointAt(p);
          };
          const Index a = corner(0, 0), b = corner(1, 0), c = corner(1, 1), d = corner(0, 1);
          for (const Triangle& triangle : { Triangle{ a, b, c }, Triangle{ a, c, d } })
          {
            surface.Triangles.push_back(
              side == 1 ? triangle : Triangle{ triangle[0], triangle[2], triangle[1] });
            surface.Planes.push_back({ axis, side * shape.Cubes[axis] });
          }
        }
      }
    }
    for (int coordinate = 1; coordinate < shape.Cubes[axis]; ++coordinate)
    {
      for (int edge = 0; edge < 4; ++edge)
      {
        for (int s = 0; s < m; ++s)
        {
          const auto at = [&](int along)
          {
            const int across = edge < 2 ? (axis + 1) % 3 : (axis + 2) % 3;
            std::array<int, 3> p;
            p[axis] = coordinate * m / shape.Cubes[axis];
            p[across] = along;
            p[3 - axis - across] = edge % 2 * m;
            return pointAt(p);
          };
          surface.Lines.push_back({ at(s), at(s + 1) });
          surface.LinePlanes.push_back({ axis, coordinate });
        }
      }
    }
  }
  return surface;
}

inline Eigen::Vector3d VoxelPlace(const ParameterShape& shape, Index id)
{
  const Index n = shape.Size;
  return { static_cast<double>(id % n), static_cast<double>(id / n % n),
    static_cast<double>(id / n / n) };
}

/// 1 at the voxels inside.
inline std::vector<std::uint8_t> MaskOf(const ParameterShape& shape)
{
  std::vector<std::uint8_t> mask(shape.Size * shape.Size * shape.Size);
  for (Index id = 0; id < static_cast<Index>(mask.size()); ++id)
  {
    const Eigen::Vector3d p = shape.Place(VoxelPlace(shape, id));
    mask[id] = (p.array() - 0.5).abs().maxCoeff() <= 0.5 ? 1 : 0;
  }
  return mask;
}

/// mask: of MaskOf, which must outlive the result.
inline ParameterVoxels VoxelsOf(const ParameterShape& shape, const std::vector<std::uint8_t>& mask)
{
  return { { shape.Size, shape.Size, shape.Size }, Eigen::Vector3d::Ones(), mask.data(),
    [shape](Index id) { return shape.Frame(VoxelPlace(shape, id)); } };
}
}

#endif
