// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "RandomRefinement.h"
#include "TSpline/BezierExtraction.h"
#include "TSpline/BezierMesh.h"
#include "ThreadedExecution.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>

using namespace trivariate;

namespace
{
// Functions with random knots: no T-mesh.
TSpline RandomFunctions(std::mt19937& random, int count)
{
  TSpline spline;
  spline.Components = 3;
  for (KnotLine& line : spline.KnotLines)
  {
    line = MakeUniformKnotLine(0.0, 1.0, 9);
  }
  for (int i = 0; i < count; ++i)
  {
    BlendingFunction f;
    for (LocalKnots& k : f)
    {
      do
      {
        std::generate(
          k.begin(), k.end(), [&]() { return static_cast<std::int32_t>(random() % 10); });
        std::sort(k.begin(), k.end());
      } while (k[0] == k[4]);
    }
    spline.Functions.push_back(f);
  }
  spline.Weights.assign(count, 1.0);
  spline.ControlPoints.assign(3 * count, 0.0);
  return spline;
}

// The unit boxes of the knot grid, taken apart by faces, the slow way.
class UnitGrid
{
public:
  explicit UnitGrid(const TSpline& spline)
  {
    for (int a = 0; a < 3; ++a)
    {
      this->Size[a] = static_cast<std::int32_t>(spline.KnotLines[a].size()) - 1;
    }
    const Index n = static_cast<Index>(this->Size[0]) * this->Size[1] * this->Size[2];
    this->Covered.assign(n, false);
    for (auto& faces : this->Faces)
    {
      faces.assign(n, false);
    }
    for (const BlendingFunction& f : spline.Functions)
    {
      const IndexBox box = SupportOf(f);
      this->ForEach(box, [&](Index unit) { this->Covered[unit] = true; });
      for (int a = 0; a < 3; ++a)
      {
        for (const std::int32_t knot : f[a])
        {
          IndexBox slab = box;
          slab.Low[a] = knot;
          slab.High[a] = std::min(knot + 1, this->Size[a]);
          this->ForEach(slab, [&](Index unit) { this->Faces[a][unit] = true; });
        }
      }
    }
  }

  template <typename Visitor>
  void ForEach(const IndexBox& box, const Visitor& visit) const
  {
    for (std::int32_t k = box.Low[2]; k < box.High[2]; ++k)
    {
      for (std::int32_t j = box.Low[1]; j < box.High[1]; ++j)
      {
        for (std::int32_t i = box.Low[0]; i < box.High[0]; ++i)
        {
          visit(this->Place({ i, j, k }));
        }
      }
    }
  }

  // Regions that are connected without crossing a face.
  Index CountRegions() const
  {
    std::vector<bool> seen(this->Covered.size(), false);
    Index regions = 0;
    IndexBox all{ { 0, 0, 0 }, this->Size };
    this->ForEach(all,
      [&](Index unit)
      {
        if (this->Covered[unit] && !seen[unit])
        {
          ++regions;
          this->Flood(unit, seen);
        }
      });
    return regions;
  }

  Index Place(const std::array<std::int32_t, 3>& at) const
  {
    return at[0] + static_cast<Index>(this->Size[0]) * (at[1] + this->Size[1] * at[2]);
  }

  std::array<std::int32_t, 3> Size;
  std::vector<bool> Covered;
  std::array<std::vector<bool>, 3> Faces; // at the low side of each unit

private:
  void Flood(Index start, std::vector<bool>& seen) const
  {
    const Index steps[3] = { 1, this->Size[0], static_cast<Index>(this->Size[0]) * this->Size[1] };
    std::vector<Index> open = { start };
    seen[start] = true;
    while (!open.empty())
    {
      const Index unit = open.back();
      open.pop_back();
      for (int a = 0; a < 3; ++a)
      {
        const Index at = unit / steps[a] % this->Size[a];
        const bool below = at > 0 && !this->Faces[a][unit];
        const bool above = at + 1 < this->Size[a] && !this->Faces[a][unit + steps[a]];
        for (const auto& [passes, next] :
          { std::pair(below, unit - steps[a]), std::pair(above, unit + steps[a]) })
        {
          if (passes && !seen[next])
          {
            seen[next] = true;
            open.push_back(next);
          }
        }
      }
    }
  }
};

// Cells are disjoint, cover the supports, cross no face, know their functions and are found.
void ExpectPartition(const TSpline& spline, const BezierMesh& mesh, std::mt19937& random)
{
  const UnitGrid grid(spline);
  std::vector<Index> owner(grid.Covered.size(), -1);
  for (Index cell = 0; cell < mesh.Size(); ++cell)
  {
    const IndexBox& box = mesh.Box(cell);
    grid.ForEach(box,
      [&](Index unit)
      {
        ASSERT_TRUE(grid.Covered[unit]);
        ASSERT_EQ(owner[unit], -1);
        owner[unit] = cell;
      });
    for (int a = 0; a < 3; ++a)
    {
      IndexBox inside = box;
      ++inside.Low[a];
      grid.ForEach(inside, [&](Index unit) { ASSERT_FALSE(grid.Faces[a][unit]); });
    }
    std::set<std::int32_t> expected;
    for (Index i = 0; i < spline.Size(); ++i)
    {
      if (SupportOf(spline.Functions[i]).Overlaps(box))
      {
        expected.insert(static_cast<std::int32_t>(i));
      }
    }
    const IdRange active = mesh.ActiveFunctions(cell);
    ASSERT_EQ(std::set<std::int32_t>(active.begin(), active.end()), expected);
    ASSERT_EQ(active.size(), static_cast<Index>(expected.size()));
  }
  for (std::size_t unit = 0; unit < owner.size(); ++unit)
  {
    ASSERT_EQ(owner[unit] >= 0, grid.Covered[unit]);
  }
  for (int n = 0; n < 2000; ++n)
  {
    std::array<std::int32_t, 3> at;
    Point x;
    for (int a = 0; a < 3; ++a)
    {
      const KnotLine& line = spline.KnotLines[a];
      at[a] = static_cast<std::int32_t>(random() % grid.Size[a]);
      x[a] = n % 3 ? Random(random, line[at[a]], line[at[a] + 1]) : line[at[a]];
    }
    const Index cell = mesh.FindCell(x[0], x[1], x[2]), wanted = owner[grid.Place(at)];
    if (wanted >= 0 || n % 3)
    {
      ASSERT_EQ(cell, wanted);
    }
    else if (cell >= 0) // at the high end of a cell that none follows
    {
      const auto b = mesh.Bounds(cell);
      for (int a = 0; a < 3; ++a)
      {
        ASSERT_TRUE(b[2 * a] <= x[a] && x[a] <= b[2 * a + 1]);
      }
    }
  }
}
}

