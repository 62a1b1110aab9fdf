// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Fits of the orbital on 64^3 to 256^3 voxels, on all threads: adaptive ones beside the uniform
// tensor-product fit. Time, memory above what was there before, and the errors reached.
#include "BenchmarkRun.h"
#include "BenchmarkSplines.h"

#include <benchmark/benchmark.h>

using namespace trivariate;

namespace
{
void Fit(benchmark::State& state)
{
  GridSamples samples;
  samples.Size = { state.range(2), state.range(2), state.range(2) };
  samples.Values = OrbitalVolume(state.range(2)).data();
  FitOptions options;
  options.Rule = static_cast<Refinement>(state.range(0));
  options.MaximumControlPoints = state.range(1);
  const PeakMemory memory;
  FitResult result;
  for (auto _ : state)
  {
    result = FitGrid(samples, options, OnThreads(HardwareThreads()));
  }
  state.counters["control_points"] = static_cast<double>(result.Spline.Size());
  state.counters["megabytes"] = memory.Bytes() * 1e-6;
  state.counters["rms_percent"] = 100.0 * result.Rounds.back().Rms;
  state.counters["maximum_error"] = result.Rounds.back().MaximumError;
}

void Fits(benchmark::internal::Benchmark* benchmark)
{
  benchmark->ArgNames({ "rule", "control_points", "voxels" });
  for (const std::int64_t size : { 64, 128, 256 })
  {
    for (const std::int64_t controlPoints : { 5000, 50000 })
    {
      for (const Refinement rule :
        { Refinement::Uniform, Refinement::Compact, Refinement::AnalysisSuitable })
      {
        benchmark->Args({ static_cast<std::int64_t>(rule), controlPoints, size });
      }
    }
  }
}
}

BENCHMARK(Fit)->Apply(Fits)->Unit(benchmark::kMillisecond)->Iterations(1)->UseRealTime();
