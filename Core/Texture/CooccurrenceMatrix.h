// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * How often two grey levels are neighbours in a direction, and the integer sums over such a matrix
 * from which texture attributes follow.
 */
#ifndef trivariate_CooccurrenceMatrix_h
#define trivariate_CooccurrenceMatrix_h

#include "TSpline/TSpline.h"

#include <array>
#include <cstdint>
#include <vector>

namespace trivariate
{
/// The offset from a voxel to its neighbour.
using PairDirection = std::array<int, 3>;

/// One of every two opposite neighbours among a voxel's 26: first the 3 axes, then the 6 diagonals
/// of faces, then the 4 of the cube. The matrix being symmetric, the opposite ones add nothing.
const std::array<PairDirection, 13>& PairDirections();

/// The symmetric matrix of counts: every pair of neighbours is counted once in each orientation.
struct CooccurrenceMatrix
{
  int Levels = 0;            ///< G
  std::vector<Index> Counts; ///< G x G

  explicit CooccurrenceMatrix(int levels)
    : Levels(levels)
    , Counts(std::size_t(levels) * levels)
  {
  }

  Index operator()(int i, int j) const { return this->Counts[i * this->Levels + j]; }

  void Add(int i, int j)
  {
    ++this->Counts[i * this->Levels + j];
    ++this->Counts[j * this->Levels + i];
  }
};

/// A box of voxels, half open.
struct VoxelBox
{
  std::array<Index, 3> Begin, End;
};

/**
 * Adds the pairs (voxel, voxel + direction) with both voxels in `box`.
 *
 * levels: 0 .. matrix.Levels - 1, x fastest, of a volume of `size` voxels in which `box` lies;
 * mask, where not null: of the same shape, and only pairs with both voxels not 0 in it count.
 */
void AddPairs(const std::uint8_t* levels, const std::array<Index, 3>& size, const VoxelBox& box,
  const PairDirection& direction, CooccurrenceMatrix& matrix, const std::uint8_t* mask = nullptr);

/// The unit of the fixed-point sums of CooccurrenceSums: as fine as their largest value allows.
struct CooccurrenceUnits
{
  double Logarithm = 1.0, Inverse = 1.0;

  /// For matrices of at most `pairs` pairs.
  explicit CooccurrenceUnits(Index pairs);

  /// n log2 n in units of Logarithm; n >= 0.
  std::int64_t NLogN(Index n) const;

  /// The weights of CooccurrenceSums::Inverse for the difference d of G = levels levels.
  std::array<std::int64_t, 5> InverseWeights(int d, int levels) const;
};

/**
 * Sums over the N pairs of a matrix, each pair once, all of them integers: they can be updated pair
 * by pair in any order and stay exact. Levels i, j are counted from 1, s = i + j, d = |i - j|.
 */
struct CooccurrenceSums
{
  int Levels = 0;
  CooccurrenceUnits Units{ 0 };
  std::int64_t Pairs = 0;                       ///< N
  std::int64_t EqualPairs = 0;                  ///< those with d = 0
  std::array<std::int64_t, 4> Sums = {};        ///< of s, s^2, s^3, s^4
  std::array<std::int64_t, 2> Differences = {}; ///< of d, d^2
  /// of 1/(1+d), 1/(1+d/G), 1/(1+d^2), 1/(1+(d/G)^2), 1/d^2 (0 for d = 0), in Units.Inverse
  std::array<std::int64_t, 5> Inverses = {};
  std::int64_t Squares = 0;      ///< of the counts of the (symmetric) matrix
  std::int64_t LargestCount = 0; ///< of the matrix
  /// n log2 n in Units.Logarithm: for n = 2 N, and summed over n, the number of pairs with the same
  /// {i, j}; with the same s; with the same d; the number of times that a level occurs in a pair.
  std::int64_t TotalLogarithm = 0, JointLogarithms = 0, SumLogarithms = 0, DifferenceLogarithms = 0,
               LevelLogarithms = 0;

  bool operator==(const CooccurrenceSums& other) const;
};

/// The sums over a matrix. Cost: G^2.
CooccurrenceSums SumsOf(const CooccurrenceMatrix& matrix);
}

#endif
