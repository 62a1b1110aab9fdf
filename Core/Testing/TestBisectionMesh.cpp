// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "TSpline/BisectionMesh.h"
#include "RandomRefinement.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace trivariate;

namespace
{
Index Volume(const IndexBox& box)
{
  return Index(box.High[0] - box.Low[0]) * (box.High[1] - box.Low[1]) * (box.High[2] - box.Low[2]);
}

// Halves a few of the cells around one random place, again and again.
BisectionMesh RandomMesh(
  const GridIndex& rootCells, const std::array<int, 3>& depth, Closure closure, unsigned seed)
{
  BisectionMesh mesh(rootCells, depth, closure);
  std::mt19937 random(seed);
  for (int n = 0; n < 12; ++n)
  {
    GridIndex at;
    for (int a = 0; a < 3; ++a)
    {
      at[a] = static_cast<std::int32_t>(random() % (rootCells[a] << depth[a]));
    }
    for (int k = 0; k < 4; ++k)
    {
      mesh.Bisect(at);
    }
  }
  return mesh;
}

TSpline SplineOf(const BisectionMesh& mesh, const GridIndex& ends)
{
  TSpline spline;
  for (int a = 0; a < 3; ++a)
  {
    spline.KnotLines[a] = MakeUniformKnotLine(0.0, 1.0, ends[a]);
  }
  spline.Functions = mesh.Functions();
  return spline;
}
}

// Numbers of functions that an independent implementation of both rules gave.
TEST(BisectionMesh, ClosureCostsWhatItShould)
{
  BisectionMesh narrow({ 12, 12, 12 }, { 2, 2, 2 }, Closure::Narrow);
  BisectionMesh published({ 12, 12, 12 }, { 2, 2, 2 }, Closure::Published);
  EXPECT_EQ(narrow.CountFunctions(), 3375);
  for (int n = 0; n < 6; ++n)
  {
    EXPECT_TRUE(narrow.Bisect({ 25, 25, 25 }));
    EXPECT_TRUE(published.Bisect({ 25, 25, 25 }));
  }
  EXPECT_FALSE(narrow.Bisect({ 25, 25, 25 }));
  EXPECT_EQ(narrow.CountFunctions(), 6127);
  EXPECT_EQ(published.CountFunctions(), 23045);
}

// Refining one point ever deeper adds a bounded number of functions a level (linear complexity).
TEST(BisectionMesh, ClosureStaysLocal)
{
  BisectionMesh mesh({ 3, 3, 3 }, { 12, 12, 12 }, Closure::Narrow);
  const GridIndex at{ 5000, 7001, 6003 };
  std::vector<Index> counts;
  while (mesh.Bisect(at))
  {
    counts.push_back(mesh.CountFunctions());
  }
  ASSERT_EQ(counts.size(), 36u);
  for (std::size_t n = 1; n < counts.size(); ++n)
  {
    EXPECT_GT(counts[n], counts[n - 1]);
    EXPECT_LT(counts[n], counts[n - 1] + 8000);
  }
}

TEST(BisectionMesh, CellsTileTheDomain)
{
  for (unsigned seed = 0; seed < 10; ++seed)
  {
    const BisectionMesh mesh = RandomMesh({ 3, 4, 2 }, { 3, 2, 3 }, Closure::Narrow, seed);
    Index volume = 0;
    for (const IndexBox& cell : mesh.Cells())
    {
      volume += Volume(cell);
      const int level = mesh.Find(cell.Low).Level;
      for (const GridIndex& at :
        { cell.Low, GridIndex{ cell.High[0] - 1, cell.High[1] - 1, cell.High[2] - 1 } })
      {
        EXPECT_EQ(mesh.Box(at, mesh.Find(at).Level).Low, cell.Low);
        EXPECT_EQ(mesh.Find(at).Level, level);
      }
    }
    EXPECT_EQ(volume, 24 * 16 * 16);
  }
}

TEST(BisectionMesh, EarlierCellsCanBeFound)
{
  BisectionMesh mesh({ 4, 4, 4 }, { 2, 2, 2 }, Closure::Narrow);
  mesh.Bisect({ 0, 0, 0 });
  const BisectionMesh before = mesh;
  const BisectionMesh::Node nodes = mesh.CountNodes();
  mesh.Bisect({ 0, 0, 0 });
  mesh.Bisect({ 9, 9, 9 });
  for (std::int32_t k = 0; k < 16; ++k)
  {
    for (std::int32_t i = 0; i < 16; ++i)
    {
      EXPECT_EQ(mesh.Find({ i, 5, k }, nodes).Id, before.Find({ i, 5, k }).Id);
    }
  }
}

