// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Frames of a bar that fills its grid and turns by a radian, levels and start included; labels: the
// sides name their axes, else any direction may be the normal.
#include "BenchmarkRun.h"
#include "Field/SegmentField.h"

#include <benchmark/benchmark.h>

#include <array>
#include <cmath>

using namespace trivariate;

namespace
{
struct FilledBar
{
  FrameVoxels Voxels;
  std::vector<FrameConstraint> Constraints;

  FilledBar(Index n, bool labels)
    : Voxels(
        CollectVoxels({ n, n, n }, std::vector<std::uint8_t>(n * n * n, 1).data(), OnThreads(1)))
  {
    for (Index v = 0; v < this->Voxels.Count(); ++v)
    {
      const std::array<Index, 3> place = this->Voxels.Place(v);
      const float turn = static_cast<float>(place[2]) / static_cast<float>(n);
      const std::array<std::array<float, 3>, 3> axes = { { { std::cos(turn), std::sin(turn), 0 },
        { -std::sin(turn), std::cos(turn), 0 }, { 0, 0, 1 } } };
      for (int side = 0; side < 6; ++side)
      {
        if (place[side / 2] != side % 2 * (n - 1))
        {
          continue;
        }
        std::array<float, 3> normal = axes[side / 2];
        for (float& x : normal)
        {
          x *= side % 2 ? 1.0f : -1.0f;
        }
        this->Constraints.push_back({ static_cast<std::int32_t>(v), normal,
          static_cast<std::int8_t>(labels ? side : AnyAxis) });
      }
    }
  }

  int Sweeps(int threads) const
  {
    return ComputeSegmentField(this->Voxels, this->Constraints, FieldOptions(), OnThreads(threads))
      .Records.back()
      .Sweep;
  }
};

void Frames(benchmark::State& state)
{
  const FilledBar bar(state.range(0), state.range(1) != 0);
  const PeakMemory memory;
  int sweeps = 0;
  for (auto _ : state)
  {
    sweeps = bar.Sweeps(1);
  }
  state.counters["iterations"] = sweeps;
  state.counters["megabytes"] = memory.Bytes() * 1e-6;
}

void FramesOnThreads(benchmark::State& state)
{
  const FilledBar bar(state.range(0), state.range(1) != 0);
  CompareThreads(state, [&bar](int threads) { bar.Sweeps(threads); });
}
}

BENCHMARK(Frames)
  ->ArgNames({ "voxels", "labels" })
  ->ArgsProduct({ { 64, 128, 256 }, { 1, 0 } })
  ->Unit(benchmark::kMillisecond)
  ->Iterations(1);
BENCHMARK(FramesOnThreads)
  ->ArgNames({ "voxels", "labels" })
  ->ArgsProduct({ { 128 }, { 1, 0 } })
  ->Unit(benchmark::kMillisecond)
  ->Iterations(7);
