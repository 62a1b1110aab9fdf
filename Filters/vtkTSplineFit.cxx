// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTSplineFit.h"

#include "DomainSamples.h"
#include "FilterRun.h"
#include "Fit/BlockFit.h"
#include "GatherSamples.h"
#include "ListProperty.h"
#include "SMPExecution.h"
#include "SharedPieces.h"
#include "TSplineGrid.h"

#include "vtkDataObject.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIdTypeArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkIntArray.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkPointData.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkStringArray.h"
#include "vtkTable.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <set>
#include <stdexcept>

using namespace trivariate;

vtkStandardNewMacro(vtkTSplineFit);
vtkCxxSetObjectMacro(vtkTSplineFit, Controller, vtkMultiProcessController);

namespace
{
//------------------------------------------------------------------------------
TSplineModel ToModel(FitResult& result, const ImageSamples& samples)
{
  TSplineModel model;
  model.Spline = std::move(result.Spline);
  for (Index i = 0; i < model.Spline.Size(); ++i)
  {
    const std::array<double, 3> point = samples.ToPhysical(model.Spline.ControlPoint(i));
    std::copy(point.begin(), point.end(), model.Spline.ControlPoint(i));
  }
  model.Attributes = samples.Attributes;
  model.Segment.assign(model.Spline.Size(), 0);
  model.Block.assign(model.Spline.Size(), 0);
  std::copy(result.RootCells.begin(), result.RootCells.end(), model.RootCells.begin());
  return model;
}

//------------------------------------------------------------------------------
TSplineModel ToModel(
  BlockFitResult& result, const BlockComplex& blocks, const ImageSamples& samples)
{
  TSplineModel model;
  model.Spline = std::move(result.Spline);
  model.Attributes = samples.Attributes;
  for (const Index block : result.BlockOf)
  {
    model.Segment.push_back(blocks.Segments[block]);
    model.Block.push_back(blocks.Groups[block]);
  }
  return model;
}

//------------------------------------------------------------------------------
template <typename ArrayT>
void AddNumbers(vtkFieldData* field, const char* name, const std::vector<double>& numbers)
{
  vtkNew<ArrayT> array;
  array->SetName(name);
  array->SetNumberOfComponents(static_cast<int>(numbers.size()));
  array->InsertNextTuple(numbers.data());
  field->AddArray(array);
}

//------------------------------------------------------------------------------
void ReportShape(const BlockFitResult& result, Index voxels, double spacing,
  const std::set<int>& layered, vtkFieldData* field)
{
  const auto number = [](Index n) { return static_cast<double>(n); };
  AddNumbers<vtkIdTypeArray>(field, "ShapeControlPoints", { number(result.ShapePoints) });
  AddNumbers<vtkDoubleArray>(
    field, "ShapeDistance", { result.ShapeRms / spacing, result.ShapeMaximum / spacing });
  AddNumbers<vtkIdTypeArray>(field, "NumbersFitted", { number(result.NumbersFitted) });
  AddNumbers<vtkIdTypeArray>(
    field, "VoxelsInside", { number(result.VoxelsInside), number(voxels) });
  AddNumbers<vtkIdTypeArray>(field, "VoxelsNear", { number(result.VoxelsNear) });
  AddNumbers<vtkDoubleArray>(field, "SmallestJacobian", { result.Folds.SmallestJacobian });
  vtkNew<vtkIntArray> segments;
  segments->SetName("FittedSegment");
  vtkNew<vtkDoubleArray> errors;
  errors->SetName("FittedSegmentRMS");
  vtkNew<vtkStringArray> domains;
  domains->SetName("FittedDomain");
  for (const auto& [segment, rms] : result.SegmentRms)
  {
    segments->InsertNextValue(segment);
    errors->InsertNextValue(100.0 * rms);
    domains->InsertNextValue(layered.count(segment) > 0 ? "LayeredCubes" : "Cubes");
  }
  field->AddArray(segments);
  field->AddArray(errors);
  field->AddArray(domains);
  AddNumbers<vtkDoubleArray>(field, "FittedRange", result.Ranges);
  AddNumbers<vtkDoubleArray>(field, "GradientJump", { result.Jump.Rms, result.Jump.Maximum });
  AddNumbers<vtkIdTypeArray>(field, "ShapeCells",
    { number(result.Folds.Cells), number(result.Folds.Folded), number(result.Folds.Certified) });
}

//------------------------------------------------------------------------------
void ToTable(const std::vector<FitRound>& rounds, vtkTable* table)
{
  vtkNew<vtkIdTypeArray> controlPoints;
  controlPoints->SetName("ControlPoints");
  vtkNew<vtkDoubleArray> rms, maximumError, seconds;
  rms->SetName("RMS");
  maximumError->SetName("MaximumError");
  seconds->SetName("Seconds");
  for (const FitRound& round : rounds)
  {
    controlPoints->InsertNextValue(round.ControlPoints);
    rms->InsertNextValue(100.0 * round.Rms);
    maximumError->InsertNextValue(round.MaximumError);
    seconds->InsertNextValue(round.Seconds);
  }
  table->AddColumn(controlPoints);
  table->AddColumn(rms);
  table->AddColumn(maximumError);
  table->AddColumn(seconds);
}
}

