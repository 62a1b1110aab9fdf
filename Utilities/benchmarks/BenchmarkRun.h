// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// What benchmarks run on, and the memory that they take.
#ifndef BenchmarkRun_h
#define BenchmarkRun_h

#include "Execution.h"

#include <algorithm>
#include <atomic>
#include <fstream>
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
