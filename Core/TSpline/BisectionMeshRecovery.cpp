// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
// The mesh of an analysis-suitable spline from its functions.
#include "BisectionMesh.h"

#include <algorithm>
#include <cmath>

namespace trivariate
{
namespace
{
// A knot line as part of one that cuts the root cells into spans by halving all of them so often.
struct DyadicPlaces
{
  int Depth = -1;                   // -1: it is part of no such line
  std::vector<std::int32_t> OfKnot; // ascending

  std::int32_t KnotAt(std::int32_t place) const
  {
    const auto found = std::lower_bound(this->OfKnot.begin(), this->OfKnot.end(), place);
    return static_cast<std::int32_t>(found - this->OfKnot.begin());
  }
};

// Equally wide root cells, whose spans need not all end at a knot of the line; otherwise, for knots
// at other distances, one span for each interval of the line.
DyadicPlaces PlacesOf(const KnotLine& line, std::int32_t rootCells)
{
  constexpr double Rounding = 1e-6; // of a span
  DyadicPlaces places;
  if (rootCells < 1 || line.size() < 2)
  {
    return places;
  }
  const auto intervals = static_cast<Index>(line.size()) - 1;
  const double low = line.front(), length = line.back() - low;
  for (const bool equal : { true, false })
  {
    for (int depth = 0;
         depth <= BisectionMesh::MaximumDepth && rootCells <= BisectionMesh::MaximumKnots >> depth;
         ++depth)
    {
      const std::int32_t spans = rootCells << depth;
      if (spans < intervals || (!equal && spans > intervals))
      {
        continue;
      }
      places.OfKnot.clear();
      bool fits = true;
      for (Index k = 0; k <= intervals && fits; ++k)
      {
        const double place = equal ? (line[k] - low) / length * spans : static_cast<double>(k);
        places.OfKnot.push_back(static_cast<std::int32_t>(std::lround(place)));
        fits = std::abs(place - places.OfKnot[k]) <= Rounding &&
               (k == 0 || places.OfKnot[k] > places.OfKnot[k - 1]);
      }
      if (fits)
      {
        places.Depth = depth;
        return places;
      }
    }
  }
  return places;
}
}

//------------------------------------------------------------------------------
std::vector<IndexBox> BisectionMesh::Recover(const TSpline& spline, const GridIndex& rootCells)
{
  std::array<DyadicPlaces, 3> places;
  std::array<int, 3> depth;
  double roots = 1.0, vertices = 1.0;
  for (int a = 0; a < 3; ++a)
  {
    places[a] = PlacesOf(spline.KnotLines[a], rootCells[a]);
    depth[a] = places[a].Depth;
    if (depth[a] < 0)
    {
      return {};
    }
    roots *= rootCells[a];
    vertices *= std::ldexp(rootCells[a], depth[a]) + 3.0;
  }
  // Every root cell has a function; the numbers of vertices must fit into an Index.
  if (roots > static_cast<double>(spline.Size()) || vertices > 0x1p62)
  {
    return {};
  }
  std::vector<BlendingFunction> given = spline.Functions;
  for (BlendingFunction& f : given)
  {
    for (int a = 0; a < 3; ++a)
    {
      for (std::int32_t& knot : f[a])
      {
        knot = places[a].OfKnot[knot];
      }
    }
  }
  BisectionMesh mesh(rootCells, depth, Closure::Narrow);
  std::unordered_set<Index> centres;
  for (const BlendingFunction& f : given)
  {
    centres.insert(mesh.AnchorOf({ f[0][2], f[1][2], f[2][2] }));
  }
  std::vector<GridIndex> corners; // of cells that may have been halved
  for (const IndexBox& root : mesh.Cells())
  {
    corners.push_back(root.Low);
  }
  while (!corners.empty())
  {
    const GridIndex corner = corners.back();
    corners.pop_back();
    const Cell cell = mesh.Find(corner);
    const int a = mesh.Levels[cell.Level].Direction;
    if (a < 0)
    {
      continue;
    }
    const auto middle = mesh.NewVertices(corner, cell.Level);
    if (std::all_of(middle.begin(), middle.end(),
          [&](const GridIndex& v) { return centres.count(mesh.AnchorOf(v)) != 0; }))
    {
      mesh.Halve(corner, cell);
      GridIndex upper = corner;
      upper[a] = middle[0][a];
      corners.push_back(corner);
      corners.push_back(upper);
    }
  }
  std::vector<BlendingFunction> found = mesh.Functions();
  std::sort(given.begin(), given.end());
  std::sort(found.begin(), found.end());
  if (given != found)
  {
    return {};
  }
  std::vector<IndexBox> cells = mesh.Cells();
  for (IndexBox& cell : cells)
  {
    for (int a = 0; a < 3; ++a)
    {
      // Every face between cells has a knot, at the functions of its corners.
      cell.Low[a] = places[a].KnotAt(cell.Low[a]);
      cell.High[a] = places[a].KnotAt(cell.High[a]);
    }
  }
  return cells;
}
}
