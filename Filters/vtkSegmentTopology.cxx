// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSegmentTopology.h"

#include "Domain/WholeSegments.h"
#include "LabelledImage.h"
#include "ListProperty.h"
#include "SMPExecution.h"
#include "SharedPieces.h"

#include "vtkFieldData.h"
#include "vtkIdTypeArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkIntArray.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"

#include <algorithm>
#include <new>
#include <set>
#include <stdexcept>
#include <string>

using namespace trivariate;

vtkStandardNewMacro(vtkSegmentTopology);
vtkCxxSetObjectMacro(vtkSegmentTopology, Controller, vtkMultiProcessController);

namespace
{
//------------------------------------------------------------------------------
// The chosen segments, or all but 0 from the highest on.
std::vector<std::int32_t> ChooseSegments(
  const std::vector<std::int32_t>& labels, const std::vector<int>& chosen)
{
  const std::set<std::int32_t> present(labels.begin(), labels.end());
  CheckPresent(present, chosen);
  std::vector<std::int32_t> segments(chosen.begin(), chosen.end());
  if (segments.empty())
  {
    std::copy_if(present.rbegin(), present.rend(), std::back_inserter(segments),
      [](std::int32_t label) { return label != 0; });
  }
  return segments;
}

//------------------------------------------------------------------------------
void AddChanges(const std::vector<SegmentChanges>& changes, vtkFieldData* data)
{
  const auto add = [&changes, data](const char* name, auto value)
  {
    vtkNew<vtkIdTypeArray> array;
    array->SetName(name);
    for (const SegmentChanges& segment : changes)
    {
      array->InsertNextValue(value(segment));
    }
    data->AddArray(array);
  };
  add("TopologySegment", [](const SegmentChanges& c) { return c.Segment; });
  add("TopologyPieces", [](const SegmentChanges& c) { return c.Pieces; });
  add("TopologyCavities", [](const SegmentChanges& c) { return c.Cavities; });
  add("TopologyCut", [](const SegmentChanges& c) { return c.CutVoxels; });
  add("TopologyClosed", [](const SegmentChanges& c) { return c.ClosedVoxels; });
  add("TopologyEuler", [](const SegmentChanges& c) { return c.EulerCharacteristic; });
}

//------------------------------------------------------------------------------
// The labels of an extent within the whole.
void StoreLabels(const LabelledImage& whole, const std::string& name, vtkImageData* output)
{
  vtkNew<vtkIntArray> array;
  array->SetName(name.c_str());
  array->SetNumberOfValues(output->GetNumberOfPoints());
  const LabelVolume labels = whole.View();
  int e[6];
  output->GetExtent(e);
  vtkIdType at = 0;
  for (int k = e[4]; k <= e[5]; ++k)
  {
    for (int j = e[2]; j <= e[3]; ++j)
    {
      for (int i = e[0]; i <= e[1]; ++i)
      {
        array->SetValue(
          at++, labels(i - whole.Extent[0], j - whole.Extent[2], k - whole.Extent[4]));
      }
    }
  }
  vtkPointData* data = output->GetPointData();
  const bool isActive = data->GetScalars() && data->GetScalars()->GetName() == name;
  data->RemoveArray(name.c_str());
  data->AddArray(array);
  if (isActive)
  {
    data->SetActiveScalars(name.c_str());
  }
}
}

//------------------------------------------------------------------------------
vtkSegmentTopology::vtkSegmentTopology()
{
  this->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Segment");
  this->SetController(vtkMultiProcessController::GetGlobalController());
}

vtkSegmentTopology::~vtkSegmentTopology()
{
  this->SetController(nullptr);
}

//------------------------------------------------------------------------------
void vtkSegmentTopology::AddSegment(int segment)
{
  AddEntry(this, this->Segments, segment);
}

void vtkSegmentTopology::ClearSegments()
{
  ClearEntries(this, this->Segments);
}

int vtkSegmentTopology::GetSegment(int i) const
{
  return EntryOf(this->Segments, i, -1);
}

//------------------------------------------------------------------------------
int vtkSegmentTopology::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  if (!ArePiecesShared(this->Controller, outputVector))
  {
    RequestWholeImage(inputVector[0]->GetInformationObject(0));
  }
  return 1;
}

