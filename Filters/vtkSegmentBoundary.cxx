// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSegmentBoundary.h"

#include "Boundary/SegmentBoundary.h"
#include "BoundaryPolyData.h"
#include "FilterRun.h"
#include "LabelledImage.h"
#include "ListProperty.h"
#include "SMPExecution.h"
#include "SharedPieces.h"

#include "vtkDataObject.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiProcessController.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <stdexcept>
#include <string>

using namespace trivariate;

vtkStandardNewMacro(vtkSegmentBoundary);
vtkCxxSetObjectMacro(vtkSegmentBoundary, Controller, vtkMultiProcessController);

//------------------------------------------------------------------------------
vtkSegmentBoundary::vtkSegmentBoundary()
{
  this->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Segment");
  this->SetInputArrayToProcess(1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Automatic");
  this->SetController(vtkMultiProcessController::GetGlobalController());
}

vtkSegmentBoundary::~vtkSegmentBoundary()
{
  this->SetController(nullptr);
}

//------------------------------------------------------------------------------
void vtkSegmentBoundary::AddSegment(int segment)
{
  AddEntry(this, this->Segments, segment);
}

void vtkSegmentBoundary::ClearSegments()
{
  ClearEntries(this, this->Segments);
}

int vtkSegmentBoundary::GetSegment(int i) const
{
  return EntryOf(this->Segments, i, -1);
}

//------------------------------------------------------------------------------
int vtkSegmentBoundary::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  return 1;
}

//------------------------------------------------------------------------------
// The array of SetInputArrayToProcess(1, ...), or the first one fit for it; null if there is none
// or none is wanted.
vtkDataArray* vtkSegmentBoundary::DensityArray(vtkImageData* image, vtkDataArray* labels)
{
  if (!this->UseDensity)
  {
    return nullptr;
  }
  vtkPointData* data = image->GetPointData();
  const char* name = this->GetInputArrayInformation(1)->Get(vtkDataObject::FIELD_NAME());
  const std::string wanted = name ? name : "";
  vtkDataArray* chosen = this->GetInputArrayToProcess(1, image);
  if (chosen)
  {
    return chosen == labels ? nullptr : chosen;
  }
  if (!wanted.empty() && wanted != "Automatic")
  {
    throw std::invalid_argument("The image has no point array \"" + wanted +
                                "\" for a density; choose another or switch UseDensity off.");
  }
  const auto isFit = [data, labels](vtkDataArray* array)
  {
    return array && array != labels &&
           array != data->GetArray(vtkDataSetAttributes::GhostArrayName()) &&
           array->GetNumberOfComponents() == 1;
  };
  if (isFit(data->GetScalars()))
  {
    return data->GetScalars();
  }
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    if (isFit(data->GetArray(i)))
    {
      return data->GetArray(i);
    }
  }
  return nullptr;
}

//------------------------------------------------------------------------------
int vtkSegmentBoundary::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  vtkInformation* inInfo = inputVector[0]->GetInformationObject(0);
  inInfo->Set(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
  if (!ArePiecesShared(this->Controller, outputVector))
  {
    RequestWholeImage(inInfo);
  }
  return 1;
}

//------------------------------------------------------------------------------
int vtkSegmentBoundary::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkImageData* input = vtkImageData::GetData(inputVector[0]);
  vtkPolyData* output = vtkPolyData::GetData(outputVector);
  const bool gathering = ArePiecesShared(this->Controller, outputVector);
  const int piece = outputVector->GetInformationObject(0)->Get(
    vtkStreamingDemandDrivenPipeline::UPDATE_PIECE_NUMBER());
  if (!gathering && piece > 0)
  {
    return 1; // the first piece is all
  }
  LabelledImage image;
  std::string fault = FaultOf(
    [&]()
    {
      if (input->GetNumberOfPoints() > 0)
      {
        vtkDataArray* labels = ChosenLabels(input, this->GetInputArrayToProcess(0, input),
          this->GetInputArrayInformation(0)->Get(vtkDataObject::FIELD_NAME()));
        image = ReadLabels(input, labels, this->DensityArray(input, labels));
      }
    });
  return RunTellingErrors(this, "crop or coarsen the image.",
    [&]()
    {
      if (gathering)
      {
        const bool sound = GatherLabels(image, fault, this->Controller);
        if (const auto answer = AnswerElsewhere(
              this, "Surfaces are made on one process", sound, fault, this->Controller))
        {
          return *answer;
        }
      }
      if (!fault.empty())
      {
        throw std::invalid_argument(fault);
      }
      if (image.Labels.empty())
      {
        throw std::invalid_argument("The image has no points.");
      }
      CheckLabels(image, this->Segments);

      BoundaryOptions options;
      options.SmoothingIterations = this->SmoothingIterations;
      options.Density = image.Density.empty() ? nullptr : image.Density.data();
      const SegmentBoundary boundary =
        ComputeSegmentBoundary(image.View(), options, SMPExecution(this, 0.0, 0.95));
      if (boundary.Intersections > 0)
      {
        vtkWarningMacro(
          "The surface meets itself at " << boundary.Intersections << " pairs of triangles.");
      }
      BoundaryToPolyData(boundary, image, this->Segments, output);
      return 1;
    });
}

//------------------------------------------------------------------------------
void vtkSegmentBoundary::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Segments:";
  for (int segment : this->Segments)
  {
    os << " " << segment;
  }
  os << "\n" << indent << "SmoothingIterations: " << this->SmoothingIterations << "\n";
  os << indent << "UseDensity: " << this->UseDensity << "\n";
  os << indent << "Controller: " << this->Controller << "\n";
}
