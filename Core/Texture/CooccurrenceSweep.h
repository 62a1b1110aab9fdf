// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The integer sums of co-occurrence matrices of windows that slide over a volume.
 *
 * The levels of a pair make one number, its code. What a code adds to the sums of a window is a
 * row of a table, so a window's sums are a plain box sum of rows: columns of the box, faces, are
 * updated from line to line, and the window adds a face and drops a face from voxel to voxel. Only
 * the counts of the codes themselves, too many for rows, are kept for the window alone, and with
 * them their sum of n log n.
 */
#ifndef trivariate_CooccurrenceSweep_h
#define trivariate_CooccurrenceSweep_h

#include "CooccurrenceMatrix.h"

namespace trivariate
{
/// A pair's code, at most G (G + 15) / 2; and a count of pairs in a window.
using PairCode = std::uint16_t;
using PairCount = std::uint16_t;

/// The most pairs that a window's 16-bit counts can hold: a level is counted up to twice a pair,
/// and the sum of squares is taken with signed numbers.
constexpr Index MostPairs = 32767;

/// A piece of a row, added and subtracted as a whole: one sum, or four counts that never carry.
using RowWord = std::uint64_t;

/// What codes stand for and add to the sums of a window of at most `mostPairs` pairs.
struct PairTables
{
  /// The first words of a row are sums, in the order of CooccurrenceSums: Pairs, EqualPairs, ...
  static constexpr int SumWords = 13;
  /// After them counts: of the G levels, the G differences, the 2 G - 1 sums. Rows are a multiple
  /// of this long.
  static constexpr int RowBlock = 16;

  int Levels;
  CooccurrenceUnits Units;
  int Unequal;                         ///< first code of a pair of two levels; before: one level
  int Codes;                           ///< their number, a multiple of 16
  int RowWidth;                        ///< words
  std::vector<PairCode> CodeOf;        ///< [i * Levels + j]
  std::vector<RowWord> Rows;           ///< [code * RowWidth + word]
  std::vector<std::int64_t> NLogN;     ///< [n], up to twice the pairs
  std::vector<std::int64_t> NextNLogN; ///< [n] = NLogN[n + 1] - NLogN[n]

  PairTables(int levels, Index mostPairs);
};

/// Windows of one direction, or of several that share one matrix, along lines of a tile.
class CooccurrenceSweep
{
public:
  /// levels, size: as in ComputeTexture; all directions have a pair in the volume.
  CooccurrenceSweep(const PairTables& tables, const std::uint8_t* levels,
    const std::array<Index, 3>& size, int radius, const std::vector<PairDirection>& directions);

  /// Starts on a box one voxel thick in z, before its first line.
  void Begin(const VoxelBox& tile);

  /// The next line's windows: their sums, and (where not null) f14 of their matrices. Sums of
  /// windows whose pairs are the same are the same.
  void NextLine(CooccurrenceSums* sums, double* maximalCorrelations);

private:
  /// The window along one axis: the low corners of its pairs, half open.
  struct Interval
  {
    Index Begin, End;
  };

  /// One direction: pairs by their low corner.
  struct Pairs
  {
    PairDirection Direction;
    std::array<Index, 3> First, Count; ///< low corners that the tile's windows reach
    std::vector<PairCode> Codes;       ///< z fastest, then y, so that a face is contiguous
    std::vector<RowWord> Faces;        ///< a row for each x
    Interval Lines;                    ///< those in the faces

    const PairCode* At(Index x, Index y) const
    {
      return &this->Codes[((x - this->First[0]) * this->Count[1] + y - this->First[1]) *
                          this->Count[2]];
    }
  };

  const PairTables& Tables;
  const std::uint8_t* Levels;
  std::array<Index, 3> Size;
  Index Radius;
  VoxelBox Tile;
  Index Line = 0;
  std::vector<Pairs> Directions;
  std::vector<PairCount> CodeCounts;
  std::vector<RowWord> Row;

  Interval Window(Index at, int axis, const PairDirection& direction) const;
  void EncodePairs(Pairs& pairs) const;
  void MoveFaces(Pairs& pairs) const;
  double MaximalCorrelation() const;
};
}

#endif
