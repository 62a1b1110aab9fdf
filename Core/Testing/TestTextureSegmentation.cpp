// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "TexturePhantoms.h"
#include "ThreadedExecution.h"

#include <gtest/gtest.h>

#include <condition_variable>
#include <mutex>
#include <numeric>
#include <set>
#include <thread>

using namespace trivariate;

namespace
{
SegmentationOptions Wanted(int segments, bool range = false)
{
  SegmentationOptions options;
  options.Segments = segments;
  options.Texture.Range = range;
  return options;
}

// Both ways: every interface found is near a true one, every true one near one that was found.
void ExpectInterfaces(
  const Phantom& phantom, const SegmentationResult& result, double mean, double most95)
{
  const InterfaceDistance found = DistanceOfInterfaces(result.Labels, phantom.Truth, phantom.Size);
  const InterfaceDistance missed = DistanceOfInterfaces(phantom.Truth, result.Labels, phantom.Size);
  EXPECT_LE(found.Mean, mean);
  EXPECT_LE(missed.Mean, mean);
  EXPECT_LE(found.Percentile95, most95);
  EXPECT_LE(missed.Percentile95, most95);
  std::printf("  ARI %.4f, from found to true mean %.2f, 95 %% %.2f, most %.2f; "
              "from true to found %.2f, %.2f, %.2f\n",
    AdjustedRandIndex(phantom.Truth, result.Labels), found.Mean, found.Percentile95, found.Maximum,
    missed.Mean, missed.Percentile95, missed.Maximum);
}

// Neither the values nor their gradients tell the regions.
void ExpectHidden(const Phantom& phantom, int segments)
{
  EXPECT_LT(RandIndexOfKMeans(phantom, phantom.Density, segments), 0.2);
  EXPECT_LT(RandIndexOfKMeans(phantom, CentralGradients(phantom), segments), 0.2);
}

//------------------------------------------------------------------------------
// Threads that play processes: each waits for the bytes of all.
class Processes
{
public:
  explicit Processes(int count)
    : Mine(count)
  {
  }

  GatherBytes GatherOf(int process)
  {
    return [this, process](const std::vector<std::uint8_t>& mine)
    {
      std::unique_lock<std::mutex> lock(this->Mutex);
      this->Mine[process] = mine;
      this->Meet(lock);
      std::vector<std::uint8_t> all;
      for (const std::vector<std::uint8_t>& bytes : this->Mine)
      {
        all.insert(all.end(), bytes.begin(), bytes.end());
      }
      this->Meet(lock);
      return all;
    };
  }

private:
  void Meet(std::unique_lock<std::mutex>& lock)
  {
    const int meeting = this->Meetings;
    if (++this->Arrived == static_cast<int>(this->Mine.size()))
    {
      this->Arrived = 0;
      ++this->Meetings;
      this->Everybody.notify_all();
    }
    this->Everybody.wait(lock, [this, meeting]() { return this->Meetings != meeting; });
  }

  std::mutex Mutex;
  std::condition_variable Everybody;
  std::vector<std::vector<std::uint8_t>> Mine;
  int Arrived = 0, Meetings = 0;
};

// The part of a piece that holds the voxels from low to high along z and the neighbourhood.
SegmentationPiece Slab(const SegmentationPiece& whole, Index low, Index high, Index neighbourhood)
{
  SegmentationPiece piece = whole;
  const Index first = std::max<Index>(0, low - neighbourhood);
  const Index last = std::min(whole.Size[2], high + neighbourhood);
  const Index slice = whole.Size[0] * whole.Size[1];
  piece.Low[2] = first;
  piece.Size[2] = last - first;
  piece.Begin[2] = low - first;
  piece.End[2] = high - first;
  piece.Density.assign(whole.Density.begin() + first * slice, whole.Density.begin() + last * slice);
  piece.Levels.assign(whole.Levels.begin() + first * slice, whole.Levels.begin() + last * slice);
  return piece;
}
}

//------------------------------------------------------------------------------
TEST(TextureSegmentation, FindsConstantMaterialsUnderNoise)
{
  // The noise is 0.1, then 0.4 of the step: density alone is right in 16 % fewer voxels then.
  for (const double noise : { 0.1, 0.4 })
  {
    const Phantom phantom = MakePhantom(40, Ball, { { 0.0 }, { 1.0 } }, noise, 1);
    const SegmentationResult result = Segment(phantom, Wanted(2));
    EXPECT_GE(AdjustedRandIndex(phantom.Truth, result.Labels), noise < 0.2 ? 0.999 : 0.98);
    ExpectInterfaces(phantom, result, 0.15, 1.0);
  }
}

