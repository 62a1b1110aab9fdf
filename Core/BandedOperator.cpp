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
// out[r] = sum_c coefficients[c] * in[first + c] for whole lines of `inner` numbers.
void CombineLines(const BandedOperator& op, Index r, Index inner, const double* in, double* out)
{
  const double* coefficients = &op.Coefficients[r * op.Width];
  const double* line = in + op.First[r] * inner;
  std::fill_n(out, inner, 0.0);
  int c = 0;
  for (; c + 4 <= op.Width; c += 4, line += 4 * inner)
  {
    const double a0 = coefficients[c], a1 = coefficients[c + 1], a2 = coefficients[c + 2],
                 a3 = coefficients[c + 3];
    const double *x0 = line, *x1 = x0 + inner, *x2 = x1 + inner, *x3 = x2 + inner;
    for (Index i = 0; i < inner; ++i)
    {
      out[i] += (a0 * x0[i] + a1 * x1[i]) + (a2 * x2[i] + a3 * x3[i]);
    }
  }
  for (; c < op.Width; ++c, line += inner)
  {
    const double a = coefficients[c];
    if (a != 0.0)
    {
      for (Index i = 0; i < inner; ++i)
      {
        out[i] += a * line[i];
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
Array3 Apply(const BandedOperator& op, int a, const Array3& in, const Execution& execution)
{
  std::array<Index, 3> size = in.Size;
  size[a] = op.Rows;
  Array3 out(size);
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
