// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "PlainTexture.h"
#include "Texture/TextureAttributes.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdio>
#include <random>
#include <string>

using namespace trivariate;
using A = TextureAttribute;

namespace
{
constexpr std::array<Index, 3> PhantomSize = { 5, 4, 4 };

// The digital phantom of the Image Biomarker Standardisation Initiative (CC BY 4.0), and its mask.
constexpr std::uint8_t Phantom[] = {                          //
  1, 4, 4, 1, 1, 1, 4, 6, 1, 1, 4, 1, 6, 4, 1, 4, 4, 6, 4, 1, //
  1, 4, 4, 1, 1, 1, 1, 6, 1, 1, 1, 1, 3, 1, 1, 4, 4, 6, 1, 1, //
  1, 4, 4, 1, 1, 1, 1, 1, 1, 1, 1, 1, 9, 1, 1, 1, 1, 6, 1, 1, //
  1, 4, 4, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 6, 1, 1
};
constexpr std::uint8_t PhantomMask[] = {                      //
  1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, //
  1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 0, 1, 1, 1, 1, 1, 1, 1, 1, 1, //
  1, 1, 1, 0, 0, 1, 1, 1, 1, 1, 1, 1, 0, 1, 1, 1, 1, 1, 1, 1, //
  1, 1, 1, 0, 0, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1
};

// The reference values as IBSI prints them, and the same with six decimals; averaged over the
// directions, and of the merged matrix.
struct Reference
{
  const char* Averaged;
  const char* Merged;
  double AveragedSix, MergedSix;
};
constexpr Reference References[TextureAttributeCount] = {
  { "0.503", "0.509", 0.502811, 0.508539 },      // JointMaximum
  { "2.14", "2.15", 2.142995, 2.148956 },        // JointAverage
  { "3.1", "3.13", 3.099321, 3.132461 },         // JointVariance
  { "2.4", "2.57", 2.399711, 2.573896 },         // JointEntropy
  { "1.43", "1.38", 1.430981, 1.379507 },        // DifferenceAverage
  { "3.06", "3.21", 3.056283, 3.214608 },        // DifferenceVariance
  { "1.56", "1.64", 1.562733, 1.640877 },        // DifferenceEntropy
  { "4.29", "4.3", 4.285990, 4.297913 },         // SumAverage
  { "7.07", "7.41", 7.072803, 7.412197 },        // SumVariance
  { "1.92", "2.11", 1.922606, 2.109863 },        // SumEntropy
  { "0.303", "0.291", 0.302975, 0.290951 },      // AngularSecondMoment
  { "5.32", "5.12", 5.324480, 5.117647 },        // Contrast
  { "1.43", "1.38", 1.430981, 1.379507 },        // Dissimilarity
  { "0.677", "0.688", 0.676615, 0.687698 },      // InverseDifference
  { "0.851", "0.856", 0.850679, 0.855898 },      // NormalisedInverseDifference
  { "0.618", "0.631", 0.617739, 0.630638 },      // InverseDifferenceMoment
  { "0.898", "0.902", 0.898443, 0.902210 },      // NormalisedInverseDifferenceMoment
  { "0.0604", "0.0574", 0.060416, 0.057445 },    // InverseVariance
  { "0.157", "0.183", 0.157350, 0.183127 },      // Correlation
  { "5.06", "5.19", 5.055436, 5.191651 },        // Autocorrelation
  { "7.07", "7.41", 7.072803, 7.412197 },        // ClusterTendency
  { "16.6", "17.4", 16.644093, 17.419205 },      // ClusterShade
  { "145", "147", 144.703381, 147.463900 },      // ClusterProminence
  { "-0.157", "-0.0288", -0.156848, -0.028800 }, // InformationCorrelation1
  { "0.52", "0.269", 0.519588, 0.269169 },       // InformationCorrelation2
  { "0.441", "0.218", 0.440543, 0.218356 },      // MaximalCorrelationCoefficient (not of IBSI)
};

// Three significant digits, without zeros at the end, as IBSI prints.
std::string Printed(double value)
{
  char text[32];
  std::snprintf(text, sizeof(text), "%.3g", value);
  return text;
}

CooccurrenceMatrix PhantomMatrix(const std::vector<PairDirection>& directions)
{
  std::vector<std::uint8_t> levels;
  for (const std::uint8_t level : Phantom)
  {
    levels.push_back(level - 1);
  }
  CooccurrenceMatrix matrix(6);
  for (const PairDirection& direction : directions)
  {
    AddPairs(
      levels.data(), PhantomSize, { { 0, 0, 0 }, PhantomSize }, direction, matrix, PhantomMask);
  }
  return matrix;
}

CooccurrenceMatrix RandomMatrix(int levels, int pairs, std::mt19937& random)
{
  // Few of the levels, so that zeros and large counts occur.
  std::uniform_int_distribution<int> level(0, levels - 1);
  const int first = level(random), second = level(random);
  CooccurrenceMatrix matrix(levels);
  for (int n = 0; n < pairs; ++n)
  {
    const int i = random() % 3 ? first : level(random);
    matrix.Add(i, random() % 2 ? second : level(random));
  }
  return matrix;
}
}

