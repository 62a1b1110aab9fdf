// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "KMeans.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace trivariate
{
namespace
{
constexpr Index BLOCK = 512; // points whose sums are taken together, whatever the threads

// Steele, Lea, Flood. Fast splittable pseudorandom number generators. OOPSLA 2014.
struct Generator
{
  std::uint64_t State;

  double operator()() // in [0, 1)
  {
    std::uint64_t z = this->State += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
  }
};

double SquaredDistance(const double* a, const double* b, int dimensions)
{
  double sum = 0.0;
  for (int d = 0; d < dimensions; ++d)
  {
    sum += (a[d] - b[d]) * (a[d] - b[d]);
  }
  return sum;
}

void ForBlocks(
  Index count, const Execution& execution, const std::function<void(Index, Index, Index)>& body)
{
  execution.ParallelFor((count + BLOCK - 1) / BLOCK,
    [count, &body](Index begin, Index end)
    {
      for (Index b = begin; b < end; ++b)
      {
        body(b, b * BLOCK, std::min(count, (b + 1) * BLOCK));
      }
    });
}

//------------------------------------------------------------------------------
class Run
{
public:
  Run(const PointRows& points, const Execution& execution)
    : Points(points)
    , Execute(execution)
    , Distances(points.Count)
    , Nearest(points.Count)
  {
  }

  // Each further centre is drawn with a probability proportional to the squared distance to the
  // centres so far; none when every point is a centre.
  void Seed(int clusters, Generator& random)
  {
    this->Centres.clear();
    std::fill(
      this->Distances.begin(), this->Distances.end(), std::numeric_limits<double>::infinity());
    this->AddCentre(static_cast<Index>(random() * this->Points.Count));
    while (this->Clusters() < clusters)
    {
      double total = 0.0;
      for (const double distance : this->Distances)
      {
        total += distance;
      }
      if (total <= 0.0)
      {
        return;
      }
      double left = random() * total;
      Index chosen = -1;
      for (Index i = 0; i < this->Points.Count && (chosen < 0 || left > 0.0); ++i)
      {
        left -= this->Distances[i];
        chosen = this->Distances[i] > 0.0 ? i : chosen;
      }
      this->AddCentre(chosen);
    }
  }

  // Lloyd's algorithm, until no point changes its cluster.
  void Iterate(int maximum)
  {
    std::fill(this->Nearest.begin(), this->Nearest.end(), -1);
    Index changes = this->Assign();
    for (int i = 0; i < maximum && changes > 0; ++i)
    {
      this->MoveCentres();
      changes = this->Assign();
    }
  }

  double Inertia() const
  {
    double total = 0.0;
    for (const double distance : this->Distances)
    {
      total += distance;
    }
    return total;
  }

  int Clusters() const
  {
    return static_cast<int>(this->Centres.size()) / std::max(1, this->Points.Dimensions);
  }

  std::vector<double> Centres;

private:
  void AddCentre(Index point)
  {
    const int dimensions = this->Points.Dimensions;
    const double* row = this->Points.Row(point);
    this->Centres.insert(this->Centres.end(), row, row + dimensions);
    ForBlocks(this->Points.Count, this->Execute,
      [this, row, dimensions](Index, Index begin, Index end)
      {
        for (Index i = begin; i < end; ++i)
        {
          this->Distances[i] =
            std::min(this->Distances[i], SquaredDistance(this->Points.Row(i), row, dimensions));
        }
      });
  }

  // The number of points that have changed their cluster.
  Index Assign()
  {
    const int dimensions = this->Points.Dimensions;
    std::vector<Index> changes((this->Points.Count + BLOCK - 1) / BLOCK, 0);
    ForBlocks(this->Points.Count, this->Execute,
      [&](Index block, Index begin, Index end)
      {
        for (Index i = begin; i < end; ++i)
        {
          const double* row = this->Points.Row(i);
          const int nearest = NearestCentre(row, dimensions, this->Centres);
          this->Distances[i] =
            SquaredDistance(row, &this->Centres[nearest * dimensions], dimensions);
          changes[block] += nearest != this->Nearest[i];
          this->Nearest[i] = nearest;
        }
      });
    Index total = 0;
    for (const Index change : changes)
    {
      total += change;
    }
    return total;
  }

  // To the means of their points. A centre that has lost all of its points goes to the point that
  // is farthest from its own.
  void MoveCentres()
  {
    const int dimensions = this->Points.Dimensions, clusters = this->Clusters();
    const Index blocks = (this->Points.Count + BLOCK - 1) / BLOCK;
    const Index stride = static_cast<Index>(clusters) * (dimensions + 1);
    std::vector<double> sums(blocks * stride, 0.0); // a block's sum and count of each cluster
    ForBlocks(this->Points.Count, this->Execute,
      [&](Index block, Index begin, Index end)
      {
        for (Index i = begin; i < end; ++i)
        {
          double* sum = &sums[block * stride + this->Nearest[i] * (dimensions + 1)];
          const double* row = this->Points.Row(i);
          for (int d = 0; d < dimensions; ++d)
          {
            sum[d] += row[d];
          }
          sum[dimensions] += 1.0;
        }
      });
    for (Index block = 1; block < blocks; ++block)
    {
      for (Index s = 0; s < stride; ++s)
      {
        sums[s] += sums[block * stride + s];
      }
    }
    for (int c = 0; c < clusters; ++c)
    {
      const double* sum = &sums[c * (dimensions + 1)];
      double* centre = &this->Centres[c * dimensions];
      if (sum[dimensions] > 0.0)
      {
        std::transform(sum, sum + dimensions, centre,
          [sum, dimensions](double s) { return s / sum[dimensions]; });
        continue;
      }
      const auto farthest = std::max_element(this->Distances.begin(), this->Distances.end());
      const double* row = this->Points.Row(farthest - this->Distances.begin());
      std::copy(row, row + dimensions, centre);
      *farthest = 0.0;
    }
  }

  const PointRows& Points;
  const Execution& Execute;
  std::vector<double> Distances; // squared, to the nearest centre
  std::vector<int> Nearest;
};
}

//------------------------------------------------------------------------------
int NearestCentre(const double* point, int dimensions, const std::vector<double>& centres)
{
  int nearest = 0;
  double best = std::numeric_limits<double>::infinity();
  const int clusters = static_cast<int>(centres.size()) / std::max(1, dimensions);
  for (int c = 0; c < clusters; ++c)
  {
    const double distance = SquaredDistance(point, &centres[c * dimensions], dimensions);
    if (distance < best)
    {
      best = distance;
      nearest = c;
    }
  }
  return nearest;
}

//------------------------------------------------------------------------------
KMeansResult KMeans(
  const PointRows& points, int clusters, const KMeansOptions& options, const Execution& execution)
{
  if (clusters < 1 || points.Count < 1 || points.Dimensions < 1)
  {
    throw std::invalid_argument("k-means needs a cluster, a point and a coordinate");
  }
  if (!std::all_of(points.Values, points.Values + points.Count * points.Dimensions,
        [](double value) { return std::isfinite(value); }))
  {
    throw std::invalid_argument("k-means needs finite numbers");
  }
  KMeansResult best;
  Run run(points, execution);
  Generator random{ options.Seed };
  for (int restart = 0; restart < std::max(1, options.Restarts); ++restart)
  {
    execution.Check(static_cast<double>(restart) / std::max(1, options.Restarts));
    run.Seed(clusters, random);
    run.Iterate(options.MaximumIterations);
    const double inertia = run.Inertia();
    if (best.Clusters == 0 || inertia < best.Inertia)
    {
      best = { run.Clusters(), run.Centres, inertia };
    }
  }
  return best;
}

//------------------------------------------------------------------------------
double SimplifiedSilhouette(
  const PointRows& points, const std::vector<double>& centres, const Execution& execution)
{
  const int dimensions = points.Dimensions;
  const int clusters = static_cast<int>(centres.size()) / std::max(1, dimensions);
  if (clusters < 2 || points.Count == 0)
  {
    return 0.0;
  }
  std::vector<double> sums((points.Count + BLOCK - 1) / BLOCK, 0.0);
  ForBlocks(points.Count, execution,
    [&](Index block, Index begin, Index end)
    {
      for (Index i = begin; i < end; ++i)
      {
        double first = std::numeric_limits<double>::infinity(), second = first;
        for (int c = 0; c < clusters; ++c)
        {
          const double d = SquaredDistance(points.Row(i), &centres[c * dimensions], dimensions);
          second = std::min(second, std::max(first, d));
          first = std::min(first, d);
        }
        sums[block] += second > 0.0 ? 1.0 - std::sqrt(first / second) : 0.0;
      }
    });
  double total = 0.0;
  for (const double sum : sums)
  {
    total += sum;
  }
  return total / points.Count;
}
}
