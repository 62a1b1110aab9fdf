// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ChainStep.h"

#include "Execution.h"

#include "vtkCommand.h"
#include "vtkDataObject.h"
#include "vtkDoubleArray.h"
#include "vtkExecutive.h"
#include "vtkFieldData.h"
#include "vtkStringArray.h"

#include <chrono>
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
ChainStep::ChainStep(
  vtkAlgorithm* step, Chain& chain, double from, double to, const std::string& name)
  : Step(step)
  , Outer(chain)
  , From(from)
  , To(to)
  , Name(name.empty() ? std::string(step->GetClassName()).substr(3) : name)
{
  step->SetContainerAlgorithm(chain.Filter);
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
    vtkAlgorithm* chain = self->Outer.Filter;
    if (chain->GetAbortExecute())
    {
      return; // the executive says 1 even of a step that was stopped
    }
    chain->UpdateProgress(self->From + (self->To - self->From) * done);
    return;
  }
  auto& texts = event == vtkCommand::ErrorEvent ? self->ErrorTexts : self->WarningTexts;
  texts.push_back(SentenceOf(static_cast<char*>(data)));
}

//------------------------------------------------------------------------------
void ChainStep::Run()
{
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  this->Step->Update();
  this->Outer.Seconds[this->Name] += std::chrono::duration<double>(Clock::now() - start).count();
  if (this->Outer.Filter->CheckAbort() || this->Outer.Filter->GetAbortOutput())
  {
    throw Aborted();
  }
  if (!this->ErrorTexts.empty())
  {
    throw std::runtime_error(this->ErrorTexts.front());
  }
  this->Outer.Filter->UpdateProgress(this->To);
}

//------------------------------------------------------------------------------
void WriteCourse(const Chain& chain, vtkDataObject* data)
{
  vtkNew<vtkStringArray> names;
  names->SetName("Step");
  vtkNew<vtkDoubleArray> seconds;
  seconds->SetName("StepSeconds");
  for (const auto& [name, time] : chain.Seconds)
  {
    names->InsertNextValue(name);
    seconds->InsertNextValue(time);
  }
  data->GetFieldData()->AddArray(names);
  data->GetFieldData()->AddArray(seconds);
  if (!chain.Remark.empty())
  {
    vtkNew<vtkStringArray> remark;
    remark->SetName("Remark");
    remark->InsertNextValue(chain.Remark);
    data->GetFieldData()->AddArray(remark);
  }
}
}
