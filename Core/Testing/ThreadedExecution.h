// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// Real threads for tests: ranges of odd sizes on `threads` threads, in no particular order.
#ifndef trivariate_ThreadedExecution_h
#define trivariate_ThreadedExecution_h

#include "Execution.h"

#include <algorithm>
#include <thread>
#include <vector>

namespace trivariate
{
inline Execution ThreadedExecution(int threads)
{
  Execution execution;
  execution.ParallelFor = [threads](Index n, const Execution::Body& body)
  {
    const Index size = n / (3 * threads) + 1;
    std::vector<std::thread> running;
    for (int t = 0; t < threads; ++t)
    {
      running.emplace_back(
        [=, &body]()
        {
          for (Index begin = t * size; begin < n; begin += threads * size)
          {
            body(begin, std::min(begin + size, n));
          }
        });
    }
    for (std::thread& thread : running)
    {
      thread.join();
    }
  };
  return execution;
}
}

#endif
