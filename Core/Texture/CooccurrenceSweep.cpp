// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "CooccurrenceSweep.h"

#include "GreyLevels.h"
#include "TargetClones.h"
#include "TextureAttributes.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>

namespace trivariate
{
namespace
{
constexpr int Block = PairTables::RowBlock;

int RoundUp(int n, int multiple)
{
  return (n + multiple - 1) / multiple * multiple;
}

// A run of codes that come or go.
struct CodeRun
{
  const PairCode* Begin;
  const PairCode* End;
};

// face += the rows of the codes that come - the rows of those that go.
TRIVARIATE_CLONES
void MoveFace(const PairTables& tables, RowWord* face, const CodeRun& come, const CodeRun& go)
{
  for (int first = 0; first < tables.RowWidth; first += Block)
  {
    const RowWord* table = tables.Rows.data() + first;
    RowWord block[Block];
    std::copy_n(face + first, Block, block);
    for (const PairCode* code = come.Begin; code != come.End; ++code)
    {
      const RowWord* row = table + std::size_t(*code) * tables.RowWidth;
      for (int k = 0; k < Block; ++k)
      {
        block[k] += row[k];
      }
    }
    for (const PairCode* code = go.Begin; code != go.End; ++code)
    {
      const RowWord* row = table + std::size_t(*code) * tables.RowWidth;
      for (int k = 0; k < Block; ++k)
      {
        block[k] -= row[k];
      }
    }
    std::copy_n(block, Block, face + first);
  }
}

// A column of pairs at the window's end: the sums over it, and its codes.
struct Face
{
  const RowWord* Row;
  CodeRun Codes;
};

bool SameCodes(const Face& a, const Face& b)
{
  return std::equal(a.Codes.Begin, a.Codes.End, b.Codes.Begin);
}

// What is kept while a window takes faces in and out.
struct MovingWindow
{
  const PairTables& Tables;
  RowWord* Row;
  PairCount* CodeCounts;
  std::int64_t JointLogarithms;
};

template <int Sign>
TRIVARIATE_INLINE void Move(MovingWindow& window, const Face& face)
{
  for (int first = 0; first < window.Tables.RowWidth; first += Block)
  {
    for (int k = first; k < first + Block; ++k)
    {
      window.Row[k] += Sign > 0 ? face.Row[k] : -face.Row[k];
    }
  }
  const std::int64_t* next = window.Tables.NextNLogN.data();
  PairCount* counts = window.CodeCounts;
  std::int64_t logarithms = window.JointLogarithms;
  for (const PairCode* code = face.Codes.Begin; code != face.Codes.End; ++code)
  {
    logarithms += Sign > 0 ? next[counts[*code]++] : -next[--counts[*code]];
  }
  window.JointLogarithms = logarithms;
}

TRIVARIATE_CLONES
void Come(MovingWindow& window, const Face& face)
{
  Move<1>(window, face);
}

TRIVARIATE_CLONES
void Go(MovingWindow& window, const Face& face)
{
  Move<-1>(window, face);
}

TRIVARIATE_INLINE std::int64_t Total(
  const std::vector<std::int64_t>& table, const PairCount* counts, int n)
{
  std::int64_t total = 0;
  for (int k = 0; k < n; ++k)
  {
    total += table[counts[k]];
  }
  return total;
}

TRIVARIATE_INLINE int Squares(const PairCount* counts, int n)
{
  int squares = 0;
  for (int k = 0; k < n; ++k)
  {
    const short count = static_cast<short>(counts[k]);
    squares += count * count;
  }
  return squares;
}

TRIVARIATE_INLINE int Largest(const PairCount* counts, int n)
{
  short largest = 0;
  for (int k = 0; k < n; ++k)
  {
    largest = std::max(largest, static_cast<short>(counts[k]));
  }
  return largest;
}

TRIVARIATE_CLONES
void Summarise(const MovingWindow& window, CooccurrenceSums& sums)
{
  const PairTables& tables = window.Tables;
  const int levels = tables.Levels;
  sums.Levels = levels;
  sums.Units = tables.Units;
  const RowWord* sum = window.Row;
  sums.Pairs = sum[0];
  sums.EqualPairs = sum[1];
  std::copy_n(sum + 2, 4, sums.Sums.begin());
  std::copy_n(sum + 6, 2, sums.Differences.begin());
  std::copy_n(sum + 8, 5, sums.Inverses.begin());
  PairCount counts[4 * MaximumGreyLevels];
  std::memcpy(counts, sum + PairTables::SumWords, levels * sizeof(RowWord));
  sums.TotalLogarithm = tables.NLogN[2 * sums.Pairs];
  sums.JointLogarithms = window.JointLogarithms;
  sums.LevelLogarithms = Total(tables.NLogN, counts, levels);
  sums.DifferenceLogarithms = Total(tables.NLogN, counts + levels, levels);
  sums.SumLogarithms = Total(tables.NLogN, counts + 2 * levels, 2 * levels - 1);
  // A pair of one level is counted twice in one entry of the matrix, another one once in two.
  const PairCount* unequal = window.CodeCounts + tables.Unequal;
  const int numberUnequal = tables.Codes - tables.Unequal;
  sums.Squares = 4 * std::int64_t(Squares(window.CodeCounts, tables.Unequal)) +
                 2 * std::int64_t(Squares(unequal, numberUnequal));
  sums.LargestCount =
    std::max(2 * Largest(window.CodeCounts, tables.Unequal), Largest(unequal, numberUnequal));
}
}

//------------------------------------------------------------------------------
PairTables::PairTables(int levels, Index mostPairs)
  : Levels(levels)
  , Units(mostPairs)
  , Unequal(RoundUp(levels, 16))
  , Codes(this->Unequal + RoundUp(levels * (levels - 1) / 2, 16))
  , RowWidth(RoundUp(SumWords + levels, RowBlock))
  , CodeOf(levels * levels)
  , Rows(std::size_t(this->Codes) * this->RowWidth)
{
  PairCode nextCode = static_cast<PairCode>(this->Unequal);
  std::vector<PairCount> counts(4 * levels);
  for (int i = 0; i < levels; ++i)
  {
    for (int j = 0; j <= i; ++j)
    {
      const PairCode code = i == j ? static_cast<PairCode>(i) : nextCode++;
      this->CodeOf[i * levels + j] = this->CodeOf[j * levels + i] = code;
      const std::int64_t d = i - j, s = i + j + 2;
      RowWord* row = &this->Rows[std::size_t(code) * this->RowWidth];
      const auto weights = this->Units.InverseWeights(i - j, levels);
      const std::array<std::int64_t, SumWords> sums = { 1, i == j, s, s * s, s * s * s,
        s * s * s * s, d, d * d, weights[0], weights[1], weights[2], weights[3], weights[4] };
      std::copy(sums.begin(), sums.end(), row);
      std::fill(counts.begin(), counts.end(), PairCount(0));
      ++counts[i];
      ++counts[j];
      ++counts[levels + i - j];
      ++counts[2 * levels + i + j];
      std::memcpy(row + SumWords, counts.data(), levels * sizeof(RowWord));
    }
  }
  for (Index n = 0; n <= 2 * mostPairs; ++n)
  {
    this->NLogN.push_back(this->Units.NLogN(n));
  }
  for (Index n = 0; n < mostPairs; ++n)
  {
    this->NextNLogN.push_back(this->NLogN[n + 1] - this->NLogN[n]);
  }
}

//------------------------------------------------------------------------------
CooccurrenceSweep::CooccurrenceSweep(const PairTables& tables, const std::uint8_t* levels,
  const std::array<Index, 3>& size, int radius, const std::vector<PairDirection>& directions)
  : Tables(tables)
  , Levels(levels)
  , Size(size)
  , Radius(radius)
  , CodeCounts(tables.Codes)
  , Row(tables.RowWidth)
{
  for (const PairDirection& direction : directions)
  {
    this->Directions.push_back({});
    this->Directions.back().Direction = direction;
  }
}

//------------------------------------------------------------------------------
CooccurrenceSweep::Interval CooccurrenceSweep::Window(
  Index at, int axis, const PairDirection& direction) const
{
  return { std::max<Index>(0, at - this->Radius),
    std::min(this->Size[axis], at + this->Radius + 1) - std::abs(direction[axis]) };
}

//------------------------------------------------------------------------------
void CooccurrenceSweep::Begin(const VoxelBox& tile)
{
  this->Tile = tile;
  this->Line = tile.Begin[1];
  for (Pairs& pairs : this->Directions)
  {
    for (int a = 0; a < 3; ++a)
    {
      pairs.First[a] = this->Window(tile.Begin[a], a, pairs.Direction).Begin;
      pairs.Count[a] = this->Window(tile.End[a] - 1, a, pairs.Direction).End - pairs.First[a];
    }
    this->EncodePairs(pairs);
    pairs.Faces.assign(pairs.Count[0] * this->Tables.RowWidth, 0);
    pairs.Lines = { pairs.First[1], pairs.First[1] };
  }
}

//------------------------------------------------------------------------------
void CooccurrenceSweep::EncodePairs(Pairs& pairs) const
{
  // From the low corner of a pair's box to its two voxels.
  Index from = 0, to = 0, stride = 1;
  for (int a = 0; a < 3; ++a)
  {
    from += pairs.Direction[a] < 0 ? stride : 0;
    to += pairs.Direction[a] > 0 ? stride : 0;
    stride *= this->Size[a];
  }
  pairs.Codes.resize(pairs.Count[0] * pairs.Count[1] * pairs.Count[2]);
  const Index step = pairs.Count[1] * pairs.Count[2];
  for (Index z = 0; z < pairs.Count[2]; ++z)
  {
    for (Index y = 0; y < pairs.Count[1]; ++y)
    {
      const std::uint8_t* row =
        this->Levels + ((pairs.First[2] + z) * this->Size[1] + pairs.First[1] + y) * this->Size[0] +
        pairs.First[0];
      PairCode* code = &pairs.Codes[y * pairs.Count[2] + z];
      for (Index x = 0; x < pairs.Count[0]; ++x, code += step)
      {
        *code = this->Tables.CodeOf[row[x + from] * this->Tables.Levels + row[x + to]];
      }
    }
  }
}

//------------------------------------------------------------------------------
void CooccurrenceSweep::MoveFaces(Pairs& pairs) const
{
  const Interval lines = this->Window(this->Line, 1, pairs.Direction);
  for (Index x = 0; x < pairs.Count[0]; ++x)
  {
    const PairCode* codes = pairs.At(pairs.First[0] + x, pairs.First[1]);
    const auto at = [codes, &pairs](Index line)
    { return codes + (line - pairs.First[1]) * pairs.Count[2]; };
    MoveFace(this->Tables, &pairs.Faces[x * this->Tables.RowWidth],
      { at(pairs.Lines.End), at(lines.End) }, { at(pairs.Lines.Begin), at(lines.Begin) });
  }
  pairs.Lines = lines;
}

//------------------------------------------------------------------------------
void CooccurrenceSweep::NextLine(CooccurrenceSums* sums, double* maximalCorrelations)
{
  std::fill(this->CodeCounts.begin(), this->CodeCounts.end(), PairCount(0));
  std::fill(this->Row.begin(), this->Row.end(), RowWord(0));
  MovingWindow window{ this->Tables, this->Row.data(), this->CodeCounts.data(), 0 };
  for (Pairs& pairs : this->Directions)
  {
    this->MoveFaces(pairs);
  }
  const Index begin = this->Tile.Begin[0];
  for (Index x = begin; x < this->Tile.End[0]; ++x)
  {
    bool moved = x == begin;
    for (const Pairs& pairs : this->Directions)
    {
      const Interval columns = this->Window(x, 0, pairs.Direction);
      const Interval before = x > begin ? this->Window(x - 1, 0, pairs.Direction)
                                        : Interval{ columns.Begin, columns.Begin };
      const auto face = [this, &pairs](Index column)
      {
        const PairCode* codes = pairs.At(column, pairs.Lines.Begin);
        return Face{ &pairs.Faces[(column - pairs.First[0]) * this->Tables.RowWidth],
          { codes, codes + (pairs.Lines.End - pairs.Lines.Begin) * pairs.Count[2] } };
      };
      if (before.End + 1 == columns.End && before.Begin + 1 == columns.Begin &&
          SameCodes(face(before.End), face(before.Begin)))
      {
        continue;
      }
      moved = true;
      // In this order no count is ever larger than a window's.
      for (Index column = before.Begin; column < columns.Begin; ++column)
      {
        Go(window, face(column));
      }
      for (Index column = before.End; column < columns.End; ++column)
      {
        Come(window, face(column));
      }
    }
    const Index at = x - begin;
    if (!moved)
    {
      sums[at] = sums[at - 1];
    }
    else
    {
      Summarise(window, sums[at]);
    }
    if (maximalCorrelations)
    {
      maximalCorrelations[at] = moved ? this->MaximalCorrelation() : maximalCorrelations[at - 1];
    }
  }
  ++this->Line;
}

//------------------------------------------------------------------------------
double CooccurrenceSweep::MaximalCorrelation() const
{
  const int levels = this->Tables.Levels;
  CooccurrenceMatrix matrix(levels);
  for (int i = 0; i < levels; ++i)
  {
    for (int j = 0; j < levels; ++j)
    {
      const Index count = this->CodeCounts[this->Tables.CodeOf[i * levels + j]];
      matrix.Counts[i * levels + j] = i == j ? 2 * count : count;
    }
  }
  return trivariate::MaximalCorrelationCoefficient(matrix);
}
}
