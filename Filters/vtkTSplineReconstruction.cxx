// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTSplineReconstruction.h"

#include "ChainStep.h"
#include "SMPExecution.h"
#include "SegmentFits.h"
#include "SharedPieces.h"
#include "TSplineGrid.h"
#include "vtkPolycubeDomain.h"
#include "vtkSegmentBoundary.h"
#include "vtkSegmentTopology.h"
#include "vtkTSplineFit.h"
#include "vtkTextureSegmentation.h"

#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTable.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <new>
#include <stdexcept>

using namespace trivariate;

vtkStandardNewMacro(vtkTSplineReconstruction);

namespace
{
enum Outputs
{
  TSPLINE,
  ROUNDS,
  SEGMENTED,
  SURFACES,
  PATCHES,
  POLYCUBES
};

// Where the steps end, as shares of the progress.
constexpr double Segmented = 0.3, Whole = 0.35, Bounded = 0.4, LaidOut = 0.5;

//------------------------------------------------------------------------------
// The image with these arrays only; that of labels, the last one, gets the name Segment.
vtkSmartPointer<vtkImageData> MakeImage(vtkImageData* like, const int* extent,
  const std::vector<vtkSmartPointer<vtkDataArray>>& arrays, bool labelled)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetOrigin(like->GetOrigin());
  image->SetSpacing(like->GetSpacing());
  image->SetDirectionMatrix(like->GetDirectionMatrix());
  image->SetExtent(const_cast<int*>(extent));
  for (std::size_t a = 0; a < arrays.size(); ++a)
  {
    vtkSmartPointer<vtkDataArray> array = arrays[a];
    if (labelled && a + 1 == arrays.size())
    {
      array = vtk::TakeSmartPointer(arrays[a]->NewInstance());
      array->ShallowCopy(arrays[a]);
      array->SetName("Segment");
    }
    image->GetPointData()->AddArray(array);
  }
  image->GetPointData()->SetActiveScalars(arrays.front()->GetName());
  return image;
}
}

//------------------------------------------------------------------------------
vtkTSplineReconstruction::vtkTSplineReconstruction()
{
  this->SetNumberOfOutputPorts(6);
  this->SetInputArrayToProcess(
    0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, vtkDataSetAttributes::SCALARS);
  this->SetInputArrayToProcess(1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "None");
}

vtkTSplineReconstruction::~vtkTSplineReconstruction() = default;

//------------------------------------------------------------------------------
void vtkTSplineReconstruction::AddAttribute(const char* name)
{
  if (name && *name)
  {
    this->Attributes.emplace_back(name);
    this->Modified();
  }
}

void vtkTSplineReconstruction::ClearAttributes()
{
  if (!this->Attributes.empty())
  {
    this->Attributes.clear();
    this->Modified();
  }
}

const char* vtkTSplineReconstruction::GetAttribute(int i) const
{
  return i >= 0 && i < this->GetNumberOfAttributes() ? this->Attributes[i].c_str() : nullptr;
}

//------------------------------------------------------------------------------
int vtkTSplineReconstruction::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  return 1;
}

int vtkTSplineReconstruction::FillOutputPortInformation(int port, vtkInformation* info)
{
  const char* types[] = { "vtkUnstructuredGrid", "vtkTable", "vtkImageData", "vtkPolyData",
    "vtkPolyData", "vtkUnstructuredGrid" };
  info->Set(vtkDataObject::DATA_TYPE_NAME(), types[port]);
  return 1;
}

//------------------------------------------------------------------------------
int vtkTSplineReconstruction::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector*)
{
  RequestWholeImage(inputVector[0]->GetInformationObject(0));
  return 1;
}

