// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Parameter/BlockMeshing.h"
#include "Parameter/CornerEnergy.h"
#include "Search/DomainShell.h"
#include "SegmentSurfaces.h"
#include "ThreadedExecution.h"
#include "WatchedExecution.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace trivariate;
using namespace trivariate_testing;

namespace
{
SegmentDomain LaidOut(const Polycube& cubes, double size, int n)
{
  std::vector<Vector3d> corners;
  for (Index i = 0; i < cubes.NumberOfCorners; ++i)
  {
    const LatticePoint& p = cubes.Points[i];
    corners.push_back(size * Vector3d(p[0], p[1], p[2]));
  }
  const SurfaceMesh mesh =
    Moved(SurfaceOf(cubes, n), [size](const Vector3d& p) { return Vector3d(size * p); });
  return DomainFromCorners(mesh, cubes, corners, Execution());
}

// Its first two axes change places.
void Mirror(DomainBlock& block)
{
  std::swap(block.Points[1], block.Points[3]);
  std::swap(block.Points[5], block.Points[7]);
}

double VolumeOf(const SurfaceMesh& mesh)
{
  double volume = 0.0;
  for (const Triangle& c : mesh.Triangles)
  {
    volume += mesh.Points[c[0]].dot(mesh.Points[c[1]].cross(mesh.Points[c[2]])) / 6.0;
  }
  return volume;
}

double VolumeOf(const BlockMesh& mesh)
{
  double volume = 0.0;
  for (const BlockPoints& cell : BlockCells(mesh).Cells)
  {
    volume += HexahedronVolume(mesh.Places, cell);
  }
  return volume;
}

// Nothing inverted, nodes of patches as near to the surface as they must be, all of the volume.
CellQuality ExpectSound(
  const BlockDomain& domain, const BlockMesh& mesh, double volume, double freedom, double share)
{
  const CellQuality quality = QualityOf(mesh, Execution());
  EXPECT_EQ(quality.Inverted, 0);
  EXPECT_GT(quality.LeastJacobian, 0.0);
  EXPECT_NEAR(VolumeOf(mesh), volume, share * volume);
  const TriangleTree surface(domain.SurfacePoints, domain.Triangles);
  for (const PatchFace& face : PatchFaces(domain, mesh))
  {
    for (const Index node : face.Nodes)
    {
      EXPECT_LT(surface.Nearest(mesh.Places[node]).Distance, freedom + 1e-9);
    }
  }
  return quality;
}

double FarthestOf(const BlockDomain& domain, const BlockMesh& mesh)
{
  return DistancesOfFaces(domain, mesh, Execution()).ToFaces.Largest;
}
}

