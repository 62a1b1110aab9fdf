// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// Solids on voxels with the six sides of a cube on their boundary, for frame fields.
#ifndef trivariate_FrameShapes_h
#define trivariate_FrameShapes_h

#include "Field/FrameVoxels.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

namespace trivariate
{
/**
 * A solid in a grid of n^3 voxels. Place: domain coordinates of a point, all within [0, 1] inside.
 * Gradient: the direction in which coordinate a grows there, of any length.
 */
struct FrameShape
{
  Index Size = 0;
  std::function<Eigen::Vector3d(const Eigen::Vector3d&)> Place;
  std::function<Eigen::Vector3d(const Eigen::Vector3d&, int)> Gradient;

  /// The side 0..5 beyond which a point lies most; -1 inside.
  int SideOf(const Eigen::Vector3d& point) const
  {
    const Eigen::Vector3d c = this->Place(point);
    int a;
    const double beyond = (c.array() - 0.5).abs().maxCoeff(&a);
    return beyond <= 0.5 ? -1 : 2 * a + (c[a] > 0.5 ? 1 : 0);
  }
};

/// The levels of a shape; labels: whether sides name their axes. free: sides that bind nothing.
inline std::vector<FrameLevel> LevelsOf(
  const FrameShape& shape, bool labels, const std::vector<int>& free = {})
{
  const Index n = shape.Size;
  const auto pointOf = [](const std::array<Index, 3>& p)
  {
    return Eigen::Vector3d(
      static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2]));
  };
  std::vector<std::uint8_t> mask(n * n * n);
  Index id = 0;
  for (Index k = 0; k < n; ++k)
  {
    for (Index j = 0; j < n; ++j)
    {
      for (Index i = 0; i < n; ++i, ++id)
      {
        mask[id] = shape.SideOf(pointOf({ i, j, k })) < 0 ? 1 : 0;
      }
    }
  }
  FrameVoxels voxels = CollectVoxels({ n, n, n }, mask.data());
  std::vector<FrameConstraint> constraints;
  for (Index v = 0; v < voxels.Count(); ++v)
  {
    const Eigen::Vector3d x = pointOf(voxels.Place(v));
    std::vector<int> seen = free;
    for (int face = 0; face < 6; ++face)
    {
      const int side = shape.SideOf(x + (face % 2 ? 1.0 : -1.0) * Eigen::Vector3d::Unit(face / 2));
      if (side < 0 || std::find(seen.begin(), seen.end(), side) != seen.end())
      {
        continue;
      }
      seen.push_back(side);
      const Eigen::Vector3f normal =
        ((side % 2 ? 1.0 : -1.0) * shape.Gradient(x, side / 2).normalized()).cast<float>();
      constraints.push_back({ static_cast<std::int32_t>(v), { normal[0], normal[1], normal[2] },
        static_cast<std::int8_t>(labels ? side : AnyAxis) });
    }
  }
  return MakeFrameLevels(std::move(voxels), std::move(constraints));
}

/// The image of the unit cube under the affine map with the columns of `edges`, in mid-grid.
inline FrameShape AffineBox(Index n, const Eigen::Matrix3d& edges)
{
  const Eigen::Matrix3d inverse = edges.inverse();
  // Off the grid's points, so that no voxel lies on the boundary.
  const Eigen::Vector3d middle(0.5 * n - 0.49, 0.5 * n - 0.48, 0.5 * n - 0.47);
  return { n,
    [inverse, middle](const Eigen::Vector3d& x) -> Eigen::Vector3d
    { return (inverse * (x - middle)).array() + 0.5; },
    [inverse](const Eigen::Vector3d&, int a) -> Eigen::Vector3d { return inverse.row(a); } };
}

inline FrameShape AlignedBox(Index n)
{
  return AffineBox(n, Eigen::Vector3d(0.8 * n, 0.6 * n, 0.7 * n).asDiagonal());
}

inline FrameShape TurnedBox(Index n)
{
  const Eigen::Matrix3d turn =
    Eigen::AngleAxisd(0.6, Eigen::Vector3d(1.0, 2.0, -0.5).normalized()).toRotationMatrix();
  return AffineBox(n, turn * Eigen::Vector3d(0.6 * n, 0.45 * n, 0.5 * n).asDiagonal());
}

/// Radius u, angle v from 0 to 90 degrees, height w.
inline FrameShape QuarterAnnulus(Index n)
{
  const double inner = 0.35 * n, outer = 0.95 * n;
  return { n,
    [n, inner, outer](const Eigen::Vector3d& x) -> Eigen::Vector3d
    {
      const double px = x[0] - 0.51, py = x[1] - 0.52;
      return { (std::hypot(px, py) - inner) / (outer - inner), std::atan2(py, px) / std::acos(0.0),
        (x[2] + 0.5) / (0.4 * n) };
    },
    [](const Eigen::Vector3d& x, int a) -> Eigen::Vector3d
    {
      const double px = x[0] - 0.51, py = x[1] - 0.52;
      return a == 0   ? Eigen::Vector3d(px, py, 0.0)
             : a == 1 ? Eigen::Vector3d(-py, px, 0.0)
                      : Eigen::Vector3d::UnitZ();
    } };
}

/// The sides are where each coordinate is the largest, as of a cube blown up.
inline FrameShape RoundBall(Index n)
{
  const double radius = 0.46 * n;
  const auto centred = [n](const Eigen::Vector3d& x) -> Eigen::Vector3d
  { return x - Eigen::Vector3d(0.5 * n - 0.49, 0.5 * n - 0.48, 0.5 * n - 0.47); };
  return { n,
    [centred, radius](const Eigen::Vector3d& x) -> Eigen::Vector3d
    {
      const Eigen::Vector3d d = centred(x);
      return 0.5 * d.norm() / (radius * d.cwiseAbs().maxCoeff()) * d.array() + 0.5;
    },
    [centred](const Eigen::Vector3d& x, int a) -> Eigen::Vector3d
    {
      const Eigen::Vector3d d = centred(x);
      return d[a] > 0.0 ? d : -d;
    } };
}

/// A square bar along z that turns by `turn` radians over its length.
inline FrameShape HelicalBar(Index n, double turn)
{
  const auto local = [n, turn](const Eigen::Vector3d& x) -> Eigen::Vector3d
  {
    const Eigen::Vector3d d = x - Eigen::Vector3d(0.5 * n - 0.49, 0.5 * n - 0.48, -0.5);
    const double t = turn * d[2] / n, c = std::cos(t), s = std::sin(t);
    return { c * d[0] + s * d[1], -s * d[0] + c * d[1], d[2] };
  };
  return { n,
    [local, n](const Eigen::Vector3d& x) -> Eigen::Vector3d
    {
      const Eigen::Vector3d d = local(x);
      return { d[0] / (0.5 * n) + 0.5, d[1] / (0.4 * n) + 0.5, d[2] / n };
    },
    [local, n, turn](const Eigen::Vector3d& x, int a) -> Eigen::Vector3d
    {
      const Eigen::Vector3d d = local(x);
      const double t = turn * d[2] / n, c = std::cos(t), s = std::sin(t);
      return a == 0   ? Eigen::Vector3d(c, s, turn / n * d[1])
             : a == 1 ? Eigen::Vector3d(-s, c, -turn / n * d[0])
                      : Eigen::Vector3d::UnitZ();
    } };
}
}

#endif
