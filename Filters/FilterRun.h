// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * What every RequestData does around its work: tell errors, and bring pieces together on process 0.
 *
 *   const std::string fault = FaultOf([&]() { samples = ReadSamples(...); });
 *   return RunTellingErrors(this, "crop the image.", [&]()
 *   {
 *     if (gathering)
 *     {
 *       const bool sound = GatherSamples(samples, fault, this->Controller);
 *       if (const auto answer = AnswerElsewhere(this, "The fit is one solve", sound, fault, ...))
 *       {
 *         return *answer;
 *       }
 *     }
 *     ...
 *     return 1;
 *   });
 */
#ifndef FilterRun_h
#define FilterRun_h

#include "Execution.h"

#include "vtkAlgorithm.h"
#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkMultiProcessController.h"
#include "vtkPointData.h"

#include <new>
#include <optional>
#include <stdexcept>
#include <string>

namespace trivariate
{
/**
 * What `work` returns; 1 where it was stopped, since the executive empties the outputs then; 0
 * after an error, which is told. `advice`: what to do where memory is short.
 */
template <typename Work>
int RunTellingErrors(vtkAlgorithm* filter, const std::string& advice, const Work& work)
{
  try
  {
    return work();
  }
  catch (const Aborted&)
  {
    return 1;
  }
  catch (const std::bad_alloc&)
  {
    vtkErrorWithObjectMacro(filter, "Out of memory; " << advice);
  }
  catch (const std::exception& error)
  {
    vtkErrorWithObjectMacro(filter, << error.what());
  }
  return 0;
}

/// Empty, or what `work` threw as a sentence for the user: of what must not throw since other
/// processes wait for this one.
template <typename Work>
std::string FaultOf(const Work& work)
{
  try
  {
    work();
  }
  catch (const std::bad_alloc&)
  {
    return "Out of memory; crop or coarsen the image.";
  }
  catch (const std::exception& error)
  {
    return error.what();
  }
  return "";
}

/**
 * After pieces were gathered, with the answer and the fault of GatherSamples: what RequestData
 * returns on a process that has nothing left to do, nothing on the one that goes on. That one
 * warns:
 * "`what`: the pieces of 3 processes were gathered to process 0."
 */
inline std::optional<int> AnswerElsewhere(vtkAlgorithm* filter, const char* what, bool sound,
  const std::string& fault, vtkMultiProcessController* controller)
{
  if (!sound)
  {
    return fault.empty() ? std::optional<int>(0) : std::nullopt; // another process tells
  }
  if (controller->GetLocalProcessId() > 0)
  {
    return 1;
  }
  vtkWarningWithObjectMacro(filter, << what << ": the pieces of "
                                    << controller->GetNumberOfProcesses()
                                    << " processes were gathered to process 0.");
  return std::nullopt;
}

/**
 * The point array of SetInputArrayToProcess(0, ...), `chosen`; the active scalars as long as
 * nothing was chosen, which a proxy says with an empty name. Throws std::invalid_argument where the
 * image does not have it.
 */
inline vtkDataArray* ChosenValues(vtkAlgorithm* filter, vtkImageData* image, vtkDataArray* chosen)
{
  const char* name = filter->GetInputArrayInformation(0)->Get(vtkDataObject::FIELD_NAME());
  vtkDataArray* array = name && !*name ? image->GetPointData()->GetScalars() : chosen;
  if (!array)
  {
    throw std::invalid_argument("The image does not have the point array that was chosen; use "
                                "SetInputArrayToProcess(0, ...).");
  }
  return array;
}
}

#endif
