// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTSplineSource.h"

#include "FilterRun.h"
#include "GatherSamples.h"
#include "SMPExecution.h"
#include "SegmentPoints.h"
#include "SharedPieces.h"
#include "TSpline/BezierMesh.h"
#include "TSplineCells.h"
#include "TSplineGrid.h"
#include "TSplinePoints.h"

#include "vtkDataSet.h"
#include "vtkDoubleArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMath.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <stdexcept>
#include <string>

vtkStandardNewMacro(vtkTSplineSource);
vtkCxxSetObjectMacro(vtkTSplineSource, Controller, vtkMultiProcessController);

namespace
{
// Makes the control points of process 0 known to all. Collective.
vtkSmartPointer<vtkPointSet> Broadcast(vtkPointSet* grid, vtkMultiProcessController* controller)
{
  auto everywhere = vtkSmartPointer<vtkUnstructuredGrid>::New();
  if (controller->GetLocalProcessId() == 0)
  {
    everywhere->SetPoints(grid->GetPoints());
    everywhere->GetPointData()->ShallowCopy(grid->GetPointData());
  }
  controller->Broadcast(everywhere, 0);
  return everywhere;
}

constexpr const char* LabelName = "Segment";

// Those of the points here; null: none.
vtkDataArray* LabelsHere(vtkInformation* pointsInfo)
{
  vtkDataSet* points = pointsInfo ? vtkDataSet::GetData(pointsInfo) : nullptr;
  return points ? points->GetPointData()->GetArray(LabelName) : nullptr;
}

// Those of an image that is spread over the processes, on process 0. Collective. Throws
// std::invalid_argument on one process where they cannot be brought together.
vtkSmartPointer<vtkDataArray> GatherLabels(
  vtkInformation* pointsInfo, vtkMultiProcessController* controller)
{
  trivariate::ImageSamples samples;
  std::string fault = trivariate::FaultOf(
    [&]()
    {
      if (vtkDataArray* labels = LabelsHere(pointsInfo))
      {
        samples = trivariate::ReadArrays(vtkImageData::GetData(pointsInfo), { labels });
      }
    });
  if (!trivariate::GatherSamples(samples, fault, controller))
  {
    if (!fault.empty())
    {
      throw std::invalid_argument(fault);
    }
    throw trivariate::Aborted(); // another process tells why
  }
  const int components = samples.Components();
  if (components == 0)
  {
    return nullptr;
  }
  auto labels = vtkSmartPointer<vtkDoubleArray>::New();
  labels->SetName(LabelName);
  labels->SetNumberOfComponents(components);
  labels->SetNumberOfTuples(samples.Count());
  auto value = samples.Values.begin();
  for (int c = 0; c < components; ++c)
  {
    for (vtkIdType point = 0; point < samples.Count(); ++point)
    {
      labels->SetTypedComponent(point, c, *value++);
    }
  }
  return labels;
}

// The lattice that the pipeline announces for an image; its data may be a piece of it.
void CopyLattice(vtkInformation* info, vtkImageData* image)
{
  image->SetExtent(info->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT()));
  if (info->Has(vtkDataObject::ORIGIN()))
  {
    image->SetOrigin(info->Get(vtkDataObject::ORIGIN()));
  }
  if (info->Has(vtkDataObject::SPACING()))
  {
    image->SetSpacing(info->Get(vtkDataObject::SPACING()));
  }
  if (info->Has(vtkDataObject::DIRECTION()))
  {
    image->SetDirectionMatrix(info->Get(vtkDataObject::DIRECTION()));
  }
}
}

vtkTSplineSource::vtkTSplineSource()
{
  this->SetNumberOfInputPorts(2);
  this->Surfaces.fill({ 0.5 });
  this->SetController(vtkMultiProcessController::GetGlobalController());
}

vtkTSplineSource::~vtkTSplineSource()
{
  this->SetController(nullptr);
}

int vtkTSplineSource::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), port == 0 ? "vtkPointSet" : "vtkDataSet");
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), port);
  return 1;
}

