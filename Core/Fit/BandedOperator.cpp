// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "BandedOperator.h"

#include <algorithm>

namespace trivariate
{
//------------------------------------------------------------------------------
BandedOperator BandedOperator::FromRows(
  Index columns, const std::vector<std::pair<std::int32_t, std::vector<double>>>& rows)
{
  BandedOperator op;
  op.Rows = static_cast<Index>(rows.size());
  op.Columns = columns;
  for (const auto& row : rows)
  {
    op.Width = std::max(op.Width, static_cast<int>(row.second.size()));
  }
  op.Width = static_cast<int>(std::min<Index>(op.Width, columns));
  op.Coefficients.assign(op.Rows * op.Width, 0.0);
  for (Index r = 0; r < op.Rows; ++r)
  {
    // A band that would stick out is shifted; its unused numbers are zero.
    const auto first = static_cast<std::int32_t>(
      std::max<Index>(0, std::min<Index>(rows[r].first, columns - op.Width)));
    op.First.push_back(first);
    std::copy(rows[r].second.begin(), rows[r].second.end(),
      &op.Coefficients[r * op.Width] + (rows[r].first - first));
  }
  return op;
}

//------------------------------------------------------------------------------
BandedOperator BandedOperator::Transposed() const
{
  std::vector<std::pair<std::int32_t, std::vector<double>>> rows(this->Columns);
  for (Index r = 0; r < this->Rows; ++r)
  {
    for (int c = 0; c < this->Width; ++c)
    {
      const double value = this->Coefficients[r * this->Width + c];
      if (value != 0.0)
      {
        auto& row = rows[this->First[r] + c];
        if (row.second.empty())
        {
          row.first = static_cast<std::int32_t>(r);
        }
        row.second.resize(r - row.first + 1, 0.0);
        row.second.back() = value;
      }
    }
  }
  return FromRows(this->Rows, rows);
}

namespace
{
// y = (or +=) a0 x0 + a1 x1 + a2 x2 + a3 x3 for four consecutive lines x.
template <bool Accumulate>
void CombineFour(const double* a, const double* line, Index inner, Index n, double* y)
{
  const double a0 = a[0], a1 = a[1], a2 = a[2], a3 = a[3];
  const double *x0 = line, *x1 = x0 + inner, *x2 = x1 + inner, *x3 = x2 + inner;
  for (Index i = 0; i < n; ++i)
  {
    const double sum = (a0 * x0[i] + a1 * x1[i]) + (a2 * x2[i] + a3 * x3[i]);
    y[i] = Accumulate ? y[i] + sum : sum;
  }
}

// out[r] = sum_c coefficients[c] * in[first + c] for whole lines of `inner` numbers, in pieces that
// stay in the cache.
void CombineLines(const BandedOperator& op, Index r, Index inner, const double* in, double* out)
{
  constexpr Index piece = 1024;
  const double* coefficients = &op.Coefficients[r * op.Width];
  for (Index begin = 0; begin < inner; begin += piece)
  {
    const Index n = std::min(piece, inner - begin);
    const double* line = in + op.First[r] * inner + begin;
    double* y = out + begin;
    int c = 0;
    if (op.Width < 4)
    {
      std::fill_n(y, n, 0.0);
    }
    else
    {
      CombineFour<false>(coefficients, line, inner, n, y);
      line += 4 * inner;
      c = 4;
    }
    for (; c + 4 <= op.Width; c += 4, line += 4 * inner)
    {
      CombineFour<true>(coefficients + c, line, inner, n, y);
    }
    for (; c < op.Width; ++c, line += inner)
    {
      const double a = coefficients[c];
      for (Index i = 0; i < n; ++i)
      {
        y[i] += a * line[i];
      }
    }
  }
}

// The same along the fastest direction. The width is known at compile time where it is usual.
template <int FixedWidth>
void CombineNumbers(const BandedOperator& op, const double* in, double* out)
{
  const int width = FixedWidth ? FixedWidth : op.Width;
  const double* coefficients = op.Coefficients.data();
  for (Index r = 0; r < op.Rows; ++r, coefficients += width)
  {
    const double* x = in + op.First[r];
    double sum = 0.0;
    for (int c = 0; c < width; ++c)
    {
      sum += coefficients[c] * x[c];
    }
    out[r] = sum;
  }
}

void CombineRow(const BandedOperator& op, const double* in, double* out)
{
  switch (op.Width)
  {
    case 3:
      return CombineNumbers<3>(op, in, out);
    case 4:
      return CombineNumbers<4>(op, in, out);
    case 5:
      return CombineNumbers<5>(op, in, out);
    case 7:
      return CombineNumbers<7>(op, in, out);
    default:
      return CombineNumbers<0>(op, in, out);
  }
}
}

//------------------------------------------------------------------------------
Array3 Array3::Clone() const
{
  Array3 copy(this->Size, this->Pool);
  std::copy(this->Values.begin(), this->Values.end(), copy.Values.begin());
  return copy;
}

//------------------------------------------------------------------------------
Buffer ArrayPool::Take(Index n)
{
  // The smallest that is large enough, unless that would waste most of it.
  const auto wanted = static_cast<std::size_t>(n);
  auto best = this->Free.end();
  for (auto free = this->Free.begin(); free != this->Free.end(); ++free)
  {
    if (free->capacity() >= wanted && free->capacity() / 4 <= wanted &&
        (best == this->Free.end() || free->capacity() < best->capacity()))
    {
      best = free;
    }
  }
  Buffer buffer;
  if (best != this->Free.end())
  {
    buffer = std::move(*best);
    this->Free.erase(best);
  }
  buffer.resize(wanted);
  return buffer;
}

//------------------------------------------------------------------------------
void ArrayPool::Give(Buffer&& buffer)
{
  constexpr std::size_t mostKept = 8;
  if (buffer.capacity() == 0)
  {
    return;
  }
  this->Free.push_back(std::move(buffer));
  if (this->Free.size() > mostKept)
  {
    this->Free.erase(std::min_element(this->Free.begin(), this->Free.end(),
      [](const Buffer& x, const Buffer& y) { return x.capacity() < y.capacity(); }));
  }
}

//------------------------------------------------------------------------------
Array3 Apply(const BandedOperator& op, int a, const Array3& in, const Execution& execution)
{
  std::array<Index, 3> size = in.Size;
  size[a] = op.Rows;
  Array3 out(size, in.Pool);
  if (a == 0)
  {
    execution.ParallelFor(size[1] * size[2],
      [&op, &in, &out](Index begin, Index end)
      {
        for (Index line = begin; line < end; ++line)
        {
          CombineRow(op, &in.Values[line * in.Size[0]], &out.Values[line * out.Size[0]]);
        }
      });
    return out;
  }
  const Index inner = a == 1 ? size[0] : size[0] * size[1];
  const Index outer = a == 1 ? size[2] : 1;
  execution.ParallelFor(outer * op.Rows,
    [&op, &in, &out, inner](Index begin, Index end)
    {
      for (Index t = begin; t < end; ++t)
      {
        const Index o = t / op.Rows, r = t % op.Rows;
        CombineLines(op, r, inner, &in.Values[o * op.Columns * inner], &out.Values[t * inner]);
      }
    });
  return out;
}
}