//------------------------------------------------------------------------------
std::vector<vtkDataArray*> vtkTSplineReconstruction::ChosenArrays(vtkImageData* image)
{
  const char* name = this->GetInputArrayInformation(0)->Get(vtkDataObject::FIELD_NAME());
  vtkDataArray* chosen =
    name && !*name ? image->GetPointData()->GetScalars() : this->GetInputArrayToProcess(0, image);
  if (!chosen || !chosen->GetName())
  {
    throw std::invalid_argument("The image does not have the point array that was chosen; use "
                                "SetInputArrayToProcess(0, ...).");
  }
  std::vector<vtkDataArray*> arrays = { chosen };
  for (const std::string& further : this->Attributes)
  {
    vtkDataArray* array = image->GetPointData()->GetArray(further.c_str());
    if (!array)
    {
      throw std::invalid_argument("The image has no point array \"" + further + "\" to fit.");
    }
    if (array != chosen)
    {
      arrays.push_back(array);
    }
  }
  return arrays;
}

//------------------------------------------------------------------------------
void vtkTSplineReconstruction::FitBox(vtkImageData* image, vtkInformationVector* outputVector)
{
  vtkNew<vtkTSplineFit> fit;
  fit->SetController(nullptr);
  fit->SetInputData(image);
  fit->SetInputArrayToProcess(
    0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, image->GetPointData()->GetArrayName(0));
  for (const std::string& name : this->Attributes)
  {
    fit->AddAttribute(name.c_str());
  }
  fit->SetMaximumNumberOfControlPoints(this->MaximumNumberOfControlPoints);
  fit->SetRMSTolerance(this->RMSTolerance);
  ChainStep step(fit, this, 0.0, 1.0);
  step.Run();
  vtkUnstructuredGrid::GetData(outputVector, TSPLINE)->ShallowCopy(fit->GetOutput());
  vtkTable::GetData(outputVector, ROUNDS)->ShallowCopy(fit->GetOutputDataObject(1));
}

//------------------------------------------------------------------------------
// Surfaces, patches and polycubes; where there is none a warning says why.
void vtkTSplineReconstruction::LayOut(vtkImageData* segments, vtkInformationVector* outputVector)
{
  try
  {
    vtkNew<vtkSegmentBoundary> boundary;
    boundary->SetController(nullptr);
    boundary->SetInputData(segments);
    ChainStep bound(boundary, this, Whole, Bounded);
    bound.Run();
    vtkPolyData::GetData(outputVector, SURFACES)->ShallowCopy(boundary->GetOutput());

    vtkNew<vtkPolycubeDomain> domain;
    domain->SetController(nullptr);
    domain->SetInputData(boundary->GetOutput());
    ChainStep layOut(domain, this, Bounded, LaidOut);
    layOut.Run();
    vtkPolyData::GetData(outputVector, PATCHES)->ShallowCopy(domain->GetPatches());
    vtkUnstructuredGrid::GetData(outputVector, POLYCUBES)->ShallowCopy(domain->GetPolycube());
    for (const std::string& warning : layOut.Warnings())
    {
      vtkWarningMacro(<< warning);
    }
  }
  catch (const std::runtime_error& reason)
  {
    vtkWarningMacro("No segment has a domain of cubes: " << reason.what());
  }
}