TEST(BezierMesh, TensorProductCellsAreItsKnotIntervals)
{
  const std::array<KnotLine, 3> lines = { MakeUniformKnotLine(0.0, 1.0, 12),
    MakeUniformKnotLine(-1.0, 1.0, 8), MakeUniformKnotLine(2.0, 3.0, 5) };
  const TSpline spline = MakeTensorProduct(lines, { 3, 2, 1 }, 0);
  const BezierMesh mesh(spline);
  ASSERT_EQ(mesh.Size(), 4 * 4 * 5);
  for (Index cell = 0; cell < mesh.Size(); ++cell)
  {
    const auto i = static_cast<std::int32_t>(cell % 4), j = static_cast<std::int32_t>(cell / 4 % 4),
               k = static_cast<std::int32_t>(cell / 16);
    EXPECT_EQ(mesh.Box(cell).Low, (std::array<std::int32_t, 3>{ 3 * i, 2 * j, k }));
    EXPECT_EQ(mesh.Box(cell).High, (std::array<std::int32_t, 3>{ 3 * i + 3, 2 * j + 2, k + 1 }));
    EXPECT_EQ(mesh.ActiveFunctions(cell).size(), 64);
    EXPECT_EQ(mesh.Level(cell), 0);
  }
}

TEST(BezierMesh, CellsAreTheRegionsBetweenTheFaces)
{
  for (unsigned seed = 0; seed < 20; ++seed)
  {
    std::mt19937 random(seed);
    const TSpline spline = RandomRefined(random, 3 + seed % 4, seed % 2 == 0);
    const BezierMesh mesh(spline);
    ExpectPartition(spline, mesh, random);
    EXPECT_EQ(mesh.Size(), UnitGrid(spline).CountRegions()) << "seed " << seed;
  }
}

TEST(BezierMesh, AnyFunctionsHaveValidCells)
{
  for (unsigned seed = 0; seed < 40; ++seed)
  {
    std::mt19937 random(seed);
    const TSpline spline = RandomFunctions(random, 1 + seed / 2);
    ExpectPartition(spline, BezierMesh(spline), random);
  }
}

TEST(BezierMesh, LevelCountsHalvings)
{
  const KnotLine line = MakeUniformKnotLine(0.0, 1.0, 16);
  TSpline spline = MakeTensorProduct({ line, line, line }, { 4, 4, 4 }, 0);
  const auto rule = MakeKnotInsertionRule(spline);
  rule->Refine(spline, { { 60, 0, 2 }, { 60, 2, 2 } });
  const BezierMesh mesh(spline);
  int highest = 0;
  for (Index cell = 0; cell < mesh.Size(); ++cell)
  {
    const IndexBox& box = mesh.Box(cell);
    const int volume =
      (box.High[0] - box.Low[0]) * (box.High[1] - box.Low[1]) * (box.High[2] - box.Low[2]);
    EXPECT_EQ(volume << mesh.Level(cell), 64);
    highest = std::max(highest, mesh.Level(cell));
  }
  EXPECT_GE(highest, 1);
}

