// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Parameter/InsideShares.h"
#include "Parameter/MonotoneMap.h"
#include "ParameterShapes.h"

#include <gtest/gtest.h>

using namespace trivariate;

namespace
{
// Volume inside, and the integral of the place over it, from all cells.
Eigen::Vector4d Moments(const InsideShares& inside, const std::array<Index, 3>& cells)
{
  Eigen::Vector4d sum = Eigen::Vector4d::Zero();
  std::vector<CellOctants> octants;
  for (Index row = 0; row < cells[1] * cells[2]; ++row)
  {
    inside.Row(row, octants);
    for (Index i = 0; i < cells[0]; ++i)
    {
      for (int o = 0; o < 8; ++o)
      {
        const double volume = octants[i].Shares[o] / 8.0;
        const std::array<float, 3>& m = octants[i].Middles[o];
        for (int a = 0; a < 3; ++a)
        {
          EXPECT_GE(m[a], 0.5F * (o >> a & 1));
          EXPECT_LE(m[a], 0.5F * (o >> a & 1) + 0.5F);
        }
        sum += volume * Eigen::Vector4d(1.0, double(i) + m[0], double(row % cells[1]) + m[1],
                          double(row / cells[1]) + m[2]);
      }
    }
  }
  return sum;
}
}

TEST(InsideShares, MeasureABoxOnTheGridExactly)
{
  ParameterShape box{ 12,
    [](const Eigen::Vector3d& p) -> Eigen::Vector3d
    { return Eigen::Vector3d(2.3, 3.25, 1.5) + p.cwiseProduct(Eigen::Vector3d(5.1, 4.5, 6.0)); },
    {}, {} };
  const ParameterSurface surface = SurfaceOf(box, 3);
  const std::array<Index, 3> cells = { 11, 11, 11 };
  const Eigen::Vector4d m = Moments(InsideShares(surface.Points, surface.Triangles, cells), cells);
  EXPECT_NEAR(m[0], 5.1 * 4.5 * 6.0, 1e-4);
  EXPECT_NEAR(m[1] / m[0], 2.3 + 2.55, 1e-5);
  EXPECT_NEAR(m[2] / m[0], 3.25 + 2.25, 1e-5);
  EXPECT_NEAR(m[3] / m[0], 1.5 + 3.0, 1e-5);
}

TEST(InsideShares, MeasureASlantedBoxAlmost)
{
  const Index n = 30;
  const ParameterShape box = SlantedBox(n);
  const ParameterSurface surface = SurfaceOf(box, 7);
  const std::array<Index, 3> cells = { n, n, n };
  const Eigen::Vector4d m = Moments(InsideShares(surface.Points, surface.Triangles, cells), cells);
  const double volume = 1.0 / box.Frame({ 0, 0, 0 }).determinant();
  EXPECT_NEAR(m[0], volume, 1e-3 * volume);
  const Eigen::Vector3d middle = box.Point({ 0.5, 0.5, 0.5 });
  for (int a = 0; a < 3; ++a)
  {
    EXPECT_NEAR(m[a + 1] / m[0], middle[a], 5e-3);
  }
}

// Points and edges exactly on the lines that are measured along: nothing leaks.
TEST(InsideShares, MeetPointsAndEdges)
{
  for (const double place : { 2.125, 2.375, 2.0 })
  {
    ParameterShape box{ 12,
      [place](const Eigen::Vector3d& p) -> Eigen::Vector3d
      { return Eigen::Vector3d::Constant(place) + 4.0 * p; },
      {}, {} };
    const ParameterSurface surface = SurfaceOf(box, 4);
    const std::array<Index, 3> cells = { 11, 11, 11 };
    const InsideShares inside(surface.Points, surface.Triangles, cells);
    EXPECT_NEAR(Moments(inside, cells)[0], 64.0, 1e-4);
    std::vector<CellOctants> octants;
    for (Index row = 0; row < 121; ++row)
    {
      inside.Row(row, octants);
      EXPECT_EQ(octants[10].Shares, (std::array<float, 8>{})) << row;
    }
  }
}

TEST(MonotoneMap, IsStraightBetweenTwoPoints)
{
  const MonotoneMap map({ 1.0, 3.0 }, { 10.0, 20.0 });
  for (const double x : { -1.0, 1.0, 1.7, 3.0, 5.5 })
  {
    EXPECT_NEAR(map(x), 5.0 + 5.0 * x, 1e-12);
  }
}

TEST(MonotoneMap, IsMonotoneSmoothAndHitsItsPoints)
{
  const std::vector<double> places = { 0.0, 0.1, 4.0, 4.2, 9.0 }, values = { 0, 1, 2, 3, 7 };
  const MonotoneMap map(places, values);
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    EXPECT_NEAR(map(places[i]), values[i], 1e-12);
    const double h = 1e-6;
    EXPECT_NEAR(
      (map(places[i] + h) - map(places[i])) / h, (map(places[i]) - map(places[i] - h)) / h, 1e-3);
  }
  for (double x = -1.0; x < 10.0; x += 0.01)
  {
    EXPECT_GT(map(x + 0.01), map(x)) << x;
  }
}
