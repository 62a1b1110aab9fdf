// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// What benchmarks run on, and the memory that they take.
#ifndef BenchmarkRun_h
#define BenchmarkRun_h

#include "Execution.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <fstream>
#include <limits>
#include <string>
#include <thread>
#include <vector>

#ifdef __GLIBC__
#include <malloc.h>
#endif

inline int HardwareThreads()
{
  return static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
}

inline trivariate::Execution OnThreads(int threads)
{
  using trivariate::Index;
  trivariate::Execution execution;
  execution.ParallelFor = [threads](Index n, const trivariate::Execution::Body& body)
  {
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
    for (int t = 1; t < threads; ++t)
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

/**
 * Measures work(1) and work(2), on so many threads, in turn, so that other work on the machine
 * meets both; "times_one_thread" compares the fastest of each by the clock on the wall.
 */
template <typename Work>
void CompareThreads(benchmark::State& state, const Work& work)
{
  std::array<double, 2> fastest;
  fastest.fill(std::numeric_limits<double>::max());
  for (auto _ : state)
  {
    for (int threads = 1; threads <= 2; ++threads)
    {
      const auto start = std::chrono::steady_clock::now();
      work(threads);
      const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
      fastest[threads - 1] = std::min(fastest[threads - 1], seconds.count());
    }
  }
  state.counters["times_one_thread"] = fastest[0] / fastest[1];
}

/// The most memory that this process has had since the construction, above what it had then; by
/// Linux's account, elsewhere 0.
class PeakMemory
{
public:
  PeakMemory()
  {
#ifdef __GLIBC__
    malloc_trim(0); // what others before left
#endif
    std::ofstream("/proc/self/clear_refs") << "5"; // the peak starts anew
    this->Before = Account("VmRSS");
  }

  double Bytes() const
  {
    return Account("VmHWM") - this->Before;
  }

private:
  double Before = 0.0;

  static double Account(const std::string& entry)
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
};

#endif
