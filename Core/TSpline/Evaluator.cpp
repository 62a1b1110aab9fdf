// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Evaluator.h"

#include "BezierExtraction.h"
#include "BezierKernels.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace trivariate
{
namespace
{
// Points whose coefficients are fetched before the first of them is evaluated.
constexpr Index BlockSize = 32;

// Asks for `count` numbers from data[first] on before they are read, or written.
template <bool Write>
void Prefetch(const double* data, Index first, Index count)
{
#if defined(__GNUC__)
  for (Index i = 0; data && i < count + 7; i += 8) // of each cache line at least one
  {
    __builtin_prefetch(data + first + std::min(i, count - 1), Write);
  }
#else
  (void)data, (void)first, (void)count;
#endif
}

// A point and the cell that holds it: its coefficients, and the place in it.
struct LocatedPoint
{
  const double* Coefficients; // null outside
  double S[3];                // in [0, 1]
  double InverseWidth[3];
};

LocatedPoint Locate(const Evaluator& evaluator, const double* x)
{
  LocatedPoint point;
  const BezierMesh& mesh = evaluator.Mesh();
  const Index cell = mesh.FindCell(x[0], x[1], x[2]);
  if (cell < 0)
  {
    point.Coefficients = nullptr;
    return point;
  }
  point.Coefficients = evaluator.Coefficients(cell);
  Prefetch<false>(point.Coefficients, 0, 64 * (evaluator.Components() + evaluator.Rational()));
  const IndexBox& box = mesh.Box(cell);
  for (int a = 0; a < 3; ++a)
  {
    const KnotLine& line = mesh.KnotLines()[a];
    const double low = line[box.Low[a]];
    point.InverseWidth[a] = 1.0 / (line[box.High[a]] - low);
    point.S[a] = (x[a] - low) * point.InverseWidth[a];
  }
  return point;
}

// Some located points, and the places where their results go.
struct Block
{
  std::array<LocatedPoint, BlockSize> Points;
  std::array<Index, BlockSize> Places;
  Index Size;
};

// A point, and the place where its results go.
struct Request
{
  double X[3];
  Index Place;
};

// The points [begin, end), those near each other in space together: by the buckets of a coarse grid
// over the domain. Empty when neighbours in the list are near each other anyhow.
std::vector<Request> GroupInSpace(
  const std::array<KnotLine, 3>& lines, const double* points, Index begin, Index end)
{
  constexpr int Buckets = 8; // a direction
  std::array<double, 3> scale;
  for (int a = 0; a < 3; ++a)
  {
    scale[a] = Buckets / (lines[a].back() - lines[a].front());
  }
  std::vector<std::uint16_t> bucket(end - begin);
  std::vector<Index> next(Buckets * Buckets * Buckets + 1, 0);
  Index jumps = 0;
  int previous = 0;
  for (Index i = begin; i < end; ++i)
  {
    int b = 0;
    for (int a = 2; a >= 0; --a)
    {
      const double t = scale[a] * (points[3 * i + a] - lines[a].front());
      b = b * Buckets + (t > 0.0 ? static_cast<int>(std::min(t, Buckets - 1.0)) : 0);
    }
    bucket[i - begin] = static_cast<std::uint16_t>(b);
    ++next[b + 1];
    jumps += b != previous;
    previous = b;
  }
  if (jumps < (end - begin) / 8)
  {
    return {};
  }
  std::partial_sum(next.begin(), next.end(), next.begin());
  std::vector<Request> requests(end - begin);
  for (Index i = begin; i < end; ++i)
  {
    const double* x = points + 3 * i;
    requests[next[bucket[i - begin]]++] = { { x[0], x[1], x[2] }, i };
  }
  return requests;
}

template <int Order>
TRIVARIATE_INLINE void WriteJet(const double* jet, const EvaluatorOutput& out, Index place)
{
  if (out.Values)
  {
    out.Values[place] = jet[0];
  }
  if (Order > 0 && out.Gradients)
  {
    std::copy_n(jet + 1, 3, out.Gradients + 3 * place);
  }
  if (Order > 1 && out.Hessians)
  {
    std::copy_n(jet + 4, 6, out.Hessians + 6 * place);
  }
}

// The jets of all components at point n; false where they do not exist.
template <int Order>
TRIVARIATE_INLINE bool EvaluatePoint(
  const LocatedPoint& point, int components, bool rational, const EvaluatorOutput& out, Index n)
{
  if (!point.Coefficients)
  {
    return false;
  }
  const BernsteinJet<Order> u(point.S[0], point.InverseWidth[0]);
  const BernsteinJet<Order> v(point.S[1], point.InverseWidth[1]);
  const BernsteinJet<Order> w(point.S[2], point.InverseWidth[2]);
  double denominator[JetSize<Order>] = {};
  if (rational)
  {
    PolynomialJet<Order>(point.Coefficients + 64 * components, u, v, w, denominator);
    if (!(denominator[0] > 0.0))
    {
      return false; // the edge of the outermost support, where every function vanishes
    }
  }
  for (int c = 0; c < components; ++c)
  {
    double jet[JetSize<Order>];
    PolynomialJet<Order>(point.Coefficients + 64 * c, u, v, w, jet);
    if (rational)
    {
      QuotientJet<Order>(jet, denominator);
    }
    WriteJet<Order>(jet, out, n * components + c);
  }
  return true;
}

template <int Order>
TRIVARIATE_INLINE void EvaluateBlockOf(
  const Block& block, int components, bool rational, const EvaluatorOutput& out)
{
  for (Index i = 0; i < block.Size; ++i)
  {
    const Index n = block.Places[i];
    const bool inside = EvaluatePoint<Order>(block.Points[i], components, rational, out, n);
    if (!inside)
    {
      const double zero[10] = {};
      for (int c = 0; c < components; ++c)
      {
        WriteJet<Order>(zero, out, n * components + c);
      }
    }
    if (out.Inside)
    {
      out.Inside[n] = inside;
    }
  }
}

TRIVARIATE_CLONES
void EvaluateBlock(const Block& block, int components, bool rational, const EvaluatorOutput& out)
{
  if (out.Hessians)
  {
    EvaluateBlockOf<2>(block, components, rational, out);
  }
  else if (out.Gradients)
  {
    EvaluateBlockOf<1>(block, components, rational, out);
  }
  else
  {
    EvaluateBlockOf<0>(block, components, rational, out);
  }
}

// Whether coefficients of a denominator are one to the rounding of their sums.
bool AreOne(const double* coefficients)
{
  return std::all_of(
    coefficients, coefficients + 64, [](double d) { return std::abs(d - 1.0) <= 1e-13; });
}
}

//------------------------------------------------------------------------------
Evaluator::Evaluator(const TSpline& spline, const BezierMesh& mesh,
  const std::vector<int>& components, const Execution& execution)
  : Cells(&mesh)
  , ComponentCount(static_cast<int>(components.size()))
{
  if (components.empty() || std::count(components.begin(), components.end(), Denominator) > 0)
  {
    throw std::invalid_argument("No component of the T-spline was chosen for evaluation.");
  }
  std::vector<int> columns = components;
  columns.push_back(Denominator);
  const Index stride = 64 * static_cast<Index>(columns.size());
  this->CellStride = stride - 64;
  this->HasDenominator = false;
  this->Bezier.resize(mesh.Size() * this->CellStride);
  // The denominators are looked at and dropped, until one is found that is needed.
  constexpr Index Batch = 1 << 15;
  for (Index first = 0; first < mesh.Size() && !this->HasDenominator; first += Batch)
  {
    const Index last = std::min(first + Batch, mesh.Size());
    const auto bezier = ExtractBezier(spline, mesh, columns, first, last,
      execution.Part(1.0 * first / mesh.Size(), 1.0 * last / mesh.Size()));
    for (Index cell = first; cell < last && !this->HasDenominator; ++cell)
    {
      const double* coefficients = &bezier[(cell - first) * stride];
      this->HasDenominator = !AreOne(coefficients + this->CellStride);
      std::copy_n(coefficients, this->CellStride, &this->Bezier[cell * this->CellStride]);
    }
  }
  if (this->HasDenominator)
  {
    this->CellStride = stride;
    this->Bezier = std::vector<double>(); // free before the next is made
    this->Bezier = ExtractBezier(spline, mesh, columns, execution);
  }
}

//------------------------------------------------------------------------------
// Scattered points wait for their cells to come from memory. Where there are many of them for each
// cell, it pays to bring neighbours together; and their results' places are asked for early.
void Evaluator::EvaluateRange(
  Index begin, Index end, const double* points, const EvaluatorOutput& output) const
{
  constexpr Index Stretch = 1 << 20, Many = 1 << 16;
  for (Index first = begin; first < end; first += Stretch)
  {
    const Index last = std::min(first + Stretch, end);
    std::vector<Request> requests;
    if (last - first >= std::max(Many, 2 * this->Cells->Size()))
    {
      requests = GroupInSpace(this->Cells->KnotLines(), points, first, last);
    }
    Block block;
    for (Index done = first; done < last; done += block.Size)
    {
      block.Size = std::min(BlockSize, last - done);
      for (Index i = 0; i < block.Size; ++i)
      {
        Index& place = block.Places[i];
        place = done + i;
        const double* x = points + 3 * place;
        if (!requests.empty())
        {
          const Request& request = requests[done - first + i];
          x = request.X;
          place = request.Place;
          const Index c = this->ComponentCount;
          Prefetch<true>(output.Values, c * place, c);
          Prefetch<true>(output.Gradients, 3 * c * place, 3 * c);
          Prefetch<true>(output.Hessians, 6 * c * place, 6 * c);
        }
        block.Points[i] = Locate(*this, x);
      }
      EvaluateBlock(block, this->ComponentCount, this->HasDenominator, output);
    }
  }
}

//------------------------------------------------------------------------------
void Evaluator::Evaluate(
  Index n, const double* points, const EvaluatorOutput& output, const Execution& execution) const
{
  constexpr Index Batch = 1 << 22; // between two looks at the abort flag
  for (Index first = 0; first < n; first += Batch)
  {
    execution.Check(static_cast<double>(first) / n);
    execution.ParallelFor(std::min(Batch, n - first), [&](Index begin, Index end)
      { this->EvaluateRange(first + begin, first + end, points, output); });
  }
}

//------------------------------------------------------------------------------
bool Evaluator::Evaluate(const double point[3], const EvaluatorOutput& output) const
{
  std::uint8_t inside = 0;
  EvaluatorOutput withInside = output;
  withInside.Inside = output.Inside ? output.Inside : &inside;
  this->EvaluateRange(0, 1, point, withInside);
  return *withInside.Inside != 0;
}
}
