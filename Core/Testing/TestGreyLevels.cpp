// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Texture/GreyLevels.h"
#include "ThreadedExecution.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

using namespace trivariate;

namespace
{
template <typename T>
GreyLevels Automatic(const std::vector<T>& values, int count, double tail = 0.001)
{
  const Index n = static_cast<Index>(values.size());
  ValueRange range;
  range.Add(values.data(), n);
  ValueHistogram histogram(range);
  histogram.Add(values.data(), n);
  return AutomaticGreyLevels(histogram, count, tail);
}

template <typename T>
std::vector<int> LevelsOf(const std::vector<T>& values, const GreyLevels& greyLevels)
{
  std::vector<std::uint8_t> levels(values.size());
  Discretise(values.data(), static_cast<Index>(values.size()), greyLevels, levels.data());
  return { levels.begin(), levels.end() };
}

std::vector<double> Normal(int n)
{
  std::mt19937 random(1);
  std::normal_distribution<double> distribution;
  std::vector<double> values(n);
  for (double& value : values)
  {
    value = distribution(random);
  }
  return values;
}
}

TEST(GreyLevels, AreEqualBinsOfTheRange)
{
  const GreyLevels levels = UniformGreyLevels(-1.0, 3.0, 8);
  const double infinity = std::numeric_limits<double>::infinity();
  const std::vector<double> values = { -infinity, -5.0, -1.0, -0.51, -0.5, 2.49, 2.5, 3.0, 7.0,
    infinity, std::nan("") };
  EXPECT_EQ(LevelsOf(values, levels), (std::vector<int>{ 0, 0, 0, 0, 1, 6, 7, 7, 7, 7, 0 }));
  EXPECT_EQ(UniformGreyLevels(2.0, 2.0, 8).Count, 1);
  EXPECT_EQ(UniformGreyLevels(2.0, 2.0, 8)(2.0), 0);
  EXPECT_EQ(UniformGreyLevels(0.0, 1.0, 256)(1.0), 255);
  EXPECT_THROW(UniformGreyLevels(0.0, 1.0, 257), std::invalid_argument);
  EXPECT_THROW(UniformGreyLevels(0.0, 1.0, 0), std::invalid_argument);
}

// Like IBSI's phantom: what is an alphabet already stays one, with its gaps.
TEST(GreyLevels, KeepIntegersOfAShortRange)
{
  const std::vector<int> values = { 1, 4, 6, 3, 1, 4 };
  const GreyLevels levels = Automatic(values, 6);
  EXPECT_EQ(levels.Count, 6);
  EXPECT_EQ(LevelsOf(values, levels), (std::vector<int>{ 0, 3, 5, 2, 0, 3 }));
  // As floating point numbers, too.
  EXPECT_EQ(LevelsOf(std::vector<float>{ 1, 4, 6 }, Automatic(std::vector<float>{ 1, 4, 6 }, 16)),
    (std::vector<int>{ 0, 3, 5 }));
}

TEST(GreyLevels, NumberFewDistinctIntegers)
{
  const std::vector<short> values = { -1000, 30000, 7, 8, 7, -1000 };
  const GreyLevels levels = Automatic(values, 4);
  EXPECT_EQ(levels.Count, 4);
  EXPECT_EQ(LevelsOf(values, levels), (std::vector<int>{ 0, 3, 1, 2, 1, 0 }));
  EXPECT_EQ(levels(5.0), 0);
  EXPECT_EQ(levels(1e9), 3);
  EXPECT_EQ(levels(-1e9), 0);
  // One too many: bins.
  EXPECT_TRUE(Automatic(values, 3).Values.empty());
  EXPECT_EQ(Automatic(values, 3).Count, 3);
}

TEST(GreyLevels, LieBetweenQuantiles)
{
  std::vector<int> ramp(10000);
  for (int i = 0; i < 10000; ++i)
  {
    ramp[i] = i;
  }
  const GreyLevels levels = Automatic(ramp, 16, 0.01);
  EXPECT_EQ(levels.Count, 16);
  EXPECT_NEAR(levels.Low, 100.0, 1.0);
  EXPECT_NEAR(levels.High, 9899.0, 1.0);

  // Outliers change next to nothing; without quantiles they would leave one level to the rest.
  std::vector<double> values = Normal(100000);
  const GreyLevels before = Automatic(values, 16);
  EXPECT_NEAR(before.Low, -3.09, 0.1);
  EXPECT_NEAR(before.High, 3.09, 0.1);
  values[0] = 1000.0;
  values[1] = -3000.0;
  const GreyLevels after = Automatic(values, 16);
  EXPECT_NEAR(after.Low, before.Low, 0.1);
  EXPECT_NEAR(after.High, before.High, 0.1);
}

TEST(GreyLevels, OfNearlyConstantValuesSpanTheExtremes)
{
  std::vector<double> values(100000, 0.25);
  values[0] = 0.0;
  values[1] = 1.0;
  const GreyLevels levels = Automatic(values, 4);
  EXPECT_EQ(levels.Count, 4);
  EXPECT_EQ(levels(0.0), 0);
  EXPECT_EQ(levels(1.0), 3);
}

TEST(GreyLevels, OfOneValueAndOfNoneAreOne)
{
  EXPECT_EQ(Automatic(std::vector<float>(10, 3.5f), 16).Count, 1);
  EXPECT_EQ(Automatic(std::vector<float>(10, 3.5f), 16)(3.5), 0);
  EXPECT_EQ(Automatic(std::vector<float>(), 16).Count, 1);
  EXPECT_EQ(Automatic(std::vector<double>(3, std::nan("")), 16).Count, 1);
}

// What the processes of a distributed run do.
TEST(GreyLevels, OfPartsAddUp)
{
  const std::vector<double> values = Normal(10000);
  ValueRange first, second, whole;
  first.Add(values.data(), 3000);
  second.Add(values.data() + 3000, 7000);
  whole.Add(values.data(), 10000);
  EXPECT_EQ(std::min(first.Low, second.Low), whole.Low);
  EXPECT_EQ(std::max(first.High, second.High), whole.High);
  EXPECT_EQ(first.Integers && second.Integers, whole.Integers);
  ValueHistogram a(whole), b(whole), all(whole);
  a.Add(values.data(), 3000);
  b.Add(values.data() + 3000, 7000);
  all.Add(values.data(), 10000);
  for (std::size_t bin = 0; bin < all.Counts.size(); ++bin)
  {
    ASSERT_EQ(a.Counts[bin] + b.Counts[bin], all.Counts[bin]);
  }
}

TEST(GreyLevels, AreTheSameOnThreadsAndForEveryType)
{
  std::mt19937 random(2);
  std::vector<std::uint8_t> bytes(100000);
  for (std::uint8_t& byte : bytes)
  {
    byte = static_cast<std::uint8_t>(random());
  }
  const GreyLevels levels = Automatic(bytes, 16);
  const std::vector<int> expected = LevelsOf(bytes, levels);
  EXPECT_EQ(LevelsOf(std::vector<double>(bytes.begin(), bytes.end()), levels), expected);
  EXPECT_EQ(LevelsOf(std::vector<float>(bytes.begin(), bytes.end()), levels), expected);
  EXPECT_EQ(LevelsOf(std::vector<long long>(bytes.begin(), bytes.end()), levels), expected);
  std::vector<std::uint8_t> threaded(bytes.size());
  Discretise(
    bytes.data(), static_cast<Index>(bytes.size()), levels, threaded.data(), ThreadedExecution(3));
  EXPECT_EQ(std::vector<int>(threaded.begin(), threaded.end()), expected);
}