TEST(TextureSegmentation, TellsCheckeredFromLayered)
{
  for (const Region& region : { Region(Ball), Region(BoxRegion) })
  {
    const Phantom phantom =
      MakePhantom(44, region, { { 0.0, "checkered" }, { 0.0, "layered z" } }, 0.0, 2);
    ExpectHidden(phantom, 2);
    const SegmentationResult result = Segment(phantom, Wanted(2));
    EXPECT_GE(AdjustedRandIndex(phantom.Truth, result.Labels), 0.97);
    ExpectInterfaces(phantom, result, 0.25, 1.0);
  }
}

TEST(TextureSegmentation, TellsNoiseByItsCorrelationLength)
{
  const Phantom phantom =
    MakePhantom(72, Ball, { { 0.0, "fine noise" }, { 0.0, "coarse noise" } }, 0.0, 3);
  ExpectHidden(phantom, 2);
  const SegmentationResult result = Segment(phantom, Wanted(2, true));
  EXPECT_GE(AdjustedRandIndex(phantom.Truth, result.Labels), 0.95);
  ExpectInterfaces(phantom, result, 0.6, 1.5);
}

TEST(TextureSegmentation, TellsGrainFromFibre)
{
  const Phantom phantom = MakePhantom(
    64, [](double x, double, double z) { return x + 0.3 * z > 0.1; },
    { { 0.0, "grain" }, { 0.0, "fibre z" } }, 0.0, 4);
  ExpectHidden(phantom, 2);
  const SegmentationResult result = Segment(phantom, Wanted(2, true));
  EXPECT_GE(AdjustedRandIndex(phantom.Truth, result.Labels), 0.95);
  ExpectInterfaces(phantom, result, 0.9, 2.5);
}

TEST(TextureSegmentation, TellsThreeTexturesThatMeet)
{
  const Phantom phantom = MakePhantom(
    48, Three, { { 0.0, "columns" }, { 0.0, "layered z" }, { 0.0, "checkered" } }, 0.0, 5);
  ExpectHidden(phantom, 3);
  const SegmentationResult result = Segment(phantom, Wanted(3));
  ASSERT_EQ(result.Segments, 3);
  EXPECT_GE(AdjustedRandIndex(phantom.Truth, result.Labels), 0.95);
  ExpectInterfaces(phantom, result, 0.5, 1.5);
}

//------------------------------------------------------------------------------
TEST(TextureSegmentation, TellsATextureFromItselfRotatedOnlyByDirections)
{
  const Phantom phantom =
    MakePhantom(40, Ball, { { 0.0, "layered z" }, { 0.0, "layered x" } }, 0.0, 6);
  ExpectHidden(phantom, 2);
  SegmentationOptions options = Wanted(2);
  options.Texture.Attributes = { TextureAttribute::Contrast, TextureAttribute::Correlation,
    TextureAttribute::AngularSecondMoment };
  EXPECT_LT(AdjustedRandIndex(phantom.Truth, Segment(phantom, options).Labels), 0.5);
  options.Texture.DirectionResolved = true;
  const SegmentationResult result = Segment(phantom, options);
  EXPECT_GE(AdjustedRandIndex(phantom.Truth, result.Labels), 0.95);
  ExpectInterfaces(phantom, result, 0.4, 1.0);
}

//------------------------------------------------------------------------------
// Where half of the way from one material to another is a third one's density, there is no shell of
// the third.
TEST(TextureSegmentation, LeavesNoShells)
{
  Phantom phantom = MakePhantom(
    48,
    [](double x, double y, double z)
    { return x * x + y * y + z * z > 0.5 ? 0 : (z > 0.0 ? 2 : 1); },
    { { 0.0 }, { 0.5 }, { 1.0 } }, 0.0, 7);
  // Partial volume: the mean of 2 x 2 x 2 voxels, then noise.
  const Phantom sharp = phantom;
  const Floats noise = WhiteNoise(static_cast<Index>(phantom.Density.size()), 8);
  ForVoxels(phantom.Size,
    [&](Index id, const Size3& p)
    {
      double sum = 0.0;
      int count = 0;
      for (int c = 0; c < 27; ++c)
      {
        const Size3 q = { p[0] + c % 3 - 1, p[1] + c / 3 % 3 - 1, p[2] + c / 9 - 1 };
        if (*std::min_element(q.begin(), q.end()) >= 0 &&
            *std::max_element(q.begin(), q.end()) < 48)
        {
          sum += sharp.Density[q[0] + 48 * (q[1] + 48 * q[2])];
          ++count;
        }
      }
      phantom.Density[id] = static_cast<float>(sum / count + 0.03 * noise[id]);
    });
  const SegmentationResult result = Segment(phantom, Wanted(3));
  ASSERT_EQ(result.Segments, 3);
  // Of the dense half ball's voxels at the surface, hardly any face the middle material.
  Index shell = 0, faces = 0;
  ForVoxels(phantom.Size,
    [&](Index id, const Size3& p)
    {
      if (p[2] < 32 && p[2] > 26 && p[0] > 0 && phantom.Truth[id] != phantom.Truth[id - 1])
      {
        ++faces;
        shell += result.Labels[id] == 1 || result.Labels[id - 1] == 1;
      }
    });
  EXPECT_GT(faces, 100);
  EXPECT_EQ(shell, 0);
  EXPECT_GT(AdjustedRandIndex(phantom.Truth, result.Labels),
    RandIndexOfKMeans(phantom, phantom.Density, 3) + 0.02);
  ExpectInterfaces(phantom, result, 0.3, 1.0);
}

