// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "LayoutSurfaces.h"
#include "Parameter/PatchMap.h"
#include "WatchedExecution.h"

#include <gtest/gtest.h>

#include <sys/resource.h>

using namespace trivariate;
using namespace trivariate_testing;
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace
{
// A cube of n x n squares a side, its points moved, without parameters. Patches: -x, +x, -y, ...
template <typename Map>
BlockDomain MovedCube(int n, const Map& map)
{
  const Polycube cube = Polycube::FromGrid({ 1, 1, 1 });
  const SurfaceMesh surface = SurfaceOf(cube, n);
  DomainParts parts;
  parts.Blocks = { cube.CubePoints[0] };
  parts.Segments = { 1 };
  for (const LatticePoint& p : cube.Points)
  {
    parts.Points.push_back(map(Vector3d(p[0], p[1], p[2])));
  }
  for (const Vector3d& p : surface.Points)
  {
    Index corner = -1;
    for (std::size_t c = 0; c < cube.Points.size(); ++c)
    {
      const LatticePoint& place = cube.Points[c];
      corner = p == Vector3d(place[0], place[1], place[2]) ? static_cast<Index>(c) : corner;
    }
    parts.SurfacePoints.push_back(map(p));
    parts.CornerOf.push_back(corner);
  }
  for (const Triangle& t : surface.Triangles)
  {
    int axis = 0;
    while (surface.Points[t[0]][axis] != surface.Points[t[1]][axis] ||
           surface.Points[t[0]][axis] != surface.Points[t[2]][axis])
    {
      ++axis;
    }
    parts.Triangles.push_back(t);
    parts.PatchOf.push_back(2 * axis + static_cast<Index>(surface.Points[t[0]][axis]));
  }
  return BlockDomain(std::move(parts));
}

// The places of the patch's corners, from the square's (0, 0) around.
std::array<Vector3d, 4> CornersOf(const BlockDomain& domain, Index patch)
{
  std::array<Vector3d, 4> corners;
  for (int i = 0; i < 4; ++i)
  {
    corners[i] = domain.Points[domain.Patches[patch].Corners[i]];
  }
  return corners;
}
}

//------------------------------------------------------------------------------
TEST(PatchMap, IsAffineOnParallelograms)
{
  const BlockDomain domain = MovedCube(
    12, [](const Vector3d& p) { return Vector3d(3.0 * p[0] + p[1], 2.0 * p[1], p[2] + p[0]); });
  for (Index patch = 0; patch < 6; ++patch)
  {
    const PatchMap map(domain, patch, Execution());
    const std::array<Vector3d, 4> x = CornersOf(domain, patch);
    for (const Vector2d& st :
      { Vector2d(0.0, 0.0), Vector2d(0.31, 0.77), Vector2d(0.5, 1.0), Vector2d(0.93, 0.02) })
    {
      const Vector3d wanted = x[0] + st[0] * (x[1] - x[0]) + st[1] * (x[3] - x[0]);
      EXPECT_LT((map.At(st) - wanted).norm(), 1e-9) << patch;
    }
    for (int i = 0; i < 4; ++i)
    {
      EXPECT_EQ(map.At(map.CornerOf(domain.Patches[patch].Corners[i])), x[i]);
    }
  }
}

TEST(PatchMap, SpreadsABump)
{
  // A spike as high as the cube is wide: half of the way up takes more than a tenth of the square.
  const BlockDomain domain = MovedCube(40,
    [](const Vector3d& p)
    {
      const double far = (Vector2d(p[0], p[1]) - Vector2d(0.5, 0.5)).squaredNorm();
      return Vector3d(p[0], p[1], p[2] * (1.0 + std::exp(-40.0 * far)));
    });
  const PatchMap map(domain, 5, Execution());
  int high = 0;
  for (int i = 0; i < 400; ++i)
  {
    high += map.At({ (i % 20 + 0.5) / 20.0, (i / 20 + 0.5) / 20.0 })[2] > 1.5 ? 1 : 0;
  }
  EXPECT_GT(high, 40);
  EXPECT_LT(high, 120);
}

TEST(PatchMap, StopsWithinASecond)
{
  const BlockDomain domain = MovedCube(200,
    [](const Vector3d& p)
    {
      const double far = (Vector2d(p[0], p[1]) - Vector2d(0.5, 0.5)).squaredNorm();
      return Vector3d(p[0], p[1], p[2] * (1.0 + std::exp(-40.0 * far)));
    });
  Watch watch;
  EXPECT_THROW(PatchMap(domain, 5, watch.Until(0.12)), Aborted); // in the second round
  EXPECT_LT(watch.LongestLook, 1.0);
}

//------------------------------------------------------------------------------
// A square with 16,000 slivers along its diagonal, each as long as it: a grid over their boxes
// would have more than 10^8 entries.
TEST(PatchMap, OfSliversTakesLittleMemory)
{
  constexpr int n = 8000;
  DomainParts parts;
  parts.Segments = { 1 };
  for (Index c = 0; c < 8; ++c)
  {
    parts.Points.emplace_back(c & 1, c >> 1 & 1, c >> 2);
  }
  parts.Blocks = { { 0, 1, 2, 3, 4, 5, 6, 7 } };
  const auto add = [&parts](double x, double y, Index corner)
  {
    parts.SurfacePoints.emplace_back(x, y, 1.0);
    parts.CornerOf.push_back(corner);
    return static_cast<Index>(parts.SurfacePoints.size()) - 1;
  };
  const Index right = add(1.0, 0.0, 5), left = add(0.0, 1.0, 6);
  std::vector<Index> low, high;
  for (int i = 0; i <= n; ++i)
  {
    const double at = 0.3 * i / n;
    low.push_back(add(at, 0.0, i == 0 ? 4 : -1));
    high.push_back(add(1.0, 1.0 - at, i == 0 ? 7 : -1));
  }
  parts.Parameters = parts.SurfacePoints;
  parts.Triangles = { { low[0], high[0], left }, { low[n], right, high[n] } };
  for (int i = 0; i < n; ++i)
  {
    parts.Triangles.push_back({ low[i], low[i + 1], high[i] });
    parts.Triangles.push_back({ low[i + 1], high[i + 1], high[i] });
  }
  parts.PatchOf.assign(parts.Triangles.size(), 0);
  const BlockDomain domain(std::move(parts));

  const auto peak = []()
  {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss; // in kB
  };
  const long before = peak();
  const PatchMap map(domain, 0, Execution());
  EXPECT_LT(peak() - before, 100000);
  const Vector2d base = map.CornerOf(4);
  const Vector2d along = map.CornerOf(5) - base, across = map.CornerOf(6) - base;
  for (const Vector2d& place :
    { Vector2d(0.2, 0.1), Vector2d(0.6, 0.55), Vector2d(0.99, 0.98), Vector2d(0.1, 0.8) })
  {
    const Vector2d st = base + place[0] * along + place[1] * across;
    EXPECT_LT((map.At(st) - Vector3d(place[0], place[1], 1.0)).norm(), 1e-6);
  }
}