TEST(BezierMesh, FindsSpansOfUnevenLines)
{
  std::mt19937 random(5);
  KnotLine line = { -3.0 };
  while (line.size() < 200)
  {
    line.push_back(line.back() + std::exp(Random(random, -25.0, 0.0)));
  }
  const TSpline spline = MakeTensorProduct({ line, { 0.0, 1.0 }, { 0.0, 1.0 } }, { 1, 1, 1 }, 0);
  const BezierMesh mesh(spline);
  const auto last = static_cast<std::int32_t>(line.size()) - 2;
  for (std::int32_t k = 0; k <= last; ++k)
  {
    EXPECT_EQ(mesh.FindSpan(0, line[k]), k);
    EXPECT_EQ(mesh.FindSpan(0, std::nextafter(line[k + 1], line[k])), k);
  }
  EXPECT_EQ(mesh.FindSpan(0, line.back()), last);
  EXPECT_EQ(mesh.FindSpan(0, std::nextafter(line.front(), -4.0)), -1);
  EXPECT_EQ(mesh.FindSpan(0, std::nextafter(line.back(), 1e9)), -1);
  EXPECT_EQ(mesh.FindSpan(0, std::numeric_limits<double>::quiet_NaN()), -1);
  EXPECT_EQ(mesh.FindCell(line[0], 2.0, 0.5), -1);
}

TEST(BezierMesh, RefusesHostileKnots)
{
  // Each function has knots of its own: 1500 in each direction.
  TSpline spline;
  spline.Components = 3;
  spline.KnotLines.fill(MakeUniformKnotLine(0.0, 1.0, 1500));
  for (std::int32_t i = 0; i < 300; ++i)
  {
    const LocalKnots k = { 5 * i, 5 * i + 1, 5 * i + 2, 5 * i + 3, 5 * i + 4 };
    spline.Functions.push_back({ k, k, k });
  }
  EXPECT_THROW(BezierMesh{ spline }, std::length_error);

  // All supports are the whole domain, and their planes cut each other into too many cells.
  spline.KnotLines.fill(MakeUniformKnotLine(0.0, 1.0, 600));
  for (std::int32_t i = 0; i < 300; ++i)
  {
    const LocalKnots k = { 0, 1 + i % 199, 200 + i % 199, 400 + i % 199, 600 };
    spline.Functions[i] = { k, k, k };
  }
  EXPECT_THROW(BezierMesh{ spline }, std::length_error);
}

TEST(BezierMesh, NoFunctionsNoCells)
{
  TSpline spline;
  spline.Components = 3;
  spline.KnotLines.fill({ 0.0, 1.0 });
  const BezierMesh mesh(spline);
  EXPECT_EQ(mesh.Size(), 0);
  EXPECT_EQ(mesh.FindCell(0.5, 0.5, 0.5), -1);
}

TEST(BezierMesh, StopsWhenAsked)
{
  std::mt19937 random(1);
  const TSpline spline = RandomRefined(random, 3);
  int looks = 0;
  Execution execution;
  execution.Continue = [&looks](double) { return ++looks < 4; };
  EXPECT_THROW(BezierMesh(spline, execution), Aborted);
}

// Two boxes with a gap between them: each is closed, also at its high end.
TEST(BezierMesh, IsClosedWhereNoCellFollows)
{
  const KnotLine line = MakeUniformKnotLine(0.0, 2.0, 2);
  TSpline spline = MakeTensorProduct({ line, line, line }, { 1, 1, 1 }, 0);
  const TSpline other = spline;
  spline.KnotLines[0] = { 0.0, 1.0, 2.0, 5.0, 6.0, 7.0 };
  for (Index i = 0; i < other.Size(); ++i)
  {
    BlendingFunction f = other.Functions[i];
    for (std::int32_t& knot : f[0])
    {
      knot += 3;
    }
    spline.Functions.push_back(f);
    spline.Weights.push_back(1.0);
    spline.ControlPoints.insert(
      spline.ControlPoints.end(), other.ControlPoint(i), other.ControlPoint(i) + 3);
  }
  const BezierMesh mesh(spline);
  ASSERT_EQ(mesh.Size(), 16);
  const auto at = [&mesh](double u, double v, double w) { return mesh.FindCell(u, v, w); };
  EXPECT_EQ(at(2.0, 0.5, 0.5), at(1.5, 0.5, 0.5));
  EXPECT_EQ(at(2.0, 2.0, 2.0), at(1.5, 1.5, 1.5));
  EXPECT_EQ(at(7.0, 2.0, 1.0), at(6.5, 1.5, 1.5));
  EXPECT_EQ(at(1.0, 1.0, 1.0), at(1.5, 1.5, 1.5)); // a cell follows
  EXPECT_EQ(at(5.0, 0.5, 0.5), at(5.5, 0.5, 0.5));
  EXPECT_GE(at(2.0, 0.5, 0.5), 0);
  EXPECT_EQ(at(std::nextafter(2.0, 3.0), 0.5, 0.5), -1);
  EXPECT_EQ(at(std::nextafter(5.0, 4.0), 0.5, 0.5), -1);
  EXPECT_EQ(at(3.0, 0.5, 0.5), -1);
}
