// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Domain/InnerCorners.h"
#include "Domain/LayoutCheck.h"
#include "Search/ChainLayout.h"
#include "Search/DomainShell.h"
#include "Search/FindDomain.h"
#include "Search/HandleLoop.h"
#include "SegmentSurfaces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <stdexcept>

namespace
{
using namespace trivariate;
using Eigen::Vector3d;
using trivariate_testing::BoundaryOf;
using trivariate_testing::Icosphere;
using trivariate_testing::LatticeCorners;
using trivariate_testing::Moved;
using trivariate_testing::RoundedSurfaceOf;
using trivariate_testing::Shuffled;
using trivariate_testing::SurfaceOf;
using trivariate_testing::SurfaceOfSegment;
using trivariate_testing::Turned;

const double Pi = std::acos(-1.0);

std::string Complaints(const SegmentDomain& domain)
{
  std::string all;
  for (const std::string& message : CheckLayout(domain.Layout, domain.Cubes))
  {
    all += message + "\n";
  }
  return all;
}

std::vector<double> SortedPatchAreas(const SurfaceLayout& layout)
{
  const SurfaceMesh mesh(layout.Points, layout.Triangles);
  std::vector<double> areas(layout.PatchLabels.size(), 0.0);
  for (Index t = 0; t < mesh.NumberOfTriangles(); ++t)
  {
    areas.at(layout.Patches[t]) += mesh.AreaVector(t).norm();
  }
  std::sort(areas.begin(), areas.end());
  return areas;
}

// A square bar along w as a round one of radius 1 about (0, 0).
Vector3d Rounded(const Vector3d& p)
{
  const double x = 2.0 * p.x() - 1.0, y = 2.0 * p.y() - 1.0;
  const double scale = std::max(std::abs(x), std::abs(y)) / std::max(std::hypot(x, y), 1e-300);
  return { scale * x, scale * y, p.z() };
}

Vector3d Bent(const Vector3d& p, double radius, double anglePerLength)
{
  const double angle = anglePerLength * p.z(), r = radius + p.x();
  return { r * std::cos(angle), p.y(), r * std::sin(angle) };
}

struct ClosedForm
{
  std::string Name;
  SurfaceMesh Surface;
  double Alignment; // at least
};

// Alignments: of a cube on a ball .8312; of four sides on a circle .9003, so that a cylinder as
// wide as high has .9335 and the quarter of the torus .91.
std::vector<ClosedForm> OneCubeShapes()
{
  const SurfaceMesh cube = SurfaceOf(Polycube::FromGrid({ 1, 1, 1 }), 16);
  const SurfaceMesh bar = SurfaceOf(Polycube::FromGrid({ 1, 1, 5 }), 10);
  return {
    { "ball", Icosphere(4), 0.825 },
    { "box",
      Moved(cube, [](const Vector3d& p) { return Vector3d(p.x(), 1.3 * p.y(), 2.0 * p.z()); }),
      1.0 - 1e-9 },
    { "cylinder",
      Moved(cube,
        [](const Vector3d& p) {
          return Rounded({ p.x(), p.y(), 2.0 * p.z() });
        }),
      0.91 },
    { "quarter of a torus",
      Moved(bar, [](const Vector3d& p) { return Bent(Rounded(p), 3.0, 0.1 * Pi); }), 0.87 },
    { "bar bent through 180 degrees",
      Moved(bar, [](const Vector3d& p) { return Bent(p, 1.2, 0.2 * Pi); }), 0.94 },
  };
}

// The same polycube by hand, with the corners of the one found.
SegmentDomain PickedFrom(const SegmentDomain& found, const SurfaceMesh& mesh)
{
  const std::vector<Vector3d> picked(
    found.Places.begin(), found.Places.begin() + found.Cubes.NumberOfCorners);
  return DomainFromCorners(mesh, found.Cubes, picked, Execution());
}

struct VoxelSolid
{
  std::string Name;
  Polycube Cubes;
  Index Corners;
};

std::vector<VoxelSolid> VoxelSolids()
{
  return {
    { "L", Polycube::FromGrid({ 2, 2, 1 }, { 1, 1, 1, 0 }), 16 },
    { "T", Polycube::FromGrid({ 3, 2, 1 }, { 1, 1, 1, 0, 1, 0 }), 20 },
    { "U", Polycube::FromGrid({ 3, 2, 1 }, { 1, 1, 1, 1, 0, 1 }), 24 },
    { "plus", Polycube::FromGrid({ 3, 3, 1 }, { 0, 1, 0, 1, 1, 1, 0, 1, 0 }), 24 },
    { "box with a hole", Polycube::FromGrid({ 3, 3, 1 }, { 1, 1, 1, 1, 0, 1, 1, 1, 1 }), 32 },
    { "cross",
      Polycube({ { 1, 1, 0 }, { 0, 1, 1 }, { 1, 0, 1 }, { 1, 1, 1 }, { 2, 1, 1 }, { 1, 2, 1 },
        { 1, 1, 2 } }),
      32 },
  };
}

TEST(SegmentDomain, IsOneCubeWhereOneWillDo)
{
  for (const ClosedForm& shape : OneCubeShapes())
  {
    const SegmentDomain domain = FindDomain(shape.Surface, DomainOptions(), Execution());
    EXPECT_EQ(Complaints(domain), "") << shape.Name;
    EXPECT_EQ(domain.Cubes.Cubes.size(), 1u) << shape.Name;
    EXPECT_EQ(domain.Layout.Corners.size(), 8u) << shape.Name;
    EXPECT_EQ(domain.Layout.PatchLabels.size(), 6u) << shape.Name;
    EXPECT_EQ(domain.Places.size(), 8u) << shape.Name;
    EXPECT_TRUE(InvertedBlocks(CubeBlocks(domain)).empty()) << shape.Name;
    EXPECT_GE(domain.Alignment, shape.Alignment) << shape.Name;
    EXPECT_LE(domain.Alignment, 1.0 + 1e-12) << shape.Name;
  }
}

TEST(SegmentDomain, FindsTheCubesOfVoxelSolids)
{
  for (const VoxelSolid& solid : VoxelSolids())
  {
    const SurfaceMesh exact = SurfaceOf(solid.Cubes, 8);
    const SurfaceMesh rounded = RoundedSurfaceOf(solid.Cubes, 9);
    for (int seed = 0; seed < 4; ++seed)
    {
      for (const bool round : { false, true })
      {
        const std::string name =
          (round ? "rounded " : "") + solid.Name + ", seed " + std::to_string(seed);
        const SurfaceMesh& mesh = round ? rounded : exact;
        const SegmentDomain domain = FindDomain(
          seed == 0 ? mesh : Turned(Shuffled(mesh, seed), seed), DomainOptions(), Execution());
        EXPECT_EQ(Complaints(domain), "") << name;
        EXPECT_EQ(domain.Cubes.Cubes.size(), solid.Cubes.Cubes.size()) << name;
        EXPECT_EQ(domain.Cubes.NumberOfCorners, solid.Corners) << name;
        EXPECT_EQ(domain.Cubes.Faces.size(), solid.Cubes.Faces.size()) << name;
        EXPECT_GE(domain.Alignment, round ? 0.945 : 1.0 - 1e-9) << name;
        if (!round)
        {
          for (const double area : SortedPatchAreas(domain.Layout))
          {
            EXPECT_NEAR(area, 1.0, 1e-6) << name;
          }
        }
      }
    }
  }
}

TEST(SegmentDomain, IsTheSameFromPickedCorners)
{
  for (const VoxelSolid& solid : VoxelSolids())
  {
    const SurfaceMesh mesh = RoundedSurfaceOf(solid.Cubes, 9);
    const SegmentDomain found = FindDomain(mesh, DomainOptions(), Execution());
    const SegmentDomain manual = PickedFrom(found, mesh);
    EXPECT_EQ(Complaints(manual), "") << solid.Name;
    EXPECT_NEAR(manual.Alignment, found.Alignment, 1e-3) << solid.Name;
    const std::vector<double> a = SortedPatchAreas(found.Layout);
    const std::vector<double> b = SortedPatchAreas(manual.Layout);
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i)
    {
      EXPECT_NEAR(a[i], b[i], 0.03 * a[i]) << solid.Name;
    }
  }
}