//------------------------------------------------------------------------------
// An easy volume: three densities. Texture makes it no worse than density alone.
TEST(TextureSegmentation, IsNoWorseThanDensityOnEasyVolumes)
{
  const Phantom phantom = MakePhantom(40, Three, { { 0.0 }, { 1.0 }, { 2.0 } }, 0.15, 9);
  const SegmentationResult result = Segment(phantom, Wanted(3));
  const double index = AdjustedRandIndex(phantom.Truth, result.Labels);
  EXPECT_GE(index, RandIndexOfKMeans(phantom, phantom.Density, 3));
  EXPECT_GE(index, 0.995);
}

TEST(TextureSegmentation, ChoosesTheNumberOfSegments)
{
  const Phantom two =
    MakePhantom(40, Ball, { { 0.0, "checkered" }, { 0.0, "layered z" } }, 0.0, 10);
  const Phantom three = MakePhantom(40, Three, { { 0.0 }, { 1.0 }, { 2.0 } }, 0.1, 11);
  for (const auto& [phantom, segments] : { std::pair(two, 2), std::pair(three, 3) })
  {
    const SegmentationResult result = Segment(phantom, Wanted(0));
    EXPECT_EQ(result.Segments, segments);
    EXPECT_GE(AdjustedRandIndex(phantom.Truth, result.Labels), 0.95);
    ASSERT_GE(result.Criterion.size(), 3u);
    EXPECT_EQ(result.Criterion.front().first, 2);
    for (const auto& [k, criterion] : result.Criterion)
    {
      EXPECT_TRUE(criterion >= 0.0 && criterion <= 1.0) << k;
    }
  }
}

//------------------------------------------------------------------------------
TEST(TextureSegmentation, NumbersSegmentsByMeanDensity)
{
  const Phantom phantom = MakePhantom(32, Three, { { 5.0 }, { -3.0 }, { 1.0 } }, 0.1, 12);
  SegmentationOptions options = Wanted(3);
  options.KeepAttributes = true;
  options.GradientWeight = 0.1;
  const SegmentationResult result = Segment(phantom, options);
  ASSERT_EQ(result.Segments, 3);
  std::vector<double> sums(3, 0.0), counts(3, 0.0);
  for (std::size_t id = 0; id < result.Labels.size(); ++id)
  {
    sums[result.Labels[id]] += phantom.Density[id];
    counts[result.Labels[id]] += 1.0;
  }
  for (int s = 0; s < 3; ++s)
  {
    EXPECT_EQ(static_cast<double>(result.Sizes[s]), counts[s]);
    EXPECT_NEAR(result.MeanDensities[s], sums[s] / counts[s], 1e-6);
    EXPECT_NEAR(result.MeanDensities[s], 4.0 * s - 3.0, 0.05);
    const std::size_t density = result.AttributeNames.size() - 2;
    EXPECT_EQ(result.AttributeNames[density], "Density");
    EXPECT_NEAR(
      result.Centres[s * result.AttributeNames.size() + density], result.MeanDensities[s], 0.1);
  }
  ASSERT_EQ(result.Attributes.size(), TextureOutputNames(options.Texture).size());
  for (const Floats& attribute : result.Attributes)
  {
    ASSERT_EQ(attribute.size(), phantom.Density.size());
    EXPECT_GE(*std::min_element(attribute.begin(), attribute.end()), 0.0f);
    EXPECT_LE(*std::max_element(attribute.begin(), attribute.end()), 1.0f);
  }
}

TEST(TextureSegmentation, OfAConstantVolumeIsOneSegment)
{
  Phantom phantom = MakePhantom(12, Ball, { { 2.5 }, { 2.5 } }, 0.0, 13);
  for (const int segments : { 0, 1, 5 })
  {
    const SegmentationResult result = Segment(phantom, Wanted(segments));
    EXPECT_EQ(result.Segments, 1);
    EXPECT_EQ(result.Sizes, std::vector<Index>{ 12 * 12 * 12 });
    EXPECT_EQ(result.MeanDensities, std::vector<double>{ 2.5 });
  }
}

