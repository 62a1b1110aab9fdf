// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Polycube.h"

#include <algorithm>
#include <map>
#include <stdexcept>

namespace trivariate
{
namespace
{
// Corners of a cube in VTK's order of a hexahedron.
constexpr int HexahedronCorners[8][3] = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 },
  { 0, 0, 1 }, { 1, 0, 1 }, { 1, 1, 1 }, { 0, 1, 1 } };

// The four of them on each face, by 2 axis + side, anticlockwise seen from outside.
constexpr int FaceCorners[6][4] = { { 0, 4, 7, 3 }, { 1, 2, 6, 5 }, { 0, 1, 5, 4 }, { 3, 7, 6, 2 },
  { 0, 3, 2, 1 }, { 4, 5, 6, 7 } };

bool Before(const LatticePoint& a, const LatticePoint& b)
{
  return std::lexicographical_compare(a.rbegin(), a.rend(), b.rbegin(), b.rend());
}

struct InOrder
{
  bool operator()(const LatticePoint& a, const LatticePoint& b) const { return Before(a, b); }
};

using PlaceMap = std::map<LatticePoint, Index, InOrder>;

PlaceMap Places(const std::vector<LatticePoint>& cubes)
{
  PlaceMap places;
  for (const LatticePoint& cube : cubes)
  {
    if (!places.emplace(cube, static_cast<Index>(places.size())).second)
    {
      throw std::invalid_argument("The cube at " + NameOf(cube) + " is given twice.");
    }
  }
  return places;
}

LatticePoint Moved(LatticePoint place, int axis, int side)
{
  place[axis] += side ? 1 : -1;
  return place;
}
}

//------------------------------------------------------------------------------
std::string NameOf(const LatticePoint& point)
{
  return "(" + std::to_string(point[0]) + ", " + std::to_string(point[1]) + ", " +
         std::to_string(point[2]) + ")";
}

//------------------------------------------------------------------------------
Polycube Polycube::FromGrid(
  const std::array<int, 3>& size, const std::vector<unsigned char>& present)
{
  if (std::min({ size[0], size[1], size[2] }) < 1)
  {
    throw std::invalid_argument("A polycube needs at least one cube along each axis; " +
                                NameOf({ size[0], size[1], size[2] }) + " were asked for.");
  }
  const std::size_t n = std::size_t(size[0]) * size[1] * size[2];
  if (!present.empty() && present.size() != n)
  {
    throw std::invalid_argument("A polycube of " + NameOf({ size[0], size[1], size[2] }) +
                                " cubes needs " + std::to_string(n) + " switches, not " +
                                std::to_string(present.size()) + ".");
  }
  std::vector<LatticePoint> cubes;
  for (std::size_t i = 0; i < n; ++i)
  {
    if (present.empty() || present[i])
    {
      cubes.push_back({ static_cast<int>(i % size[0]), static_cast<int>(i / size[0] % size[1]),
        static_cast<int>(i / size[0] / size[1]) });
    }
  }
  return Polycube(std::move(cubes));
}

//------------------------------------------------------------------------------
Polycube::Polycube(std::vector<LatticePoint> cubes)
  : Cubes(std::move(cubes))
{
  if (this->Cubes.empty())
  {
    throw std::invalid_argument("A polycube needs at least one cube; all are switched off.");
  }
  this->CheckFaceConnected();
  this->FindPointsAndFaces();
  this->FindEdges();
  this->FindFans();
}

//------------------------------------------------------------------------------
void Polycube::CheckFaceConnected() const
{
  const PlaceMap places = Places(this->Cubes);
  std::vector<char> reached(this->Cubes.size(), 0);
  std::vector<Index> waiting(1, 0);
  reached[0] = 1;
  while (!waiting.empty())
  {
    const LatticePoint cube = this->Cubes[waiting.back()];
    waiting.pop_back();
    for (int face = 0; face < 6; ++face)
    {
      const auto next = places.find(Moved(cube, face / 2, face % 2));
      if (next != places.end() && !reached[next->second])
      {
        reached[next->second] = 1;
        waiting.push_back(next->second);
      }
    }
  }
  const auto lost = std::find(reached.begin(), reached.end(), 0);
  if (lost != reached.end())
  {
    throw std::invalid_argument("The cube at " + NameOf(this->Cubes[lost - reached.begin()]) +
                                " is not joined by faces to the cube at " + NameOf(this->Cubes[0]) +
                                ".");
  }
}

