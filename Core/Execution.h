// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * How long work is run: on which threads, told to whom, stopped by whom.
 *
 * The mathematics does not know the host's threads. A VTK filter hands in vtkSMPTools, its progress
 * and its abort flag; a test takes the defaults (one thread, never stopped). No result may depend
 * on how ParallelFor cuts the range.
 */
#ifndef trivariate_Execution_h
#define trivariate_Execution_h

#include "TSpline/TSpline.h"

#include <exception>
#include <functional>

namespace trivariate
{
/// Thrown out of a computation whose Continue function said no.
struct Aborted : std::exception
{
  const char* what() const noexcept override { return "stopped by the user"; }
};

struct Execution
{
  using Body = std::function<void(Index begin, Index end)>;

  /// Calls body on disjoint ranges that cover [0, n), in any order and on any threads.
  std::function<void(Index n, const Body& body)> ParallelFor = [](Index n, const Body& body)
  { body(0, n); };

  /// Told the share of the work done, 0 to 1; called from the calling thread at least once a
  /// second; false stops the work.
  std::function<bool(double)> Continue = [](double) { return true; };

  /// Reports progress and throws Aborted when the user has had enough.
  void Check(double done) const
  {
    if (!this->Continue(done))
    {
      throw Aborted();
    }
  }

  /// For a part of the work: the same, but what the part calls 0 to 1 is reported as from to to.
  Execution Part(double from, double to) const
  {
    Execution part = *this;
    part.Continue = [whole = this->Continue, from, to](double done)
    { return whole(from + (to - from) * done); };
    return part;
  }
};
}

#endif
