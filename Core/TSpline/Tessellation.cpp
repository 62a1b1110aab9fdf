// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Tessellation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>

namespace trivariate
{
namespace
{
// Cells between two calls that report progress.
constexpr Index Stride = 1 << 14;

// The places of one direction where points can lie, and which of them belong to a cell's interval.
class Axis
{
public:
  // Cuts every interval of the mesh's cells in direction a.
  Axis(const BezierMesh& mesh, int a, int subdivisions)
    : Direction(a)
  {
    const KnotLine& line = mesh.KnotLines()[a];
    std::vector<std::pair<double, std::int32_t*>> places;
    for (Index cell = 0; cell < mesh.Size(); ++cell)
    {
      this->Ids[this->Interval(mesh.Box(cell))].resize(subdivisions + 1);
    }
    for (auto& [interval, ids] : this->Ids)
    {
      const double low = line[interval.first], high = line[interval.second];
      for (int i = 0; i <= subdivisions; ++i)
      {
        const double share = static_cast<double>(i) / subdivisions;
        places.emplace_back(i < subdivisions ? low + share * (high - low) : high, &ids[i]);
      }
    }
    // The same place reached from two intervals differs by rounding.
    const double rounding = 8.0 * std::numeric_limits<double>::epsilon() *
                            std::max(std::abs(line.front()), std::abs(line.back()));
    std::sort(places.begin(), places.end());
    for (const auto& [value, id] : places)
    {
      if (this->Values.empty() || value > this->Values.back() + rounding)
      {
        this->Values.push_back(value);
      }
      *id = static_cast<std::int32_t>(this->Values.size() - 1);
    }
  }

  // The one place `value`, for all cells.
  Axis(int a, double value)
    : Direction(a)
    , Values{ value }
    , OnlyPlace{ 0 }
  {
  }

  Index Size() const { return static_cast<Index>(this->Values.size()); }
  double Value(Index id) const { return this->Values[id]; }

  const std::vector<std::int32_t>& Places(const IndexBox& box) const
  {
    return this->OnlyPlace.empty() ? this->Ids.at(this->Interval(box)) : this->OnlyPlace;
  }

private:
  using IndexInterval = std::pair<std::int32_t, std::int32_t>;

  int Direction;
  std::vector<double> Values;
  std::vector<std::int32_t> OnlyPlace;
  std::map<IndexInterval, std::vector<std::int32_t>> Ids;

  IndexInterval Interval(const IndexBox& box) const
  {
    return { box.Low[this->Direction], box.High[this->Direction] };
  }
};

// The points of some cells on three axes: a point is one number made of its three places.
class PointLattice
{
public:
  PointLattice(const BezierMesh& mesh, std::array<Axis, 3> axes)
    : Mesh(mesh)
    , Axes(std::move(axes))
  {
    const double count = 1.0 * this->Axes[0].Size() * this->Axes[1].Size() * this->Axes[2].Size();
    if (count > 9e18)
    {
      throw std::length_error("The subdivided cells have too many different sizes to be numbered; "
                              "ask for fewer subdivisions.");
    }
  }

  // Calls body(point) for the points of a cell, u fastest.
  template <typename Body>
  void ForEachPoint(Index cell, const Body& body) const
  {
    const IndexBox& box = this->Mesh.Box(cell);
    const std::array<const std::vector<std::int32_t>*, 3> places = { &this->Axes[0].Places(box),
      &this->Axes[1].Places(box), &this->Axes[2].Places(box) };
    for (const std::int32_t w : *places[2])
    {
      for (const std::int32_t v : *places[1])
      {
        for (const std::int32_t u : *places[0])
        {
          body((w * this->Axes[1].Size() + v) * this->Axes[0].Size() + u);
        }
      }
    }
  }

  void Parameters(Index point, double* parameters) const
  {
    const Index nu = this->Axes[0].Size(), nv = this->Axes[1].Size();
    parameters[0] = this->Axes[0].Value(point % nu);
    parameters[1] = this->Axes[1].Value(point / nu % nv);
    parameters[2] = this->Axes[2].Value(point / nu / nv);
  }

private:
  const BezierMesh& Mesh;
  std::array<Axis, 3> Axes;
};

/**
 * Numbers the lattice's points on the given cells and connects them: each element takes those of
 * its cell's points that `corners` lists (their place among the points of the cell, u fastest).
 */
Tessellation Connect(const PointLattice& lattice, const std::vector<Index>& cells,
  Index pointsPerCell, const std::vector<std::vector<Index>>& corners, const Execution& execution)
{
  const Index count = static_cast<Index>(cells.size());
  const Index elementsPerCell = static_cast<Index>(corners.size());
  const Index cornersPerElement = static_cast<Index>(corners.front().size());
  const auto forEachCell = [&execution, count](double from, double to, const auto& body)
  {
    const Execution part = execution.Part(from, to);
    for (Index first = 0; first < count; first += Stride)
    {
      part.Check(static_cast<double>(first) / count);
      part.ParallelFor(std::min(Stride, count - first),
        [first, &body](Index begin, Index end)
        {
          for (Index i = first + begin; i < first + end; ++i)
          {
            body(i);
          }
        });
    }
  };

  std::vector<Index> points(count * pointsPerCell);
  forEachCell(0.0, 0.2,
    [&](Index i)
    {
      Index* next = &points[i * pointsPerCell];
      lattice.ForEachPoint(cells[i], [&next](Index point) { *next++ = point; });
    });
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());