TEST(TextureAttributes, AgreeWithTheDigitalPhantomOfIBSI)
{
  const auto& directions = PairDirections();
  TextureAttributeValues averaged = {};
  for (const PairDirection& direction : directions)
  {
    const TextureAttributeValues values = ComputeTextureAttributes(PhantomMatrix({ direction }));
    for (int k = 0; k < TextureAttributeCount; ++k)
    {
      averaged[k] += values[k] / directions.size();
    }
  }
  const TextureAttributeValues merged =
    ComputeTextureAttributes(PhantomMatrix({ directions.begin(), directions.end() }));
  for (int k = 0; k < TextureAttributeCount; ++k)
  {
    const char* name = TextureAttributeName(static_cast<A>(k));
    EXPECT_EQ(Printed(averaged[k]), References[k].Averaged) << name;
    EXPECT_EQ(Printed(merged[k]), References[k].Merged) << name;
    EXPECT_NEAR(averaged[k], References[k].AveragedSix, 1e-5) << name;
    EXPECT_NEAR(merged[k], References[k].MergedSix, 1e-5) << name;
  }
}

TEST(TextureAttributes, ThePhantomsMatrixHasTheKnownCounts)
{
  const auto& directions = PairDirections();
  const CooccurrenceMatrix merged = PhantomMatrix({ directions.begin(), directions.end() });
  const std::vector<Index> expected = { 536, 0, 14, 105, 0, 61, 0, 0, 0, 0, 0, 0, 14, 0, 0, 5, 0, 6,
    105, 0, 5, 64, 0, 28, 0, 0, 0, 0, 0, 0, 61, 0, 6, 28, 0, 16 };
  EXPECT_EQ(merged.Counts, expected);
}

// Cancellation would show: the exact sums against the definitions, relative to the bounds.
TEST(TextureAttributes, SumsGiveWhatTheDefinitionsSay)
{
  std::mt19937 random(1);
  for (const int levels : { 2, 3, 16, 64, 256 })
  {
    for (int trial = 0; trial < 40; ++trial)
    {
      const CooccurrenceMatrix matrix = RandomMatrix(levels, 1 + random() % 900, random);
      TextureAttributeValues values;
      ComputeTextureAttributes(SumsOf(matrix), values);
      const TextureAttributeValues plain = PlainAttributes(matrix);
      for (int k = 0; k + 1 < TextureAttributeCount; ++k)
      {
        const A a = static_cast<A>(k);
        const auto [low, high] = TextureAttributeBounds(a, levels);
        EXPECT_NEAR(values[k], plain[k], 1e-12 * (high - low))
          << TextureAttributeName(a) << ", " << levels << " levels, trial " << trial;
      }
    }
  }
}

TEST(TextureAttributes, StayWithinTheirBounds)
{
  std::mt19937 random(2);
  for (const int levels : { 1, 2, 5, 16 })
  {
    for (int trial = 0; trial < 200; ++trial)
    {
      const CooccurrenceMatrix matrix = RandomMatrix(levels, 1 + random() % 30, random);
      const TextureAttributeValues values = ComputeTextureAttributes(matrix);
      for (int k = 0; k < TextureAttributeCount; ++k)
      {
        const A a = static_cast<A>(k);
        const auto [low, high] = TextureAttributeBounds(a, levels);
        EXPECT_GE(values[k], low - 1e-12) << TextureAttributeName(a);
        EXPECT_LE(values[k], high + 1e-12) << TextureAttributeName(a);
      }
    }
  }
}