//------------------------------------------------------------------------------
void vtkTSplineReconstruction::FitParts(
  vtkImageData* image, bool labelled, vtkInformationVector* outputVector)
{
  SegmentFitOptions options;
  options.Array = image->GetPointData()->GetArrayName(0);
  options.Further = this->Attributes;
  options.MaximumControlPoints = this->MaximumNumberOfControlPoints;
  options.RmsTolerance = this->RMSTolerance;
  options.OverDomains = this->Domain == AUTOMATIC;

  vtkNew<vtkImageData> segments;
  segments->ShallowCopy(image);
  if (!labelled)
  {
    vtkNew<vtkTextureSegmentation> segmentation;
    segmentation->SetController(nullptr);
    segmentation->SetInputData(image);
    segmentation->SetInputArrayToProcess(
      0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, options.Array.c_str());
    segmentation->SetNumberOfSegments(this->NumberOfSegments);
    ChainStep segment(segmentation, this, 0.0, Segmented);
    segment.Run();
    for (const std::string& warning : segment.Warnings())
    {
      vtkWarningMacro(<< warning);
    }
    segments->ShallowCopy(segmentation->GetOutput());
  }
  vtkNew<vtkSegmentTopology> topology;
  topology->SetController(nullptr);
  topology->SetInputData(segments);
  ChainStep makeWhole(topology, this, Segmented, Whole);
  makeWhole.Run();
  segments->ShallowCopy(topology->GetOutput());
  double range[2];
  segments->GetPointData()->GetArray("Segment")->GetRange(range);
  if (range[0] < range[1])
  {
    this->LayOut(segments, outputVector);
  }
  vtkImageData::GetData(outputVector, SEGMENTED)->ShallowCopy(segments);
  std::vector<std::string> why;
  const TSplineModel model = FitSegments(
    segments, options, vtkTable::GetData(outputVector, ROUNDS), why, this, LaidOut, 1.0);
  for (const std::string& reason : why)
  {
    vtkWarningMacro(<< reason);
  }
  TSplineToGrid(model, vtkUnstructuredGrid::GetData(outputVector, TSPLINE));
}

//------------------------------------------------------------------------------
int vtkTSplineReconstruction::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkImageData* input = vtkImageData::GetData(inputVector[0]);
  const int piece = outputVector->GetInformationObject(0)->Get(
    vtkStreamingDemandDrivenPipeline::UPDATE_PIECE_NUMBER());
  if (piece > 0)
  {
    return 1; // the first piece is all
  }
  const char* name = this->GetInputArrayInformation(1)->Get(vtkDataObject::FIELD_NAME());
  const std::string labelName = name ? name : "";
  const bool labelled = this->Domain != BOX && !labelName.empty() && labelName != "None";
  std::vector<vtkSmartPointer<vtkDataArray>> arrays;
  std::array<int, 6> extent;
  input->GetExtent(extent.data());
  std::string fault;
  try
  {
    if (input->GetNumberOfPoints() > 0)
    {
      std::vector<vtkDataArray*> chosen = this->ChosenArrays(input);
      if (labelled)
      {
        chosen.push_back(this->GetInputArrayToProcess(1, input));
        if (!chosen.back())
        {
          throw std::invalid_argument(
            "The image has no point array \"" + labelName + "\" of labels.");
        }
      }
      arrays.assign(chosen.begin(), chosen.end());
    }
  }
  catch (const std::exception& error)
  {
    fault = error.what();
  }
  try
  {
    if (!fault.empty())
    {
      throw std::invalid_argument(fault);
    }
    if (arrays.empty())
    {
      throw std::invalid_argument("The image has no points.");
    }
    const auto image = MakeImage(input, extent.data(), arrays, labelled);
    if (this->Domain == BOX)
    {
      this->FitBox(image, outputVector);
    }
    else
    {
      this->FitParts(image, labelled, outputVector);
    }
  }
  catch (const Aborted&)
  {
    return 1; // the executive empties the outputs
  }
  catch (const std::bad_alloc&)
  {
    vtkErrorMacro("Out of memory; crop or coarsen the image, or allow fewer than "
                  << this->MaximumNumberOfControlPoints << " control points.");
    return 0;
  }
  catch (const std::exception& error)
  {
    vtkErrorMacro(<< error.what());
    return 0;
  }
  return 1;
}

//------------------------------------------------------------------------------
void vtkTSplineReconstruction::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Domain: " << this->Domain << "\n";
  os << indent << "NumberOfSegments: " << this->NumberOfSegments << "\n";
  os << indent << "MaximumNumberOfControlPoints: " << this->MaximumNumberOfControlPoints << "\n";
  os << indent << "RMSTolerance: " << this->RMSTolerance << "\n";
  os << indent << "Attributes:";
  for (const std::string& name : this->Attributes)
  {
    os << " " << name;
  }
  os << "\n";
}