//------------------------------------------------------------------------------
TEST(CornerEnergy, HasTheDerivativesOfItsValue)
{
  const std::vector<Vector3d> places{ { 0, 0, 0 }, { 2, .1, 0 }, { 2.2, 3, .3 }, { .1, 3, -.2 },
    { 0, .4, 4 }, { 2.3, 0, 4.1 }, { 2, 3, 4 }, { 0, 2.7, 4.4 } };
  const BlockPoints cell{ 0, 1, 2, 3, 4, 5, 6, 7 };
  const Vector3d lengths(1.5, 3.5, 4.0), d(0.3, -0.2, 0.5);
  for (int corner = 0; corner < 8; ++corner)
  {
    for (int axis = -1; axis < 3; ++axis)
    {
      const CornerTerm term = TermOf(places, cell, corner, axis, lengths);
      std::vector<Vector3d> moved = places;
      moved[axis < 0 ? corner : AcrossAxis(corner, axis)] += d;
      const Eigen::Matrix3d j = CornerJacobian(moved, cell, corner, lengths);
      EXPECT_NEAR(term.TraceAt(d), j.squaredNorm(), 1e-12);
      EXPECT_NEAR(term.DeterminantAt(d), j.determinant(), 1e-12);
    }
  }
  const double h = 1e-5;
  for (const double epsilon : { 1e-8, 0.1, 1.0 })
  {
    for (const double det : { -0.7, 0.05, 0.9, 3.0 })
    {
      if (det < 0.0 && epsilon < 0.1)
      {
        continue; // almost infinite there
      }
      const double trace = 3.4;
      const auto at = [&](double t, double x)
      { return CornerEnergy(trace + t, det + x, epsilon, 0.7); };
      const EnergyDerivatives e = CornerDerivatives(trace, det, epsilon, 0.7);
      EXPECT_DOUBLE_EQ(e.Value, at(0, 0));
      const double scale = 1.0 + std::abs(e.ByDeterminantTwice);
      EXPECT_NEAR(e.ByTrace, (at(h, 0) - at(-h, 0)) / (2 * h), 1e-5 * scale);
      EXPECT_NEAR(e.ByDeterminant, (at(0, h) - at(0, -h)) / (2 * h), 1e-5 * scale);
      EXPECT_NEAR(
        e.ByBoth, (at(h, h) - at(h, -h) - at(-h, h) + at(-h, -h)) / (4 * h * h), 1e-4 * scale);
      EXPECT_NEAR(
        e.ByDeterminantTwice, (at(0, h) - 2 * at(0, 0) + at(0, -h)) / (h * h), 1e-3 * scale);
    }
  }
}

TEST(BlockMeshing, KeepsABoxAGrid)
{
  const SegmentDomain box = LaidOut(Polycube::FromGrid({ 2, 1, 1 }), 6.0, 6);
  const BlockDomain domain = DomainOfSegment(CubeBlocks(box), box);
  BlockMeshOptions options;
  options.CellLength = 1.0;
  const BlockMesh mesh = MakeBlockMesh(domain, options, Execution());
  EXPECT_EQ(mesh.NumberOfCells(), 2 * 216);
  for (const Vector3d& place : mesh.Places)
  {
    EXPECT_LT((place - place.array().round().matrix()).norm(), 1e-6);
  }
}

TEST(BlockMeshing, FillsManyShapesWithoutFolds)
{
  struct Case
  {
    std::array<int, 3> Size;
    std::vector<unsigned char> Present;
  };
  for (const Case& c : { Case{ { 1, 1, 1 }, {} }, Case{ { 2, 2, 1 }, { 1, 1, 1, 0 } },
         Case{ { 3, 2, 1 }, { 1, 1, 1, 0, 1, 0 } }, Case{ { 3, 2, 1 }, { 1, 1, 1, 1, 0, 1 } } })
  {
    const Polycube cubes = Polycube::FromGrid(c.Size, c.Present);
    const SegmentDomain shape = LaidOut(cubes, 10.0, 6);
    const double volume = 1000.0 * cubes.Cubes.size();
    BlockMeshOptions options;
    options.CellLength = 1.5;
    for (const DomainBlocks& blocks : { CubeBlocks(shape), LayeredBlocks(shape, 2.5, Execution()) })
    {
      const BlockDomain domain = DomainOfSegment(blocks, shape);
      const BlockMesh mesh = MakeBlockMesh(domain, options, Execution());
      EXPECT_GT(ExpectSound(domain, mesh, volume, 0.0, 1e-6).LeastJacobian, 0.3);
      EXPECT_LT(FarthestOf(domain, mesh), 1e-6); // sharp edges hold their nodes
    }
  }
}