int vtkTSplineSource::RequestDataObject(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkDataObject* points = vtkDataObject::GetData(inputVector[1]);
  vtkSmartPointer<vtkDataObject> wanted;
  switch (this->OutputType)
  {
    case IMAGE:
      wanted = vtkSmartPointer<vtkImageData>::New();
      break;
    case ISO_SURFACES:
      wanted = vtkSmartPointer<vtkPolyData>::New();
      break;
    case POINTS:
      if (points)
      {
        wanted.TakeReference(points->NewInstance());
        break;
      }
      [[fallthrough]]; // RequestData says what is missing
    default:
      wanted = vtkSmartPointer<vtkUnstructuredGrid>::New();
  }
  vtkDataObject* output = vtkDataObject::GetData(outputVector);
  if (!output || output->GetDataObjectType() != wanted->GetDataObjectType())
  {
    outputVector->GetInformationObject(0)->Set(vtkDataObject::DATA_OBJECT(), wanted);
  }
  return 1;
}

int vtkTSplineSource::RequestInformation(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  vtkInformation* outInfo = outputVector->GetInformationObject(0);
  vtkInformation* pointsInfo = inputVector[1]->GetInformationObject(0);
  const bool image = this->OutputType == IMAGE;
  if ((image || this->OutputType == POINTS) && pointsInfo &&
      pointsInfo->Has(Pipeline::WHOLE_EXTENT()))
  {
    outInfo->CopyEntry(pointsInfo, Pipeline::WHOLE_EXTENT());
    outInfo->CopyEntry(pointsInfo, vtkDataObject::ORIGIN());
    outInfo->CopyEntry(pointsInfo, vtkDataObject::SPACING());
    outInfo->CopyEntry(pointsInfo, vtkDataObject::DIRECTION());
  }
  else if (image)
  {
    const int extent[6] = { 0, this->Dimensions[0] - 1, 0, this->Dimensions[1] - 1, 0,
      this->Dimensions[2] - 1 };
    outInfo->Set(Pipeline::WHOLE_EXTENT(), extent, 6);
  }
  return 1;
}

void vtkTSplineSource::CheckSettings(vtkDataObject* points) const
{
  if (this->OutputType == POINTS && !points)
  {
    throw std::invalid_argument("There is no second input; connect the points to evaluate at.");
  }
  if (this->OutputType == IMAGE && points && !vtkImageData::SafeDownCast(points))
  {
    throw std::invalid_argument(std::string("The second input is a ") + points->GetClassName() +
                                "; the lattice of an image is taken from a vtkImageData.");
  }
  const int smallest = *std::min_element(this->Dimensions, this->Dimensions + 3);
  if (this->OutputType == IMAGE && !points && smallest < 2)
  {
    throw std::invalid_argument(
      "The image has " + std::to_string(smallest) + " points along an axis; it needs two or more.");
  }
  if (this->OutputType == ISO_SURFACES)
  {
    for (const std::vector<double>& shares : this->Surfaces)
    {
      for (const double share : shares)
      {
        if (!(share >= 0.0 && share <= 1.0))
        {
          throw std::invalid_argument("A surface is placed at " + std::to_string(share) +
                                      " of the parameter's range; it must be 0 to 1.");
        }
      }
    }
  }
}

void vtkTSplineSource::Evaluate(
  vtkPointSet* grid, vtkInformation* pointsInfo, vtkDataArray* labels, vtkDataObject* output)
{
  const trivariate::Execution execution = trivariate::SMPExecution(this);
  const trivariate::TSplineModel model = trivariate::TSplineFromGrid(grid);
  const trivariate::BezierMesh mesh(model.Spline, execution.Part(0.0, 0.2));
  const trivariate::TSplineView view{ model, mesh, this->ComputeGradients, this->ComputeJacobian };
  const trivariate::Execution rest = execution.Part(0.2, 1.0);
  const auto fill = [&view, labels, output](const trivariate::Execution& part)
  {
    vtkDataSet* points = vtkDataSet::SafeDownCast(output);
    if (trivariate::GoBySegments(view.Model, labels != nullptr))
    {
      trivariate::FillPointsOfSegments(view, labels, points, part);
    }
    else
    {
      trivariate::FillPoints(view, points, part);
    }
  };
  switch (this->OutputType)
  {
    case IMAGE:
    {
      vtkImageData* image = vtkImageData::SafeDownCast(output);
      if (pointsInfo)
      {
        CopyLattice(pointsInfo, image);
      }
      else
      {
        trivariate::PlaceImage(view, this->Dimensions, image, rest.Part(0.0, 0.1));
      }
      fill(rest.Part(0.1, 1.0));
      break;
    }
    case POINTS:
      output->ShallowCopy(vtkDataObject::GetData(pointsInfo));
      fill(rest);
      break;
    case ISO_SURFACES:
      trivariate::FillSurfaces(
        view, this->Surfaces, this->Subdivisions, vtkPolyData::SafeDownCast(output), rest);
      break;
    case BEZIER_HEXES:
      trivariate::FillBezierHexahedra(view, vtkUnstructuredGrid::SafeDownCast(output), rest);
      break;
    case TMESH:
      trivariate::FillTMesh(view, vtkUnstructuredGrid::SafeDownCast(output), rest);
      break;
    default:
      trivariate::FillHexahedra(
        view, this->Subdivisions, vtkUnstructuredGrid::SafeDownCast(output), rest);
  }
}

