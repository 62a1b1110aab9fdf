// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// Collects the warnings of one algorithm, one after the other, instead of printing them.
#ifndef WarningLog_h
#define WarningLog_h

#include "vtkAlgorithm.h"
#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkNew.h"

#include <string>

class WarningLog
{
public:
  explicit WarningLog(vtkAlgorithm* algorithm)
  {
    this->Collect->SetClientData(&this->Text);
    this->Collect->SetCallback([](vtkObject*, unsigned long, void* text, void* message)
      { *static_cast<std::string*>(text) += static_cast<char*>(message); });
    algorithm->AddObserver(vtkCommand::WarningEvent, this->Collect);
  }

  bool Says(const std::string& words) const { return this->Text.find(words) != std::string::npos; }

  std::string Text;

private:
  vtkNew<vtkCallbackCommand> Collect;
};

#endif
