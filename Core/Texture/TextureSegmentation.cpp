// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "TextureSegmentation.h"

#include "Boundary/SegmentShells.h"
#include "InterfacePlacement.h"
#include "PieceVolume.h"
#include "SegmentAttributes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace trivariate
{
namespace
{
// Clusters are sought anew within the segments so far if so many sampled voxels are well inside.
constexpr Index LEAST_SURE_SAMPLES = 200;
// Differences of the criterion that say nothing.
constexpr double AS_GOOD = 0.01;

//------------------------------------------------------------------------------
// The sample's rows before smoothing as the feature space wants them; of the sure voxels only, if
// there is a mask of the volume.
struct FeatureRows
{
  std::vector<double> Rows, Left, Right;

  FeatureRows(const AttributeSample& sample, int attributes, Index lag, const Size3& whole,
    const std::vector<std::uint8_t>& sure, const std::vector<Label>& labels)
  {
    const Index steps[3] = { lag, lag * whole[0], lag * whole[0] * whole[1] };
    for (std::size_t i = 0; i < sample.Keys.size(); ++i)
    {
      const Index key = sample.Keys[i];
      const double* row = &sample.Rows[4 * i * attributes];
      if (!sure.empty() && !sure[key])
      {
        continue;
      }
      this->Rows.insert(this->Rows.end(), row, row + attributes);
      for (int axis = 0; axis < 3; ++axis)
      {
        const double* partner = row + (axis + 1) * attributes;
        if (std::isnan(partner[0]) ||
            (!sure.empty() &&
              (!sure[key + steps[axis]] || labels[key + steps[axis]] != labels[key])))
        {
          continue;
        }
        this->Left.insert(this->Left.end(), row, row + attributes);
        this->Right.insert(this->Right.end(), partner, partner + attributes);
      }
    }
  }
};

PointRows View(const std::vector<double>& values, int dimensions)
{
  return { static_cast<Index>(values.size()) / std::max(1, dimensions), dimensions, values.data() };
}

//------------------------------------------------------------------------------
class Segmentation
{
public:
  Segmentation(const SegmentationPiece& piece, const SegmentationOptions& options,
    const GatherBytes& gather, const Execution& execution)
    : Piece(piece)
    , Options(options)
    , Gather(gather)
    , Execute(execution)
    , Attributes(piece, options, execution.Part(0.0, 0.6))
  {
  }

  SegmentationResult Run()
  {
    if (this->Options.KeepAttributes)
    {
      this->Result.Attributes = this->Attributes.OwnTexture();
    }
    this->Result.AttributeNames = this->Attributes.Names();
    this->Levels = GatherVolume(this->Piece, this->OwnLevels(), this->Gather);
    this->Raw = this->Attributes.Sample(true, this->Gather);
    this->Measure({}, {});
    if (this->Space.Dimensions == 0)
    {
      this->Labels.assign(Volume(this->Piece.Whole), 0); // nothing varies: one segment
      this->Clusters = 1;
    }
    else
    {
      this->Attributes.Smooth(this->Space, this->Execute.Part(0.6, 0.7));
      this->Smooth = this->Attributes.Sample(false, this->Gather);
      this->Cluster({});
      this->Clean(this->Execute.Part(0.75, 0.85));
      this->Retry();
    }
    this->Number();
    return std::move(this->Result);
  }

private:
  std::vector<std::uint8_t> OwnLevels() const
  {
    const Size3 own = OwnSize(this->Piece);
    std::vector<std::uint8_t> levels(std::max<Index>(0, Volume(own)));
    ForOwnRows(this->Piece, [&](Index place, Index inPiece, Index)
      { std::copy_n(&this->Piece.Levels[inPiece], own[0], &levels[place]); });
    return levels;
  }

  // The space in which attributes are compared.
  void Measure(const std::vector<std::uint8_t>& sure, const std::vector<Label>& labels)
  {
    const int n = this->Attributes.Count();
    const FeatureRows rows(
      this->Raw, n, SegmentAttributes::Lag(this->Options.Texture), this->Piece.Whole, sure, labels);
    this->Space = MakeFeatureSpace(
      { View(rows.Rows, n), View(rows.Left, n), View(rows.Right, n), this->Attributes.Weights() });
  }

  // Clusters of the sample, or of its sure voxels, then labels of all voxels.
  void Cluster(const std::vector<std::uint8_t>& sure)
  {
    const int n = this->Attributes.Count(), dimensions = this->Space.Dimensions;
    std::vector<double> points, point(dimensions);
    for (std::size_t i = 0; i < this->Smooth.Keys.size(); ++i)
    {
      if (sure.empty() || sure[this->Smooth.Keys[i]])
      {
        this->Space.Apply(&this->Smooth.Rows[i * n], point.data());
        points.insert(points.end(), point.begin(), point.end());
      }
    }
    const KMeansResult clusters = this->Choose(View(points, dimensions));
    this->Clusters = clusters.Clusters;
    this->Centres = clusters.Centres;

    const Size3 own = OwnSize(this->Piece);
    std::vector<Label> mine(std::max<Index>(0, Volume(own)));
    const auto nearest = [&](Index begin, Index end)
    {
      std::vector<double> row(n), coordinates(dimensions);
      for (Index line = begin; line < end; ++line)
      {
        for (Index i = 0; i < own[0]; ++i)
        {
          this->Attributes.Row(i, line % own[1], line / own[1], row.data());
          this->Space.Apply(row.data(), coordinates.data());
          mine[i + own[0] * line] =
            static_cast<Label>(NearestCentre(coordinates.data(), dimensions, this->Centres));
        }
      }
    };
    const Index lines = own[1] * own[2], atOnce = (1 << 20) / std::max<Index>(1, own[0]) + 1;
    for (Index start = 0; start < lines; start += atOnce) // so that it can be stopped
    {
      this->Execute.Check(0.75);
      this->Execute.ParallelFor(std::min(atOnce, lines - start),
        [&](Index begin, Index end) { nearest(start + begin, start + end); });
    }
    this->Labels = GatherVolume(this->Piece, mine, this->Gather);
  }

  KMeansResult Choose(const PointRows& points)
  {
    const Execution part = this->Execute.Part(0.7, 0.75);
    if (this->Options.Segments > 0)
    {
      KMeansResult result = KMeans(points, this->Options.Segments, {}, part);
      this->Result.Criterion = { { result.Clusters,
        SimplifiedSilhouette(points, result.Centres, part) } };
      return result;
    }
    std::vector<KMeansResult> tried;
    double most = 0.0;
    for (int k = 2; k <= MaximumAutomaticSegments; ++k)
    {
      tried.push_back(KMeans(points, k, {}, part));
      if (tried.back().Clusters < k && k > 2)
      {
        tried.pop_back(); // there are no more distinct points
        break;
      }
      const double criterion = SimplifiedSilhouette(points, tried.back().Centres, part);
      this->Result.Criterion.push_back({ tried.back().Clusters, criterion });
      most = std::max(most, criterion);
    }
    // The fewest of those that are as good as the best.
    std::size_t chosen = 0;
    while (this->Result.Criterion[chosen].second < most - AS_GOOD)
    {
      ++chosen;
    }
    return tried[chosen];
  }

  // Shells, interfaces and small components.
  void Clean(const Execution& execution)
  {
    const Size3& size = this->Piece.Whole;
    const int radius = this->Options.Texture.Radius;
    const Index window = 2 * radius + 1;
    const Index minimum = this->Options.MinimumSegmentSize > 0 ? this->Options.MinimumSegmentSize
                                                               : window * window * window;
    const PointRows centres = View(this->Centres, this->Space.Dimensions);
    MergeSmallComponents(this->Labels, size, minimum);
    execution.Check(0.0);
    RemoveShells(this->Labels, size, centres, (radius + 1) / 2, execution);
    execution.Check(0.0);
    PlacementOptions placement;
    placement.GreyLevels = this->Options.Texture.GreyLevels;
    placement.Reach = radius;
    PlaceInterfaces(this->Labels, this->Levels, size, this->Clusters, placement, execution);
    execution.Check(1.0);
    RemoveShells(this->Labels, size, centres, 1, execution);
    execution.Check(1.0);
    MergeSmallComponents(this->Labels, size, minimum);
  }

  int Present() const
  {
    std::array<bool, 256> present = {};
    for (const Label label : this->Labels)
    {
      present[label] = true;
    }
    return static_cast<int>(std::count(present.begin(), present.end(), true));
  }

  // A cluster of mixtures has taken the place of a segment: look for it away from interfaces.
  void Retry()
  {
    const int found = this->Present();
    if (this->Options.Segments == 0 || found == this->Clusters)
    {
      return;
    }
    const int radius = this->Options.Texture.Radius;
    std::vector<std::uint8_t> sure =
      NearInterfaces(this->Labels, this->Piece.Whole, 2 * radius, this->Execute);
    std::transform(sure.begin(), sure.end(), sure.begin(),
      [](std::uint8_t near) { return static_cast<std::uint8_t>(!near); });
    if (std::count_if(this->Raw.Keys.begin(), this->Raw.Keys.end(),
          [&sure](Index key) { return sure[key] != 0; }) < LEAST_SURE_SAMPLES)
    {
      return;
    }
    const std::vector<Label> before = this->Labels;
    const FeatureSpace spaceBefore = this->Space;
    this->Measure(sure, before);
    if (this->Space.Dimensions > 0)
    {
      this->Cluster(sure);
      this->Clean(this->Execute.Part(0.85, 0.98));
    }
    if (this->Space.Dimensions == 0 || this->Present() <= found)
    {
      this->Space = spaceBefore;
      this->Labels = before;
    }
  }

  // Labels by ascending mean density. Sums are of integers, so that their order does not matter.
  void Number()
  {
    const Size3 own = OwnSize(this->Piece);
    std::array<Index, 256> sizes = {};
    for (const Label label : this->Labels)
    {
      ++sizes[label];
    }
    const std::vector<double> means = this->MeanDensities(sizes);
    std::vector<int> order;
    for (int l = 0; l < 256; ++l)
    {
      if (sizes[l] > 0)
      {
        order.push_back(l);
      }
    }
    std::stable_sort(
      order.begin(), order.end(), [&means](int a, int b) { return means[a] < means[b]; });
    std::array<Label, 256> rank = {};
    for (std::size_t s = 0; s < order.size(); ++s)
    {
      rank[order[s]] = static_cast<Label>(s);
      this->Result.Sizes.push_back(sizes[order[s]]);
      this->Result.MeanDensities.push_back(means[order[s]]);
    }
    this->Result.Segments = static_cast<int>(order.size());
    this->Result.Labels.resize(std::max<Index>(0, Volume(own)));
    ForOwnRows(this->Piece,
      [&](Index place, Index, Index inVolume)
      {
        std::transform(&this->Labels[inVolume], &this->Labels[inVolume] + own[0],
          &this->Result.Labels[place], [&rank](Label label) { return rank[label]; });
      });
    this->MeanAttributes(rank);
  }

  // Of each label, to 1e-9 of the range of the sample.
  std::vector<double> MeanDensities(const std::array<Index, 256>& sizes) const
  {
    struct Bounds
    {
      float Low = std::numeric_limits<float>::infinity();
      float High = -std::numeric_limits<float>::infinity();
    } mine;
    const Size3 own = OwnSize(this->Piece);
    ForOwnRows(this->Piece,
      [&](Index, Index inPiece, Index)
      {
        const float* row = &this->Piece.Density[inPiece];
        mine.Low = std::min(mine.Low, *std::min_element(row, row + own[0]));
        mine.High = std::max(mine.High, *std::max_element(row, row + own[0]));
      });
    Bounds range;
    for (const Bounds& bounds : GatherAll(this->Gather, std::vector<Bounds>{ mine }))
    {
      range.Low = std::min(range.Low, bounds.Low);
      range.High = std::max(range.High, bounds.High);
    }
    const double width = static_cast<double>(range.High) - range.Low;
    const double unit = width > 0.0 ? 0x1p30 / width : 0.0;
    const std::vector<PieceBox> boxes =
      GatherAll(this->Gather, std::vector<PieceBox>{ OwnBox(this->Piece) });
    std::vector<std::int64_t> sums(256, 0);
    ForOwnRows(this->Piece,
      [&](Index, Index inPiece, Index inVolume)
      {
        for (Index i = 0; i < own[0]; ++i)
        {
          // A voxel of several pieces counts in the first of them.
          const bool counted = std::any_of(boxes.begin(), boxes.begin() + this->Piece.Process,
            [&](const PieceBox& box) { return box.Has(inVolume + i, this->Piece.Whole); });
          if (!counted)
          {
            sums[this->Labels[inVolume + i]] += std::llround(
              (static_cast<double>(this->Piece.Density[inPiece + i]) - range.Low) * unit);
          }
        }
      });
    const std::vector<std::int64_t> all = GatherAll(this->Gather, sums);
    std::vector<double> means(256, 0.0);
    for (int l = 0; l < 256; ++l)
    {
      std::int64_t sum = 0;
      for (std::size_t at = 0; at < all.size(); at += sums.size())
      {
        sum += all[at + l];
      }
      means[l] = sizes[l] > 0 && unit > 0.0
                   ? range.Low + static_cast<double>(sum) / static_cast<double>(sizes[l]) / unit
                   : range.Low;
    }
    return means;
  }

  // Mean rows of the sampled voxels of each segment.
  void MeanAttributes(const std::array<Label, 256>& rank)
  {
    const int n = this->Attributes.Count();
    const AttributeSample& sample = this->Smooth.Keys.empty() ? this->Raw : this->Smooth;
    const std::size_t stride = sample.Keys.empty() ? 0 : sample.Rows.size() / sample.Keys.size();
    this->Result.Centres.assign(static_cast<std::size_t>(this->Result.Segments) * n, 0.0);
    std::vector<double> counts(this->Result.Segments, 0.0);
    for (std::size_t i = 0; i < sample.Keys.size(); ++i)
    {
      const Label segment = rank[this->Labels[sample.Keys[i]]];
      counts[segment] += 1.0;
      for (int a = 0; a < n; ++a)
      {
        this->Result.Centres[segment * n + a] += sample.Rows[i * stride + a];
      }
    }
    for (int s = 0; s < this->Result.Segments; ++s)
    {
      for (int a = 0; a < n; ++a)
      {
        // NaN: so small that no voxel of it was sampled.
        this->Result.Centres[s * n + a] /= counts[s];
      }
    }
  }

  const SegmentationPiece& Piece;
  const SegmentationOptions& Options;
  const GatherBytes& Gather;
  const Execution& Execute;
  SegmentAttributes Attributes;
  AttributeSample Raw, Smooth; // the sample before smoothing (with partners) and after
  FeatureSpace Space;
  std::vector<double> Centres; // of the clusters, in the space
  int Clusters = 0;
  std::vector<std::uint8_t> Levels; // of the whole volume
  std::vector<Label> Labels;        // of the whole volume
  SegmentationResult Result;
};

//------------------------------------------------------------------------------
void Check(const SegmentationPiece& piece, const SegmentationOptions& options)
{
  if (options.Segments < 0 || options.Segments > MaximumSegments)
  {
    throw std::invalid_argument("the number of segments is not in range");
  }
  if (Volume(piece.Whole) > std::numeric_limits<std::int32_t>::max())
  {
    throw std::length_error("more than 2^31 - 1 voxels");
  }
  if (!(options.DensityWeight >= 0.0) || !(options.GradientWeight >= 0.0) ||
      (options.Texture.Attributes.empty() && options.DensityWeight == 0.0 &&
        options.GradientWeight == 0.0))
  {
    throw std::invalid_argument("there is no attribute to tell segments by");
  }
}
}

//------------------------------------------------------------------------------
int SegmentationNeighbourhood(const SegmentationOptions& options)
{
  return options.Texture.Radius + SegmentAttributes::Lag(options.Texture);
}

SegmentationResult SegmentByTexture(const SegmentationPiece& piece,
  const SegmentationOptions& options, const GatherBytes& gather, const Execution& execution)
{
  Check(piece, options);
  return Segmentation(piece, options, gather, execution).Run();
}
}
