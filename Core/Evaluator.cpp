// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Evaluator.h"

#include "BezierExtraction.h"
#include "BezierKernels.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace trivariate
{
namespace
{
// Points whose coefficients are fetched before the first of them is evaluated.
constexpr Index BlockSize = 32;

void Prefetch(const double* data, Index count)
{
#if defined(__GNUC__)
  for (Index i = 0; i < count; i += 8)
  {
    __builtin_prefetch(data + i);
  }
#else
  (void)data;
  (void)count;
#endif
}

// A point and the cell that holds it: its coefficients, and the place in it.
struct LocatedPoint
{
  const double* Coefficients; // null outside
  double S[3];                // in [0, 1]
  double InverseWidth[3];
};

// A run of located points, their results to go to the places from First on.
struct Block
{
  std::array<LocatedPoint, BlockSize> Points;
  Index Size, First;
};

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
    const Index n = block.First + i;
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
void Evaluator::EvaluateRange(
  Index begin, Index end, const double* points, const EvaluatorOutput& output) const
{
  const auto& lines = this->Cells->KnotLines();
  Block block;
  for (block.First = begin; block.First < end; block.First += block.Size)
  {
    block.Size = std::min(BlockSize, end - block.First);
    for (Index i = 0; i < block.Size; ++i)
    {
      const double* x = points + 3 * (block.First + i);
      LocatedPoint& point = block.Points[i];
      const Index cell = this->Cells->FindCell(x[0], x[1], x[2]);
      if (cell < 0)
      {
        point.Coefficients = nullptr;
        continue;
      }
      point.Coefficients = this->Coefficients(cell);
      Prefetch(point.Coefficients, this->CellStride);
      const IndexBox& box = this->Cells->Box(cell);
      for (int a = 0; a < 3; ++a)
      {
        const double low = lines[a][box.Low[a]];
        point.InverseWidth[a] = 1.0 / (lines[a][box.High[a]] - low);
        point.S[a] = (x[a] - low) * point.InverseWidth[a];
      }
    }
    EvaluateBlock(block, this->ComponentCount, this->HasDenominator, output);
  }
}

//------------------------------------------------------------------------------
void Evaluator::Evaluate(
  Index n, const double* points, const EvaluatorOutput& output, const Execution& execution) const
{
  constexpr Index Batch = 1 << 20; // between two looks at the abort flag
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