// Geodesics leave the rim of a cylinder and the outside of a bend, so patches are others; but they
// are those of a cube with these corners.
TEST(SegmentDomain, IsValidFromPickedCorners)
{
  for (const ClosedForm& shape : OneCubeShapes())
  {
    const SegmentDomain found = FindDomain(shape.Surface, DomainOptions(), Execution());
    const SegmentDomain manual = PickedFrom(found, shape.Surface);
    EXPECT_EQ(Complaints(manual), "") << shape.Name;
    for (Index corner = 0; corner < found.Cubes.NumberOfCorners; ++corner)
    {
      EXPECT_LT((manual.Places[corner] - found.Places[corner]).norm(), 1e-9) << shape.Name;
    }
  }
}

// A shape without any symmetry, so that there is one best answer.
TEST(SegmentDomain, MovesWithTheSurface)
{
  const SurfaceMesh blob = Moved(Icosphere(4),
    [](const Vector3d& p)
    {
      const double bumps = 1.0 + 0.15 * std::sin(3.0 * p.x() + 1.0) * std::cos(2.0 * p.y()) +
                           0.1 * std::sin(4.0 * p.z() + 2.0 * p.y());
      return Vector3d(bumps * p.x(), 1.3 * bumps * p.y(), 1.9 * bumps * p.z());
    });
  const SegmentDomain still = FindDomain(blob, DomainOptions(), Execution());
  EXPECT_EQ(still.Cubes.NumberOfCorners, 8);
  const std::vector<double> areas = SortedPatchAreas(still.Layout);
  for (int seed = 1; seed < 5; ++seed)
  {
    const SegmentDomain moved =
      FindDomain(Turned(Shuffled(blob, seed), seed), DomainOptions(), Execution());
    EXPECT_EQ(moved.Cubes.NumberOfCorners, 8);
    EXPECT_NEAR(moved.Alignment, still.Alignment, 1e-3) << seed;
    const std::vector<double> other = SortedPatchAreas(moved.Layout);
    for (std::size_t i = 0; i < areas.size(); ++i)
    {
      EXPECT_NEAR(other[i], areas[i], 0.01 * areas[i]) << seed;
    }
  }
}

