// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * One filter inside another: its progress, its abort and its messages are those of the outer one.
 */
#ifndef ChainStep_h
#define ChainStep_h

#include "vtkAlgorithm.h"
#include "vtkCallbackCommand.h"
#include "vtkNew.h"

#include <map>
#include <string>
#include <vector>

class vtkDataObject;

namespace trivariate
{
/// The outer filter, and what there is to tell of its run.
struct Chain
{
  vtkAlgorithm* Filter;
  std::map<std::string, double> Seconds; ///< by the name of the step
  std::vector<std::string> Warnings;     ///< of steps whose results count
  std::string Remark;                    ///< on a choice that is no fault
};

/// Adds to the field data where the time went, Step (string) and StepSeconds (double), and Remark
/// (string), if there is one.
void WriteCourse(const Chain& chain, vtkDataObject* data);

class ChainStep
{
public:
  /// `step` and `chain` must outlive this object; the chain's progress goes from `from` to `to`
  /// while the step runs. `name` is what its time is counted to; none: its class without "vtk".
  ChainStep(vtkAlgorithm* step, Chain& chain, double from, double to, const std::string& name = "");
  ~ChainStep();
  ChainStep(const ChainStep&) = delete;
  void operator=(const ChainStep&) = delete;

  /// Updates the step. Throws Aborted when the chain was asked to stop, std::runtime_error with the
  /// step's own sentence when it failed.
  void Run();

  /// The same; what the step warned of becomes warnings of the chain.
  void RunTelling()
  {
    this->Run();
    this->Outer.Warnings.insert(
      this->Outer.Warnings.end(), this->WarningTexts.begin(), this->WarningTexts.end());
  }

private:
  static void Hear(vtkObject* caller, unsigned long event, void* self, void* text);

  vtkAlgorithm* Step;
  Chain& Outer;
  double From, To;
  std::string Name;
  std::vector<std::string> ErrorTexts, WarningTexts;
  vtkNew<vtkCallbackCommand> Listener, Silence;
  std::vector<unsigned long> Tags;
  unsigned long SilenceTag;
};
}

#endif
