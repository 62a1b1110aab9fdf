// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The core's work on VTK's threads, under VTK's progress bar and abort button.
 *
 *   trivariate::FitGrid(samples, options, trivariate::SMPExecution(this));
 *
 * Debian's VTK is sequential unless told otherwise, so threads are asked for, in the scope of one
 * loop only: the back end of the process stays what it was. vtkSMPTools::Initialize(n) and
 * VTK_SMP_MAX_THREADS limit the number of threads as everywhere in VTK.
 */
#ifndef SMPExecution_h
#define SMPExecution_h

#include "Execution.h"

#include "vtkAlgorithm.h"
#include "vtkSMPTools.h"

#include <exception>
#include <mutex>
#include <string>

namespace trivariate
{
/// Calls body on ranges that cover [0, n) with vtkSMPTools. What a body throws is thrown here,
/// once.
inline void SMPParallelFor(Index n, const Execution::Body& body)
{
  std::exception_ptr failure;
  std::mutex failureMutex;
  // An exception must not leave a thread of the pool: that would end the process.
  const auto guarded = [&body, &failure, &failureMutex](vtkIdType begin, vtkIdType end)
  {
    try
    {
      body(begin, end);
    }
    catch (...)
    {
      const std::lock_guard<std::mutex> lock(failureMutex);
      failure = std::current_exception();
    }
  };
  vtkSMPTools::Config config(vtk::detail::smp::vtkSMPToolsAPI::GetInstance());
  if (config.Backend == "Sequential")
  {
    config.Backend = "STDThread";
  }
  vtkSMPTools::LocalScope(config, [n, &guarded]() { vtkSMPTools::For(0, n, guarded); });
  if (failure)
  {
    std::rethrow_exception(failure);
  }
}

/**
 * Runs for `filter`: its progress goes from `from` to `to` while the work is done, and the work
 * stops with Aborted when the filter (or its container) is asked to abort.
 */
inline Execution SMPExecution(vtkAlgorithm* filter, double from = 0.0, double to = 1.0)
{
  Execution execution;
  execution.ParallelFor = SMPParallelFor;
  execution.Continue = [filter, from, to](double done)
  {
    filter->UpdateProgress(from + (to - from) * done);
    filter->CheckAbort();
    return !filter->GetAbortOutput();
  };
  return execution;
}
}

#endif
