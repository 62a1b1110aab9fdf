// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Parameter/BlockMeshing.h"
#include "Search/DomainShell.h"
#include "SegmentSurfaces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace trivariate;
using namespace trivariate_testing;

namespace
{
constexpr double Half = 24.0, Arm = 13.0; // of the length along the bar

// A bar along z, bent into a U: beyond +-Arm from its middle it is straight.
Vector3d Bent(const Vector3d& p)
{
  const double radius = 2.0 * Arm / EIGEN_PI, bent = std::clamp(p[2], -Half + Arm, Half - Arm);
  const double angle = bent / radius, rest = p[2] - bent;
  const Vector3d out(std::cos(angle), 0.0, std::sin(angle)), along(-out[2], 0.0, out[0]);
  return (radius + p[0]) * out + rest * along + p[1] * Vector3d::UnitY();
}

// A U with all of its corners around one end: nodes slide over the borders of the small patches
// there until cells are even, and so around the bend, from where the nearest point of their patch
// is across the gap.
BlockDomain Lopsided()
{
  const SurfaceMesh surface = Moved(Icosphere(6),
    [](const Vector3d& p) {
      return Bent({ 4.0 * p[0], 4.0 * p[1], Half * p[2] });
    });
  const Polycube cube = Polycube::FromGrid({ 1, 1, 1 }, {});
  std::vector<Vector3d> corners;
  for (Index i = 0; i < cube.NumberOfCorners; ++i)
  {
    const LatticePoint& p = cube.Points[i];
    corners.push_back(Bent({ 4.0 * p[0] - 2.0, 4.0 * p[1] - 2.0, p[2] == 0 ? 12.0 : 20.0 }));
  }
  const SegmentDomain domain = DomainFromCorners(surface, cube, corners, Execution());
  return DomainOfSegment(LayeredBlocks(domain, 2.0, Execution()), domain);
}

// The domain, and the same once more at another place.
BlockDomain Twice(const BlockDomain& domain, const Vector3d& shift)
{
  DomainParts parts = domain;
  const Index points = static_cast<Index>(domain.Points.size());
  const Index surfacePoints = static_cast<Index>(domain.SurfacePoints.size());
  const Index patches = static_cast<Index>(domain.Patches.size());
  for (BlockPoints block : domain.Blocks)
  {
    std::transform(
      block.begin(), block.end(), block.begin(), [points](Index p) { return p + points; });
    parts.Blocks.push_back(block);
  }
  parts.Segments.insert(parts.Segments.end(), domain.Segments.begin(), domain.Segments.end());
  for (const Vector3d& p : domain.Points)
  {
    parts.Points.push_back(p + shift);
  }
  for (const Vector3d& p : domain.SurfacePoints)
  {
    parts.SurfacePoints.push_back(p + shift);
  }
  for (const Index corner : domain.CornerOf)
  {
    parts.CornerOf.push_back(corner < 0 ? -1 : corner + points);
  }
  parts.Parameters.insert(
    parts.Parameters.end(), domain.Parameters.begin(), domain.Parameters.end());
  for (const Triangle& t : domain.Triangles)
  {
    parts.Triangles.push_back({ t[0] + surfacePoints, t[1] + surfacePoints, t[2] + surfacePoints });
  }
  for (const Index patch : domain.PatchOf)
  {
    parts.PatchOf.push_back(patch + patches);
  }
  return BlockDomain(std::move(parts));
}

// How far from their own patches nodes are, in the mean.
double SlidBy(const BlockDomain& domain, const BlockMesh& mesh)
{
  const DomainSurface surface(domain, 1.0);
  double sum = 0.0, count = 0.0;
  const std::vector<PatchFace> faces = PatchFaces(domain, mesh);
  for (std::size_t patch = 0; patch < faces.size(); ++patch)
  {
    for (const Index node : faces[patch].Nodes)
    {
      const Vector3d& place = mesh.Places[node];
      sum += (surface.NearestOnPatch(static_cast<Index>(patch), place).Place - place).norm();
      count += 1.0;
    }
  }
  return sum / count;
}
}

//------------------------------------------------------------------------------
TEST(BlockResampling, LeavesNodesWhereTheySlid)
{
  const BlockDomain domain = Lopsided();
  BlockMeshOptions options;
  options.CellLength = 2.0;
  options.Freedom = 0.45;
  options.LayerCells = 2.0;
  BlockMeshReport made, report;
  const BlockMesh mesh = MakeBlockMesh(domain, options, Execution(), &made);
  ASSERT_EQ(made.End.Inverted, 0);
  ASSERT_GT(SlidBy(domain, mesh), 1.0);
  const BlockMesh same = RefineBlockMesh(domain, mesh, options, Execution(), &report);
  EXPECT_EQ(report.Start.Inverted, 0);
  ASSERT_EQ(same.Places.size(), mesh.Places.size());
  for (std::size_t node = 0; node < mesh.Places.size(); ++node)
  {
    ASSERT_LT((same.Places[node] - mesh.Places[node]).norm(), 1e-12) << node;
  }
  options.CellLength = 1.0;
  RefineBlockMesh(domain, mesh, options, Execution(), &report);
  EXPECT_EQ(report.End.Inverted, 0);
  EXPECT_LE(report.Distances.ToFaces.Largest, 1.001 * made.Distances.ToFaces.Largest);
}

//------------------------------------------------------------------------------
TEST(DomainSurface, FindsTheNearestPointOfAPiece)
{
  const BlockDomain domain = Lopsided();
  const Vector3d shift(0.0, 9.0, 0.0);
  const BlockDomain two = Twice(domain, shift);
  const DomainSurface surface(domain, 1.0), surfaces(two, 1.0);
  const Index other = static_cast<Index>(domain.Patches.size());
  for (const Vector3d& p : domain.SurfacePoints)
  {
    ASSERT_LT((surfaces.NearestOnPieceOf(0, p).Place - p).norm(), 1e-12);
    ASSERT_LT((surfaces.NearestOnPieceOf(other, p + shift).Place - p - shift).norm(), 1e-12);
    const Vector3d across = surface.NearestOnPieceOf(0, p + shift).Place;
    ASSERT_GT((across - p - shift).norm(), 0.5);
    ASSERT_LT((surfaces.NearestOnPieceOf(0, p + shift).Place - across).norm(), 1e-12);
  }
}
