// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "StencilMatrix.h"

#include "TargetClones.h"

#include <algorithm>
#include <tuple>

namespace trivariate
{
namespace
{
// Nodes of a common run that are worked on at once.
constexpr Index Piece = 256;

// The nine lines around a node, at dy + 1 + 3 (dz + 1).
template <typename Real>
using Lines = std::array<const Real*, 9>;

template <typename Real>
Lines<Real> LinesAround(const StencilMatrix& a, const Real* x, Index line)
{
  Lines<Real> lines;
  for (Index dz = -1; dz <= 1; ++dz)
  {
    for (Index dy = -1; dy <= 1; ++dy)
    {
      lines[dy + 1 + 3 * (dz + 1)] = x + a.Size[0] * (line + dy + a.Size[1] * dz);
    }
  }
  return lines;
}

// The product of n common rows from node `begin` of a line, with or without the line itself.
template <typename Real>
TRIVARIATE_INLINE void CommonSums(const std::array<double, 8>& common, const Lines<Real>& lines,
  Index begin, Index n, bool own, Real* sums)
{
  Real weights[8];
  std::copy(common.begin(), common.end(), weights);
  if (!own)
  {
    weights[0] = weights[1] = Real(0);
  }
  Real sides[Piece + 2];
  for (Index m = 0; m < n + 2; ++m)
  {
    const Index i = begin + m - 1;
    const Real y = lines[3][i] + lines[5][i], z = lines[1][i] + lines[7][i];
    const Real yz = lines[0][i] + lines[2][i] + lines[6][i] + lines[8][i];
    sides[m] = weights[1] * lines[4][i] + weights[3] * y + weights[5] * z + weights[7] * yz;
  }
  for (Index m = 0; m < n; ++m)
  {
    const Index i = begin + m;
    const Real y = lines[3][i] + lines[5][i], z = lines[1][i] + lines[7][i];
    const Real yz = lines[0][i] + lines[2][i] + lines[6][i] + lines[8][i];
    sums[m] = weights[0] * lines[4][i] + weights[2] * y + weights[4] * z + weights[6] * yz +
              sides[m] + sides[m + 2];
  }
}

TRIVARIATE_CLONES void SumCommon(const std::array<double, 8>& common, const Lines<float>& lines,
  Index begin, Index n, bool own, float* sums)
{
  CommonSums(common, lines, begin, n, own, sums);
}

TRIVARIATE_CLONES void SumCommon(const std::array<double, 8>& common, const Lines<double>& lines,
  Index begin, Index n, bool own, double* sums)
{
  CommonSums(common, lines, begin, n, own, sums);
}

template <typename Real>
double RowTimes(const StencilRow& row, const Lines<Real>& lines, Index i)
{
  double sum = 0.0;
  for (int l = 0; l < 9; ++l)
  {
    const Real* x = lines[l] + i;
    sum += row[3 * l] * x[-1] + row[3 * l + 1] * x[0] + row[3 * l + 2] * x[1];
  }
  return sum;
}

// Calls store(node of the line, product) for the unknowns of a line.
template <typename Real, typename Store>
void LineTimes(const StencilMatrix& a, const Real* x, Index line, const Store& store)
{
  const Lines<Real> lines = LinesAround(a, x, line);
  for (Index r = a.LineBegin[line]; r < a.LineBegin[line + 1]; ++r)
  {
    const StencilMatrix::Run& run = a.Runs[r];
    if (run.Row != CommonRow)
    {
      for (Index i = run.Begin; i < run.End; ++i)
      {
        store(i, static_cast<Real>(RowTimes(a.Rows[run.Row + i - run.Begin], lines, i)));
      }
      continue;
    }
    for (Index begin = run.Begin; begin < run.End; begin += Piece)
    {
      Real sums[Piece];
      const Index n = std::min<Index>(Piece, run.End - begin);
      SumCommon(a.Common, lines, begin, n, true, sums);
      for (Index m = 0; m < n; ++m)
      {
        store(begin + m, sums[m]);
      }
    }
  }
}

template <typename Real>
void RelaxLine(const StencilMatrix& a, const Real* b, Real* x, Index line, bool forward)
{
  const Lines<Real> lines = LinesAround<Real>(a, x, line);
  b += a.Size[0] * line;
  x += a.Size[0] * line;
  const Real diagonal = static_cast<Real>(1.0 / a.Common[0]);
  const Real aside = static_cast<Real>(a.Common[1] / a.Common[0]);
  const Index first = a.LineBegin[line], runs = a.LineBegin[line + 1] - first;
  for (Index r = 0; r < runs; ++r)
  {
    const StencilMatrix::Run& run = a.Runs[first + (forward ? r : runs - 1 - r)];
    const Index length = run.End - run.Begin;
    if (run.Row != CommonRow)
    {
      for (Index m = 0; m < length; ++m)
      {
        const Index at = forward ? m : length - 1 - m, i = run.Begin + at;
        const StencilRow& row = a.Rows[run.Row + at];
        x[i] += static_cast<Real>((b[i] - RowTimes(row, lines, i)) / row[13]);
      }
      continue;
    }
    for (Index done = 0; done < length; done += Piece)
    {
      Real sums[Piece];
      const Index n = std::min(Piece, length - done);
      const Index begin = forward ? run.Begin + done : run.End - done - n;
      SumCommon(a.Common, lines, begin, n, false, sums);
      for (Index m = 0; m < n; ++m)
      {
        sums[m] = diagonal * (b[begin + m] - sums[m]);
      }
      for (Index m = 0; m < n; ++m)
      {
        const Index at = forward ? m : n - 1 - m, i = begin + at;
        x[i] = sums[at] - aside * (x[i - 1] + x[i + 1]);
      }
    }
  }
}

// One color after the other: no two lines of a color are neighbours. Both colors of a slab in one
// go, since a slab is not beside another one of the same parity.
template <typename Real>
void RelaxLines(
  const StencilMatrix& a, const Real* b, Real* x, bool forward, const Execution& execution)
{
  for (int step = 0; step < 2; ++step)
  {
    const int parity = forward ? step : 1 - step;
    ForEachSlab(
      a.Size, (a.Size[2] - parity + 1) / 2, execution,
      [&](Index slab)
      {
        const Index k = 2 * slab + parity;
        for (const Index first : { forward ? 0 : 1, forward ? 1 : 0 })
        {
          for (Index j = first; j < a.Size[1]; j += 2)
          {
            RelaxLine(a, b, x, j + a.Size[1] * k, forward);
          }
        }
      },
      QuickNodes);
  }
}

template <typename Real>
void RelaxPlanes(const StencilMatrix& a, const Real* b, Real* x)
{
  std::vector<double> rest(b + a.Nodes(), b + a.Length());
  for (const StencilMatrix::Link& link : a.Links)
  {
    rest[link.Plane] -= link.Value * x[link.Node];
  }
  for (Index p = 0; p < a.Planes(); ++p)
  {
    x[a.Nodes() + p] = static_cast<Real>(rest[p] / a.PlaneDiagonal[p]);
  }
}

// y -= the planes' columns times x.
template <typename Real>
void SubtractLinks(const StencilMatrix& a, const Real* x, Real* y)
{
  for (const StencilMatrix::Link& link : a.Links)
  {
    y[link.Node] -= static_cast<Real>(link.Value * x[a.Nodes() + link.Plane]);
  }
}
}

//------------------------------------------------------------------------------
void ForEachSlab(const std::array<Index, 3>& size, Index count, const Execution& execution,
  const std::function<void(Index)>& body, Index atOnce)
{
  const bool small = size[0] * size[1] * size[2] < atOnce / 128;
  const auto range = [&body](Index begin, Index end)
  {
    for (Index k = begin; k < end; ++k)
    {
      body(k);
    }
  };
  if (small)
  {
    range(0, count);
    return;
  }
  const Index batch = std::max<Index>(2, atOnce / (size[0] * size[1]));
  for (Index first = 0; first < count; first += batch)
  {
    execution.Check(static_cast<double>(first) / static_cast<double>(count));
    execution.ParallelFor(std::min(batch, count - first),
      [&range, first](Index begin, Index end) { range(first + begin, first + end); });
  }
}

//------------------------------------------------------------------------------
void StencilMatrix::SetRows(const std::vector<std::int32_t>& rowOf)
{
  this->LineBegin.assign(1, 0);
  this->Runs.clear();
  std::size_t rows = 0;
  for (Index line = 0; line < this->Size[1] * this->Size[2]; ++line)
  {
    const std::int32_t* row = rowOf.data() + this->Size[0] * line;
    for (Index i = 0; i < this->Size[0]; ++i)
    {
      if (row[i] == NoUnknown)
      {
        continue;
      }
      const bool common = row[i] == CommonRow;
      rows += common ? 0 : 1;
      const bool goesOn = i > 0 && row[i - 1] != NoUnknown && (row[i - 1] == CommonRow) == common;
      if (!goesOn)
      {
        this->Runs.push_back({ static_cast<std::int32_t>(i), 0, row[i] });
      }
      this->Runs.back().End = static_cast<std::int32_t>(i + 1);
    }
    this->LineBegin.push_back(static_cast<Index>(this->Runs.size()));
  }
  this->Rows.assign(rows, StencilRow{});
}

//------------------------------------------------------------------------------
std::vector<std::int32_t> StencilMatrix::RowOfNodes() const
{
  std::vector<std::int32_t> rowOf(this->Nodes(), NoUnknown);
  for (Index line = 0; line + 1 < static_cast<Index>(this->LineBegin.size()); ++line)
  {
    for (Index r = this->LineBegin[line]; r < this->LineBegin[line + 1]; ++r)
    {
      const Run& run = this->Runs[r];
      for (Index i = run.Begin; i < run.End; ++i)
      {
        rowOf[i + this->Size[0] * line] =
          run.Row == CommonRow ? CommonRow : static_cast<std::int32_t>(run.Row + i - run.Begin);
      }
    }
  }
  return rowOf;
}

//------------------------------------------------------------------------------
void StencilMatrix::SetLinks(std::vector<Link> links)
{
  const auto pairOf = [](const Link& link) { return std::tie(link.Node, link.Plane); };
  std::stable_sort(links.begin(), links.end(),
    [&pairOf](const Link& a, const Link& b) { return pairOf(a) < pairOf(b); });
  this->Links.clear();
  for (const Link& link : links)
  {
    if (!this->Links.empty() && pairOf(this->Links.back()) == pairOf(link))
    {
      this->Links.back().Value += link.Value;
    }
    else
    {
      this->Links.push_back(link);
    }
  }
}

//------------------------------------------------------------------------------
StencilRow StencilMatrix::CommonStencil() const
{
  StencilRow row;
  for (int d = 0; d < 27; ++d)
  {
    row[d] = this->Common[(d % 3 != 1) + 2 * (d / 3 % 3 != 1) + 4 * (d / 9 != 1)];
  }
  return row;
}

//------------------------------------------------------------------------------
template <typename Real>
void Multiply(const StencilMatrix& a, const Real* x, Real* y, const Execution& execution)
{
  ForEachSlab(
    a.Size, a.Size[2], execution,
    [&](Index k)
    {
      for (Index line = a.Size[1] * k; line < a.Size[1] * (k + 1); ++line)
      {
        Real* to = y + a.Size[0] * line;
        LineTimes(a, x, line, [to](Index i, Real product) { to[i] = product; });
      }
    },
    QuickNodes);
  std::vector<double> planes(a.Planes());
  for (Index p = 0; p < a.Planes(); ++p)
  {
    planes[p] = a.PlaneDiagonal[p] * x[a.Nodes() + p];
  }
  for (const StencilMatrix::Link& link : a.Links)
  {
    y[link.Node] += static_cast<Real>(link.Value * x[a.Nodes() + link.Plane]);
    planes[link.Plane] += link.Value * x[link.Node];
  }
  std::copy(planes.begin(), planes.end(), y + a.Nodes());
}

//------------------------------------------------------------------------------
template <typename Real>
void Residual(
  const StencilMatrix& a, const Real* b, const Real* x, Real* r, const Execution& execution)
{
  ForEachSlab(
    a.Size, a.Size[2], execution,
    [&](Index k)
    {
      for (Index line = a.Size[1] * k; line < a.Size[1] * (k + 1); ++line)
      {
        const Real* from = b + a.Size[0] * line;
        Real* to = r + a.Size[0] * line;
        LineTimes(a, x, line, [from, to](Index i, Real product) { to[i] = from[i] - product; });
      }
    },
    QuickNodes);
  SubtractLinks(a, x, r);
  std::vector<double> planes(a.Planes());
  for (Index p = 0; p < a.Planes(); ++p)
  {
    planes[p] = b[a.Nodes() + p] - a.PlaneDiagonal[p] * x[a.Nodes() + p];
  }
  for (const StencilMatrix::Link& link : a.Links)
  {
    planes[link.Plane] -= link.Value * x[link.Node];
  }
  std::copy(planes.begin(), planes.end(), r + a.Nodes());
}

//------------------------------------------------------------------------------
template <typename Real>
void RelaxForward(const StencilMatrix& a, const Real* b, Real* x, const Execution& execution)
{
  RelaxLines(a, b, x, true, execution);
  RelaxPlanes(a, b, x);
}

//------------------------------------------------------------------------------
template <typename Real>
void RelaxBackward(const StencilMatrix& a, Real* b, Real* x, const Execution& execution)
{
  RelaxPlanes(a, b, x);
  SubtractLinks(a, x, b);
  RelaxLines<Real>(a, b, x, false, execution);
}

template void Multiply(const StencilMatrix&, const double*, double*, const Execution&);
template void Residual(const StencilMatrix&, const float*, const float*, float*, const Execution&);
template void RelaxForward(const StencilMatrix&, const float*, float*, const Execution&);
template void RelaxBackward(const StencilMatrix&, float*, float*, const Execution&);
}
