// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "BezierMesh.h"

#include "BoxPartition.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace trivariate
{
namespace
{
// The bits of entries first to last, each `width` bits wide.
constexpr std::uint64_t Bits(Index first, Index last, int width)
{
  return first > last ? 0
                      : (~std::uint64_t(0) >> (64 - (last - first + 1) * width)) << first * width;
}

// Place of the lowest bit set in a number that is not zero.
inline int LowestBit(std::uint64_t bits)
{
#if defined(__GNUC__)
  return __builtin_ctzll(bits);
#else
  int place = 0;
  while (!((bits >> place) & 1))
  {
    ++place;
  }
  return place;
#endif
}

// How often an index is halved to tell the entries of a block of this depth apart.
constexpr int EntryShift(int depth)
{
  return 2 * (depth - 1);
}
}

//------------------------------------------------------------------------------
Index BezierMesh::MaximumCells(Index functions)
{
  return std::clamp<Index>(
    64 * functions, Index(1) << 20, std::numeric_limits<std::int32_t>::max());
}

//------------------------------------------------------------------------------
Index BezierMesh::MaximumPairs(Index functions)
{
  return std::max<Index>(4096 * functions, Index(1) << 24);
}

//------------------------------------------------------------------------------
BezierMesh::BezierMesh(const TSpline& spline, const Execution& execution)
  : Lines(spline.KnotLines)
  , Boxes(PartitionIntoBoxes(spline, execution.Part(0.0, 0.4)))
{
  this->BuildUnivariate(spline);
  this->BuildSpanTables();
  this->BuildLevels();
  this->BuildTree(execution.Part(0.4, 0.5));
  this->BuildActive(spline, execution.Part(0.5, 1.0));
}

//------------------------------------------------------------------------------
std::array<double, 6> BezierMesh::Bounds(Index cell) const
{
  const IndexBox& box = this->Boxes[cell];
  std::array<double, 6> bounds;
  for (int a = 0; a < 3; ++a)
  {
    bounds[2 * a] = this->Lines[a][box.Low[a]];
    bounds[2 * a + 1] = this->Lines[a][box.High[a]];
  }
  return bounds;
}

//------------------------------------------------------------------------------
void BezierMesh::BuildUnivariate(const TSpline& spline)
{
  this->UnivariateIds.resize(spline.Functions.size());
  for (int a = 0; a < 3; ++a)
  {
    std::vector<LocalKnots>& distinct = this->UnivariateKnots[a];
    for (const BlendingFunction& f : spline.Functions)
    {
      distinct.push_back(f[a]);
    }
    std::sort(distinct.begin(), distinct.end());
    distinct.erase(std::unique(distinct.begin(), distinct.end()), distinct.end());
    for (std::size_t i = 0; i < spline.Functions.size(); ++i)
    {
      const auto found = std::lower_bound(distinct.begin(), distinct.end(), spline.Functions[i][a]);
      this->UnivariateIds[i][a] = static_cast<std::int32_t>(found - distinct.begin());
    }
  }
}

//------------------------------------------------------------------------------
void BezierMesh::BuildSpanTables()
{
  for (int a = 0; a < 3; ++a)
  {
    const KnotLine& line = this->Lines[a];
    const std::size_t steps = line.size() - 1; // an equally spaced line's own knots
    SpanTable& table = this->SpanTables[a];
    table.Origin = line.front();
    table.InverseStep = steps / (line.back() - line.front());
    std::size_t span = 0;
    for (std::size_t step = 0; step <= steps; ++step)
    {
      const double x = table.Origin + step / table.InverseStep;
      while (span + 2 < line.size() && line[span + 1] <= x)
      {
        ++span;
      }
      table.Spans.push_back(static_cast<std::int32_t>(span));
    }
  }
}

//------------------------------------------------------------------------------
std::int32_t BezierMesh::FindSpan(int a, double x) const
{
  const KnotLine& line = this->Lines[a];
  if (!(x >= line.front() && x <= line.back()))
  {
    return -1;
  }
  const SpanTable& table = this->SpanTables[a];
  const auto step = std::min(
    static_cast<std::size_t>((x - table.Origin) * table.InverseStep), table.Spans.size() - 2);
  std::int32_t low = table.Spans[step];
  for (std::int32_t high = table.Spans[step + 1]; low < high;)
  {
    const std::int32_t middle = low + (high - low + 1) / 2;
    const bool above = line[middle] <= x;
    low = above ? middle : low;
    high = above ? high : middle - 1;
  }
  // Only where the step was rounded.
  while (line[low] > x)
  {
    --low;
  }
  while (low + 2 < static_cast<std::int32_t>(line.size()) && line[low + 1] <= x)
  {
    ++low;
  }
  return low;
}

//------------------------------------------------------------------------------
void BezierMesh::BuildLevels()
{
  std::array<std::int32_t, 3> root = { 1, 1, 1 };
  for (const IndexBox& box : this->Boxes)
  {
    for (int a = 0; a < 3; ++a)
    {
      root[a] = std::max(root[a], box.High[a] - box.Low[a]);
    }
  }
  for (const IndexBox& box : this->Boxes)
  {
    int level = 0;
    for (int a = 0; a < 3; ++a)
    {
      level += static_cast<int>(
        std::lround(std::log2(static_cast<double>(root[a]) / (box.High[a] - box.Low[a]))));
    }
    this->Levels.push_back(level);
  }
}

//------------------------------------------------------------------------------
void BezierMesh::BuildTree(const Execution& execution)
{
  Index longest = 1;
  for (const KnotLine& line : this->Lines)
  {
    longest = std::max(longest, static_cast<Index>(line.size()) - 1);
  }
  while ((Index(1) << (2 * this->Depth)) < longest)
  {
    ++this->Depth;
  }
  this->AddBlock();
  for (Index cell = 0; cell < this->Size(); ++cell)
  {
    if (cell % 4096 == 0)
    {
      execution.Check(static_cast<double>(cell) / this->Size());
    }
    this->InsertIntoTree(static_cast<std::int32_t>(cell), 0, { { 0, 0, 0 }, this->Depth });
  }
}

//------------------------------------------------------------------------------
// Calls visit(entry, low corner of the entry) for those of some entries of a block (their bits set)
// that overlap the box.
template <typename Visitor>
void BezierMesh::VisitEntries(
  const IndexBox& box, const Place& place, std::uint64_t entries, Visitor&& visit) const
{
  const int shift = EntryShift(place.Depth);
  std::array<Index, 3> first, last;
  for (int a = 0; a < 3; ++a)
  {
    first[a] = std::max<Index>(0, (box.Low[a] - place.Low[a]) >> shift);
    last[a] = std::min<Index>(3, (box.High[a] - 1 - place.Low[a]) >> shift);
  }
  entries &= Bits(first[0], last[0], 1) * 0x1111111111111111u;
  entries &= Bits(first[1], last[1], 4) * 0x0001000100010001u;
  entries &= Bits(first[2], last[2], 16);
  for (; entries != 0; entries &= entries - 1)
  {
    const Index entry = LowestBit(entries);
    visit(entry,
      std::array<Index, 3>{ place.Low[0] + ((entry & 3) << shift),
        place.Low[1] + (((entry >> 2) & 3) << shift), place.Low[2] + ((entry >> 4) << shift) });
  }
}

//------------------------------------------------------------------------------
std::int32_t BezierMesh::AddBlock()
{
  if (this->Tree.size() >= MaximumBlocks)
  {
    throw std::length_error(
      "The T-spline's Bezier cells are scattered too finely over its knots to "
      "be located; its knots do not come from a T-mesh.");
  }
  this->Tree.emplace_back();
  this->Tree.back().Entries.fill(Nothing);
  this->Tree.back().Ways = 0;
  return -1 - static_cast<std::int32_t>(this->Tree.size());
}

//------------------------------------------------------------------------------
void BezierMesh::InsertIntoTree(std::int32_t cell, std::size_t block, const Place& place)
{
  const IndexBox& box = this->Boxes[cell];
  const Index width = Index(1) << EntryShift(place.Depth);
  this->VisitEntries(box, place, ~std::uint64_t(0),
    [&](Index entry, const std::array<Index, 3>& low)
    {
      bool whole = true, corner = true;
      for (int a = 0; a < 3; ++a)
      {
        const Index end = static_cast<Index>(this->Lines[a].size()) - 1;
        whole = whole && box.Low[a] <= low[a] && std::min(low[a] + width, end) <= box.High[a];
        corner = corner && box.Low[a] == low[a];
      }
      if (!whole || corner)
      {
        this->Tree[block].Ways |= std::uint64_t(1) << entry;
      }
      if (whole)
      {
        this->Tree[block].Entries[entry] = cell;
        return;
      }
      if (this->Tree[block].Entries[entry] == Nothing)
      {
        const std::int32_t below = this->AddBlock();
        this->Tree[block].Entries[entry] = below;
      }
      this->InsertIntoTree(cell, -2 - this->Tree[block].Entries[entry], { low, place.Depth - 1 });
    });
}

//------------------------------------------------------------------------------
// Calls visit(cell) once for each cell whose low corner lies in the box.
template <typename Visitor>
void BezierMesh::VisitCells(
  const IndexBox& box, std::size_t block, const Place& place, Visitor&& visit) const
{
  const Block& here = this->Tree[block];
  this->VisitEntries(box, place, here.Ways,
    [&](Index entry, const std::array<Index, 3>& low)
    {
      const std::int32_t found = here.Entries[entry];
      if (found < Nothing)
      {
        this->VisitCells(box, -2 - found, { low, place.Depth - 1 }, visit);
      }
      else
      {
        visit(found);
      }
    });
}

//------------------------------------------------------------------------------
void BezierMesh::BuildActive(const TSpline& spline, const Execution& execution)
{
  std::vector<std::int32_t> order(spline.Functions.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
    [this](std::int32_t x, std::int32_t y)
    {
      const auto& p = this->UnivariateIds[x];
      const auto& q = this->UnivariateIds[y];
      return std::lexicographical_compare(p.rbegin(), p.rend(), q.rbegin(), q.rend());
    });

  // The cells of each function, found in parallel ...
  constexpr Index ChunkSize = 1024;
  struct Chunk
  {
    std::vector<Index> Ends; // of each function's cells
    std::vector<std::int32_t> Cells;
  };
  std::vector<Chunk> chunks((order.size() + ChunkSize - 1) / ChunkSize);
  const Index limit = MaximumPairs(spline.Size());
  std::atomic<Index> pairs{ 0 };
  const auto find = [&](Index c)
  {
    Chunk& chunk = chunks[c];
    const Index end = std::min<Index>((c + 1) * ChunkSize, order.size());
    for (Index n = c * ChunkSize; n < end && pairs <= limit; ++n)
    {
      const std::size_t before = chunk.Cells.size();
      this->VisitCells(SupportOf(spline.Functions[order[n]]), 0, { { 0, 0, 0 }, this->Depth },
        [&chunk](std::int32_t cell) { chunk.Cells.push_back(cell); });
      chunk.Ends.push_back(chunk.Cells.size());
      pairs += chunk.Cells.size() - before;
    }
  };
  constexpr Index Batch = 32; // chunks between two looks at the abort flag
  const auto count = static_cast<Index>(chunks.size());
  for (Index first = 0; first < count; first += Batch)
  {
    execution.Check(static_cast<double>(first) / count);
    execution.ParallelFor(std::min(Batch, count - first),
      [&](Index begin, Index end)
      {
        for (Index c = first + begin; c < first + end; ++c)
        {
          find(c);
        }
      });
    if (pairs > limit)
    {
      throw std::length_error("The supports of the T-spline's blending functions hold more than " +
                              std::to_string(limit) +
                              " Bezier cells in all; its knots do not come from a T-mesh.");
    }
  }

  // ... and turned into the functions of each cell.
  this->ActiveOffsets.assign(this->Size() + 1, 0);
  for (const Chunk& chunk : chunks)
  {
    for (const std::int32_t cell : chunk.Cells)
    {
      ++this->ActiveOffsets[cell + 1];
    }
  }
  std::partial_sum(
    this->ActiveOffsets.begin(), this->ActiveOffsets.end(), this->ActiveOffsets.begin());
  this->Active.resize(pairs);
  std::vector<Index> next(this->ActiveOffsets.begin(), this->ActiveOffsets.end() - 1);
  auto function = order.begin();
  for (Chunk& chunk : chunks)
  {
    Index n = 0;
    for (const Index end : chunk.Ends)
    {
      for (; n < end; ++n)
      {
        this->Active[next[chunk.Cells[n]]++] = *function;
      }
      ++function;
    }
    chunk = Chunk(); // frees as it goes
  }
}

//------------------------------------------------------------------------------
Index BezierMesh::FindCell(double u, double v, double w) const
{
  const double x[3] = { u, v, w };
  std::array<std::int32_t, 3> span;
  int atKnot = 0; // bits of the directions in which x is at the low end of its interval
  for (int a = 0; a < 3; ++a)
  {
    span[a] = this->FindSpan(a, x[a]);
    if (span[a] < 0)
    {
      return Nothing;
    }
    atKnot |= span[a] > 0 && this->Lines[a][span[a]] == x[a] ? 1 << a : 0;
  }
  std::int32_t cell = this->CellOfSpans(span);
  for (int down = 1; cell == Nothing && down < 8; ++down)
  {
    if ((down & atKnot) == down)
    {
      cell = this->CellOfSpans(
        { span[0] - (down & 1), span[1] - (down >> 1 & 1), span[2] - (down >> 2) });
    }
  }
  return cell;
}

//------------------------------------------------------------------------------
std::int32_t BezierMesh::CellOfSpans(const std::array<std::int32_t, 3>& span) const
{
  const auto [i, j, k] = span;
  std::int32_t entry = -2;
  for (int depth = this->Depth; entry < Nothing; --depth)
  {
    const int shift = EntryShift(depth);
    const int quarters = (((k >> shift) & 3) * 4 + ((j >> shift) & 3)) * 4 + ((i >> shift) & 3);
    entry = this->Tree[-2 - entry].Entries[quarters];
  }
  return entry;
}
}
