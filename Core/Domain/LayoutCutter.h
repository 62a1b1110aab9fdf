// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// What CutAlongEdges does, in two parts: lines traced (LayoutCutter.cpp), faces between them
/// filled (LayoutCutting.cpp).
#ifndef trivariate_LayoutCutter_h
#define trivariate_LayoutCutter_h

#include "LayoutUnfolding.h"

#include <algorithm>

namespace trivariate
{
// Where a line goes on: its direction, and its end, in the chart of a triangle.
struct LineHeading
{
  Index Triangle;
  Eigen::Vector2d Along, End;
};

class LayoutCutter
{
public:
  LayoutCutter(const LayoutUnfolding& unfolding, const SurfaceLayout& layout)
    : Map(unfolding)
    , Mesh(unfolding.Mesh)
    , Old(layout)
    , Cubes(unfolding.Charts.Cubes)
    , CornerPoints(layout.Corners.size(), -1)
    , Borders(layout.Borders.size())
  {
    for (Index line = 0; line < unfolding.Charts.NumberOfLines(); ++line)
    {
      this->Longest = std::max(this->Longest, unfolding.LineValue(line));
    }
    for (const LayoutUnfolding::ChartTriangle& triangle : unfolding.Triangles)
    {
      this->Charts.push_back(triangle.Face);
      this->Places.push_back({ unfolding.Place(triangle, 0), unfolding.Place(triangle, 1),
        unfolding.Place(triangle, 2) });
    }
    std::fill(this->Mesh.Occupied.begin(), this->Mesh.Occupied.end(), 0);
    for (std::size_t corner = 0; corner < layout.Corners.size(); ++corner)
    {
      if (unfolding.IsTied(layout.Corners[corner]))
      {
        this->CornerPoints[corner] = layout.Corners[corner];
        this->Mesh.Occupied[layout.Corners[corner]] = 1;
      }
    }
  }

  SurfaceLayout Result();

private:
  using TrianglePlaces = std::array<Eigen::Vector2d, 3>;

  void TraceAll();
  void Trace(Index edge, Index from);
  Index NextPoint(LineHeading& heading, Index point, Index& end);
  Index EndInside(const LineHeading& heading, Index point, double where, double share);
  LineHeading Start(Index edge, Index corner) const;
  LineHeading TurnedTo(LineHeading heading, Index point, bool anticlockwise) const;
  LineHeading Facing(LineHeading heading, Index point) const;
  int TurnAcross(Index t, int side) const;
  LineHeading Across(const LineHeading& heading, int side) const;
  Index Split(Index t, int side, double where);
  bool MoveOnto(Index t, int corner, const Eigen::Vector2d& place);
  void Claim(Index edge, bool forwards, std::vector<Index>& waiting);
  void FillFaces();
  std::vector<Eigen::Vector3d> Parameters() const;
  double LengthOf(Index edge) const;
  Eigen::Vector2d CornerPlace(Index face, Index corner) const;
  Eigen::Vector2d InFace(Index t, int k) const
  {
    return Turned(this->Places[t][k], this->Turns[t]) + this->Shifts[t];
  }

  const LayoutUnfolding& Map;
  LayoutMesh Mesh;
  std::vector<Index> Charts; // of each triangle: the face whose chart Places are in
  const SurfaceLayout& Old;
  const Polycube& Cubes;
  std::vector<TrianglePlaces> Places;
  std::vector<Index> CornerPoints; // -1: not found yet
  std::vector<std::vector<Index>> Borders;
  double Longest = 0.0; // side of the polycube
  // Of each triangle: the face that it lies in, and the way from its chart to that of the face.
  std::vector<Index> Faces;
  std::vector<int> Turns;
  std::vector<Eigen::Vector2d> Shifts;
};
}

#endif
