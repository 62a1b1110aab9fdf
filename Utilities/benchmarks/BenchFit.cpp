// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Fits of the orbital on 64^3 to 256^3 voxels, on all threads: adaptive ones beside the uniform
// tensor-product fit. Time, memory above what was there before, and the errors reached.
#include "BenchmarkSplines.h"

#include <benchmark/benchmark.h>

#include <atomic>
#include <fstream>
#include <string>
#include <thread>

#ifdef __GLIBC__
#include <malloc.h>
#endif

using namespace trivariate;

namespace
{
Execution AllThreads()
{
  Execution execution;
  execution.ParallelFor = [](Index n, const Execution::Body& body)
  {
    const auto threads = static_cast<Index>(std::max(1u, std::thread::hardware_concurrency()));
    const Index size = std::max<Index>(1, n / (8 * threads));
    std::atomic<Index> next{ 0 };
    const auto work = [&]()
    {
      for (Index begin = next += size; begin - size < n; begin = next += size)
      {
        body(begin - size, std::min(begin, n));
      }
    };
    std::vector<std::thread> others;
    for (Index t = 1; t < threads; ++t)
    {
      others.emplace_back(work);
    }
    work();
    for (std::thread& thread : others)
    {
      thread.join();
    }
  };
  return execution;
}

// Bytes of this process by Linux's account ("VmHWM": the most so far, "VmRSS": now); elsewhere 0.
double ProcessMemory(const std::string& entry)
{
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;)
  {
    if (word == entry + ":")
    {
      double kilobytes = 0.0;
      status >> kilobytes;
      return 1024.0 * kilobytes;
    }
  }
  return 0.0;
}

void Fit(benchmark::State& state)
{
  GridSamples samples;
  samples.Size = { state.range(2), state.range(2), state.range(2) };
  samples.Values = OrbitalVolume(state.range(2)).data();
  FitOptions options;
  options.Rule = static_cast<Refinement>(state.range(0));
  options.MaximumControlPoints = state.range(1);
#ifdef __GLIBC__
  malloc_trim(0); // what the fits before it left
#endif
  std::ofstream("/proc/self/clear_refs") << "5"; // the peak starts anew
  const double before = ProcessMemory("VmRSS");
  FitResult result;
  for (auto _ : state)
  {
    result = FitGrid(samples, options, AllThreads());
  }
  state.counters["control_points"] = static_cast<double>(result.Spline.Size());
  state.counters["megabytes"] = (ProcessMemory("VmHWM") - before) * 1e-6;
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
