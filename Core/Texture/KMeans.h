// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * k-means with k-means++ seeding, the same numbers on every run, machine and number of threads.
 *
 * Random numbers come from a generator of our own with a fixed seed, and sums are taken in a fixed
 * order: block by block, then over the blocks.
 *
 * Reference: D. Arthur, S. Vassilvitskii. k-means++: the advantages of careful seeding. SODA 2007.
 */
#ifndef trivariate_KMeans_h
#define trivariate_KMeans_h

#include "Execution.h"

#include <cstdint>
#include <vector>

namespace trivariate
{
/// Points by rows; a view, nothing is copied.
struct PointRows
{
  Index Count = 0;
  int Dimensions = 0;
  const double* Values = nullptr;

  const double* Row(Index i) const { return this->Values + i * this->Dimensions; }
};

struct KMeansOptions
{
  int Restarts = 8;            ///< the best of so many seedings counts; 1 or more
  int MaximumIterations = 100; ///< of Lloyd's algorithm, for each seeding
  std::uint64_t Seed = 1;
};

struct KMeansResult
{
  int Clusters = 0;            ///< fewer than asked for when there are fewer distinct points
  std::vector<double> Centres; ///< by rows, in no particular order
  double Inertia = 0.0;        ///< sum of squared distances to the nearest centre
};

/// The centre nearest to a point; the first of equally near ones.
int NearestCentre(const double* point, int dimensions, const std::vector<double>& centres);

/**
 * The best of several runs. Throws std::invalid_argument for fewer than one cluster, no points, or
 * a number that is not finite.
 * Cost: restarts x iterations x points x clusters x dimensions; 16 bytes a point beside the points.
 */
KMeansResult KMeans(
  const PointRows& points, int clusters, const KMeansOptions& options, const Execution& execution);

/**
 * How well separated the clusters are: the mean over the points of (b - a) / max(a, b), where a and
 * b are the distances to the nearest and the second nearest centre; 0 to 1, the larger the better,
 * 0 for a single cluster. This is the silhouette with centres in place of all points (Hruschka, de
 * Castro, Campello. Evolutionary algorithms for clustering gene-expression data. ICDM 2004).
 */
double SimplifiedSilhouette(
  const PointRows& points, const std::vector<double>& centres, const Execution& execution);
}

#endif
