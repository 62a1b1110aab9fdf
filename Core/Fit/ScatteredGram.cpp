// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The normal equations of scattered samples: cells in blocks of neighbours, each block a small
// dense matrix, the blocks' rows summed in their order.
#include "ScatteredSystem.h"

#include "TargetClones.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace trivariate
{
namespace
{
constexpr Index MostCells = 128;   // of a block,
constexpr Index EnoughBlocks = 64; // for any number of threads
constexpr int Batch = 8;           // samples that are added at once

// lower(G) += sum over Batch rows r of r r^T; rows of `stride` numbers.
TRIVARIATE_CLONES void AddRows(const float* rows, int n, int stride, float* gram)
{
  for (int i = 0; i < n; ++i)
  {
    float factor[Batch];
    for (int r = 0; r < Batch; ++r)
    {
      factor[r] = rows[r * stride + i];
    }
    float* __restrict out = gram + i * stride;
    for (int j = 0; j <= i; ++j)
    {
      float sum = out[j];
      for (int r = 0; r < Batch; ++r)
      {
        sum += factor[r] * rows[r * stride + j];
      }
      out[j] = sum;
    }
  }
}
}

//------------------------------------------------------------------------------
// The matrix of the control points of a block of cells.
struct ScatteredSystem::LocalMatrix
{
  std::vector<std::int32_t> Points;    // ascending
  std::vector<std::int32_t> NumberOf;  // of each function that occurs: of its point, in Points
  std::vector<std::int32_t> Functions; // ascending, those that occur
  std::vector<double> Norms;           // of these functions
  std::vector<float> Values;           // Points.size() squared, symmetric
  std::vector<float> Rows, Gram;       // of the cell at hand

  std::int32_t IndexOf(std::int32_t function) const
  {
    return static_cast<std::int32_t>(
      std::lower_bound(this->Functions.begin(), this->Functions.end(), function) -
      this->Functions.begin());
  }
};

//------------------------------------------------------------------------------
void ScatteredSystem::AddCell(CellBasis& basis, LocalMatrix& matrix) const
{
  const Index begin = this->SampleBegin[basis.Cell], end = this->SampleBegin[basis.Cell + 1];
  const IdRange active = basis.Active();
  const int n = static_cast<int>(active.size());
  const int stride = (n + 15) / 16 * 16;
  matrix.Gram.assign(static_cast<std::size_t>(n) * stride, 0.0f);
  // Rows of the functions' values, or derivatives, are collected and added some at a time.
  int rows = 0;
  std::array<std::vector<float>, 3> values;
  const auto flush = [&]()
  {
    std::fill(matrix.Rows.begin() + static_cast<Index>(rows) * stride, matrix.Rows.end(), 0.0f);
    AddRows(matrix.Rows.data(), n, stride, matrix.Gram.data());
    rows = 0;
  };
  const auto addRow = [&](double scale, const std::array<BernsteinForm, 3>& b)
  {
    for (int a = 0; a < 3; ++a)
    {
      values[a].clear();
      for (const BernsteinForm& form : basis.Forms[a])
      {
        const double value =
          form[0] * b[a][0] + form[1] * b[a][1] + form[2] * b[a][2] + form[3] * b[a][3];
        values[a].push_back(static_cast<float>(a == 0 ? scale * value : value));
      }
    }
    float* row = &matrix.Rows[static_cast<std::size_t>(rows) * stride];
    for (int i = 0; i < n; ++i)
    {
      const std::array<int, 3>& number = basis.Numbers[i];
      row[i] = values[0][number[0]] * values[1][number[1]] * values[2][number[2]];
    }
    if (++rows == Batch)
    {
      flush();
    }
  };
  matrix.Rows.assign(static_cast<std::size_t>(Batch) * stride, 0.0f);
  for (Index at = begin; at < end; ++at)
  {
    const Index sample = this->Sorted[at];
    addRow(
      std::sqrt(this->WeightOf(sample)), basis.BernsteinAt(&this->Samples.Parameters[3 * sample]));
  }
  flush();
  // Squared norms, by which splits are judged, are of the samples alone.
  for (int i = 0; i < n; ++i)
  {
    matrix.Norms[matrix.IndexOf(active.First[i])] +=
      matrix.Gram[static_cast<std::size_t>(i) * stride + i];
  }
  if (this->Fairness[basis.Cell] > 0.0f)
  {
    const double scale = std::sqrt(this->Fairness[basis.Cell]);
    VisitSecondDerivatives(
      [&](const std::array<BernsteinForm, 3>& derivative) { addRow(scale, derivative); });
    flush();
  }
  const std::size_t size = matrix.Points.size();
  std::vector<std::int32_t> local(n);
  for (int i = 0; i < n; ++i)
  {
    local[i] = matrix.NumberOf[matrix.IndexOf(active.First[i])];
  }
  for (int i = 0; i < n; ++i)
  {
    const float* row = &matrix.Gram[static_cast<std::size_t>(i) * stride];
    for (int j = 0; j < i; ++j)
    {
      matrix.Values[local[i] * size + local[j]] += row[j];
      matrix.Values[local[j] * size + local[i]] += row[j];
    }
    matrix.Values[local[i] * size + local[i]] += row[i];
  }
}

//------------------------------------------------------------------------------
ScatteredSystem::LocalMatrix ScatteredSystem::AssembleBlock(Index firstCell, Index lastCell) const
{
  LocalMatrix matrix;
  for (Index k = firstCell; k < lastCell; ++k)
  {
    const Index cell = this->Order[k];
    if (!this->IsEmpty(cell))
    {
      const IdRange active = this->Cells->ActiveFunctions(cell);
      matrix.Functions.insert(matrix.Functions.end(), active.begin(), active.end());
    }
  }
  const auto makeSet = [](std::vector<std::int32_t>& ids)
  {
    std::sort(ids.begin(), ids.end());
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  };
  makeSet(matrix.Functions);
  for (const std::int32_t i : matrix.Functions)
  {
    matrix.Points.push_back(static_cast<std::int32_t>(this->Shared.PointOf[i]));
  }
  makeSet(matrix.Points);
  for (const std::int32_t i : matrix.Functions)
  {
    const auto point = static_cast<std::int32_t>(this->Shared.PointOf[i]);
    matrix.NumberOf.push_back(static_cast<std::int32_t>(
      std::lower_bound(matrix.Points.begin(), matrix.Points.end(), point) - matrix.Points.begin()));
  }
  matrix.Norms.assign(matrix.Functions.size(), 0.0);
  matrix.Values.assign(matrix.Points.size() * matrix.Points.size(), 0.0f);
  CellBasis basis(*this->Cells);
  for (Index k = firstCell; k < lastCell; ++k)
  {
    const Index cell = this->Order[k];
    if (!this->IsEmpty(cell))
    {
      basis.SetCell(cell);
      this->AddCell(basis, matrix);
    }
  }
  return matrix;
}

//------------------------------------------------------------------------------
GramMatrix ScatteredSystem::Assemble()
{
  // What a block has of a row: columns ascending.
  struct Piece
  {
    Index Begin, End; // in the block's Columns and Values
    Index Block;
  };
  struct SparseBlock
  {
    std::vector<std::int32_t> Columns;
    std::vector<float> Values;
    std::vector<std::pair<std::int32_t, std::pair<Index, Index>>> Rows; // point, range
    std::vector<std::pair<std::int32_t, double>> Norms;
  };
  const Index cells = this->Cells->Size();
  const Index ofBlock = std::clamp<Index>(cells / EnoughBlocks, 1, MostCells);
  const Index blocks = (cells + ofBlock - 1) / ofBlock;
  std::vector<SparseBlock> sparse(blocks);
  constexpr Index Batch = 32; // blocks between two looks at the abort flag
  for (Index firstBlock = 0; firstBlock < blocks; firstBlock += Batch)
  {
    this->Run.Check(0.0);
    this->Run.ParallelFor(std::min(Batch, blocks - firstBlock),
      [this, &sparse, firstBlock, ofBlock, cells](Index begin, Index end)
      {
        for (Index b = firstBlock + begin; b < firstBlock + end; ++b)
        {
          const LocalMatrix matrix =
            this->AssembleBlock(b * ofBlock, std::min(cells, (b + 1) * ofBlock));
          const std::size_t size = matrix.Points.size();
          SparseBlock& out = sparse[b];
          for (std::size_t r = 0; r < size; ++r)
          {
            const Index first = static_cast<Index>(out.Columns.size());
            for (std::size_t c = 0; c < size; ++c)
            {
              const float value = matrix.Values[r * size + c];
              if (value != 0.0f)
              {
                out.Columns.push_back(matrix.Points[c]);
                out.Values.push_back(value);
              }
            }
            out.Rows.push_back(
              { matrix.Points[r], { first, static_cast<Index>(out.Columns.size()) } });
          }
          for (std::size_t f = 0; f < matrix.Functions.size(); ++f)
          {
            out.Norms.push_back({ matrix.Functions[f], matrix.Norms[f] });
          }
        }
      });
  }

  const Index n = this->Shared.Count();
  std::vector<std::vector<Piece>> pieces(n);
  this->SquaredNorms.assign(this->Shared.PointOf.size(), 0.0);
  for (Index b = 0; b < blocks; ++b)
  {
    for (const auto& [point, range] : sparse[b].Rows)
    {
      pieces[point].push_back({ range.first, range.second, b });
    }
    for (const auto& [function, norm] : sparse[b].Norms)
    {
      this->SquaredNorms[function] += norm;
    }
  }
  std::vector<std::vector<std::pair<std::int32_t, float>>> rows(n);
  this->Run.ParallelFor(n,
    [&](Index begin, Index end)
    {
      std::vector<float> sums(n, 0.0f);
      std::vector<char> seen(n, 0);
      std::vector<std::int32_t> columns;
      for (Index r = begin; r < end; ++r)
      {
        columns.assign(1, static_cast<std::int32_t>(r)); // the diagonal in any case
        seen[r] = 1;
        for (const Piece& piece : pieces[r])
        {
          const SparseBlock& block = sparse[piece.Block];
          for (Index at = piece.Begin; at < piece.End; ++at)
          {
            const std::int32_t c = block.Columns[at];
            if (!seen[c])
            {
              seen[c] = 1;
              columns.push_back(c);
            }
            sums[c] += block.Values[at];
          }
        }
        std::sort(columns.begin(), columns.end());
        for (const std::int32_t c : columns)
        {
          rows[r].emplace_back(c, sums[c]);
          sums[c] = 0.0f;
          seen[c] = 0;
        }
      }
    });
  std::vector<Index> rowBegin(n + 1, 0);
  std::vector<std::int32_t> columns;
  std::vector<float> entries;
  for (Index r = 0; r < n; ++r)
  {
    for (const auto& [column, entry] : rows[r])
    {
      columns.push_back(column);
      entries.push_back(entry);
    }
    rowBegin[r + 1] = static_cast<Index>(columns.size());
    std::vector<std::pair<std::int32_t, float>>().swap(rows[r]);
  }
  return GramMatrix(std::move(rowBegin), std::move(columns), std::move(entries), this->Run);
}
}
