// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Texture/KMeans.h"
#include "ThreadedExecution.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

using namespace trivariate;

namespace
{
PointRows View(const std::vector<double>& values, int dimensions)
{
  return { static_cast<Index>(values.size()) / dimensions, dimensions, values.data() };
}

std::vector<double> Blobs(int blobs, int each, int dimensions, double width, unsigned seed)
{
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::vector<double> points;
  for (int i = 0; i < blobs * each; ++i)
  {
    for (int d = 0; d < dimensions; ++d)
    {
      points.push_back(10.0 * ((i % blobs) * (d + 1) % blobs) + width * normal(random));
    }
  }
  return points;
}

double Inertia(const PointRows& points, const std::vector<double>& centres)
{
  double sum = 0.0;
  for (Index i = 0; i < points.Count; ++i)
  {
    const int c = NearestCentre(points.Row(i), points.Dimensions, centres);
    for (int d = 0; d < points.Dimensions; ++d)
    {
      sum += std::pow(points.Row(i)[d] - centres[c * points.Dimensions + d], 2);
    }
  }
  return sum;
}
}

//------------------------------------------------------------------------------
TEST(KMeans, FindsSeparateBlobs)
{
  for (unsigned seed = 0; seed < 20; ++seed)
  {
    const int blobs = 2 + seed % 6;
    const std::vector<double> points = Blobs(blobs, 200, 3, 0.5, seed);
    const KMeansResult result = KMeans(View(points, 3), blobs, {}, Execution());
    ASSERT_EQ(result.Clusters, blobs);
    // The variance within a blob is 3 x 0.25 a point.
    EXPECT_NEAR(result.Inertia / (blobs * 200), 0.75, 0.15);
    EXPECT_NEAR(result.Inertia, Inertia(View(points, 3), result.Centres), 1e-9 * result.Inertia);
  }
}

// At a fixed point every centre is the mean of its points.
TEST(KMeans, EndsWithMeans)
{
  const std::vector<double> points = Blobs(3, 500, 2, 6.0, 1);
  const PointRows rows = View(points, 2);
  const KMeansResult result = KMeans(rows, 5, { 3, 1000, 7 }, Execution());
  std::vector<double> sums(10, 0.0), counts(5, 0.0);
  for (Index i = 0; i < rows.Count; ++i)
  {
    const int c = NearestCentre(rows.Row(i), 2, result.Centres);
    counts[c] += 1.0;
    sums[2 * c] += rows.Row(i)[0];
    sums[2 * c + 1] += rows.Row(i)[1];
  }
  for (int c = 0; c < 5; ++c)
  {
    EXPECT_NEAR(result.Centres[2 * c], sums[2 * c] / counts[c], 1e-9);
    EXPECT_NEAR(result.Centres[2 * c + 1], sums[2 * c + 1] / counts[c], 1e-9);
  }
}

TEST(KMeans, HasNoMoreClustersThanDistinctPoints)
{
  std::vector<double> points;
  for (int i = 0; i < 300; ++i)
  {
    points.push_back(i % 3);
  }
  const KMeansResult result = KMeans(View(points, 1), 7, {}, Execution());
  EXPECT_EQ(result.Clusters, 3);
  EXPECT_EQ(result.Inertia, 0.0);
  EXPECT_EQ(KMeans(View({ 4.0, 4.0 }, 2), 2, {}, Execution()).Clusters, 1);
}

TEST(KMeans, MoreRestartsAreNoWorse)
{
  const std::vector<double> points = Blobs(7, 60, 2, 1.5, 2);
  double before = std::numeric_limits<double>::infinity();
  for (int restarts = 1; restarts <= 8; restarts *= 2)
  {
    const double inertia = KMeans(View(points, 2), 7, { restarts, 100, 3 }, Execution()).Inertia;
    EXPECT_LE(inertia, before);
    before = inertia;
  }
}

TEST(KMeans, DoesNotDependOnThreads)
{
  const std::vector<double> points = Blobs(4, 1111, 5, 4.0, 3);
  const KMeansResult one = KMeans(View(points, 5), 6, {}, Execution());
  for (const int threads : { 2, 3, 7 })
  {
    const KMeansResult other = KMeans(View(points, 5), 6, {}, ThreadedExecution(threads));
    EXPECT_EQ(one.Centres, other.Centres);
    EXPECT_EQ(one.Inertia, other.Inertia);
    EXPECT_EQ(SimplifiedSilhouette(View(points, 5), one.Centres, Execution()),
      SimplifiedSilhouette(View(points, 5), one.Centres, ThreadedExecution(threads)));
  }
}

TEST(KMeans, RefusesWhatIsNoPoint)
{
  const std::vector<double> bad = { 1.0, std::numeric_limits<double>::quiet_NaN() };
  EXPECT_THROW(KMeans(View(bad, 1), 1, {}, Execution()), std::invalid_argument);
  EXPECT_THROW(KMeans(View({}, 1), 1, {}, Execution()), std::invalid_argument);
  EXPECT_THROW(KMeans(View({ 1.0 }, 1), 0, {}, Execution()), std::invalid_argument);
}

//------------------------------------------------------------------------------
TEST(SimplifiedSilhouette, IsBestForTheTrueNumber)
{
  const std::vector<double> points = Blobs(5, 200, 2, 0.6, 4);
  int best = 0;
  double most = 0.0;
  for (int k = 2; k <= 8; ++k)
  {
    const KMeansResult result = KMeans(View(points, 2), k, {}, Execution());
    const double s = SimplifiedSilhouette(View(points, 2), result.Centres, Execution());
    EXPECT_TRUE(s >= 0.0 && s <= 1.0);
    best = s > most ? k : best;
    most = std::max(most, s);
  }
  EXPECT_EQ(best, 5);
  // By hand: distances 1 and 3, then 0 and 4, to the nearest and the second centre.
  EXPECT_NEAR(SimplifiedSilhouette(View({ 1.0, 4.0 }, 1), { 0.0, 4.0 }, Execution()),
    0.5 * (2.0 / 3.0 + 1.0), 1e-15);
  EXPECT_EQ(SimplifiedSilhouette(View({ 1.0, 4.0 }, 1), { 0.0 }, Execution()), 0.0);
}
