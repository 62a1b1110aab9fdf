// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "BoxPartition.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <tuple>

namespace trivariate
{
namespace
{
// The knots of one direction that any function uses, numbered anew without gaps.
struct UsedKnots
{
  std::vector<std::int32_t> Knots;     // old numbers, ascending
  std::vector<std::int32_t> NewNumber; // of each old number that is used

  UsedKnots(const TSpline& spline, int a)
    : NewNumber(spline.KnotLines[a].size(), 0)
  {
    for (const BlendingFunction& f : spline.Functions)
    {
      for (const std::int32_t k : f[a])
      {
        this->NewNumber[k] = 1;
      }
    }
    for (const IndexBox& hole : spline.Holes)
    {
      this->NewNumber[hole.Low[a]] = this->NewNumber[hole.High[a]] = 1;
    }
    for (std::size_t k = 0; k < this->NewNumber.size(); ++k)
    {
      if (this->NewNumber[k])
      {
        this->NewNumber[k] = static_cast<std::int32_t>(this->Knots.size());
        this->Knots.push_back(static_cast<std::int32_t>(k));
      }
    }
  }

  Index Intervals() const { return static_cast<Index>(this->Knots.size()) - 1; }
};

// What is known of a unit square of the layer.
enum Mark : std::uint8_t
{
  FaceAtColumn = 1, // at its low side in the column direction
  FaceAtRow = 2,    // at its low side in the row direction
  FaceBelow = 4,
  Covered = 8, // by a support, and not yet by a rectangle of this layer
  Hole = 16,
};

// How many of a changing set of rectangles cover each unit square of the layer, as the mixed second
// difference of that count: a rectangle costs four updates however large it is.
class RectangleCount
{
public:
  RectangleCount(Index columns, Index rows)
    : Columns(columns)
    , Rows(rows)
    , Differences((columns + 1) * (rows + 1), 0)
  {
  }

  void Add(Index column0, Index column1, Index row0, Index row1, std::int32_t count)
  {
    this->At(column0, row0) += count;
    this->At(column1, row0) -= count;
    this->At(column0, row1) -= count;
    this->At(column1, row1) += count;
  }

  // Sets `mark` on every covered square.
  void MarkCovered(Mark mark, std::vector<std::uint8_t>& marks) const
  {
    std::vector<std::int32_t> sums(this->Columns, 0);
    for (Index row = 0; row < this->Rows; ++row)
    {
      const std::int32_t* differences = &this->Differences[row * (this->Columns + 1)];
      std::uint8_t* squares = &marks[row * this->Columns];
      std::int32_t count = 0;
      for (Index column = 0; column < this->Columns; ++column)
      {
        sums[column] += differences[column];
        count += sums[column];
        squares[column] |= count ? mark : 0;
      }
    }
  }

  void Clear() { std::fill(this->Differences.begin(), this->Differences.end(), 0); }

private:
  std::int32_t& At(Index column, Index row)
  {
    return this->Differences[row * (this->Columns + 1) + column];
  }

  Index Columns, Rows;
  std::vector<std::int32_t> Differences;
};

class Sweep
{
public:
  Sweep(const TSpline& spline, const std::array<UsedKnots, 3>& used)
    : Spline(spline)
    , Used(used)
    , Up(LongestDirection(used))
    , Column(this->Up == 0 ? 1 : 0)
    , Row(this->Up == 2 ? 1 : 2)
    , Columns(used[this->Column].Intervals())
    , Rows(used[this->Row].Intervals())
    , MaximumBoxes(BezierMesh::MaximumCells(spline.Size()))
    , ColumnFaces(this->Columns, this->Rows)
    , RowFaces(this->Columns, this->Rows)
    , FacesBelow(this->Columns, this->Rows)
    , Supports(this->Columns, this->Rows)
    , Holes(this->Columns, this->Rows)
    , Marks(this->Columns * this->Rows)
    , Begun(this->Columns * this->Rows, -1)
  {
  }

