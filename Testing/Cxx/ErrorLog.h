// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// Collects the errors of one algorithm instead of printing them.
#ifndef ErrorLog_h
#define ErrorLog_h

#include "vtkAlgorithm.h"
#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkExecutive.h"
#include "vtkNew.h"

#include <string>
#include <vector>

class ErrorLog
{
public:
  explicit ErrorLog(vtkAlgorithm* algorithm)
  {
    this->Collect->SetClientData(&this->Messages);
    this->Collect->SetCallback([](vtkObject*, unsigned long, void* messages, void* text)
      { static_cast<std::vector<std::string>*>(messages)->push_back(static_cast<char*>(text)); });
    algorithm->AddObserver(vtkCommand::ErrorEvent, this->Collect);
    // The executive only repeats that the algorithm has failed.
    algorithm->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, this->Ignore);
    this->Ignore->SetCallback([](vtkObject*, unsigned long, void*, void*) {});
  }

  /// The one error since the last call; otherwise a text that tells how many there were.
  std::string TakeOnly()
  {
    const std::string text = this->Messages.size() == 1
                               ? this->Messages.front()
                               : std::to_string(this->Messages.size()) + " errors";
    this->Messages.clear();
    return text;
  }

private:
  std::vector<std::string> Messages;
  vtkNew<vtkCallbackCommand> Collect, Ignore;
};

#endif
