// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "BisectionMesh.h"

#include <algorithm>
#include <stdexcept>

namespace trivariate
{
namespace
{
// The integer below and above a / b, b > 0.
std::int32_t FloorOf(std::int32_t a, std::int32_t b)
{
  return a / b - (a % b < 0 ? 1 : 0);
}
std::int32_t CeilingOf(std::int32_t a, std::int32_t b)
{
  return -FloorOf(-a, b);
}
}

//------------------------------------------------------------------------------
BisectionMesh::BisectionMesh(
  const GridIndex& rootCells, const std::array<int, 3>& depth, Closure closure)
  : RootCells(rootCells)
  , Rule(closure)
{
  for (int a = 0; a < 3; ++a)
  {
    if (rootCells[a] < 1 || depth[a] < 0 || depth[a] > MaximumDepth ||
        rootCells[a] > (MaximumKnots >> depth[a]))
    {
      throw std::invalid_argument("The mesh has no cell in a direction, or too many knots.");
    }
    this->Ends[a] = rootCells[a] << depth[a];
  }
  LevelShape shape{ depth, 0 };
  for (int round = 0; round < MaximumDepth; ++round)
  {
    for (int a = 0; a < 3; ++a)
    {
      if (round < depth[a])
      {
        shape.Direction = a;
        this->Levels.push_back(shape);
        --shape.Shift[a];
      }
    }
  }
  this->Levels.push_back({ shape.Shift, -1 });

  this->Children.assign(std::size_t(rootCells[0]) * rootCells[1] * rootCells[2], 0);
  for (std::int32_t k = 0; k <= rootCells[2]; ++k)
  {
    for (std::int32_t j = 0; j <= rootCells[1]; ++j)
    {
      for (std::int32_t i = 0; i <= rootCells[0]; ++i)
      {
        this->AddVertex({ i << depth[0], j << depth[1], k << depth[2] });
      }
    }
  }
}

//------------------------------------------------------------------------------
BisectionMesh::Node BisectionMesh::RootOf(const GridIndex& at) const
{
  const auto& shift = this->Levels[0].Shift;
  return ((at[2] >> shift[2]) * this->RootCells[1] + (at[1] >> shift[1])) * this->RootCells[0] +
         (at[0] >> shift[0]);
}

//------------------------------------------------------------------------------
BisectionMesh::Cell BisectionMesh::Find(const GridIndex& at, Node nodes) const
{
  Cell cell{ this->RootOf(at), 0 };
  while (!this->IsCell(cell.Id, nodes))
  {
    cell = this->ChildAt(cell, at);
  }
  return cell;
}

//------------------------------------------------------------------------------
BisectionMesh::Cell BisectionMesh::MarkPath(const GridIndex& at, std::vector<char>& wanted) const
{
  const Node nodes = static_cast<Node>(wanted.size());
  Cell node{ this->RootOf(at), 0 };
  wanted[node.Id] = true;
  while (!this->IsCell(node.Id, nodes))
  {
    node = this->ChildAt(node, at);
    wanted[node.Id] = true;
  }
  return node;
}

//------------------------------------------------------------------------------
IndexBox BisectionMesh::Box(const GridIndex& at, int level) const
{
  IndexBox box;
  for (int a = 0; a < 3; ++a)
  {
    const int shift = this->Levels[level].Shift[a];
    box.Low[a] = (at[a] >> shift) << shift;
    box.High[a] = box.Low[a] + (1 << shift);
  }
  return box;
}

//------------------------------------------------------------------------------
// Which cells of the level above must not be cells any more before one of this level is halved; in
// units of that level. (Cells larger than these cannot be in reach: the closure of the parent's
// bisection, whose reach contains this one, has halved them.)
IndexBox BisectionMesh::Neighbours(const GridIndex& at, int level) const
{
  const LevelShape& shape = this->Levels[level];
  const IndexBox cell = this->Box(at, level);
  IndexBox result;
  for (int a = 0; a < 3; ++a)
  {
    // Midpoints and reach, all doubled to stay in integers.
    const std::int32_t width = 1 << shape.Shift[a];
    const std::int32_t middle = cell.Low[a] + cell.High[a];
    const std::int32_t other = 1 << this->Levels[level - 1].Shift[a];
    const bool narrow = this->Rule == Closure::Narrow;
    const std::int32_t reach = width * (narrow ? (a == shape.Direction ? 3 : 5) : 9);
    // A cell of the level above counts if its midpoint, or else any part of it, is in reach.
    const std::int32_t lowest = middle - reach - other * (narrow ? 1 : 2);
    const std::int32_t highest = middle + reach - other * (narrow ? 1 : 0);
    result.Low[a] = std::max(CeilingOf(lowest, 2 * other), 0);
    result.High[a] = std::min(FloorOf(highest, 2 * other), this->Ends[a] / other - 1) + 1;
  }
  return result;
}

//------------------------------------------------------------------------------
bool BisectionMesh::Bisect(const GridIndex& at)
{
  const int level = this->Find(at).Level;
  if (this->Levels[level].Direction < 0)
  {
    return false;
  }
  if (level > 0)
  {
    const auto& shift = this->Levels[level - 1].Shift;
    const IndexBox near = this->Neighbours(at, level);
    for (std::int32_t k = near.Low[2]; k < near.High[2]; ++k)
    {
      for (std::int32_t j = near.Low[1]; j < near.High[1]; ++j)
      {
        for (std::int32_t i = near.Low[0]; i < near.High[0]; ++i)
        {
          const GridIndex other{ i << shift[0], j << shift[1], k << shift[2] };
          if (this->Find(other).Level < level)
          {
            this->Bisect(other);
          }
        }
      }
    }
  }
  this->Halve(at, this->Find(at));
  return true;
}

//------------------------------------------------------------------------------
void BisectionMesh::Halve(const GridIndex& at, const Cell& cell)
{
  this->Children[cell.Id] = this->CountNodes();
  this->Children.insert(this->Children.end(), 2, 0);
  for (const GridIndex& vertex : this->NewVertices(at, cell.Level))
  {
    this->AddVertex(vertex);
  }
}

//------------------------------------------------------------------------------
// The corners of the face between the halves of the cell of this level that holds `at`.
std::array<GridIndex, 4> BisectionMesh::NewVertices(const GridIndex& at, int level) const
{
  const int a = this->Levels[level].Direction, b = (a + 1) % 3, c = (a + 2) % 3;
  const IndexBox box = this->Box(at, level);
  std::array<GridIndex, 4> vertices;
  for (int i = 0; i < 4; ++i)
  {
    vertices[i][a] = (box.Low[a] + box.High[a]) / 2;
    vertices[i][b] = i % 2 == 0 ? box.Low[b] : box.High[b];
    vertices[i][c] = i / 2 == 0 ? box.Low[c] : box.High[c];
  }
  return vertices;
}

//------------------------------------------------------------------------------
void BisectionMesh::VisitCells(
  const IndexBox& box, const std::vector<char>& wanted, const Visitor& visit) const
{
  const auto& shift = this->Levels[0].Shift;
  for (std::int32_t k = box.Low[2] >> shift[2]; k <= (box.High[2] - 1) >> shift[2]; ++k)
  {
    for (std::int32_t j = box.Low[1] >> shift[1]; j <= (box.High[1] - 1) >> shift[1]; ++j)
    {
      for (std::int32_t i = box.Low[0] >> shift[0]; i <= (box.High[0] - 1) >> shift[0]; ++i)
      {
        const GridIndex corner{ i << shift[0], j << shift[1], k << shift[2] };
        this->VisitBelow({ this->RootOf(corner), 0 }, corner, box, wanted, visit);
      }
    }
  }
}

//------------------------------------------------------------------------------
void BisectionMesh::VisitBelow(const Cell& node, const GridIndex& corner, const IndexBox& box,
  const std::vector<char>& wanted, const Visitor& visit) const
{
  if (!wanted[node.Id])
  {
    return;
  }
  if (this->IsCell(node.Id, static_cast<Node>(wanted.size())))
  {
    visit(node, corner);
    return;
  }
  const int a = this->Levels[node.Level].Direction;
  GridIndex upper = corner;
  upper[a] += 1 << this->Levels[node.Level + 1].Shift[a];
  if (box.Low[a] < upper[a])
  {
    this->VisitBelow(this->ChildAt(node, corner), corner, box, wanted, visit);
  }
  if (box.High[a] > upper[a])
  {
    this->VisitBelow(this->ChildAt(node, upper), upper, box, wanted, visit);
  }
}

//------------------------------------------------------------------------------
std::vector<IndexBox> BisectionMesh::Cells() const
{
  return this->Cells({ { 0, 0, 0 }, this->Ends });
}

//------------------------------------------------------------------------------
std::vector<IndexBox> BisectionMesh::Cells(const IndexBox& box) const
{
  std::vector<IndexBox> cells;
  this->VisitCells(box, std::vector<char>(this->Children.size(), true),
    [this, &cells](const Cell& cell, const GridIndex& corner)
    { cells.push_back(this->Box(corner, cell.Level)); });
  return cells;
}

//------------------------------------------------------------------------------
// A number for a vertex of the grid with one further layer (index -1 and Ends + 1) around it.
Index BisectionMesh::AnchorOf(const GridIndex& layer) const
{
  return ((Index(layer[2]) + 1) * (this->Ends[1] + 3) + layer[1] + 1) * (this->Ends[0] + 3) +
         layer[0] + 1;
}

//------------------------------------------------------------------------------
void BisectionMesh::AddVertex(const GridIndex& vertex)
{
  GridIndex low = vertex, high = vertex;
  for (int a = 0; a < 3; ++a)
  {
    low[a] -= vertex[a] == 0 ? 1 : 0;
    high[a] += vertex[a] == this->Ends[a] ? 1 : 0;
  }
  GridIndex layer;
  for (layer[2] = low[2]; layer[2] <= high[2]; ++layer[2])
  {
    for (layer[1] = low[1]; layer[1] <= high[1]; ++layer[1])
    {
      for (layer[0] = low[0]; layer[0] <= high[0]; ++layer[0])
      {
        this->Anchors.insert(this->AnchorOf(layer));
      }
    }
  }
}

//------------------------------------------------------------------------------
std::vector<Index> BisectionMesh::SortedAnchors() const
{
  std::vector<Index> anchors(this->Anchors.begin(), this->Anchors.end());
  std::sort(anchors.begin(), anchors.end());
  return anchors;
}

//------------------------------------------------------------------------------
// The next two knots of a line through a vertex: where the first of the (up to four) cells along
// the line ends. The domain's end repeats.
std::array<std::int32_t, 2> BisectionMesh::NextKnots(
  const GridIndex& vertex, int direction, bool up) const
{
  const int b = (direction + 1) % 3, c = (direction + 2) % 3;
  const std::int32_t end = up ? this->Ends[direction] : 0;
  std::array<std::int32_t, 2> knots{ end, end };
  std::int32_t knot = vertex[direction];
  for (int step = 0; step < 2 && knot != end; ++step)
  {
    std::int32_t next = end;
    GridIndex at;
    at[direction] = up ? knot : knot - 1;
    for (at[b] = std::max(vertex[b] - 1, 0); at[b] <= std::min(vertex[b], this->Ends[b] - 1);
         ++at[b])
    {
      for (at[c] = std::max(vertex[c] - 1, 0); at[c] <= std::min(vertex[c], this->Ends[c] - 1);
           ++at[c])
      {
        const int shift = this->Levels[this->Find(at).Level].Shift[direction];
        const std::int32_t low = (at[direction] >> shift) << shift;
        next = up ? std::min(next, low + (1 << shift)) : std::max(next, low);
      }
    }
    knots[step] = knot = next;
  }
  return knots;
}

//------------------------------------------------------------------------------
BlendingFunction BisectionMesh::FunctionAt(Index anchor) const
{
  const Index row = anchor / (this->Ends[0] + 3);
  const GridIndex layer{ static_cast<std::int32_t>(anchor % (this->Ends[0] + 3)) - 1,
    static_cast<std::int32_t>(row % (this->Ends[1] + 3)) - 1,
    static_cast<std::int32_t>(row / (this->Ends[1] + 3)) - 1 };
  GridIndex vertex;
  for (int a = 0; a < 3; ++a)
  {
    vertex[a] = std::clamp(layer[a], 0, this->Ends[a]);
  }
  BlendingFunction function;
  for (int a = 0; a < 3; ++a)
  {
    const auto below = this->NextKnots(vertex, a, false);
    const auto above = this->NextKnots(vertex, a, true);
    // The outer layers are one knot of the repeated end further out.
    if (layer[a] < vertex[a])
    {
      function[a] = { 0, 0, 0, 0, above[0] };
    }
    else if (layer[a] > vertex[a])
    {
      function[a] = { below[0], vertex[a], vertex[a], vertex[a], vertex[a] };
    }
    else
    {
      function[a] = { below[1], below[0], vertex[a], above[0], above[1] };
    }
  }
  return function;
}

//------------------------------------------------------------------------------
std::vector<BlendingFunction> BisectionMesh::Functions() const
{
  std::vector<BlendingFunction> functions;
  for (const Index anchor : this->SortedAnchors())
  {
    functions.push_back(this->FunctionAt(anchor));
  }
  return functions;
}
}