  std::vector<IndexBox> Run(const Execution& execution)
  {
    const Index layers = this->Used[this->Up].Intervals();
    this->SortFunctionsByKnots(layers);
    for (Index layer = 0; layer < layers; ++layer)
    {
      execution.Check(static_cast<double>(layer) / layers);
      this->MarkLayer(layer);
      this->CutLayer(static_cast<std::int32_t>(layer));
    }
    for (IndexBox& box : this->Boxes)
    {
      for (int a = 0; a < 3; ++a)
      {
        box.Low[a] = this->Used[a].Knots[box.Low[a]];
        box.High[a] = this->Used[a].Knots[box.High[a]];
      }
    }
    return std::move(this->Boxes);
  }

private:
  static int LongestDirection(const std::array<UsedKnots, 3>& used)
  {
    int longest = 2;
    for (const int a : { 1, 0 })
    {
      longest = used[a].Intervals() > used[longest].Intervals() ? a : longest;
    }
    return longest;
  }

  std::int32_t KnotNumber(const BlendingFunction& f, int a, int k) const
  {
    return this->Used[a].NewNumber[f[a][k]];
  }

  // Each distinct knot of each function, by layer.
  void SortFunctionsByKnots(Index layers)
  {
    this->FunctionsWithKnot.resize(layers + 1);
    for (const BlendingFunction& f : this->Spline.Functions)
    {
      for (int k = 0; k < 5; ++k)
      {
        if (k == 0 || f[this->Up][k] != f[this->Up][k - 1])
        {
          this->FunctionsWithKnot[this->KnotNumber(f, this->Up, k)].push_back(&f);
        }
      }
    }
  }

  // Adds what the function's support and knots do to the layers that it spans, or takes it away.
  void AddFunction(const BlendingFunction& f, std::int32_t count)
  {
    const auto column0 = this->KnotNumber(f, this->Column, 0);
    const auto column4 = this->KnotNumber(f, this->Column, 4);
    const auto row0 = this->KnotNumber(f, this->Row, 0);
    const auto row4 = this->KnotNumber(f, this->Row, 4);
    this->Supports.Add(column0, column4, row0, row4, count);
    for (int k = 0; k < 5; ++k)
    {
      const auto column = this->KnotNumber(f, this->Column, k);
      const auto row = this->KnotNumber(f, this->Row, k);
      if (column < this->Columns)
      {
        this->ColumnFaces.Add(column, column + 1, row0, row4, count);
      }
      if (row < this->Rows)
      {
        this->RowFaces.Add(column0, column4, row, row + 1, count);
      }
    }
  }

  void MarkLayer(Index layer)
  {
    this->FacesBelow.Clear();
    for (const BlendingFunction* f : this->FunctionsWithKnot[layer])
    {
      this->FacesBelow.Add(this->KnotNumber(*f, this->Column, 0),
        this->KnotNumber(*f, this->Column, 4), this->KnotNumber(*f, this->Row, 0),
        this->KnotNumber(*f, this->Row, 4), 1);
      const bool begins = this->KnotNumber(*f, this->Up, 0) == layer;
      const bool ends = this->KnotNumber(*f, this->Up, 4) == layer;
      if (begins || ends)
      {
        this->AddFunction(*f, begins ? 1 : -1);
      }
    }
    for (const IndexBox& hole : this->Spline.Holes)
    {
      const auto knot = [this](const GridIndex& corner, int a)
      { return this->Used[a].NewNumber[corner[a]]; };
      const bool begins = knot(hole.Low, this->Up) == layer;
      if (begins || knot(hole.High, this->Up) == layer)
      {
        this->Holes.Add(knot(hole.Low, this->Column), knot(hole.High, this->Column),
          knot(hole.Low, this->Row), knot(hole.High, this->Row), begins ? 1 : -1);
      }
    }
    std::fill(this->Marks.begin(), this->Marks.end(), 0);
    this->ColumnFaces.MarkCovered(FaceAtColumn, this->Marks);
    this->RowFaces.MarkCovered(FaceAtRow, this->Marks);
    this->FacesBelow.MarkCovered(FaceBelow, this->Marks);
    this->Supports.MarkCovered(Covered, this->Marks);
    if (!this->Spline.Holes.empty())
    {
      this->Holes.MarkCovered(Hole, this->Marks);
      for (std::uint8_t& mark : this->Marks)
      {
        mark &= mark & Hole ? ~Covered : ~0;
      }
    }
  }

  // Whether the squares [column0, column1) of a row continue the rectangle above them.
  bool RowJoins(Index column0, Index column1, Index row) const
  {
    const std::uint8_t* squares = &this->Marks[row * this->Columns];
    if ((squares[column0] & (FaceAtRow | Covered)) != Covered)
    {
      return false;
    }
    for (Index column = column0 + 1; column < column1; ++column)
    {
      if ((squares[column] & (FaceAtRow | FaceAtColumn | Covered)) != Covered)
      {
        return false;
      }
    }
    return true;
  }