TEST(BlockMeshing, FillsABallOnAnyThreads)
{
  const SurfaceMesh surface =
    Moved(Icosphere(4), [](const Vector3d& p) { return Vector3d(10.0 * p); });
  const SegmentDomain ball = FindDomain(surface, DomainOptions(), Execution());
  const BlockDomain domain = DomainOfSegment(LayeredBlocks(ball, 2.5, Execution()), ball);
  BlockMeshOptions options;
  options.CellLength = 1.0;
  options.Freedom = 0.25;
  BlockMeshReport report;
  const BlockMesh mesh = MakeBlockMesh(domain, options, Execution(), &report);
  const CellQuality quality = ExpectSound(domain, mesh, VolumeOf(surface), 0.25, 0.002);
  EXPECT_EQ(report.End.Cells, quality.Cells);
  EXPECT_GT(quality.LeastJacobian, 0.4);
  EXPECT_GT(quality.MeanJacobian, 0.93);
  // The freedom, and what the diagonal of a cell, a chord, leaves of a sphere of radius 10.
  EXPECT_LT(FarthestOf(domain, mesh), 0.25 + 2.0 / 80.0);
  EXPECT_GT(quality.LowRatio, 0.3);
  EXPECT_LT(quality.HighRatio, 3.0);
  EXPECT_EQ(MakeBlockMesh(domain, options, ThreadedExecution(3)).Places, mesh.Places);
  EXPECT_EQ(report.Distances.ToFaces.Largest, FarthestOf(domain, mesh));
}

// A box whose face at x = 12 is drawn out to a ridge along y.
TEST(BlockMeshing, MeasuresDistancesBothWays)
{
  const SegmentDomain box = LaidOut(Polycube::FromGrid({ 1, 1, 1 }), 12.0, 6);
  const BlockDomain domain = DomainOfSegment(CubeBlocks(box), box);
  BlockMeshOptions options;
  options.CellsPerBlock = 6;
  BlockMeshReport report;
  BlockMesh mesh = MakeBlockMesh(domain, options, Execution(), &report);
  EXPECT_LT(report.Distances.ToFaces.Largest, 1e-6);
  EXPECT_LT(report.Distances.FromFaces.Largest, 1e-6);
  const double height = 1.0;
  for (Vector3d& place : mesh.Places)
  {
    place.x() += place.x() > 11.0 ? height * (1.0 - std::abs(place.z() - 6.0) / 6.0) : 0.0;
  }
  for (const Execution& execution : { Execution(), Execution(ThreadedExecution(3)) })
  {
    const SurfaceDistances distances = DistancesOfFaces(domain, mesh, execution);
    EXPECT_NEAR(distances.FromFaces.Largest, height, 1e-6); // from the ridge
    // To the slopes at right angles.
    EXPECT_NEAR(distances.ToFaces.Largest, height * 6.0 / std::sqrt(37.0), 0.05);
    // A sixth of the area is on average a third of the height squared away: sqrt(1 / 18).
    EXPECT_NEAR(distances.FromFaces.Mean, height / std::sqrt(18.0), 0.02);
    EXPECT_NEAR(distances.ToFaces.Mean, height / std::sqrt(18.0), 0.02);
  }
}

TEST(BlockMeshing, FillsAShell)
{
  const SurfaceMesh inside =
    Moved(Icosphere(3), [](const Vector3d& p) { return Vector3d(5.0 * p); });
  const SurfaceMesh outside =
    Moved(Icosphere(4), [](const Vector3d& p) { return Vector3d(10.0 * p + Vector3d(1, 0.5, 0)); });
  const SegmentDomain inner = FindDomain(inside, DomainOptions(), Execution());
  const SegmentDomain outer = DomainAround(outside, inner, DomainOptions(), Execution());
  const BlockDomain domain = DomainOfSegment(ShellBlocks(outer, inner), outer, &inner);
  BlockMeshOptions options;
  options.CellLength = 1.0;
  const BlockMesh mesh = MakeBlockMesh(domain, options, Execution());
  const double volume = VolumeOf(outside) - VolumeOf(inside);
  EXPECT_GT(ExpectSound(domain, mesh, volume, 0.0, 0.015).MeanJacobian, 0.9);
}

