// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "GramMatrix.h"

#include "TSpline/SupportTree.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace trivariate
{
namespace
{
// Functions that are summed, and relaxed, together in one order. The blocks are fixed, so no result
// depends on how the range is cut among threads.
constexpr Index BlockSize = 2048;

// The sum of term(begin, end) over the blocks of [0, n).
template <typename Term>
double SumOverBlocks(Index n, const Execution& execution, const Term& term)
{
  std::vector<double> partial((n + BlockSize - 1) / BlockSize, 0.0);
  execution.ParallelFor(static_cast<Index>(partial.size()),
    [&](Index begin, Index end)
    {
      for (Index block = begin; block < end; ++block)
      {
        partial[block] = term(block * BlockSize, std::min(n, (block + 1) * BlockSize));
      }
    });
  return std::accumulate(partial.begin(), partial.end(), 0.0);
}

// Products of all pairs of univariate functions of one direction over the samples.
std::vector<float> UnivariateGram(
  const std::vector<Univariate>& factors, const Execution& execution)
{
  const Index n = static_cast<Index>(factors.size());
  std::vector<float> gram(n * n);
  execution.ParallelFor(n,
    [&factors, &gram, n](Index begin, Index end)
    {
      for (Index i = begin; i < end; ++i)
      {
        for (Index j = 0; j < n; ++j)
        {
          const bool overlap =
            factors[i].Knots[0] < factors[j].Knots[4] && factors[j].Knots[0] < factors[i].Knots[4];
          gram[i * n + j] =
            overlap ? static_cast<float>(Dot(factors[i].Samples, factors[j].Samples)) : 0.0f;
        }
      }
    });
  return gram;
}
}

//------------------------------------------------------------------------------
GramMatrix::GramMatrix(const TSpline& spline, const FunctionTable& table, const VoxelMask& mask,
  const Execution& execution)
{
  const Index n = spline.Size();
  std::array<std::vector<float>, 3> gram;
  std::array<Index, 3> factors;
  for (int a = 0; a < 3; ++a)
  {
    gram[a] = UnivariateGram(table.AllFactors(a), execution);
    factors[a] = static_cast<Index>(table.AllFactors(a).size());
  }
  const auto separable = [&gram, &factors, &table](Index i, Index j)
  {
    return double(gram[0][table.Id(i, 0) * factors[0] + table.Id(j, 0)]) *
           gram[1][table.Id(i, 1) * factors[1] + table.Id(j, 1)] *
           gram[2][table.Id(i, 2) * factors[2] + table.Id(j, 2)];
  };
  // Without the pairs that the mask's border crosses, which are not separable.
  const auto entry = [&separable, &table, &mask](Index i, Index j) {
    return !mask.Values || PartThatCounts(mask, table, i, j) == Part::All ? separable(i, j) : 0.0;
  };

  this->Allocate(n);
  this->RowBegin.assign(n + 1, 0);
  const SupportTree tree(spline.Functions);
  const Index blocks = (n + BlockSize - 1) / BlockSize;
  std::vector<std::vector<std::int32_t>> columns(blocks);
  execution.ParallelFor(blocks,
    [&](Index firstBlock, Index endBlock)
    {
      for (Index block = firstBlock; block < endBlock; ++block)
      {
        const Index begin = block * BlockSize, end = std::min(n, begin + BlockSize);
        for (Index i = begin; i < end; ++i)
        {
          this->SetDiagonal(i, entry(i, i));
        }
        tree.QueryPairs(begin, end,
          [this, &columns, block](Index i, Index j)
          {
            columns[block].push_back(static_cast<std::int32_t>(j));
            ++this->RowBegin[i + 1];
          });
      }
    });
  std::partial_sum(this->RowBegin.begin(), this->RowBegin.end(), this->RowBegin.begin());
  this->SetCrossedDiagonal(table, mask, execution);
  execution.Check(0.0);

  this->Columns.resize(this->RowBegin[n]);
  this->Values.resize(this->RowBegin[n]);
  execution.ParallelFor(blocks,
    [&](Index firstBlock, Index endBlock)
    {
      for (Index block = firstBlock; block < endBlock; ++block)
      {
        const Index begin = block * BlockSize, end = std::min(n, begin + BlockSize);
        const auto all = this->Columns.begin();
        std::copy(columns[block].begin(), columns[block].end(), all + this->RowBegin[begin]);
        std::vector<std::int32_t>().swap(columns[block]);
        for (Index i = begin; i < end; ++i)
        {
          const auto row = all + this->RowBegin[i], rowEnd = all + this->RowBegin[i + 1];
          for (auto column = row; column != rowEnd; ++column)
          {
            this->Values[column - all] =
              static_cast<float>(entry(i, *column) * this->Scale[i] * this->Scale[*column]);
          }
          this->FindBlock(i, n);
        }
      }
    });
  execution.Check(0.0);
  this->SetCrossedEntries(table, mask, execution);
}

//------------------------------------------------------------------------------
GramMatrix::GramMatrix(std::vector<Index> rowBegin, std::vector<std::int32_t> columns,
  std::vector<float> entries, const Execution& execution)
  : RowBegin(std::move(rowBegin))
  , Columns(std::move(columns))
  , Values(std::move(entries))
{
  const Index n = static_cast<Index>(this->RowBegin.size()) - 1;
  this->Allocate(n);
  const auto all = this->Columns.begin();
  for (Index i = 0; i < n; ++i)
  {
    this->FindBlock(i, n);
    this->SetDiagonal(i, this->Values[this->DiagonalAt[i]]);
  }
  execution.ParallelFor(n,
    [this, all](Index begin, Index end)
    {
      for (Index i = begin; i < end; ++i)
      {
        for (Index at = this->RowBegin[i]; at < this->RowBegin[i + 1]; ++at)
        {
          this->Values[at] *= static_cast<float>(this->Scale[i] * this->Scale[all[at]]);
        }
      }
    });
}

//------------------------------------------------------------------------------
void GramMatrix::Allocate(Index n)
{
  this->Diagonal.resize(n);
  this->Scale.resize(n);
  this->BlockBegin.resize(n);
  this->DiagonalAt.resize(n);
  this->BlockEnd.resize(n);
}

//------------------------------------------------------------------------------
void GramMatrix::SetDiagonal(Index i, double value)
{
  this->Diagonal[i] = value;
  this->Scale[i] = value > 0.0 ? 1.0 / std::sqrt(value) : 0.0;
}

//------------------------------------------------------------------------------
// The diagonal's entries that the mask's border crosses.
void GramMatrix::SetCrossedDiagonal(
  const FunctionTable& table, const VoxelMask& mask, const Execution& execution)
{
  std::vector<FunctionPair> crossed;
  for (std::int32_t i = 0; mask.Values && i < this->Size(); ++i)
  {
    if (PartThatCounts(mask, table, i, i) == Part::Some)
    {
      crossed.push_back({ i, i });
    }
  }
  const std::vector<double> products = MaskedProducts(mask, table, crossed, execution);
  for (std::size_t k = 0; k < crossed.size(); ++k)
  {
    this->SetDiagonal(crossed[k][0], products[k]);
  }
}

//------------------------------------------------------------------------------
// The other entries that it crosses, each with its mirror image.
void GramMatrix::SetCrossedEntries(
  const FunctionTable& table, const VoxelMask& mask, const Execution& execution)
{
  if (!mask.Values)
  {
    return;
  }
  const Index n = this->Size();
  const auto all = this->Columns.begin();
  const Index blocks = (n + BlockSize - 1) / BlockSize;
  std::vector<std::vector<FunctionPair>> ofBlock(blocks);
  execution.ParallelFor(blocks,
    [&](Index firstBlock, Index endBlock)
    {
      for (Index i = firstBlock * BlockSize; i < std::min(n, endBlock * BlockSize); ++i)
      {
        for (Index at = this->DiagonalAt[i]; at < this->RowBegin[i + 1]; ++at)
        {
          if (PartThatCounts(mask, table, i, all[at]) == Part::Some)
          {
            ofBlock[i / BlockSize].push_back({ static_cast<std::int32_t>(i), all[at] });
          }
        }
      }
    });
  for (const std::vector<FunctionPair>& crossed : ofBlock)
  {
    const std::vector<double> products = MaskedProducts(mask, table, crossed, execution);
    for (std::size_t k = 0; k < crossed.size(); ++k)
    {
      const auto [i, j] = crossed[k];
      const float value = static_cast<float>(products[k] * this->Scale[i] * this->Scale[j]);
      for (const auto& [row, column] : { std::make_pair(i, j), std::make_pair(j, i) })
      {
        this->Values[std::lower_bound(
                       all + this->RowBegin[row], all + this->RowBegin[row + 1], column) -
                     all] = value;
      }
    }
    execution.Check(0.0);
  }
}

//------------------------------------------------------------------------------
// Where in row i the columns of its block are.
void GramMatrix::FindBlock(Index i, Index n)
{
  const Index begin = i / BlockSize * BlockSize, end = std::min(n, begin + BlockSize);
  const auto all = this->Columns.begin();
  const auto row = all + this->RowBegin[i], rowEnd = all + this->RowBegin[i + 1];
  this->BlockBegin[i] = std::lower_bound(row, rowEnd, begin) - all;
  this->DiagonalAt[i] = std::lower_bound(row, rowEnd, i) - all;
  this->BlockEnd[i] = std::lower_bound(row, rowEnd, end) - all;
}

//------------------------------------------------------------------------------
double GramMatrix::Multiply(Index begin, Index end, const std::vector<double>& x) const
{
  // Four sums, for one would wait for each addition before the next.
  double sum[4] = { 0.0, 0.0, 0.0, 0.0 };
  Index at = begin;
  for (; at + 4 <= end; at += 4)
  {
    for (int k = 0; k < 4; ++k)
    {
      sum[k] += this->Values[at + k] * x[this->Columns[at + k]];
    }
  }
  for (; at < end; ++at)
  {
    sum[0] += this->Values[at] * x[this->Columns[at]];
  }
  return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

//------------------------------------------------------------------------------
void GramMatrix::Relax(
  const std::vector<double>& r, Index begin, Index end, std::vector<double>& z) const
{
  for (Index i = begin; i < end; ++i)
  {
    z[i] = r[i] - this->Multiply(this->BlockBegin[i], this->DiagonalAt[i], z);
  }
  for (Index i = end - 1; i >= begin; --i)
  {
    z[i] -= this->Multiply(this->DiagonalAt[i] + 1, this->BlockEnd[i], z);
  }
}

//------------------------------------------------------------------------------
int GramMatrix::Solve(const std::vector<double>& b, double tolerance, int maximumIterations,
  std::vector<double>& x, const Execution& execution) const
{
  // The unknowns are scaled so that the matrix has a unit diagonal.
  const Index n = this->Size();
  x.assign(n, 0.0);
  std::vector<double> r(n), z(n), p(n, 0.0), ap(n);
  for (Index i = 0; i < n; ++i)
  {
    r[i] = b[i] * this->Scale[i];
  }
  double alpha = 0.0, goal = 0.0, rzBefore = 0.0;
  int iteration = 0;
  for (;; ++iteration)
  {
    execution.Check(0.0);
    const double rz = SumOverBlocks(n, execution,
      [&](Index begin, Index end)
      {
        for (Index i = begin; i < end; ++i)
        {
          x[i] += alpha * p[i];
          r[i] -= alpha * ap[i];
        }
        this->Relax(r, begin, end, z);
        return std::inner_product(&r[begin], &r[0] + end, &z[begin], 0.0);
      });
    if (iteration == 0)
    {
      goal = rz * tolerance * tolerance;
    }
    if (iteration == maximumIterations || !(rz > goal))
    {
      break;
    }
    const double beta = iteration == 0 ? 0.0 : rz / rzBefore;
    rzBefore = rz;
    for (Index i = 0; i < n; ++i)
    {
      p[i] = z[i] + beta * p[i];
    }
    const double pap = SumOverBlocks(n, execution,
      [&](Index begin, Index end)
      {
        double sum = 0.0;
        for (Index i = begin; i < end; ++i)
        {
          ap[i] = this->Multiply(this->RowBegin[i], this->RowBegin[i + 1], p);
          sum += p[i] * ap[i];
        }
        return sum;
      });
    if (!(pap > 0.0))
    {
      break; // rounding has used up what the system can tell
    }
    alpha = rz / pap;
  }
  for (Index i = 0; i < n; ++i)
  {
    x[i] *= this->Scale[i];
  }
  return iteration;
}
}