  Tessellation result;
  result.Parameters.resize(3 * points.size());
  for (std::size_t id = 0; id < points.size(); ++id)
  {
    lattice.Parameters(points[id], &result.Parameters[3 * id]);
  }
  result.Cells.resize(count * elementsPerCell);
  result.Elements.resize(count * elementsPerCell * cornersPerElement);
  forEachCell(0.6, 1.0,
    [&](Index i)
    {
      std::vector<Index> ids;
      ids.reserve(pointsPerCell);
      lattice.ForEachPoint(cells[i], [&points, &ids](Index point)
        { ids.push_back(std::lower_bound(points.begin(), points.end(), point) - points.begin()); });
      Index* next = &result.Elements[i * elementsPerCell * cornersPerElement];
      for (const std::vector<Index>& element : corners)
      {
        for (const Index corner : element)
        {
          *next++ = ids[corner];
        }
      }
      std::fill_n(&result.Cells[i * elementsPerCell], elementsPerCell, cells[i]);
    });
  return result;
}

void CheckSubdivisions(int subdivisions)
{
  if (subdivisions < 1)
  {
    throw std::invalid_argument(
      "There are " + std::to_string(subdivisions) + " subdivisions; one or more are needed.");
  }
}
}

Tessellation TessellateVolume(const BezierMesh& mesh, int subdivisions, const Execution& execution)
{
  CheckSubdivisions(subdivisions);
  const PointLattice lattice(mesh,
    { Axis(mesh, 0, subdivisions), Axis(mesh, 1, subdivisions), Axis(mesh, 2, subdivisions) });
  std::vector<Index> cells(mesh.Size());
  for (Index cell = 0; cell < mesh.Size(); ++cell)
  {
    cells[cell] = cell;
  }
  const Index row = subdivisions + 1, layer = row * row;
  std::vector<std::vector<Index>> corners;
  for (Index k = 0; k < subdivisions; ++k)
  {
    for (Index j = 0; j < subdivisions; ++j)
    {
      for (Index i = 0; i < subdivisions; ++i)
      {
        const Index p = k * layer + j * row + i, q = p + layer;
        corners.push_back({ p, p + 1, p + row + 1, p + row, q, q + 1, q + row + 1, q + row });
      }
    }
  }
  return Connect(lattice, cells, row * layer, corners, execution);
}

//------------------------------------------------------------------------------
Tessellation TessellateBoxes(
  const std::array<KnotLine, 3>& lines, const std::vector<IndexBox>& boxes)
{
  // VTK's order of the corners: round the low face in w, then round the high one.
  std::vector<GridIndex> corners;
  for (const IndexBox& box : boxes)
  {
    for (const std::int32_t w : { box.Low[2], box.High[2] })
    {
      corners.push_back({ box.Low[0], box.Low[1], w });
      corners.push_back({ box.High[0], box.Low[1], w });
      corners.push_back({ box.High[0], box.High[1], w });
      corners.push_back({ box.Low[0], box.High[1], w });
    }
  }
  const auto isBefore = [](const GridIndex& a, const GridIndex& b)
  { return std::lexicographical_compare(a.rbegin(), a.rend(), b.rbegin(), b.rend()); };
  std::vector<GridIndex> points = corners;
  std::sort(points.begin(), points.end(), isBefore);
  points.erase(std::unique(points.begin(), points.end()), points.end());

  Tessellation result;
  for (const GridIndex& point : points)
  {
    for (int a = 0; a < 3; ++a)
    {
      result.Parameters.push_back(lines[a][point[a]]);
    }
  }
  for (const GridIndex& corner : corners)
  {
    result.Elements.push_back(
      std::lower_bound(points.begin(), points.end(), corner, isBefore) - points.begin());
  }
  result.Cells.resize(boxes.size());
  std::iota(result.Cells.begin(), result.Cells.end(), Index(0));
  return result;
}

Tessellation TessellateSurface(
  const BezierMesh& mesh, int direction, double value, int subdivisions, const Execution& execution)
{
  CheckSubdivisions(subdivisions);
  // The cells in which points of the surface are found: at a knot those behind it, or where none
  // follows, at the end of a group of blocks or at a hole, those before it.
  std::vector<Index> cells;
  for (Index cell = 0; cell < mesh.Size(); ++cell)
  {
    const std::array<double, 6> bounds = mesh.Bounds(cell);
    if (bounds[2 * direction] <= value && value <= bounds[2 * direction + 1])
    {
      std::array<double, 3> middle;
      for (int a = 0; a < 3; ++a)
      {
        middle[a] = a == direction ? value : 0.5 * (bounds[2 * a] + bounds[2 * a + 1]);
      }
      if (mesh.FindCell(middle[0], middle[1], middle[2]) == cell)
      {
        cells.push_back(cell);
      }
    }
  }
  const auto axis = [&](int a)
  { return a == direction ? Axis(a, value) : Axis(mesh, a, subdivisions); };
  const PointLattice lattice(mesh, { axis(0), axis(1), axis(2) });

  // Of the two other directions in ascending order, the first varies fastest. For v it is u, then
  // w: the other way round as w x u = v wants it.
  const Index row = subdivisions + 1;
  std::vector<std::vector<Index>> corners;
  for (Index j = 0; j < subdivisions; ++j)
  {
    for (Index i = 0; i < subdivisions; ++i)
    {
      const Index p = j * row + i;
      corners.push_back(direction == 1 ? std::vector<Index>{ p, p + row, p + row + 1, p + 1 }
                                       : std::vector<Index>{ p, p + 1, p + row + 1, p + row });
    }
  }
  return Connect(lattice, cells, row * row, corners, execution);
}
}