TEST(BlockMeshing, CoversABump)
{
  // A ball with a bump as high as three cells and as thick as four on one side.
  const SurfaceMesh surface = Moved(Icosphere(5),
    [](const Vector3d& p)
    {
      const double bump = std::exp(-40.0 * (p - Vector3d(0.6, 0.64, 0.48)).squaredNorm());
      return Vector3d((10.0 + 5.0 * bump) * p);
    });
  const SegmentDomain ball = FindDomain(surface, DomainOptions(), Execution());
  const BlockDomain domain = DomainOfSegment(LayeredBlocks(ball, 2.5, Execution()), ball);
  BlockMeshOptions options;
  options.CellLength = 1.5;
  options.Freedom = 0.5;
  const BlockMesh mesh = MakeBlockMesh(domain, options, Execution());
  ExpectSound(domain, mesh, VolumeOf(surface), 0.5, 0.005);
  EXPECT_LT(FarthestOf(domain, mesh), 0.75); // half a cell
}

TEST(BlockMeshing, CoversALimbWithPatience)
{
  // A ball with a limb as long as its radius, onto which nodes have to slide: a blunt one, which
  // the cells cover, and one about as thin as they are long.
  for (const auto& [sharpness, length] : { std::pair(20.0, 1.5), { 80.0, 2.0 } })
  {
    const SurfaceMesh surface = Moved(Icosphere(5),
      [sharpness = sharpness](const Vector3d& p)
      {
        const double limb = std::exp(-sharpness * (p - Vector3d(0.6, 0.64, 0.48)).squaredNorm());
        return Vector3d((10.0 + 10.0 * limb) * p);
      });
    const SegmentDomain ball = FindDomain(surface, DomainOptions(), Execution());
    const BlockDomain domain = DomainOfSegment(LayeredBlocks(ball, 2.5, Execution()), ball);
    BlockMeshOptions options;
    options.CellLength = length;
    options.Freedom = 0.5;
    options.Repair.Patience = 1;
    BlockMeshReport hasty, patient;
    MakeBlockMesh(domain, options, Execution(), &hasty);
    options.Repair.Patience = 6;
    const BlockMesh mesh = MakeBlockMesh(domain, options, Execution(), &patient);
    EXPECT_GT(patient.End.MeanJacobian, hasty.End.MeanJacobian + 0.001);
    if (sharpness < 50.0)
    {
      ExpectSound(domain, mesh, VolumeOf(surface), 0.5, 0.005);
    }
    else
    {
      EXPECT_LT(patient.Distances.ToFaces.Mean, 0.5 * hasty.Distances.ToFaces.Mean);
    }
  }
}

TEST(BlockMeshing, HasRightAnglesWhereLayersAreAsDeepAsCellsAreLong)
{
  const SurfaceMesh surface =
    Moved(Icosphere(5), [](const Vector3d& p) { return Vector3d(10.0 * p); });
  const SegmentDomain ball = FindDomain(surface, DomainOptions(), Execution());
  const BlockDomain domain = DomainOfSegment(LayeredBlocks(ball, 1.5, Execution()), ball);
  BlockMeshOptions options;
  options.CellLength = 1.5;
  options.Freedom = 0.5;
  BlockMeshReport asTheyAre, deep;
  MakeBlockMesh(domain, options, Execution(), &asTheyAre);
  options.LayerCells = options.CellLength;
  options.Repair.Evenness = 0.35;
  const BlockMesh mesh = MakeBlockMesh(domain, options, Execution(), &deep);
  ExpectSound(domain, mesh, VolumeOf(surface), 0.5, 0.005);
  EXPECT_GT(deep.End.MeanJacobian, 0.93);
  EXPECT_GT(deep.End.MeanJacobian, asTheyAre.End.MeanJacobian + 0.02);
  EXPECT_GT(deep.End.LeastJacobian, 0.65); // where three blocks meet, at best sin 120 degrees

  // The blocks after the core are layers, of two cells.
  for (std::size_t b = 1; b < mesh.Sizes.size(); ++b)
  {
    const int axis = static_cast<int>(b - 1) / 2;
    ASSERT_EQ(mesh.Sizes[b][axis], 2);
    double depth = 0.0;
    const std::vector<Index> low = mesh.FaceNodes(b, axis, 0), high = mesh.FaceNodes(b, axis, 1);
    for (std::size_t i = 0; i < low.size(); ++i)
    {
      depth += (mesh.Places[high[i]] - mesh.Places[low[i]]).norm() / low.size();
    }
    EXPECT_NEAR(depth, 3.0, 0.6);
  }
}

