// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Texture attributes of noise, the dearest of volumes: all default attributes, items are voxels.
// PlainTexture counts every window anew; Texture slides it. "times_plain" is how many times faster
// it is, "times_64" the time of a voxel as a multiple of that in a volume of 64^3, both in
// processor time; "times_one_thread" how many times faster than on one thread, by the clock on the
// wall.
#include "BenchmarkRun.h"
#include "Texture/TextureWindow.h"

#include <benchmark/benchmark.h>

#include <chrono>
#include <ctime>
#include <map>
#include <random>

using namespace trivariate;

namespace
{
using Case = std::array<std::int64_t, 4>; // radius, levels, voxels a side, threads

// What a voxel took: by the clock, and of all threads' processor time.
struct Cost
{
  double Seconds = 0.0, ProcessorSeconds = 0.0;
};

// Of what has been run so far; in no volume (0) the plain one.
std::map<Case, Cost>& Measured()
{
  static std::map<Case, Cost> measured;
  return measured;
}

std::vector<std::uint8_t> Noise(Index size, int levels)
{
  std::mt19937 random(1);
  std::vector<std::uint8_t> noise(size * size * size);
  for (std::uint8_t& level : noise)
  {
    level = static_cast<std::uint8_t>(random() % levels);
  }
  return noise;
}

class Stopwatch
{
public:
  Cost Of(Index voxels) const
  {
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - this->Start;
    const double processor = static_cast<double>(std::clock() - this->ProcessorStart);
    return { seconds.count() / voxels, processor / CLOCKS_PER_SEC / voxels };
  }

private:
  std::chrono::steady_clock::time_point Start = std::chrono::steady_clock::now();
  std::clock_t ProcessorStart = std::clock();
};

constexpr Index PlainSize = 16;

double MeanOfDirections(
  const std::vector<std::uint8_t>& levels, const VoxelBox& window, int greyLevels)
{
  TextureAttributeValues values = {};
  double sum = 0.0;
  for (const PairDirection& direction : PairDirections())
  {
    CooccurrenceMatrix matrix(greyLevels);
    AddPairs(levels.data(), { PlainSize, PlainSize, PlainSize }, window, direction, matrix);
    ComputeTextureAttributes(SumsOf(matrix), values);
    for (const TextureAttribute attribute : DefaultTextureAttributes())
    {
      sum += values[static_cast<int>(attribute)];
    }
  }
  return sum;
}

void PlainTexture(benchmark::State& state)
{
  const Index radius = state.range(0);
  const int levels = static_cast<int>(state.range(1));
  const std::vector<std::uint8_t> noise = Noise(PlainSize, levels);
  const Index side = PlainSize - 2 * radius;
  const Index voxels = side * side * side;
  const Stopwatch watch;
  for (auto _ : state)
  {
    for (Index at = 0; at < voxels; ++at)
    {
      const std::array<Index, 3> low = { at % side, at / side % side, at / side / side };
      const Index width = 2 * radius + 1;
      benchmark::DoNotOptimize(MeanOfDirections(
        noise, { low, { low[0] + width, low[1] + width, low[2] + width } }, levels));
    }
  }
  Measured()[{ radius, levels, 0, 1 }] = watch.Of(state.iterations() * voxels);
  state.SetItemsProcessed(state.iterations() * voxels);
}

void Texture(benchmark::State& state)
{
  TextureOptions options;
  options.Radius = static_cast<int>(state.range(0));
  options.GreyLevels = static_cast<int>(state.range(1));
  const Index size = state.range(2), voxels = size * size * size;
  const int threads = static_cast<int>(state.range(3));
  const std::vector<std::uint8_t> noise = Noise(size, options.GreyLevels);
  std::vector<std::vector<float>> arrays(
    TextureOutputNames(options).size(), std::vector<float>(voxels));
  std::vector<float*> out;
  for (std::vector<float>& array : arrays)
  {
    out.push_back(array.data());
  }
  const PeakMemory memory;
  const Stopwatch watch;
  for (auto _ : state)
  {
    ComputeTexture(noise.data(), { size, size, size }, { 0, 0, 0 }, { size, size, size }, options,
      out, OnThreads(threads));
  }
  const Cost cost = watch.Of(state.iterations() * voxels);
  Measured()[{ options.Radius, options.GreyLevels, size, threads }] = cost;
  const auto of = [&options](Index voxels, int threads) {
    return Measured()[{ options.Radius, options.GreyLevels, voxels, threads }];
  };
  if (size == 64 && threads == 1)
  {
    state.counters["times_plain"] = of(0, 1).ProcessorSeconds / cost.ProcessorSeconds;
  }
  if (size > 64)
  {
    state.counters["times_64"] = cost.ProcessorSeconds / of(64, threads).ProcessorSeconds;
  }
  if (threads > 1)
  {
    state.counters["times_one_thread"] = of(size, 1).Seconds / cost.Seconds;
  }
  state.counters["megabytes"] = memory.Bytes() * 1e-6;
  state.SetItemsProcessed(state.iterations() * voxels);
}

void Windows(benchmark::internal::Benchmark* benchmark)
{
  benchmark->ArgNames({ "radius", "levels" });
  for (const std::int64_t radius : { 1, 2, 3, 5 })
  {
    benchmark->Args({ radius, 16 });
  }
  benchmark->Args({ 2, 32 })->Args({ 2, 64 });
}

void Volumes(benchmark::internal::Benchmark* benchmark)
{
  benchmark->ArgNames({ "radius", "levels", "voxels", "threads" });
  for (const std::int64_t radius : { 1, 2, 3, 5 })
  {
    benchmark->Args({ radius, 16, 64, 1 });
  }
  benchmark->Args({ 2, 32, 64, 1 })->Args({ 2, 64, 64, 1 });
  for (const std::int64_t size : { 64, 128, 256 })
  {
    benchmark->Args({ 2, 16, size, 1 })->Args({ 2, 16, size, 2 });
  }
}
}

BENCHMARK(PlainTexture)->Apply(Windows)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(Texture)->Apply(Volumes)->Unit(benchmark::kMillisecond)->Iterations(1)->UseRealTime();