//------------------------------------------------------------------------------
vtkTSplineFit::vtkTSplineFit()
{
  this->SetNumberOfInputPorts(3);
  this->SetNumberOfOutputPorts(2);
  this->SetInputArrayToProcess(
    0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, vtkDataSetAttributes::SCALARS);
  this->SetController(vtkMultiProcessController::GetGlobalController());
}

vtkTSplineFit::~vtkTSplineFit()
{
  this->SetController(nullptr);
}

//------------------------------------------------------------------------------
void vtkTSplineFit::AddAttribute(const char* name)
{
  if (name && *name)
  {
    AddEntry(this, this->Attributes, std::string(name));
  }
}

void vtkTSplineFit::ClearAttributes()
{
  ClearEntries(this, this->Attributes);
}

const char* vtkTSplineFit::GetAttribute(int i) const
{
  return i >= 0 && i < this->GetNumberOfAttributes() ? this->Attributes[i].c_str() : nullptr;
}

void vtkTSplineFit::SetMaskArray(const char* name)
{
  const std::string wanted = name ? name : "";
  if (wanted != this->MaskArray)
  {
    this->MaskArray = wanted;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
int vtkTSplineFit::FillInputPortInformation(int port, vtkInformation* info)
{
  const char* const types[3] = { "vtkImageData", "vtkUnstructuredGrid",
    "vtkPartitionedDataSetCollection" };
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), types[port]);
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), port > 0 ? 1 : 0);
  return 1;
}

int vtkTSplineFit::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 0 ? "vtkUnstructuredGrid" : "vtkTable");
  return 1;
}