int vtkTSplineSource::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkSmartPointer<vtkPointSet> grid = vtkPointSet::GetData(inputVector[0]);
  vtkInformation* pointsInfo = inputVector[1]->GetInformationObject(0);
  vtkDataObject* output = vtkDataObject::GetData(outputVector);
  output->Initialize();
  const bool alone = !this->Controller || this->Controller->GetNumberOfProcesses() == 1;
  try
  {
    this->CheckSettings(pointsInfo ? vtkDataObject::GetData(pointsInfo) : nullptr);
    const bool gathering = this->OutputType == IMAGE && pointsInfo &&
                           trivariate::ArePiecesShared(this->Controller, outputVector);
    const vtkSmartPointer<vtkDataArray> labels =
      gathering ? GatherLabels(pointsInfo, this->Controller)
                : vtkSmartPointer<vtkDataArray>(LabelsHere(pointsInfo));
    if (!alone && this->OutputType == POINTS)
    {
      grid = Broadcast(grid, this->Controller);
    }
    else if (!alone && this->Controller->GetLocalProcessId() != 0)
    {
      if (grid->GetNumberOfPoints() > 0)
      {
        throw std::invalid_argument("The T-spline is spread over several processes; bring it to "
                                    "process 0.");
      }
      return 1; // all is made where the spline is
    }
    this->Evaluate(grid, pointsInfo, labels, output);
  }
  catch (const trivariate::Aborted&)
  {
    output->Initialize();
  }
  catch (const std::bad_alloc&)
  {
    output->Initialize();
    vtkErrorMacro("The memory does not suffice for this output; ask for fewer points.");
    return 0;
  }
  catch (const std::exception& fault)
  {
    output->Initialize();
    vtkErrorMacro(<< fault.what());
    return 0;
  }
  return 1;
}

void vtkTSplineSource::AddSurface(int direction, double share)
{
  this->Surfaces[direction].push_back(share);
  this->Modified();
}

void vtkTSplineSource::RemoveAllSurfaces(int direction)
{
  if (!this->Surfaces[direction].empty())
  {
    this->Surfaces[direction].clear();
    this->Modified();
  }
}

int vtkTSplineSource::GetNumberOfSurfaces(int direction)
{
  const bool exists = direction >= 0 && direction < 3;
  return exists ? static_cast<int>(this->Surfaces[direction].size()) : 0;
}

double vtkTSplineSource::GetSurface(int direction, int index)
{
  const bool exists = index >= 0 && index < this->GetNumberOfSurfaces(direction);
  return exists ? this->Surfaces[direction][index] : vtkMath::Nan();
}

void vtkTSplineSource::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "OutputType: " << this->OutputType << "\n";
  os << indent << "Dimensions: " << this->Dimensions[0] << " " << this->Dimensions[1] << " "
     << this->Dimensions[2] << "\n";
  os << indent << "Subdivisions: " << this->Subdivisions << "\n";
  for (const std::vector<double>& shares : this->Surfaces)
  {
    os << indent << "Surfaces:";
    for (const double share : shares)
    {
      os << " " << share;
    }
    os << "\n";
  }
  os << indent << "ComputeGradients: " << this->ComputeGradients << "\n";
  os << indent << "ComputeJacobian: " << this->ComputeJacobian << "\n";
  os << indent << "Controller: " << this->Controller << "\n";
}