TEST(SegmentDomain, CutsACubeIntoAnyChain)
{
  const SurfaceMesh box = Moved(SurfaceOf(Polycube::FromGrid({ 1, 1, 1 }), 7),
    [](const Vector3d& p) { return Vector3d(2.0 * p.x(), 3.0 * p.y(), 5.0 * p.z()); });
  const Polycube cube = Polycube::FromGrid({ 1, 1, 1 });
  std::vector<Vector3d> corners = LatticeCorners(cube);
  for (Vector3d& p : corners)
  {
    p = Vector3d(2.0, 3.0, 5.0).cwiseProduct(p);
  }
  const SurfaceLayout one = LayoutFromCorners(box, cube, corners, Execution(), 1e-9);
  for (int axis = 0; axis < 3; ++axis)
  {
    for (const int cubes : { 1, 2, 5, 7, 12 })
    {
      const SurfaceLayout chain = CutIntoChain(one, axis, cubes, Execution());
      EXPECT_TRUE(CheckLayout(chain, Chain(axis, cubes)).empty()) << axis << " " << cubes;
      Vector3d sides(2.0, 3.0, 5.0);
      sides[axis] /= cubes;
      for (const double area : SortedPatchAreas(chain))
      {
        const double off = std::min({ std::abs(area - sides[0] * sides[1]),
          std::abs(area - sides[1] * sides[2]), std::abs(area - sides[2] * sides[0]) });
        EXPECT_LT(off, 0.01) << axis << " " << cubes;
      }
    }
  }
}

// Three quarters of a ring: a straight cube between its ends would be turned inside out.
TEST(SegmentDomain, CutsWhatIsBentIntoSoundCubes)
{
  const SurfaceMesh ring = Moved(SurfaceOf(Polycube::FromGrid({ 1, 1, 9 }), 8),
    [](const Vector3d& p) { return Bent(p, 2.0, Pi / 6.0); });
  const SegmentDomain domain = FindDomain(ring, DomainOptions(), Execution());
  EXPECT_EQ(Complaints(domain), "");
  EXPECT_GT(domain.Cubes.Cubes.size(), 1u);
  EXPECT_LE(domain.Cubes.Cubes.size(), 9u);
  EXPECT_TRUE(InvertedBlocks(CubeBlocks(domain)).empty());
  EXPECT_GT(domain.Alignment, 0.9);
}

TEST(SegmentDomain, TakesMoreCubesOnlyForTheirWorth)
{
  const ClosedForm bar = OneCubeShapes().back();
  DomainOptions options;
  options.CornerCost = 0.0;
  const SegmentDomain free = FindDomain(bar.Surface, options, Execution());
  options.CornerCost = 1.0;
  const SegmentDomain dear = FindDomain(bar.Surface, options, Execution());
  EXPECT_EQ(Complaints(free), "");
  EXPECT_GE(free.Alignment, dear.Alignment);
  EXPECT_GT(free.Cubes.Cubes.size(), 1u);
  EXPECT_EQ(dear.Cubes.Cubes.size(), 1u);

  const VoxelSolid plus = VoxelSolids()[3];
  EXPECT_EQ(FindDomain(SurfaceOf(plus.Cubes, 8), options, Execution()).Cubes.NumberOfCorners, 8);
  options = DomainOptions();
  options.MostCubes = 4;
  EXPECT_EQ(FindDomain(SurfaceOf(plus.Cubes, 8), options, Execution()).Cubes.NumberOfCorners, 8);
}