TEST(TextureSegmentation, RefusesWhatMakesNoSense)
{
  const Phantom phantom = MakePhantom(8, Ball, { { 0.0 }, { 1.0 } }, 0.0, 14);
  SegmentationOptions options = Wanted(65);
  EXPECT_THROW(Segment(phantom, options), std::invalid_argument);
  options = Wanted(-1);
  EXPECT_THROW(Segment(phantom, options), std::invalid_argument);
  options = Wanted(2);
  options.Texture.Attributes.clear();
  options.DensityWeight = 0.0;
  EXPECT_THROW(Segment(phantom, options), std::invalid_argument);
  SegmentationPiece huge = WholePiece(phantom, 16);
  huge.Whole = { 2048, 1024, 1024 };
  EXPECT_THROW(SegmentByTexture(huge, Wanted(2), OneProcess, Execution()), std::length_error);
}

//------------------------------------------------------------------------------
TEST(TextureSegmentation, DoesNotDependOnThreads)
{
  const Phantom phantom = MakePhantom(
    28, Three, { { 0.0, "fine noise" }, { 0.0, "layered z" }, { 1.0, "coarse noise" } }, 0.0, 15);
  const SegmentationPiece piece = WholePiece(phantom, 16);
  const SegmentationResult one = SegmentByTexture(piece, Wanted(0), OneProcess, Execution());
  for (const int threads : { 2, 5 })
  {
    const SegmentationResult other =
      SegmentByTexture(piece, Wanted(0), OneProcess, ThreadedExecution(threads));
    EXPECT_EQ(one.Labels, other.Labels);
    EXPECT_EQ(one.Centres, other.Centres);
    EXPECT_EQ(one.Criterion, other.Criterion);
  }
}

// Slabs that share a slice, and one process without any.
TEST(TextureSegmentation, DoesNotDependOnProcesses)
{
  const Phantom phantom = MakePhantom(
    36, Three, { { 0.0, "fine noise" }, { 0.0, "layered z" }, { 1.0, "coarse noise" } }, 0.0, 16);
  SegmentationOptions options = Wanted(3);
  options.GradientWeight = 0.5;
  const SegmentationPiece whole = WholePiece(phantom, options.Texture.GreyLevels);
  const SegmentationResult one = SegmentByTexture(whole, options, OneProcess, Execution());
  const Index slice = 36 * 36;
  for (const std::vector<Index>& cuts : { std::vector<Index>{ 0, 17, 35 }, { 0, 9, 9, 20, 35 } })
  {
    const int count = static_cast<int>(cuts.size()) - 1;
    Processes processes(count);
    std::vector<SegmentationResult> results(count);
    std::vector<std::thread> running;
    for (int p = 0; p < count; ++p)
    {
      running.emplace_back(
        [&, p]()
        {
          SegmentationPiece piece =
            Slab(whole, cuts[p], cuts[p + 1] + 1, SegmentationNeighbourhood(options));
          if (cuts[p] == cuts[p + 1])
          {
            piece = SegmentationPiece();
            piece.Whole = whole.Whole;
          }
          piece.Process = p;
          results[p] = SegmentByTexture(piece, options, processes.GatherOf(p), Execution());
        });
    }
    for (std::thread& thread : running)
    {
      thread.join();
    }
    for (int p = 0; p < count; ++p)
    {
      EXPECT_EQ(results[p].MeanDensities, one.MeanDensities);
      EXPECT_EQ(results[p].Sizes, one.Sizes);
      EXPECT_EQ(results[p].Centres, one.Centres);
      EXPECT_TRUE(
        cuts[p] == cuts[p + 1] ||
        std::equal(results[p].Labels.begin(), results[p].Labels.end(),
          one.Labels.begin() + cuts[p] * slice, one.Labels.begin() + (cuts[p + 1] + 1) * slice))
        << p << " of " << count;
    }
  }
}

TEST(TextureSegmentation, StopsWhenTold)
{
  const Phantom phantom = MakePhantom(24, Ball, { { 0.0 }, { 1.0 } }, 0.1, 17);
  for (const double end : { 0.0, 0.3, 0.65, 0.72, 0.8 })
  {
    Execution execution;
    execution.Continue = [end](double done) { return done <= end; };
    EXPECT_THROW(
      SegmentByTexture(WholePiece(phantom, 16), Wanted(2), OneProcess, execution), Aborted)
      << end;
  }
}
