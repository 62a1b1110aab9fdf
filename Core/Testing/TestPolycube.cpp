// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Domain/Polycube.h"

#include <gtest/gtest.h>

#include <set>
#include <stdexcept>

namespace
{
using trivariate::Index;
using trivariate::LatticePoint;
using trivariate::Polycube;

std::string Refusal(const std::vector<LatticePoint>& cubes)
{
  try
  {
    Polycube{ cubes };
  }
  catch (const std::invalid_argument& error)
  {
    return error.what();
  }
  return "";
}

TEST(Polycube, CountsAsThePaperDoes)
{
  EXPECT_EQ(Polycube::FromGrid({ 1, 1, 1 }).NumberOfCorners, 8);
  EXPECT_EQ(Polycube::FromGrid({ 1, 1, 2 }).NumberOfCorners, 12);
  EXPECT_EQ(Polycube::FromGrid({ 1, 1, 3 }).NumberOfCorners, 16);
  EXPECT_EQ(Polycube::FromGrid({ 1, 1, 5 }).NumberOfCorners, 24);
  EXPECT_EQ(Polycube::FromGrid({ 1, 2, 3 }).NumberOfCorners, 24);
  const Polycube large = Polycube::FromGrid({ 3, 4, 5 });
  EXPECT_EQ(large.NumberOfCorners, 4 * 5 * 6 - 2 * 3 * 4);
  EXPECT_EQ(large.Points.size(), 4u * 5 * 6);
  EXPECT_EQ(large.Faces.size(), 2u * (12 + 20 + 15));
  EXPECT_EQ(large.EulerCharacteristic(), 2);
  const Polycube ring = Polycube::FromGrid({ 3, 3, 1 }, { 1, 1, 1, 1, 0, 1, 1, 1, 1 });
  EXPECT_EQ(ring.NumberOfCorners, 32);
  EXPECT_EQ(ring.EulerCharacteristic(), 0);
}

TEST(Polycube, FacesLookOutwardAndCloseUp)
{
  const Polycube shape({ { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 1, 0, 1 }, { 1, 0, -1 } });
  for (const Polycube::Face& face : shape.Faces)
  {
    // The cross product of two edges is the outward normal, and the face is one of its cube's.
    LatticePoint u, v;
    for (int axis = 0; axis < 3; ++axis)
    {
      u[axis] = shape.Points[face.Corners[1]][axis] - shape.Points[face.Corners[0]][axis];
      v[axis] = shape.Points[face.Corners[3]][axis] - shape.Points[face.Corners[0]][axis];
    }
    for (int axis = 0; axis < 3; ++axis)
    {
      const int a = (axis + 1) % 3, b = (axis + 2) % 3;
      EXPECT_EQ(u[a] * v[b] - u[b] * v[a], axis == face.Axis ? 2 * face.Side - 1 : 0);
    }
    EXPECT_EQ(
      shape.Points[face.Corners[0]][face.Axis], shape.Cubes[face.Cube][face.Axis] + face.Side);
  }
  for (const Polycube::Edge& edge : shape.Edges)
  {
    EXPECT_EQ(shape.Points[edge.To][edge.Axis], shape.Points[edge.From][edge.Axis] + 1);
  }
  std::size_t ends = 0;
  for (const auto& around : shape.EdgesAround)
  {
    EXPECT_EQ(std::set<Index>(around.begin(), around.end()).size(), around.size());
    ends += around.size();
  }
  EXPECT_EQ(ends, 2 * shape.Edges.size());
}

TEST(Polycube, NumbersCubesAsHexahedra)
{
  const Polycube two = Polycube::FromGrid({ 1, 1, 2 });
  const std::vector<LatticePoint> wanted{ { 0, 0, 1 }, { 1, 0, 1 }, { 1, 1, 1 }, { 0, 1, 1 },
    { 0, 0, 2 }, { 1, 0, 2 }, { 1, 1, 2 }, { 0, 1, 2 } };
  for (int k = 0; k < 8; ++k)
  {
    EXPECT_EQ(two.Points[two.CubePoints[1][k]], wanted[k]);
  }
}

TEST(Polycube, RefusesWhatIsNoManifoldAndSaysWhere)
{
  EXPECT_NE(Refusal({}).find("at least one cube"), std::string::npos);
  EXPECT_NE(
    Refusal({ { 1, 2, 3 }, { 1, 2, 3 } }).find("(1, 2, 3) is given twice"), std::string::npos);
  EXPECT_NE(
    Refusal({ { 0, 0, 0 }, { 2, 0, 0 } }).find("(2, 0, 0) is not joined"), std::string::npos);
  // Two cubes across an edge, joined by a way around.
  EXPECT_NE(Refusal({ { 0, 0, 0 }, { 0, 0, 1 }, { 1, 0, 1 }, { 1, 1, 1 }, { 1, 1, 0 } })
              .find("edge from (1, 1, 0) to (1, 1, 1)"),
    std::string::npos);
  // Two cubes across a point, joined by a long way around.
  std::vector<LatticePoint> around{ { 0, 0, 0 }, { -1, 0, 0 }, { -1, 0, 1 }, { -1, 0, 2 },
    { 0, 0, 2 }, { 1, 0, 2 }, { 1, 1, 2 }, { 1, 1, 1 } };
  EXPECT_NE(Refusal(around).find("point (1, 1, 1)"), std::string::npos);
  EXPECT_THROW(Polycube::FromGrid({ 0, 1, 1 }), std::invalid_argument);
  EXPECT_THROW(Polycube::FromGrid({ 2, 1, 1 }, { 1 }), std::invalid_argument);
}
}