//------------------------------------------------------------------------------
void Polycube::FindPointsAndFaces()
{
  const PlaceMap places = Places(this->Cubes);
  std::map<LatticePoint, bool, InOrder> onBoundary;
  const auto corner = [](LatticePoint cube, int k)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      cube[axis] += HexahedronCorners[k][axis];
    }
    return cube;
  };
  for (const LatticePoint& cube : this->Cubes)
  {
    for (int k = 0; k < 8; ++k)
    {
      onBoundary.emplace(corner(cube, k), false);
    }
    for (int face = 0; face < 6; ++face)
    {
      if (places.count(Moved(cube, face / 2, face % 2)) == 0)
      {
        for (const int k : FaceCorners[face])
        {
          onBoundary[corner(cube, k)] = true;
        }
      }
    }
  }
  PlaceMap number;
  for (const bool wanted : { true, false })
  {
    for (const auto& point : onBoundary)
    {
      if (point.second == wanted)
      {
        number[point.first] = static_cast<Index>(this->Points.size());
        this->Points.push_back(point.first);
      }
    }
    this->NumberOfCorners =
      wanted ? static_cast<Index>(this->Points.size()) : this->NumberOfCorners;
  }
  for (std::size_t i = 0; i < this->Cubes.size(); ++i)
  {
    std::array<Index, 8> points;
    for (int k = 0; k < 8; ++k)
    {
      points[k] = number[corner(this->Cubes[i], k)];
    }
    this->CubePoints.push_back(points);
    for (int face = 0; face < 6; ++face)
    {
      if (places.count(Moved(this->Cubes[i], face / 2, face % 2)) == 0)
      {
        const int* k = FaceCorners[face];
        this->Faces.push_back({ { points[k[0]], points[k[1]], points[k[2]], points[k[3]] },
          face / 2, face % 2, static_cast<Index>(i) });
      }
    }
  }
}

//------------------------------------------------------------------------------
// Each face has each of its edges on its left.
void Polycube::FindEdges()
{
  std::map<std::array<Index, 2>, Index> left;
  for (std::size_t f = 0; f < this->Faces.size(); ++f)
  {
    for (int k = 0; k < 4; ++k)
    {
      const Index from = this->Faces[f].Corners[k], to = this->Faces[f].Corners[(k + 1) % 4];
      if (!left.emplace(std::array<Index, 2>{ from, to }, static_cast<Index>(f)).second)
      {
        throw std::invalid_argument("Cubes touch at the edge from " + NameOf(this->Points[from]) +
                                    " to " + NameOf(this->Points[to]) +
                                    " only; fill the gap or separate them.");
      }
    }
  }
  for (const auto& side : left)
  {
    const auto [from, to] = side.first;
    if (from < to)
    {
      int axis = 0;
      while (this->Points[from][axis] == this->Points[to][axis])
      {
        ++axis;
      }
      this->Edges.push_back({ from, to, side.second, left.at({ to, from }), axis });
    }
  }
}

//------------------------------------------------------------------------------
void Polycube::FindFans()
{
  std::vector<Index> degree(this->NumberOfCorners, 0), first(this->NumberOfCorners, -1);
  std::map<std::array<Index, 2>, Index> next; // by corner and edge: the next edge anticlockwise
  for (std::size_t e = 0; e < this->Edges.size(); ++e)
  {
    for (const Index corner : { this->Edges[e].From, this->Edges[e].To })
    {
      ++degree[corner];
      first[corner] = static_cast<Index>(e);
    }
  }
  // Anticlockwise around the corner between two edges of a face comes first the one that leaves it.
  std::map<std::array<Index, 2>, Index> leaving, arriving;
  for (std::size_t e = 0; e < this->Edges.size(); ++e)
  {
    const Edge& edge = this->Edges[e];
    const Index id = static_cast<Index>(e);
    leaving[{ edge.Left, edge.From }] = arriving[{ edge.Left, edge.To }] = id;
    leaving[{ edge.Right, edge.To }] = arriving[{ edge.Right, edge.From }] = id;
  }
  for (const auto& side : leaving)
  {
    next[{ side.first[1], side.second }] = arriving.at(side.first);
  }
  this->EdgesAround.resize(this->NumberOfCorners);
  for (Index corner = 0; corner < this->NumberOfCorners; ++corner)
  {
    Index edge = first[corner];
    do
    {
      this->EdgesAround[corner].push_back(edge);
      edge = next.at({ corner, edge });
    } while (edge != first[corner]);
    if (static_cast<Index>(this->EdgesAround[corner].size()) != degree[corner])
    {
      throw std::invalid_argument("Cubes touch at the point " + NameOf(this->Points[corner]) +
                                  " only; fill the gap or separate them.");
    }
  }
}
}