  // Cuts the layer into rectangles, greedily: as long, then as high as no face is in the way.
  void CutLayer(std::int32_t layer)
  {
    for (Index row = 0; row < this->Rows; ++row)
    {
      const std::uint8_t* squares = &this->Marks[row * this->Columns];
      for (Index column = 0; column < this->Columns;)
      {
        if (!(squares[column] & Covered))
        {
          ++column;
          continue;
        }
        Index column1 = column + 1;
        while (column1 < this->Columns && (squares[column1] & (FaceAtColumn | Covered)) == Covered)
        {
          ++column1;
        }
        Index row1 = row + 1;
        while (row1 < this->Rows && this->RowJoins(column, column1, row1))
        {
          ++row1;
        }
        this->AddRectangle(column, column1, row, row1, layer);
        column = column1;
      }
    }
  }

  // The rectangle begins a box, or makes the box below it higher.
  void AddRectangle(Index column0, Index column1, Index row0, Index row1, std::int32_t layer)
  {
    std::uint8_t all = 0;
    for (Index row = row0; row < row1; ++row)
    {
      std::uint8_t* squares = &this->Marks[row * this->Columns];
      for (Index column = column0; column < column1; ++column)
      {
        all |= squares[column];
        squares[column] &= ~Covered;
      }
    }
    std::int32_t& begun = this->Begun[row0 * this->Columns + column0];
    if (begun >= 0 && !(all & FaceBelow))
    {
      IndexBox& below = this->Boxes[begun];
      if (below.High[this->Up] == layer && below.High[this->Column] == column1 &&
          below.High[this->Row] == row1)
      {
        below.High[this->Up] = layer + 1;
        return;
      }
    }
    begun = static_cast<std::int32_t>(this->Boxes.size());
    if (begun >= this->MaximumBoxes)
    {
      throw std::length_error("The T-spline has more than " + std::to_string(this->MaximumBoxes) +
                              " Bezier cells; its knots do not come from a T-mesh.");
    }
    IndexBox box;
    box.Low[this->Up] = layer;
    box.High[this->Up] = layer + 1;
    box.Low[this->Column] = static_cast<std::int32_t>(column0);
    box.High[this->Column] = static_cast<std::int32_t>(column1);
    box.Low[this->Row] = static_cast<std::int32_t>(row0);
    box.High[this->Row] = static_cast<std::int32_t>(row1);
    this->Boxes.push_back(box);
  }

  const TSpline& Spline;
  const std::array<UsedKnots, 3>& Used;
  int Up, Column, Row; // directions
  Index Columns, Rows;
  Index MaximumBoxes;
  std::vector<std::vector<const BlendingFunction*>> FunctionsWithKnot;
  RectangleCount ColumnFaces, RowFaces, FacesBelow, Supports, Holes;
  std::vector<std::uint8_t> Marks;
  std::vector<std::int32_t> Begun; // the last box that began with its low corner in this square
  std::vector<IndexBox> Boxes;
};
}

//------------------------------------------------------------------------------
std::vector<IndexBox> PartitionIntoBoxes(const TSpline& spline, const Execution& execution)
{
  if (spline.Functions.empty())
  {
    return {};
  }
  const std::array<UsedKnots, 3> used = { UsedKnots(spline, 0), UsedKnots(spline, 1),
    UsedKnots(spline, 2) };
  const double grid =
    static_cast<double>(used[0].Intervals()) * used[1].Intervals() * used[2].Intervals();
  if (grid > static_cast<double>(BezierMesh::MaximumGrid))
  {
    throw std::length_error(
      "The T-spline's knots make an index grid of " + std::to_string(used[0].Intervals()) + " x " +
      std::to_string(used[1].Intervals()) + " x " + std::to_string(used[2].Intervals()) +
      " boxes; at most " + std::to_string(BezierMesh::MaximumGrid) + " can be handled.");
  }
  std::vector<IndexBox> boxes = Sweep(spline, used).Run(execution);
  std::sort(boxes.begin(), boxes.end(),
    [](const IndexBox& x, const IndexBox& y)
    {
      return std::tie(x.Low[2], x.High[2], x.Low[1], x.High[1], x.Low[0]) <
             std::tie(y.Low[2], y.High[2], y.Low[1], y.High[1], y.Low[0]);
    });
  return boxes;
}
}