// A left-handed block, and sharp edges that hold it so.
TEST(BlockMeshing, GivesUpOnHopelessBlocks)
{
  const SegmentDomain cube = LaidOut(Polycube::FromGrid({ 1, 1, 1 }, {}), 10.0, 6);
  DomainBlocks blocks = CubeBlocks(cube);
  Mirror(blocks.Blocks[0]);
  BlockMeshOptions options;
  options.CellsPerBlock = 4; // one level
  Watch watch;
  const BlockMesh mesh = MakeBlockMesh(DomainOfSegment(blocks, cube), options, watch.Until(2.0));
  const CellQuality quality = QualityOf(mesh, Execution());
  EXPECT_GT(quality.Inverted, 32);
  EXPECT_EQ(quality.InvertedIn, std::vector<Index>{ quality.Inverted });
  EXPECT_LT(watch.Progress, 0.4); // one round of the four
}

// Rounds begin by spreading nodes; what that makes of the best mesh is not left behind.
TEST(BlockMeshing, KeepsTheRoundWithTheFewestFolds)
{
  const SurfaceMesh surface =
    Moved(Icosphere(3), [](const Vector3d& p) { return Vector3d(10.0 * p); });
  const SegmentDomain ball = FindDomain(surface, DomainOptions(), Execution());
  DomainBlocks blocks = LayeredBlocks(ball, 2.5, Execution());
  Mirror(blocks.Blocks[3]);
  const BlockDomain domain = DomainOfSegment(blocks, ball);
  BlockMeshOptions options;
  options.CellsPerBlock = 4;
  options.Repair.MostInverted = 1.0;
  Index fewest = 64; // a block's cells
  for (const int rounds : { 1, 2, 3 })
  {
    options.Repair.MostRounds = rounds;
    BlockMeshReport report;
    MakeBlockMesh(domain, options, Execution(), &report);
    EXPECT_LE(report.End.Inverted, fewest);
    fewest = report.End.Inverted;
  }
}

// Faces that are drawn to the surface at any price pass through the nodes beneath them.
TEST(BlockMeshing, KeepsTheLastMeshWithoutFolds)
{
  const SurfaceMesh surface =
    Moved(Icosphere(4), [](const Vector3d& p) { return Vector3d(10.0 * p); });
  const SegmentDomain ball = FindDomain(surface, DomainOptions(), Execution());
  const BlockDomain domain = DomainOfSegment(LayeredBlocks(ball, 2.5, Execution()), ball);
  BlockMeshOptions options;
  options.CellsPerBlock = 4;
  BlockMesh mesh = MakeBlockMesh(domain, options, Execution());
  for (Vector3d& place : mesh.Places)
  {
    place *= 1.6;
  }
  ASSERT_EQ(QualityOf(mesh, Execution()).Inverted, 0);
  const DomainSurface walls(domain, 1.0);
  SlidingNodes sliding(walls, mesh, 7.0, Execution());
  BoundaryFit fit(walls, mesh);
  options.Repair.Fitting = 1e30;
  options.Repair.MostRounds = 0;
  Repair(mesh, sliding, fit, CellTargets(mesh), options.Repair, Execution());
  EXPECT_EQ(QualityOf(mesh, Execution()).Inverted, 0);
}