TEST(BisectionMesh, IsRecoveredFromItsFunctions)
{
  for (const Closure closure : { Closure::Narrow, Closure::Published })
  {
    for (unsigned seed = 0; seed < 10; ++seed)
    {
      const BisectionMesh mesh = RandomMesh({ 5, 4, 6 }, { 3, 2, 1 }, closure, seed);
      TSpline spline = SplineOf(mesh, { 40, 16, 12 });
      std::shuffle(spline.Functions.begin(), spline.Functions.end(), std::mt19937(seed));
      const auto cells = BisectionMesh::Recover(spline, { 5, 4, 6 });
      // A cell with all neighbours halved may count as halved: nothing in the functions tells.
      ASSERT_GE(cells.size(), mesh.Cells().size());
      EXPECT_LE(cells.size(), mesh.Cells().size() * 11 / 10);
      Index volume = 0;
      for (const IndexBox& cell : cells)
      {
        volume += Volume(cell);
      }
      EXPECT_EQ(volume, 40 * 16 * 12);
    }
  }
}

// As a spline comes back from a pipeline: lines of the values in use alone, each its own distance.
TEST(BisectionMesh, IsRecoveredWhereLinesLackUnusedKnots)
{
  int incomplete = 0;
  for (unsigned seed = 0; seed < 20; ++seed)
  {
    const BisectionMesh mesh = RandomMesh({ 3, 2, 5 }, { 4, 5, 2 }, Closure::Narrow, seed);
    const TSpline whole = SplineOf(mesh, { 48, 64, 20 });
    const auto expected = BisectionMesh::Recover(whole, { 3, 2, 5 });
    ASSERT_FALSE(expected.empty());
    TSpline spline = whole;
    for (int a = 0; a < 3; ++a)
    {
      std::vector<std::int32_t> used;
      for (const BlendingFunction& f : whole.Functions)
      {
        used.insert(used.end(), f[a].begin(), f[a].end());
      }
      std::sort(used.begin(), used.end());
      used.erase(std::unique(used.begin(), used.end()), used.end());
      incomplete += used.size() < whole.KnotLines[a].size();
      spline.KnotLines[a].clear();
      for (const std::int32_t knot : used)
      {
        // An image of a hundred voxels, far from the origin.
        spline.KnotLines[a].push_back(7.0 + 99.0 * knot / (whole.KnotLines[a].size() - 1));
      }
      for (BlendingFunction& f : spline.Functions)
      {
        for (std::int32_t& knot : f[a])
        {
          knot = std::lower_bound(used.begin(), used.end(), knot) - used.begin();
        }
      }
    }
    const auto cells = BisectionMesh::Recover(spline, { 3, 2, 5 });
    ASSERT_EQ(cells.size(), expected.size());
    for (std::size_t i = 0; i < cells.size(); ++i)
    {
      for (int a = 0; a < 3; ++a)
      {
        for (const auto end : { &IndexBox::Low, &IndexBox::High })
        {
          const double x = (spline.KnotLines[a][(cells[i].*end)[a]] - 7.0) / 99.0;
          EXPECT_NEAR(x, double((expected[i].*end)[a]) / (whole.KnotLines[a].size() - 1), 1e-14);
        }
      }
    }
  }
  EXPECT_GT(incomplete, 0);
}

// Knots at other distances: every root cell has equally many intervals of the line.
TEST(BisectionMesh, IsRecoveredWithKnotsAtAnyDistance)
{
  std::mt19937 random(4);
  TSpline spline =
    SplineOf(RandomMesh({ 3, 2, 5 }, { 3, 3, 2 }, Closure::Narrow, 1), { 24, 16, 20 });
  const auto expected = BisectionMesh::Recover(spline, { 3, 2, 5 });
  const TSpline other = RandomTensorProduct({ 3, 2, 5 }, { 3, 3, 2 }, random);
  spline.KnotLines = other.KnotLines;
  EXPECT_EQ(BisectionMesh::Recover(spline, { 3, 2, 5 }).size(), expected.size());
}

TEST(BisectionMesh, OtherFunctionsAreNotMistakenForAMesh)
{
  TSpline spline =
    SplineOf(RandomMesh({ 4, 4, 4 }, { 2, 2, 2 }, Closure::Narrow, 1), { 16, 16, 16 });
  EXPECT_FALSE(BisectionMesh::Recover(spline, { 4, 4, 4 }).empty());
  EXPECT_TRUE(BisectionMesh::Recover(spline, { 5, 4, 4 }).empty());
  EXPECT_TRUE(BisectionMesh::Recover(spline, { 0, 4, 4 }).empty());
  EXPECT_TRUE(BisectionMesh::Recover(spline, { 16 << 16, 16 << 16, 16 << 10 }).empty());
  spline.Functions.pop_back();
  EXPECT_TRUE(BisectionMesh::Recover(spline, { 4, 4, 4 }).empty());
}

TEST(BisectionMesh, RefusesImpossibleSizes)
{
  EXPECT_THROW(BisectionMesh({ 0, 1, 1 }, { 1, 1, 1 }, Closure::Narrow), std::invalid_argument);
  EXPECT_THROW(BisectionMesh({ 1, 1, 1 }, { 1, 21, 1 }, Closure::Narrow), std::invalid_argument);
  EXPECT_THROW(
    BisectionMesh({ 1, 1, 1 << 20 }, { 1, 1, 9 }, Closure::Narrow), std::invalid_argument);
}
