// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// Asks an algorithm to stop in the middle.
#ifndef Stop_h
#define Stop_h

#include "vtkAlgorithm.h"
#include "vtkCallbackCommand.h"
#include "vtkNew.h"

#include <ctime>

namespace trivariate_testing
{
// Asks an algorithm to stop as soon as it has got so far, and tells how much it worked after that.
class Stop
{
public:
  Stop(vtkAlgorithm* algorithm, double at)
    : Algorithm(algorithm)
    , At(at)
  {
    this->Observer->SetClientData(this);
    this->Observer->SetCallback(
      [](vtkObject*, unsigned long, void* self, void*) { static_cast<Stop*>(self)->Look(); });
    this->Tag = algorithm->AddObserver(vtkCommand::ProgressEvent, this->Observer);
  }

  ~Stop()
  {
    this->Algorithm->RemoveObserver(this->Tag);
    this->Algorithm->SetAbortExecute(0);
  }

  bool WasAsked() const { return this->Asked; }
  double Where() const { return this->Last; } // the last progress told
  double AskedAt() const { return this->First; }
  double ProcessorSeconds() const { return double(std::clock() - this->Since) / CLOCKS_PER_SEC; }

private:
  void Look()
  {
    const double now = this->Algorithm->GetProgress();
    if (now >= this->At && now < 1.0) // the executive ends with 1
    {
      this->Last = now;
      if (!this->Asked)
      {
        this->First = now;
        this->Asked = true;
        this->Since = std::clock();
        this->Algorithm->SetAbortExecute(1);
      }
    }
  }

  vtkAlgorithm* Algorithm;
  double At;
  vtkNew<vtkCallbackCommand> Observer;
  unsigned long Tag;
  bool Asked = false;
  double First = 0.0, Last = 0.0;
  std::clock_t Since = 0;
};
}

#endif
