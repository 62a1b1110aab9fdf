// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Densities as a few grey levels 0 .. G - 1, the alphabet of co-occurrence matrices.
 *
 * Three steps, so that the processes of a distributed run can add up between them: the range of the
 * values, their histogram over that range, and the decision, which depends on these two alone.
 *
 *   ValueRange range;       range.Add(values, n);        // then minimum, maximum, logical and
 *   ValueHistogram counts(range); counts.Add(values, n); // then the sum of Counts
 *   const GreyLevels levels = AutomaticGreyLevels(counts, 16);
 *   Discretise(values, n, levels, out, execution);
 */
#ifndef trivariate_GreyLevels_h
#define trivariate_GreyLevels_h

#include "Execution.h"

#include <cstdint>
#include <limits>
#include <vector>

namespace trivariate
{
/// Levels are bytes.
constexpr int MaximumGreyLevels = 256;

/// Smallest and largest finite value, and whether all of these are integers. Empty: Low > High.
struct ValueRange
{
  double Low = std::numeric_limits<double>::infinity();
  double High = -std::numeric_limits<double>::infinity();
  bool Integers = true;

  template <typename T>
  void Add(const T* values, Index n);
};

/// How often values occur: integers one bin each where 2^16 bins allow, else 2^16 equal bins.
struct ValueHistogram
{
  ValueRange Range;
  double BinWidth = 1.0;
  bool Exact = false; ///< one bin an integer: bin b counts Range.Low + b
  std::vector<Index> Counts;

  explicit ValueHistogram(const ValueRange& range);

  /// Values that are not finite are not counted.
  template <typename T>
  void Add(const T* values, Index n);
};

/// Which level a density has.
struct GreyLevels
{
  int Count = 1;     ///< G, 1 to MaximumGreyLevels
  double Low = 0.0;  ///< densities up to Low are level 0,
  double High = 0.0; ///< those from High on level G - 1, between them G equal bins
  /// Where not empty: level i is the density Values[i] (ascending; a density between two of them
  /// gets the lower one), Low and High are not used.
  std::vector<double> Values;

  /// Level of a density; that of NaN is 0.
  std::uint8_t operator()(double density) const;
};

/// `count` equal bins from low to high; one level if low >= high. count 1 to MaximumGreyLevels.
GreyLevels UniformGreyLevels(double low, double high, int count);

/**
 * At most `count` levels for values with this histogram.
 *
 * Integers that span at most `count` values keep their differences: level = value - lowest value.
 * At most `count` distinct integers that span more are numbered in ascending order. Otherwise
 * `count` equal bins between the quantiles `tail` and 1 - tail, so that a few outliers do not
 * flatten the rest; between the extremes where the two quantiles are equal. The result's Count is
 * the G of matrices and attributes; it is 1 for a single value, and for none.
 */
GreyLevels AutomaticGreyLevels(const ValueHistogram& histogram, int count, double tail = 0.001);

/// levels[i] = the level of values[i], i = 0 .. n - 1.
template <typename T>
void Discretise(const T* values, Index n, const GreyLevels& greyLevels, std::uint8_t* levels,
  const Execution& execution = {});
}

#endif