//------------------------------------------------------------------------------
int vtkSegmentTopology::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkImageData* input = vtkImageData::GetData(inputVector[0]);
  vtkImageData* output = vtkImageData::GetData(outputVector);
  const bool gathering = ArePiecesShared(this->Controller, outputVector);
  LabelledImage image;
  std::string fault, name;
  try
  {
    if (input->GetNumberOfPoints() > 0)
    {
      vtkDataArray* labels = ChosenLabels(input, this->GetInputArrayToProcess(0, input),
        this->GetInputArrayInformation(0)->Get(vtkDataObject::FIELD_NAME()));
      image = ReadLabels(input, labels, nullptr);
      name = labels->GetName() ? labels->GetName() : "Segment";
    }
  }
  catch (const std::exception& error)
  {
    fault = error.what();
  }
  std::vector<SegmentChanges> changes;
  try
  {
    const bool sound = !gathering || GatherLabels(image, fault, this->Controller);
    const bool isFirst = !gathering || this->Controller->GetLocalProcessId() == 0;
    if (!sound && fault.empty())
    {
      return 0; // another process tells
    }
    if (!fault.empty())
    {
      throw std::invalid_argument(fault);
    }
    if (isFirst)
    {
      try
      {
        changes = this->MakeWhole(image, gathering);
      }
      catch (const Aborted&)
      {
        image = LabelledImage();
      }
      catch (const std::bad_alloc&)
      {
        fault = "Out of memory; crop or coarsen the image.";
        image = LabelledImage();
      }
      catch (const std::exception& error)
      {
        fault = error.what();
        image = LabelledImage();
      }
    }
    if (gathering)
    {
      this->Share(image);
    }
    if (!fault.empty())
    {
      throw std::invalid_argument(fault);
    }
  }
  catch (const std::bad_alloc&)
  {
    vtkErrorMacro("Out of memory; crop or coarsen the image.");
    return 0;
  }
  catch (const std::exception& error)
  {
    vtkErrorMacro(<< error.what());
    return 0;
  }
  if (image.Labels.empty())
  {
    return 1; // stopped, or told by the first process
  }
  output->ShallowCopy(input);
  if (input->GetNumberOfPoints() > 0)
  {
    StoreLabels(image, name, output);
  }
  AddChanges(changes, output->GetFieldData());
  return 1;
}

//------------------------------------------------------------------------------
std::vector<SegmentChanges> vtkSegmentTopology::MakeWhole(LabelledImage& image, bool gathered)
{
  if (image.Labels.empty())
  {
    throw std::invalid_argument("The image has no points.");
  }
  if (gathered)
  {
    vtkWarningMacro("Handles are a matter of the whole: the pieces of "
                    << this->Controller->GetNumberOfProcesses()
                    << " processes were gathered to process 0.");
  }
  TopologyOptions options;
  options.LargestSheet = this->LargestSheet;
  options.LargestCavity = this->LargestCavity;
  const std::vector<SegmentChanges> changes = MakeSegmentsWhole(image.Labels, image.View().Size,
    ChooseSegments(image.Labels, this->Segments), options, SMPExecution(this));
  for (const SegmentChanges& segment : changes)
  {
    if (std::find(image.Labels.begin(), image.Labels.end(), segment.Segment) == image.Labels.end())
    {
      vtkWarningMacro("Segment " << segment.Segment
                                 << " is gone: it lay in a cavity or a handle of "
                                 << "another. A smaller LargestCavity or LargestSheet keeps it.");
    }
    else if (segment.EulerCharacteristic < 1)
    {
      vtkWarningMacro("Segment " << segment.Segment << " still has handles: its Euler "
                                 << "characteristic is " << segment.EulerCharacteristic
                                 << ", less than 1. Larger sheets may be allowed.");
    }
  }
  return changes;
}

//------------------------------------------------------------------------------
// Collective: all get what process 0 has.
void vtkSegmentTopology::Share(LabelledImage& image)
{
  this->Controller->Broadcast(image.Extent.data(), 6, 0);
  vtkIdType count = static_cast<vtkIdType>(image.Labels.size());
  this->Controller->Broadcast(&count, 1, 0);
  image.Labels.resize(count);
  this->Controller->Broadcast(image.Labels.data(), count, 0);
}

//------------------------------------------------------------------------------
void vtkSegmentTopology::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Segments:";
  for (int segment : this->Segments)
  {
    os << " " << segment;
  }
  os << "\n" << indent << "LargestSheet: " << this->LargestSheet << "\n";
  os << indent << "LargestCavity: " << this->LargestCavity << "\n";
  os << indent << "Controller: " << this->Controller << "\n";
}
