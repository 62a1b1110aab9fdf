// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// A ball as a cube with a layer on each side, mapped in closed form, and phantoms over it.
#ifndef trivariate_BallBlocks_h
#define trivariate_BallBlocks_h

#include "BlockShapes.h"
#include "Fit/BlockFit.h"

#include <cmath>

namespace trivariate
{
/// The core is a cube of half the side Core times the radius; rays from it to the sphere are the
/// depth lines of the layers of LayeredCubeComplex.
struct BallMap
{
  double Radius = 1.0;
  double Core = 0.45;
  BlockComplex Blocks = LayeredCubeComplex();

  /// The place of (u, v, w) of parameter space, in block b.
  std::array<double, 3> Place(Index b, const std::array<double, 3>& parameter) const
  {
    std::array<double, 3> q; // in [-1, 1]
    for (int a = 0; a < 3; ++a)
    {
      q[a] = 2.0 * (parameter[a] - this->Blocks.Origins[b][a]) - 1.0;
    }
    double onCore = this->Radius * this->Core, onSphere = 0.0;
    if (b > 0)
    {
      const int axis = static_cast<int>((b - 1) / 2);
      const double side = (b - 1) % 2 ? 1.0 : -1.0;
      const double depth = 0.5 + 0.5 * side * q[axis]; // 1 on the sphere
      q[axis] = side;
      onCore *= 1.0 - depth;
      onSphere = this->Radius * depth / std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2]);
    }
    return { (onCore + onSphere) * q[0], (onCore + onSphere) * q[1], (onCore + onSphere) * q[2] };
  }

  /// The parameter of a place in the ball; false outside.
  bool Find(const std::array<double, 3>& place, std::array<double, 3>& parameter) const
  {
    std::array<double, 3> q;
    int axis = 0;
    double r = 0.0;
    for (int a = 0; a < 3; ++a)
    {
      q[a] = place[a] / this->Radius;
      r += q[a] * q[a];
      axis = std::abs(q[a]) > std::abs(q[axis]) ? a : axis;
    }
    r = std::sqrt(r);
    const double m = std::abs(q[axis]);
    if (r > 1.0)
    {
      return false;
    }
    const bool isCore = m <= this->Core;
    const int side = q[axis] > 0.0 ? 1 : 0;
    const double depth = isCore ? 0.0 : (m - this->Core) / (m / r - this->Core);
    const Index b = isCore ? 0 : 1 + 2 * axis + side;
    for (int a = 0; a < 3; ++a)
    {
      const double local = isCore      ? 0.5 + 0.5 * q[a] / this->Core
                           : a == axis ? (side ? depth : 1.0 - depth)
                                       : 0.5 + 0.5 * q[a] / m;
      parameter[a] = this->Blocks.Origins[b][a] + local;
    }
    return true;
  }

  /// (n + 1)^3 nodes of each block.
  ShapeSamples Nodes(int n) const
  {
    ShapeSamples shape;
    for (Index b = 0; b < this->Blocks.Size(); ++b)
    {
      AddSamplesOfBlock(
        this->Blocks, b, { n, n, n },
        [this, b](const std::array<double, 3>& local)
        {
          const LatticePoint& o = this->Blocks.Origins[b];
          return this->Place(b, { o[0] + local[0], o[1] + local[1], o[2] + local[2] });
        },
        shape);
    }
    return shape;
  }
};

/// A ball of smooth texture whose edge is blurred by a voxel, in n^3 voxels of side one with the
/// origin in the middle: the voxels that are not empty, with their parameters, and the whole grid.
struct BallPhantom
{
  BallMap Map;
  BlockSamples Voxels;
  std::vector<double> Grid;
  std::vector<std::uint8_t> Mask;

  explicit BallPhantom(int n)
    : Grid(static_cast<std::size_t>(n) * n * n, 0.0)
    , Mask(Grid.size(), 0)
  {
    const double ball = 0.5 * n - 3.0;
    this->Map.Radius = ball + 0.5;
    for (int m = 0; m < n * n * n; ++m)
    {
      const double c = 0.5 * (n - 1);
      const std::array<double, 3> x{ m % n - c, m / n % n - c, m / n / n - c };
      const double r = std::sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
      const double density = std::clamp(ball - r + 0.5, 0.0, 1.0) *
                             (0.8 + 0.1 * std::cos(x[0] / 6.0) * std::cos(x[1] / 7.0));
      std::array<double, 3> p;
      this->Grid[m] = density;
      if (density > 0.0 && this->Map.Find(x, p))
      {
        this->Mask[m] = 1;
        this->Voxels.Parameters.insert(this->Voxels.Parameters.end(), p.begin(), p.end());
        this->Voxels.Places.insert(this->Voxels.Places.end(), x.begin(), x.end());
        this->Voxels.Values.push_back(density);
      }
    }
  }
};
}

#endif
