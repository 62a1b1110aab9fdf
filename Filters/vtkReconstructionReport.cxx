// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkReconstructionReport.h"

#include "FilterRun.h"
#include "GatherSamples.h"
#include "SMPExecution.h"
#include "SegmentReport.h"
#include "SharedPieces.h"
#include "TSplineGrid.h"

#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkDoubleArray.h"
#include "vtkIdTypeArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkIntArray.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkStringArray.h"
#include "vtkTable.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

using namespace trivariate;

vtkStandardNewMacro(vtkReconstructionReport);
vtkCxxSetObjectMacro(vtkReconstructionReport, Controller, vtkMultiProcessController);

namespace
{
enum Ports
{
  IMAGE,
  TSPLINE,
  SURFACES,
  ROUNDS
};

//------------------------------------------------------------------------------
void ToTable(const std::vector<ReportRow>& rows, vtkTable* table)
{
  for (const std::string& name : ReportColumns())
  {
    if (name == "Domain")
    {
      vtkNew<vtkStringArray> domains;
      domains->SetName(name.c_str());
      for (const ReportRow& row : rows)
      {
        domains->InsertNextValue(row.Domain);
      }
      table->AddColumn(domains);
      continue;
    }
    vtkSmartPointer<vtkDataArray> column = vtkSmartPointer<vtkDoubleArray>::New();
    if (name == "Segment")
    {
      column = vtkSmartPointer<vtkIntArray>::New();
    }
    else if (name == "Voxels")
    {
      column = vtkSmartPointer<vtkIdTypeArray>::New();
    }
    column->SetName(name.c_str());
    for (const ReportRow& row : rows)
    {
      column->InsertNextTuple1(row.Numbers.at(name));
    }
    table->AddColumn(column);
  }
}

//------------------------------------------------------------------------------
// The attribute of the spline with the name of the array to compare.
int FindAttribute(const TSplineModel& model, const std::string& name)
{
  std::string known;
  for (std::size_t a = 0; a < model.Attributes.size(); ++a)
  {
    if (model.Attributes[a].Name == name)
    {
      if (model.Attributes[a].Components != 1)
      {
        throw std::invalid_argument("The attribute \"" + name + "\" of the T-spline has " +
                                    std::to_string(model.Attributes[a].Components) +
                                    " components; choose one with one.");
      }
      return static_cast<int>(a);
    }
    known += (known.empty() ? "" : ", ") + model.Attributes[a].Name;
  }
  throw std::invalid_argument("The T-spline has no attribute \"" + name +
                              "\" to compare with; it has: " + (known.empty() ? "none" : known) +
                              ".");
}

//------------------------------------------------------------------------------
// Splines of several segments overlap in space.
void CheckLabels(const ReportInput& input)
{
  const std::size_t count = SegmentsOf(input.Model).size();
  if (count > 1 && input.Labels < 0)
  {
    throw std::invalid_argument(
      "The T-spline has " + std::to_string(count) +
      " segments, but the image has no point array \"Segment\" that tells which of them a voxel "
      "belongs to; take the output Segments of T-Spline Reconstruction, or choose Labels.");
  }
}

//------------------------------------------------------------------------------
void CheckFinite(const ImageSamples& image)
{
  const auto end = image.Values.begin() + image.Count();
  const auto bad =
    std::find_if(image.Values.begin(), end, [](double value) { return !std::isfinite(value); });
  if (bad != end)
  {
    throw std::invalid_argument(
      "The array \"" + image.Attributes[0].Name + "\" is " + std::to_string(*bad) + " at voxel " +
      std::to_string(bad - image.Values.begin()) + "; it must be finite everywhere.");
  }
}
}

//------------------------------------------------------------------------------
vtkReconstructionReport::vtkReconstructionReport()
{
  this->SetNumberOfInputPorts(4);
  this->SetInputArrayToProcess(
    0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, vtkDataSetAttributes::SCALARS);
  this->SetInputArrayToProcess(1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Automatic");
  this->SetController(vtkMultiProcessController::GetGlobalController());
}

vtkReconstructionReport::~vtkReconstructionReport()
{
  this->SetController(nullptr);
}

//------------------------------------------------------------------------------
int vtkReconstructionReport::FillInputPortInformation(int port, vtkInformation* info)
{
  const char* types[] = { "vtkImageData", "vtkPointSet", "vtkPolyData", "vtkTable" };
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), types[port]);
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), port >= SURFACES);
  return 1;
}

