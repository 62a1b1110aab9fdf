// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// For tests: how often work looks at the user's abort flag, and how its progress goes on.
#ifndef trivariate_WatchedExecution_h
#define trivariate_WatchedExecution_h

#include "Execution.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <ctime>

namespace trivariate
{
/// Of one thread, in seconds of the processor, so that other work on the machine does not count.
struct Watch
{
  double LongestLook = 0.0; ///< between two looks at the flag
  double LongestRest = 0.0; ///< in which progress stood still
  double Progress = 0.0;

  /// Stops the work once its progress is `end`. Expects that progress never goes back. The watch
  /// must outlive the execution.
  Execution Until(double end)
  {
    this->LastLook = this->LastStep = Seconds();
    Execution execution;
    execution.Continue = [this, end](double done)
    {
      const double now = Seconds();
      this->LongestLook = std::max(this->LongestLook, now - this->LastLook);
      this->LongestRest = std::max(this->LongestRest, now - this->LastStep);
      this->LastLook = now;
      EXPECT_GE(done, this->Progress - 1e-12);
      if (done > this->Progress)
      {
        this->LastStep = now;
        this->Progress = done;
      }
      return done < end;
    };
    return execution;
  }

private:
  static double Seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

  double LastLook = 0.0, LastStep = 0.0;
};
}

#endif
