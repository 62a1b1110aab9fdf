// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Evaluation on a lattice, sum-factorised: the coefficients of a cell are contracted over w once
// for each plane of the lattice in the cell, over v once for each row, over u for each point.
#include "BezierKernels.h"
#include "Evaluator.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace trivariate
{
namespace
{
// Rows are computed this many points at a time.
constexpr Index Lanes = 8;

// The lattice's coordinates of one direction, by the knots between which they lie.
class LatticeAxis
{
public:
  LatticeAxis(const std::vector<double>& coordinates, const KnotLine& line)
    : X(coordinates)
    , Line(line)
  {
    if (!std::is_sorted(coordinates.begin(), coordinates.end()) ||
        std::any_of(coordinates.begin(), coordinates.end(), [](double x) { return std::isnan(x); }))
    {
      throw std::invalid_argument("The coordinates of a lattice must be numbers that ascend.");
    }
    for (const double knot : line)
    {
      this->Begin.push_back(
        std::lower_bound(coordinates.begin(), coordinates.end(), knot) - coordinates.begin());
    }
    // The last interval is closed.
    this->Begin.back() =
      std::upper_bound(coordinates.begin(), coordinates.end(), line.back()) - coordinates.begin();
  }

  Index Size() const { return static_cast<Index>(this->X.size()); }

  // Place of the first coordinate at or after a knot.
  Index First(std::int32_t knot) const { return this->Begin[knot]; }

  // The Bernstein polynomials of the interval between two knots at a coordinate.
  template <int Order>
  TRIVARIATE_INLINE BernsteinJet<Order> Bernstein(
    Index place, std::int32_t low, std::int32_t high) const
  {
    const double inverseWidth = 1.0 / (this->Line[high] - this->Line[low]);
    return { (this->X[place] - this->Line[low]) * inverseWidth, inverseWidth };
  }

private:
  const std::vector<double>& X;
  const KnotLine& Line;
  std::vector<Index> Begin;
};

// The points of the lattice in a cell, or some planes of them: [First, Last) in each direction.
struct LatticeBox
{
  Index Cell;
  std::array<Index, 3> First, Last;

  Index Points() const
  {
    return (this->Last[0] - this->First[0]) * (this->Last[1] - this->First[1]) *
           (this->Last[2] - this->First[2]);
  }
};

struct Lattice
{
  const Evaluator* Spline;
  std::array<LatticeAxis, 3> Axes;
  EvaluatorOutput Output;

  Index Place(Index i, Index j, Index k) const
  {
    return i + this->Axes[0].Size() * (j + this->Axes[1].Size() * k);
  }
};

// Jets of a component at Lanes points side by side.
template <int Order>
struct LaneJets
{
  double A[JetSize<Order>][Lanes];

  // out[lane] = sum over n of b[n][lane] a[n] for each derivative; `table` as in RowTable.
  TRIVARIATE_INLINE void Set(const double* table, const ContractedVW<Order>& row)
  {
    for (int m = 0; m < JetSize<Order>; ++m)
    {
      const auto& d = JetDerivatives[m];
      const double* b = table + 4 * d[0] * Lanes;
      const double* a = row.A[d[1]][d[2]];
      for (Index lane = 0; lane < Lanes; ++lane)
      {
        this->A[m][lane] = b[lane] * a[0] + b[Lanes + lane] * a[1] + b[2 * Lanes + lane] * a[2] +
                           b[3 * Lanes + lane] * a[3];
      }
    }
  }

  TRIVARIATE_INLINE void Divide(const LaneJets& denominator)
  {
    for (Index lane = 0; lane < Lanes; ++lane)
    {
      double n[JetSize<Order>], d[JetSize<Order>];
      for (int m = 0; m < JetSize<Order>; ++m)
      {
        n[m] = this->A[m][lane];
        d[m] = denominator.A[m][lane];
      }
      QuotientJet<Order>(n, d);
      for (int m = 0; m < JetSize<Order>; ++m)
      {
        this->A[m][lane] = d[0] > 0.0 ? n[m] : 0.0;
      }
    }
  }

  // Writes the first `count` lanes as component c of the points from `place` on.
  TRIVARIATE_INLINE void Write(
    const EvaluatorOutput& out, Index place, Index count, int c, int components) const
  {
    for (Index lane = 0; lane < count; ++lane)
    {
      const Index target = (place + lane) * components + c;
      if (out.Values)
      {
        out.Values[target] = this->A[0][lane];
      }
      for (int m = 0; m < 3 && Order > 0 && out.Gradients; ++m)
      {
        out.Gradients[3 * target + m] = this->A[1 + m][lane];
      }
      for (int m = 0; m < 6 && Order > 1 && out.Hessians; ++m)
      {
        out.Hessians[6 * target + m] = this->A[4 + m][lane];
      }
    }
  }
};

// Bernstein polynomials and derivatives at the points of a row, Lanes points side by side; behind
// the end of the row its last point is repeated.
template <int Order>
struct RowTable
{
  static constexpr Index BlockSize = (Order + 1) * 4 * Lanes;
  std::vector<double> B; // [block of lanes][derivative][polynomial][lane]

  TRIVARIATE_INLINE void Set(const LatticeAxis& axis, Index first, Index last, const IndexBox& cell)
  {
    const Index blocks = (last - first + Lanes - 1) / Lanes;
    this->B.resize(blocks * BlockSize);
    for (Index i = 0; i < blocks * Lanes; ++i)
    {
      const auto jet =
        axis.Bernstein<Order>(std::min(first + i, last - 1), cell.Low[0], cell.High[0]);
      double* lane = &this->B[i / Lanes * BlockSize + i % Lanes];
      for (int n = 0; n < 4 * (Order + 1); ++n)
      {
        lane[n * Lanes] = jet.B[n / 4][n % 4];
      }
    }
  }
};

template <int Order>
class BoxEvaluator
{
public:
  explicit BoxEvaluator(const Lattice& lattice)
    : Grid(lattice)
    , Components(lattice.Spline->Components())
    , Planes(this->Components + lattice.Spline->Rational())
    , Rows(this->Planes.size())
  {
  }

  TRIVARIATE_INLINE void Evaluate(const LatticeBox& box)
  {
    const IndexBox& cell = this->Grid.Spline->Mesh().Box(box.Cell);
    const double* coefficients = this->Grid.Spline->Coefficients(box.Cell);
    this->Table.Set(this->Grid.Axes[0], box.First[0], box.Last[0], cell);
    for (Index k = box.First[2]; k < box.Last[2]; ++k)
    {
      const auto w = this->Grid.Axes[2].template Bernstein<Order>(k, cell.Low[2], cell.High[2]);
      for (std::size_t c = 0; c < this->Planes.size(); ++c)
      {
        this->Planes[c].Set(coefficients + 64 * c, w);
      }
      for (Index j = box.First[1]; j < box.Last[1]; ++j)
      {
        const auto v = this->Grid.Axes[1].template Bernstein<Order>(j, cell.Low[1], cell.High[1]);
        for (std::size_t c = 0; c < this->Planes.size(); ++c)
        {
          this->Rows[c].Set(this->Planes[c], v);
        }
        this->EvaluateRow(box.Last[0] - box.First[0], this->Grid.Place(box.First[0], j, k));
      }
    }
  }

private:
  TRIVARIATE_INLINE void EvaluateRow(Index points, Index place)
  {
    const double* table = this->Table.B.data();
    for (Index i = 0; i < points; i += Lanes, table += RowTable<Order>::BlockSize)
    {
      const Index count = std::min(Lanes, points - i);
      LaneJets<Order> denominator{};
      const bool rational = this->Rows.size() > static_cast<std::size_t>(this->Components);
      if (rational)
      {
        denominator.Set(table, this->Rows.back());
      }
      for (int c = 0; c < this->Components; ++c)
      {
        LaneJets<Order> jets;
        jets.Set(table, this->Rows[c]);
        if (rational)
        {
          jets.Divide(denominator);
        }
        jets.Write(this->Grid.Output, place + i, count, c, this->Components);
      }
      if (this->Grid.Output.Inside)
      {
        for (Index lane = 0; lane < count; ++lane)
        {
          // A denominator of zero: the edge of the outermost support, where every function
          // vanishes.
          this->Grid.Output.Inside[place + i + lane] = !rational || denominator.A[0][lane] > 0.0;
        }
      }
    }
  }

  const Lattice& Grid;
  int Components;
  RowTable<Order> Table;
  std::vector<ContractedW<Order>> Planes; // of each component, and of the denominator
  std::vector<ContractedVW<Order>> Rows;
};

template <int Order>
TRIVARIATE_INLINE void EvaluateBoxesOf(
  const Lattice& lattice, const LatticeBox* begin, const LatticeBox* end)
{
  BoxEvaluator<Order> evaluator(lattice);
  for (const LatticeBox* box = begin; box != end; ++box)
  {
    evaluator.Evaluate(*box);
  }
}

TRIVARIATE_CLONES
void EvaluateBoxes(const Lattice& lattice, const LatticeBox* begin, const LatticeBox* end)
{
  if (lattice.Output.Hessians)
  {
    EvaluateBoxesOf<2>(lattice, begin, end);
  }
  else if (lattice.Output.Gradients)
  {
    EvaluateBoxesOf<1>(lattice, begin, end);
  }
  else
  {
    EvaluateBoxesOf<0>(lattice, begin, end);
  }
}

// The non-empty cells' boxes of points, large ones cut between planes so that threads share them.
std::vector<LatticeBox> CutIntoBoxes(const Lattice& lattice)
{
  constexpr Index Target = 1 << 14; // points
  std::vector<LatticeBox> boxes;
  const BezierMesh& mesh = lattice.Spline->Mesh();
  for (Index cell = 0; cell < mesh.Size(); ++cell)
  {
    LatticeBox box;
    box.Cell = cell;
    for (int a = 0; a < 3; ++a)
    {
      box.First[a] = lattice.Axes[a].First(mesh.Box(cell).Low[a]);
      box.Last[a] = lattice.Axes[a].First(mesh.Box(cell).High[a]);
    }
    if (box.Points() == 0)
    {
      continue;
    }
    const Index end = box.Last[2];
    const Index plane = box.Points() / (end - box.First[2]);
    const Index planes = std::max<Index>(1, Target / plane);
    for (; box.First[2] < end; box.First[2] = box.Last[2])
    {
      box.Last[2] = std::min(end, box.First[2] + planes);
      boxes.push_back(box);
    }
  }
  return boxes;
}

template <typename T>
void FillZero(T* data, Index count)
{
  if (data)
  {
    std::fill_n(data, count, T(0));
  }
}
}

//------------------------------------------------------------------------------
void Evaluator::EvaluateLattice(const std::array<std::vector<double>, 3>& coordinates,
  const EvaluatorOutput& output, const Execution& execution) const
{
  const auto& lines = this->Cells->KnotLines();
  const Lattice lattice{ this,
    { LatticeAxis(coordinates[0], lines[0]), LatticeAxis(coordinates[1], lines[1]),
      LatticeAxis(coordinates[2], lines[2]) },
    output };
  const std::vector<LatticeBox> boxes = CutIntoBoxes(lattice);
  const Index points = lattice.Place(0, 0, lattice.Axes[2].Size());
  Index inside = 0;
  for (const LatticeBox& box : boxes)
  {
    inside += box.Points();
  }
  if (inside < points)
  {
    FillZero(output.Values, points * this->ComponentCount);
    FillZero(output.Gradients, points * this->ComponentCount * 3);
    FillZero(output.Hessians, points * this->ComponentCount * 6);
    FillZero(output.Inside, points);
  }
  constexpr Index Batch = 1 << 22; // points between two looks at the abort flag
  Index done = 0;
  for (auto first = boxes.begin(); first != boxes.end();)
  {
    execution.Check(static_cast<double>(done) / inside);
    Index batch = 0;
    auto last = first;
    for (; last != boxes.end() && batch < Batch; ++last)
    {
      batch += last->Points();
    }
    execution.ParallelFor(last - first,
      [&](Index begin, Index end) { EvaluateBoxes(lattice, &first[begin], &first[0] + end); });
    done += batch;
    first = last;
  }
}
}
