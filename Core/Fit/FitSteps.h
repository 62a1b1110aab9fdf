// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// What the fits over a grid and over blocks have in common: how far they solve, and their clock.
#ifndef trivariate_FitSteps_h
#define trivariate_FitSteps_h

#include <algorithm>
#include <chrono>
#include <string>
#include <utility>
#include <vector>

namespace trivariate
{
// Between refinements the system is only solved as far as the next refinement can tell; the last
// solve goes on until the error stands still (measured on the volumes in Documentation/Results.md).
constexpr double RoundTolerance = 1e-2;
constexpr int RoundIterations = 20;
constexpr double FinalTolerance = 1e-4;

/// The smallest root mean square, as a share of the range, that rounding lets the fit tell from
/// zero.
constexpr double RmsFloor = 1e-11;

/// Seconds of a fit by topic.
class FitClock
{
public:
  /// What has passed since the last call goes to `topic`.
  void Lap(const char* topic)
  {
    const auto now = Clock::now();
    auto entry = std::find_if(this->Seconds.begin(), this->Seconds.end(),
      [topic](const auto& e) { return e.first == topic; });
    if (entry == this->Seconds.end())
    {
      entry = this->Seconds.insert(this->Seconds.end(), { topic, 0.0 });
    }
    entry->second += Between(this->LastLap, now);
    this->LastLap = now;
  }

  /// From the start to the last lap.
  double Total() const { return Between(this->Start, this->LastLap); }

  std::vector<std::pair<std::string, double>> Seconds;

private:
  using Clock = std::chrono::steady_clock;

  static double Between(Clock::time_point a, Clock::time_point b)
  {
    return std::chrono::duration<double>(b - a).count();
  }

  Clock::time_point Start = Clock::now(), LastLap = Start;
};
}

#endif
