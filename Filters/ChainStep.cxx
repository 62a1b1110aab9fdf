// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ChainStep.h"

#include "Execution.h"

#include "vtkCommand.h"
#include "vtkExecutive.h"

#include <stdexcept>

namespace trivariate
{
namespace
{
// The sentence of a message of VTK's, without the place in the source in front of it.
std::string SentenceOf(const std::string& message)
{
  const std::size_t place = message.find("): ");
  std::string text = place == std::string::npos ? message : message.substr(place + 3);
  text.erase(text.find_last_not_of(" \n") + 1);
  return text;
}
}

//------------------------------------------------------------------------------
ChainStep::ChainStep(vtkAlgorithm* step, vtkAlgorithm* chain, double from, double to)
  : Step(step)
  , Chain(chain)
  , From(from)
  , To(to)
{
  step->SetContainerAlgorithm(chain);
  this->Listener->SetClientData(this);
  this->Listener->SetCallback(ChainStep::Hear);
  for (const unsigned long event :
    { vtkCommand::ProgressEvent, vtkCommand::ErrorEvent, vtkCommand::WarningEvent })
  {
    this->Tags.push_back(step->AddObserver(event, this->Listener));
  }
  // The executive only repeats that the step has failed.
  this->Silence->SetCallback([](vtkObject*, unsigned long, void*, void*) {});
  this->SilenceTag = step->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, this->Silence);
}

ChainStep::~ChainStep()
{
  for (const unsigned long tag : this->Tags)
  {
    this->Step->RemoveObserver(tag);
  }
  this->Step->GetExecutive()->RemoveObserver(this->SilenceTag);
  this->Step->SetContainerAlgorithm(nullptr);
}

//------------------------------------------------------------------------------
void ChainStep::Hear(vtkObject*, unsigned long event, void* client, void* data)
{
  auto* self = static_cast<ChainStep*>(client);
  if (event == vtkCommand::ProgressEvent)
  {
    const double done = *static_cast<double*>(data);
    if (self->Chain->GetAbortExecute())
    {
      return; // the executive says 1 even of a step that was stopped
    }
    self->Chain->UpdateProgress(self->From + (self->To - self->From) * done);
    return;
  }
  auto& texts = event == vtkCommand::ErrorEvent ? self->ErrorTexts : self->WarningTexts;
  texts.push_back(SentenceOf(static_cast<char*>(data)));
}

//------------------------------------------------------------------------------
void ChainStep::Run()
{
  this->Step->Update();
  if (this->Chain->CheckAbort() || this->Chain->GetAbortOutput())
  {
    throw Aborted();
  }
  if (!this->ErrorTexts.empty())
  {
    throw std::runtime_error(this->ErrorTexts.front());
  }
  this->Chain->UpdateProgress(this->To);
}
}