TEST(BlockMeshing, StopsWithinASecond)
{
  const SurfaceMesh surface =
    Moved(Icosphere(6), [](const Vector3d& p) { return Vector3d(10.0 * p); });
  const SegmentDomain ball = FindDomain(surface, DomainOptions(), Execution());
  const BlockDomain domain = DomainOfSegment(LayeredBlocks(ball, 2.5, Execution()), ball);
  BlockMeshOptions options;
  options.CellLength = 0.7;
  Watch watch;
  EXPECT_THROW(MakeBlockMesh(domain, options, watch.Until(0.214)), Aborted); // in the finest mesh
  EXPECT_LT(watch.LongestLook, 1.0);
}

//------------------------------------------------------------------------------
TEST(SurfaceWalk, StaysOnItsSideOfAThinSheet)
{
  // A sheet of 20 x 20 x 1: from above, the nearest point within reach of one that lies below the
  // middle of the sheet is above.
  const SurfaceMesh sheet = Moved(SurfaceOf(Polycube::FromGrid({ 1, 1, 1 }), 20),
    [](const Vector3d& p) { return Vector3d(20.0 * p[0], 20.0 * p[1], p[2]); });
  const SurfaceWalk walk(sheet.Points, sheet.Triangles);
  const TriangleTree tree(sheet.Points, sheet.Triangles);
  const Index above = tree.Nearest({ 10.3, 10.2, 1.2 }).Triangle;
  const Vector3d target(12.4, 8.7, 0.2);
  EXPECT_NEAR(tree.Nearest(target).Place[2], 0.0, 1e-12);
  EXPECT_LT((walk.Nearest(above, target).Place - Vector3d(12.4, 8.7, 1.0)).norm(), 1e-12);
  EXPECT_EQ(walk.PieceOf(above), walk.PieceOf(0));
}

TEST(SurfaceWalk, EndsWhereThreeSheetsMeet)
{
  // Three half planes around the line x = y = 0.
  const std::vector<Vector3d> points{ { 0, 0, 0 }, { 0, 0, 1 }, { 1, 0, 0 }, { 0, 1, 0 },
    { -1, 0, 0 } };
  const std::vector<Triangle> triangles{ { 0, 2, 1 }, { 0, 3, 1 }, { 0, 4, 1 } };
  const SurfaceWalk walk(points, triangles);
  EXPECT_NE(walk.PieceOf(0), walk.PieceOf(1));
  EXPECT_NE(walk.PieceOf(0), walk.PieceOf(2));
  EXPECT_LT((walk.Nearest(0, { -0.5, 0.1, 0.2 }).Place - Vector3d(0, 0, 0.2)).norm(), 1e-12);
}

TEST(CornerEnergy, KnowsTheInsideOfACell)
{
  const std::vector<Vector3d> places{ { 0, 0, 0 }, { 2, .1, 0 }, { 2.2, 3, .3 }, { .1, 3, -.2 },
    { 0, .4, 4 }, { 2.3, 0, 4.1 }, { 2, 3, 4 }, { 0, 2.7, 4.4 } };
  const BlockPoints cell{ 0, 1, 2, 3, 4, 5, 6, 7 };
  const Vector3d lengths(1.5, 3.5, 4.0), d(0.3, -0.2, 0.5), at(0.2, 0.7, 0.4);
  for (int corner = 0; corner < 8; ++corner)
  {
    const CornerTerm term = TermAt(places, cell, at, corner, lengths);
    std::vector<Vector3d> moved = places;
    moved[corner] += d;
    const Eigen::Matrix3d j = JacobianAt(moved, cell, at) * lengths.cwiseInverse().asDiagonal();
    EXPECT_NEAR(term.TraceAt(d), j.squaredNorm(), 1e-12);
    EXPECT_NEAR(term.DeterminantAt(d), j.determinant(), 1e-12);
  }
}