//------------------------------------------------------------------------------
int vtkTSplineFit::RequestUpdateExtent(
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
void vtkTSplineFit::FitImage(ImageSamples& samples, vtkUnstructuredGrid* output, vtkTable* rounds)
{
  FitOptions options;
  options.Rule = static_cast<Refinement>(this->RefinementRule);
  options.MaximumControlPoints = this->MaximumNumberOfControlPoints;
  options.RmsTolerance = this->RMSTolerance / 100.0;
  options.MaximumErrorTolerance = this->MaximumErrorTolerance;
  options.Independent = this->LinearlyIndependent;
  FitResult result = FitGrid(samples.View(), options, SMPExecution(this));
  TSplineToGrid(ToModel(result, samples), output);
  ToTable(result.Rounds, rounds);
}

//------------------------------------------------------------------------------
void vtkTSplineFit::FitDomain(ImageSamples& samples, vtkInformationVector** inputVector,
  vtkUnstructuredGrid* output, vtkTable* rounds)
{
  const BlockComplex blocks = ReadBlocks(vtkUnstructuredGrid::GetData(inputVector[1]));
  const BlockSamples voxels = TakeVoxels(samples, blocks);
  const ShapeSamples shape =
    ReadShape(vtkPartitionedDataSetCollection::GetData(inputVector[2]), blocks);
  BlockFitOptions options;
  options.Rule = static_cast<Refinement>(this->RefinementRule);
  options.MaximumControlPoints = this->MaximumNumberOfControlPoints;
  options.RmsTolerance = this->RMSTolerance / 100.0;
  options.MaximumErrorTolerance = this->MaximumErrorTolerance;
  options.Spacing = VoxelSpacing(samples);
  options.ShapeTolerance = this->ShapeTolerance * options.Spacing;
  options.MaximumShapePoints =
    static_cast<Index>(this->ShapeShare * this->MaximumNumberOfControlPoints);
  options.LargestShapeDistance = this->LargestShapeDistance * options.Spacing;
  BlockFitResult result = FitBlocks(blocks, voxels, shape, options, SMPExecution(this));
  if (result.Folds.Folded > 0)
  {
    vtkWarningMacro("The shape folds in " << result.Folds.Folded << " of " << result.Folds.Cells
                                          << " cells; allow more control points, or improve the "
                                             "parameterization there.");
  }
  vtkNew<vtkIdTypeArray> shared;
  shared->SetName("SharedControlPoint");
  for (const Index point : result.PointOf)
  {
    shared->InsertNextValue(point);
  }
  ToTable(result.Rounds, rounds);
  ReportShape(result, voxels.Count(), options.Spacing,
    LayeredSegments(vtkUnstructuredGrid::GetData(inputVector[1])), rounds->GetFieldData());
  TSplineToGrid(ToModel(result, blocks, samples), output);
  output->GetPointData()->AddArray(shared);
}

//------------------------------------------------------------------------------
int vtkTSplineFit::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkImageData* input = vtkImageData::GetData(inputVector[0]);
  vtkUnstructuredGrid* output = vtkUnstructuredGrid::GetData(outputVector, 0);
  vtkTable* rounds = vtkTable::GetData(outputVector, 1);
  const bool gathering = ArePiecesShared(this->Controller, outputVector);
  const int piece = outputVector->GetInformationObject(0)->Get(
    vtkStreamingDemandDrivenPipeline::UPDATE_PIECE_NUMBER());
  if (!gathering && piece > 0)
  {
    return 1; // the first piece is all
  }
  const bool isDomain = this->GetNumberOfInputConnections(1) > 0;
  ImageSamples samples;
  std::string fault = FaultOf(
    [&]()
    {
      if (input->GetNumberOfPoints() > 0)
      {
        std::vector<std::string> further = this->Attributes;
        if (isDomain)
        {
          further.insert(further.end(), { ParameterArrayName, ParameterMaskName });
        }
        vtkDataArray* chosen = ChosenValues(this, input, this->GetInputArrayToProcess(0, input));
        samples = ReadSamples(input, chosen, further, this->MaskArray);
      }
    });
  return RunTellingErrors(this,
    "crop or coarsen the image, or allow fewer than " +
      std::to_string(this->MaximumNumberOfControlPoints) + " control points.",
    [&]()
    {
      if (gathering)
      {
        const bool sound = GatherSamples(samples, fault, this->Controller);
        if (const auto answer =
              AnswerElsewhere(this, "The fit is one global solve", sound, fault, this->Controller))
        {
          return *answer;
        }
      }
      if (!fault.empty())
      {
        throw std::invalid_argument(fault);
      }
      CheckExtent(samples);

      if (isDomain)
      {
        this->FitDomain(samples, inputVector, output, rounds);
      }
      else
      {
        this->FitImage(samples, output, rounds);
      }
      return 1;
    });
}

//------------------------------------------------------------------------------
void vtkTSplineFit::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "RefinementRule: " << this->RefinementRule << "\n";
  os << indent << "MaximumNumberOfControlPoints: " << this->MaximumNumberOfControlPoints << "\n";
  os << indent << "RMSTolerance: " << this->RMSTolerance << "\n";
  os << indent << "MaximumErrorTolerance: " << this->MaximumErrorTolerance << "\n";
  os << indent << "LinearlyIndependent: " << this->LinearlyIndependent << "\n";
  os << indent << "ShapeTolerance: " << this->ShapeTolerance << "\n";
  os << indent << "ShapeShare: " << this->ShapeShare << "\n";
  os << indent << "LargestShapeDistance: " << this->LargestShapeDistance << "\n";
  os << indent << "Attributes:";
  for (const std::string& name : this->Attributes)
  {
    os << " " << name;
  }
  os << "\n" << indent << "MaskArray: " << this->MaskArray << "\n";
  os << indent << "Controller: " << this->Controller << "\n";
}