// A bound that nothing reaches would waste a part of [0, 1].
TEST(TextureAttributes, ReachTheirBounds)
{
  static constexpr int levels = 4;
  std::vector<CooccurrenceMatrix> matrices;
  const auto matrix = [&matrices](const std::vector<std::array<int, 3>>& pairs)
  {
    matrices.emplace_back(levels);
    for (const auto& [i, j, times] : pairs)
    {
      for (int n = 0; n < times; ++n)
      {
        matrices.back().Add(i, j);
      }
    }
  };
  matrix({ { 0, 0, 1 } });
  matrix({ { 3, 3, 1 } });
  matrix({ { 0, 3, 1 } });
  matrix({ { 0, 1, 1 } });
  matrix({ { 0, 0, 1 }, { 3, 3, 1 } });
  matrix({ { 0, 0, 1 }, { 0, 3, 1 } });
  matrix({ { 0, 0, 1 }, { 1, 1, 1 }, { 2, 2, 1 }, { 3, 3, 1 } });
  // Every entry the same; d = 0 ... 3 alike often; s = 2 ... 8 alike often.
  matrix({ { 0, 0, 1 }, { 1, 1, 1 }, { 2, 2, 1 }, { 3, 3, 1 }, { 0, 1, 2 }, { 0, 2, 2 },
    { 0, 3, 2 }, { 1, 2, 2 }, { 1, 3, 2 }, { 2, 3, 2 } });
  matrix({ { 0, 0, 1 }, { 0, 1, 1 }, { 0, 2, 1 }, { 0, 3, 1 } });
  matrix(
    { { 0, 0, 1 }, { 0, 1, 1 }, { 0, 2, 1 }, { 0, 3, 1 }, { 1, 3, 1 }, { 2, 3, 1 }, { 3, 3, 1 } });
  // The most skew and the most heavy-tailed of two values.
  matrix({ { 0, 0, 21132 }, { 3, 3, 78868 } });
  matrix({ { 0, 0, 78868 }, { 3, 3, 21132 } });
  for (int k = 0; k < TextureAttributeCount; ++k)
  {
    const A a = static_cast<A>(k);
    double lowest = 1.0, highest = 0.0;
    for (const CooccurrenceMatrix& m : matrices)
    {
      const double value = NormalisedTextureAttribute(a, levels, ComputeTextureAttributes(m)[k]);
      lowest = std::min(lowest, value);
      highest = std::max(highest, value);
    }
    EXPECT_NEAR(lowest, 0.0, 1e-9) << TextureAttributeName(a);
    EXPECT_NEAR(highest, 1.0, 1e-9) << TextureAttributeName(a);
  }
}

TEST(TextureAttributes, OfOneLevelAndOfNothingAreDefined)
{
  CooccurrenceMatrix one(8);
  one.Add(0, 0);
  one.Add(0, 0);
  one.Add(0, 0);
  const TextureAttributeValues values = ComputeTextureAttributes(one);
  EXPECT_EQ(values[static_cast<int>(A::Correlation)], 1.0);
  EXPECT_EQ(values[static_cast<int>(A::MaximalCorrelationCoefficient)], 1.0);
  EXPECT_EQ(values[static_cast<int>(A::InformationCorrelation1)], 0.0);
  EXPECT_EQ(values[static_cast<int>(A::InformationCorrelation2)], 0.0);
  EXPECT_EQ(values[static_cast<int>(A::JointEntropy)], 0.0);
  EXPECT_EQ(values[static_cast<int>(A::AngularSecondMoment)], 1.0);
  EXPECT_EQ(ComputeTextureAttributes(CooccurrenceMatrix(8)), values);
}

TEST(TextureAttributes, NamesAndDefaults)
{
  EXPECT_STREQ(TextureAttributeName(A::AngularSecondMoment), "AngularSecondMoment");
  EXPECT_STREQ(
    TextureAttributeName(A::MaximalCorrelationCoefficient), "MaximalCorrelationCoefficient");
  EXPECT_EQ(DefaultTextureAttributes().size(), 22u);
  // No two of the defaults are the same up to scale and shift.
  std::mt19937 random(3);
  std::vector<TextureAttributeValues> samples;
  for (int n = 0; n < 20; ++n)
  {
    samples.push_back(ComputeTextureAttributes(RandomMatrix(6, 50, random)));
  }
  const auto correlation = [&samples](int k, int l)
  {
    double sums[5] = {};
    for (const TextureAttributeValues& v : samples)
    {
      const double products[5] = { v[k], v[l], v[k] * v[k], v[l] * v[l], v[k] * v[l] };
      for (int i = 0; i < 5; ++i)
      {
        sums[i] += products[i] / samples.size();
      }
    }
    return (sums[4] - sums[0] * sums[1]) /
           std::sqrt((sums[2] - sums[0] * sums[0]) * (sums[3] - sums[1] * sums[1]));
  };
  for (const A a : DefaultTextureAttributes())
  {
    for (const A b : DefaultTextureAttributes())
    {
      EXPECT_TRUE(a == b || std::abs(correlation(int(a), int(b))) < 1.0 - 1e-9)
        << TextureAttributeName(a) << ' ' << TextureAttributeName(b);
    }
  }
}
