// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "GreyLevels.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace trivariate
{
namespace
{
constexpr Index Bins = 1 << 16;
constexpr Index Stride = 1 << 24; // values between two looks at the abort flag

void CheckCount(int count)
{
  if (count < 1 || count > MaximumGreyLevels)
  {
    throw std::invalid_argument("There can be 1 to " + std::to_string(MaximumGreyLevels) +
                                " grey levels, not " + std::to_string(count) + ".");
  }
}

// The lower end of the bin in which the share `share` of the values is reached, from below.
Index QuantileBin(const ValueHistogram& histogram, Index total, double share)
{
  Index below = 0, bin = 0;
  const Index last = static_cast<Index>(histogram.Counts.size()) - 1;
  while (bin < last && below + histogram.Counts[bin] <= share * total)
  {
    below += histogram.Counts[bin++];
  }
  return bin;
}
}

//------------------------------------------------------------------------------
template <typename T>
void ValueRange::Add(const T* values, Index n)
{
  for (Index i = 0; i < n; ++i)
  {
    const double value = static_cast<double>(values[i]);
    if (std::isfinite(value))
    {
      this->Low = std::min(this->Low, value);
      this->High = std::max(this->High, value);
      this->Integers = this->Integers && value == std::floor(value);
    }
  }
}

//------------------------------------------------------------------------------
ValueHistogram::ValueHistogram(const ValueRange& range)
  : Range(range)
{
  const double span = range.High - range.Low;
  this->Exact = range.Integers && span < Bins;
  if (!(span >= 0.0))
  {
    return; // without values, without bins
  }
  this->Counts.resize(this->Exact ? static_cast<Index>(span) + 1 : Bins);
  this->BinWidth = this->Exact ? 1.0 : range.High / Bins - range.Low / Bins;
}

//------------------------------------------------------------------------------
template <typename T>
void ValueHistogram::Add(const T* values, Index n)
{
  const double last = static_cast<double>(this->Counts.size()) - 1.0;
  for (Index i = 0; i < n; ++i)
  {
    const double value = static_cast<double>(values[i]);
    if (std::isfinite(value))
    {
      const double bin = (value - this->Range.Low) / this->BinWidth;
      ++this->Counts[static_cast<Index>(std::min(std::max(bin, 0.0), last))];
    }
  }
}

//------------------------------------------------------------------------------
std::uint8_t GreyLevels::operator()(double density) const
{
  if (!this->Values.empty())
  {
    const auto above = std::upper_bound(this->Values.begin(), this->Values.end(), density);
    return static_cast<std::uint8_t>(std::max<Index>(above - this->Values.begin() - 1, 0));
  }
  if (!(density > this->Low))
  {
    return 0;
  }
  const double bin = (density - this->Low) / (this->High - this->Low) * this->Count;
  return static_cast<std::uint8_t>(bin < this->Count ? bin : this->Count - 1);
}

//------------------------------------------------------------------------------
GreyLevels UniformGreyLevels(double low, double high, int count)
{
  CheckCount(count);
  GreyLevels levels;
  levels.Count = low < high ? count : 1;
  levels.Low = low;
  levels.High = high;
  return levels;
}

//------------------------------------------------------------------------------
GreyLevels AutomaticGreyLevels(const ValueHistogram& histogram, int count, double tail)
{
  CheckCount(count);
  const ValueRange& range = histogram.Range;
  if (!(range.Low < range.High))
  {
    return {};
  }
  if (histogram.Exact)
  {
    GreyLevels levels;
    const Index bins = static_cast<Index>(histogram.Counts.size());
    for (Index bin = 0; bin < bins && Index(levels.Values.size()) <= count; ++bin)
    {
      if (histogram.Counts[bin] > 0 || bins <= count)
      {
        levels.Values.push_back(range.Low + bin);
      }
    }
    levels.Count = static_cast<int>(levels.Values.size());
    if (levels.Count <= count)
    {
      return levels;
    }
  }
  Index total = 0;
  for (const Index n : histogram.Counts)
  {
    total += n;
  }
  const Index first = QuantileBin(histogram, total, tail);
  const Index last = QuantileBin(histogram, total, 1.0 - tail);
  if (first == last)
  {
    return UniformGreyLevels(range.Low, range.High, count);
  }
  // Integers stand in the middle of their levels' share, other values anywhere in their bins.
  const double low = range.Low + first * histogram.BinWidth;
  const double high = range.Low + (histogram.Exact ? last : last + 1) * histogram.BinWidth;
  return UniformGreyLevels(low, high, count);
}

//------------------------------------------------------------------------------
template <typename T>
void Discretise(const T* values, Index n, const GreyLevels& greyLevels, std::uint8_t* levels,
  const Execution& execution)
{
  for (Index first = 0; first < n; first += Stride)
  {
    execution.Check(static_cast<double>(first) / n);
    execution.ParallelFor(std::min(Stride, n - first),
      [=, &greyLevels](Index begin, Index end)
      {
        std::transform(values + first + begin, values + first + end, levels + first + begin,
          [&greyLevels](T value) { return greyLevels(static_cast<double>(value)); });
      });
  }
}

#define TRIVARIATE_INSTANTIATE(T)                     \
  template void ValueRange::Add(const T*, Index);     \
  template void ValueHistogram::Add(const T*, Index); \
  template void Discretise(const T*, Index, const GreyLevels&, std::uint8_t*, const Execution&)
TRIVARIATE_INSTANTIATE(char);
TRIVARIATE_INSTANTIATE(signed char);
TRIVARIATE_INSTANTIATE(unsigned char);
TRIVARIATE_INSTANTIATE(short);
TRIVARIATE_INSTANTIATE(unsigned short);
TRIVARIATE_INSTANTIATE(int);
TRIVARIATE_INSTANTIATE(unsigned int);
TRIVARIATE_INSTANTIATE(long);
TRIVARIATE_INSTANTIATE(unsigned long);
TRIVARIATE_INSTANTIATE(long long);
TRIVARIATE_INSTANTIATE(unsigned long long);
TRIVARIATE_INSTANTIATE(float);
TRIVARIATE_INSTANTIATE(double);
#undef TRIVARIATE_INSTANTIATE
}