TEST(SegmentDomain, PutsInnerPointsInTheMiddle)
{
  const Polycube block = Polycube::FromGrid({ 3, 4, 3 });
  const SegmentDomain domain =
    DomainFromCorners(SurfaceOf(block, 4), block, LatticeCorners(block), Execution(), 1e-9);
  ASSERT_EQ(domain.Places.size(), 80u);
  EXPECT_EQ(block.NumberOfCorners, 68);
  EXPECT_NEAR(domain.Alignment, 1.0, 1e-9);
  for (std::size_t p = 0; p < block.Points.size(); ++p)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      EXPECT_NEAR(domain.Places[p][axis], block.Points[p][axis], 1e-9);
    }
  }
}

// A ball in a ball and two boxes with a common face: each closed surface has its own domain.
TEST(SegmentDomain, IsFoundForEachOfSeveralSegments)
{
  const auto nested = [](int i, int j, int k)
  {
    const double r = std::hypot(i - 15.5, j - 15.5, k - 15.5);
    return r < 7.0 ? 2 : r < 13.0 ? 1 : 0;
  };
  const auto boxes = [](int i, int j, int k)
  {
    const bool inside = std::min({ i, j, k }) >= 4 && i < 28 && j < 14 && k < 16;
    return inside ? (i < 16 ? 1 : 2) : 0;
  };
  const SegmentBoundary balls = BoundaryOf({ 32, 32, 32 }, nested);
  const SegmentBoundary touching = BoundaryOf({ 32, 18, 20 }, boxes);
  for (const SurfaceMesh& mesh :
    { SurfaceOfSegment(balls, 2), SurfaceOfSegment(touching, 1), SurfaceOfSegment(touching, 2) })
  {
    const SegmentDomain domain = FindDomain(mesh, DomainOptions(), Execution());
    EXPECT_EQ(Complaints(domain), "");
    EXPECT_EQ(domain.Cubes.NumberOfCorners, 8);
    EXPECT_GT(domain.Alignment, 0.82);
  }
  // The outer ball's own surface is that of a shell.
  try
  {
    FindDomain(SurfaceOfSegment(balls, 1), DomainOptions(), Execution());
    ADD_FAILURE() << "A shell has no domain of its own.";
  }
  catch (const std::invalid_argument& error)
  {
    EXPECT_NE(std::string(error.what()).find("2 pieces"), std::string::npos) << error.what();
  }
}

TEST(SegmentDomain, RefusesWhatHasNoDomain)
{
  const VoxelSolid hole = VoxelSolids()[4];
  DomainOptions options;
  options.MostCubes = 7;
  try
  {
    FindDomain(SurfaceOf(hole.Cubes, 6), options, Execution());
    ADD_FAILURE() << "Seven cubes have no hole.";
  }
  catch (const std::runtime_error& error)
  {
    EXPECT_NE(std::string(error.what()).find("8 cubes"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("loop around a handle"), std::string::npos)
      << error.what();
  }
}

// Around a bar of the frame and around its hole: four faces each.
TEST(HandleLoop, FindsTheShortest)
{
  const SurfaceMesh frame = SurfaceOf(VoxelSolids()[4].Cubes, 6);
  EXPECT_NEAR(FindHandle(frame).Length, 4.0, 1e-9);
  EXPECT_NEAR(FindHandle(Turned(Shuffled(frame, 7), 7)).Length, 4.0, 1e-9);
  EXPECT_EQ(FindHandle(Icosphere(3)).Length, 0.0);
}

// Three low u charts and no high one: every chart is a disc with at least four neighbours of other
// axes, and three axes meet at every corner.
TEST(SegmentDomain, NeedsBothSidesOfEachAxis)
{
  const SurfaceMesh mesh = SurfaceOf(VoxelSolids()[0].Cubes, 6);
  std::vector<ChartLabel> labels;
  for (Index t = 0; t < mesh.NumberOfTriangles(); ++t)
  {
    int axis = 0;
    mesh.AreaVector(t).cwiseAbs().maxCoeff(&axis);
    labels.push_back(static_cast<ChartLabel>(2 * axis + (mesh.AreaVector(t)[axis] > 0.0)));
  }
  EXPECT_TRUE(CheckCharts(LayoutFromCharts(mesh, labels, Execution())).empty());
  std::replace(labels.begin(), labels.end(), ChartLabel(1), ChartLabel(0));
  const SurfaceLayout layout = LayoutFromCharts(mesh, labels, Execution());
  EXPECT_EQ(std::count(layout.PatchLabels.begin(), layout.PatchLabels.end(), 0), 3);
  EXPECT_EQ(std::count(layout.PatchLabels.begin(), layout.PatchLabels.end(), 1), 0);
  EXPECT_TRUE(CheckPatches(layout).empty());
  EXPECT_FALSE(CheckCharts(layout).empty());
}
}
