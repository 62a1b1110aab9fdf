// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "RandomRefinement.h"
#include "TSpline/Tessellation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>

namespace
{
using namespace trivariate;

TSpline RandomSpline(unsigned seed, bool uniform)
{
  std::mt19937 random(seed);
  TSpline spline = RandomTensorProduct({ 2, 1, 3 }, { 3, 3, 2 }, random, uniform);
  const auto rule = MakeKnotInsertionRule(spline);
  for (int round = 0; round < 8; ++round)
  {
    rule->Refine(spline, RandomMarks(spline, 6, random));
  }
  return spline;
}

double Length(const TSpline& spline, int a)
{
  return spline.KnotLines[a].back() - spline.KnotLines[a].front();
}

// The corners of an element.
std::vector<Point> Corners(const Tessellation& mesh, Index element, int count)
{
  std::vector<Point> corners;
  for (int i = 0; i < count; ++i)
  {
    const double* p = &mesh.Parameters[3 * mesh.Elements[element * count + i]];
    corners.push_back({ p[0], p[1], p[2] });
  }
  return corners;
}

// The points that must be there: those of each cell's own lattice, the same to 1e-9 being one.
std::set<std::array<long, 3>> ExpectedPoints(const BezierMesh& mesh, int subdivisions)
{
  std::set<std::array<long, 3>> points;
  for (Index cell = 0; cell < mesh.Size(); ++cell)
  {
    const auto b = mesh.Bounds(cell);
    for (int i = 0; i < (subdivisions + 1) * (subdivisions + 1) * (subdivisions + 1); ++i)
    {
      std::array<long, 3> key;
      int rest = i;
      for (int a = 0; a < 3; ++a)
      {
        const double s = 1.0 * (rest % (subdivisions + 1)) / subdivisions;
        rest /= subdivisions + 1;
        key[a] = std::lround(1e9 * (b[2 * a] + s * (b[2 * a + 1] - b[2 * a])));
      }
      points.insert(key);
    }
  }
  return points;
}

TEST(Tessellation, HexahedraFillTheDomainAndShareTheirPoints)
{
  for (unsigned seed = 0; seed < 12; ++seed)
  {
    const TSpline spline = RandomSpline(seed, seed % 2 == 0);
    const BezierMesh cells(spline);
    for (const int n : { 1, 2, 3 })
    {
      const Tessellation mesh = TessellateVolume(cells, n);
      ASSERT_EQ(mesh.ElementCount(), cells.Size() * n * n * n);
      double volume = 0.0;
      for (Index e = 0; e < mesh.ElementCount(); ++e)
      {
        const auto c = Corners(mesh, e, 8);
        const auto bounds = cells.Bounds(mesh.Cells[e]);
        double box = 1.0;
        for (int a = 0; a < 3; ++a)
        {
          const double low = c[0][a], high = c[6][a];
          box *= high - low;
          ASSERT_NEAR(high - low, (bounds[2 * a + 1] - bounds[2 * a]) / n, 1e-12);
          ASSERT_GE(low, bounds[2 * a] - 1e-13);
          ASSERT_LE(high, bounds[2 * a + 1] + 1e-13);
          // The eight corners in VTK's order.
          const int ones[3] = { 0b01100110, 0b11001100, 0b11110000 };
          for (int i = 0; i < 8; ++i)
          {
            ASSERT_EQ(c[i][a], ones[a] >> i & 1 ? high : low);
          }
        }
        volume += box;
      }
      EXPECT_NEAR(volume / (Length(spline, 0) * Length(spline, 1) * Length(spline, 2)), 1.0, 1e-12);
      EXPECT_EQ(mesh.PointCount(), static_cast<Index>(ExpectedPoints(cells, n).size()));
      std::set<Index> used(mesh.Elements.begin(), mesh.Elements.end());
      EXPECT_EQ(static_cast<Index>(used.size()), mesh.PointCount());
    }
  }
}

TEST(Tessellation, AxesOfATensorProductAreConforming)
{
  const TSpline spline =
    MakeTensorProduct({ MakeUniformKnotLine(0.0, 0.7, 6), MakeUniformKnotLine(-1.0, 2.1, 4),
                        MakeUniformKnotLine(5.0, 5.3, 3) },
      { 2, 1, 1 }, 0);
  const BezierMesh cells(spline);
  const Tessellation mesh = TessellateVolume(cells, 3);
  EXPECT_EQ(mesh.PointCount(), 10 * 13 * 10);
  // Each inner quadrilateral belongs to two hexahedra.
  const int faces[6][4] = { { 0, 1, 2, 3 }, { 4, 5, 6, 7 }, { 0, 1, 5, 4 }, { 3, 2, 6, 7 },
    { 0, 3, 7, 4 }, { 1, 2, 6, 5 } };
  std::map<std::vector<Index>, int> count;
  for (Index e = 0; e < mesh.ElementCount(); ++e)
  {
    for (const auto& face : faces)
    {
      std::vector<Index> key;
      for (const int corner : face)
      {
        key.push_back(mesh.Elements[8 * e + corner]);
      }
      std::sort(key.begin(), key.end());
      ++count[key];
    }
  }
  const auto boundary =
    std::count_if(count.begin(), count.end(), [](const auto& face) { return face.second == 1; });
  EXPECT_EQ(boundary, 2 * (9 * 12 + 12 * 9 + 9 * 9));
  EXPECT_TRUE(
    std::all_of(count.begin(), count.end(), [](const auto& face) { return face.second <= 2; }));
}

TEST(Tessellation, SurfacesCoverTheirFaceAndLookUp)
{
  for (unsigned seed = 0; seed < 8; ++seed)
  {
    const TSpline spline = RandomSpline(seed, false);
    const BezierMesh cells(spline);
    for (int a = 0; a < 3; ++a)
    {
      const int b = (a + 1) % 3, c = (a + 2) % 3;
      const KnotLine& line = spline.KnotLines[a];
      for (const double value : { line.front(), line[1], 0.5 * (line[1] + line[2]), line.back() })
      {
        const Tessellation mesh = TessellateSurface(cells, a, value, 2);
        double area = 0.0;
        for (Index e = 0; e < mesh.ElementCount(); ++e)
        {
          const auto corner = Corners(mesh, e, 4);
          for (const Point& x : corner)
          {
            ASSERT_EQ(x[a], value);
          }
          // Half the cross product of the diagonals, along the direction itself.
          area += 0.5 * ((corner[2][b] - corner[0][b]) * (corner[3][c] - corner[1][c]) -
                          (corner[2][c] - corner[0][c]) * (corner[3][b] - corner[1][b]));
        }
        EXPECT_NEAR(area / (Length(spline, b) * Length(spline, c)), 1.0, 1e-12);
      }
      EXPECT_EQ(TessellateSurface(cells, a, line.back() + 1e-6, 2).ElementCount(), 0);
      EXPECT_EQ(TessellateSurface(cells, a, line.front() - 1e-6, 2).PointCount(), 0);
    }
  }
}

TEST(Tessellation, IsTheSameForAnyThreads)
{
  const TSpline spline = RandomSpline(5, false);
  const BezierMesh cells(spline);
  Execution shuffled;
  shuffled.ParallelFor = [](Index n, const Execution::Body& body)
  {
    for (Index end = n; end > 0; end -= std::min<Index>(end, 7))
    {
      body(std::max<Index>(0, end - 7), end);
    }
  };
  const Tessellation one = TessellateVolume(cells, 2), other = TessellateVolume(cells, 2, shuffled);
  EXPECT_EQ(one.Parameters, other.Parameters);
  EXPECT_EQ(one.Elements, other.Elements);
  EXPECT_EQ(one.Cells, other.Cells);
}

TEST(Tessellation, RefusesNoSubdivisionsAndStops)
{
  const TSpline spline = RandomSpline(1, true);
  const BezierMesh cells(spline);
  EXPECT_THROW(TessellateVolume(cells, 0), std::invalid_argument);
  EXPECT_THROW(TessellateSurface(cells, 0, 0.0, -1), std::invalid_argument);
  Execution stopped;
  stopped.Continue = [](double) { return false; };
  EXPECT_THROW(TessellateVolume(cells, 2, stopped), Aborted);
}
}