//------------------------------------------------------------------------------
int vtkReconstructionReport::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkInformation* inInfo = inputVector[IMAGE]->GetInformationObject(0);
  inInfo->Set(vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
  if (!ArePiecesShared(this->Controller, outputVector))
  {
    RequestWholeImage(inInfo);
  }
  return 1;
}

//------------------------------------------------------------------------------
void vtkReconstructionReport::ReadImage(vtkImageData* image, ReportInput& input)
{
  vtkPointData* data = image->GetPointData();
  vtkDataArray* chosen = ChosenValues(this, image, this->GetInputArrayToProcess(0, image));
  if (chosen->GetNumberOfComponents() != 1)
  {
    throw std::invalid_argument("The array \"" + std::string(chosen->GetName()) + "\" has " +
                                std::to_string(chosen->GetNumberOfComponents()) +
                                " components; choose one with one.");
  }
  const char* labelName = this->GetInputArrayInformation(1)->Get(vtkDataObject::FIELD_NAME());
  const std::string wanted = labelName ? labelName : "";
  const bool automatic = wanted.empty() || wanted == "Automatic";
  vtkDataArray* labels =
    automatic ? data->GetArray("Segment") : this->GetInputArrayToProcess(1, image);
  if (!automatic && !labels)
  {
    throw std::invalid_argument("The image has no point array \"" + wanted + "\" of labels.");
  }
  std::vector<vtkDataArray*> arrays = { chosen };
  int block = 1;
  const auto add = [&arrays, &block](vtkDataArray* array, int components, int& first)
  {
    if (!array)
    {
      return;
    }
    if (array->GetNumberOfComponents() != components)
    {
      throw std::invalid_argument("The array \"" + std::string(array->GetName()) + "\" has " +
                                  std::to_string(array->GetNumberOfComponents()) + " components; " +
                                  std::to_string(components) + " are needed.");
    }
    arrays.push_back(array);
    first = block;
    block += components;
  };
  add(labels, 1, input.Labels);
  add(data->GetArray("Parameter"), 3, input.Parameter);
  add(input.Parameter < 0 ? nullptr : data->GetArray("ParameterMask"), 1, input.Mask);
  input.ScalarType = chosen->GetDataType();
  input.Image = ReadArrays(image, arrays);
}

//------------------------------------------------------------------------------
int vtkReconstructionReport::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkImageData* image = vtkImageData::GetData(inputVector[IMAGE]);
  vtkPointSet* grid = vtkPointSet::GetData(inputVector[TSPLINE]);
  const bool gathering = ArePiecesShared(this->Controller, outputVector);
  const int piece = outputVector->GetInformationObject(0)->Get(
    vtkStreamingDemandDrivenPipeline::UPDATE_PIECE_NUMBER());
  if (!gathering && piece > 0)
  {
    return 1; // the first piece is all
  }
  ReportInput input;
  std::string fault = FaultOf(
    [&]()
    {
      if (image->GetNumberOfPoints() > 0)
      {
        this->ReadImage(image, input);
      }
    });
  return RunTellingErrors(this, "crop or coarsen the image.",
    [&]()
    {
      if (gathering)
      {
        // A process without voxels does not know the arrays.
        const int own[4] = { input.ScalarType, input.Labels, input.Parameter, input.Mask };
        int all[4];
        this->Controller->AllReduce(own, all, 4, vtkCommunicator::MAX_OP);
        input.ScalarType = all[0];
        input.Labels = all[1];
        input.Parameter = all[2];
        input.Mask = all[3];
        const bool sound = GatherSamples(input.Image, fault, this->Controller);
        if (const auto answer = AnswerElsewhere(
              this, "The report is made on one process", sound, fault, this->Controller))
        {
          return *answer;
        }
      }
      if (!fault.empty())
      {
        throw std::invalid_argument(fault);
      }
      if (input.Image.Count() == 0)
      {
        throw std::invalid_argument("The image has no points.");
      }
      CheckFinite(input.Image);
      input.Model = TSplineFromGrid(grid);
      CheckLabels(input);
      input.Attribute = FindAttribute(input.Model, input.Image.Attributes[0].Name);
      vtkNew<vtkImageData> lattice;
      lattice->CopyStructure(image);
      lattice->SetExtent(input.Image.Extent.data());
      input.Lattice = lattice;
      input.Surfaces = vtkPolyData::GetData(inputVector[SURFACES]);
      input.Rounds = vtkTable::GetData(inputVector[ROUNDS]);
      ToTable(MakeReport(input, SMPExecution(this)), vtkTable::GetData(outputVector));
      return 1;
    });
}

//------------------------------------------------------------------------------
void vtkReconstructionReport::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Controller: " << this->Controller << "\n";
}
