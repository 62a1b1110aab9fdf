// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkVolumeParameterization.h"

#include "BlockMeshOutput.h"
#include "GatherSamples.h"
#include "LabelledImage.h"
#include "MemoryLimit.h"
#include "ParameterOutput.h"
#include "SMPExecution.h"
#include "SharedPieces.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkUnstructuredGrid.h"

#include <new>
#include <stdexcept>

using namespace trivariate;

vtkStandardNewMacro(vtkVolumeParameterization);
vtkCxxSetObjectMacro(vtkVolumeParameterization, Controller, vtkMultiProcessController);

namespace
{
constexpr double BytesPerVoxel = 240.0; // image and box around a segment together
}

//------------------------------------------------------------------------------
vtkVolumeParameterization::vtkVolumeParameterization()
{
  this->SetNumberOfInputPorts(3);
  this->SetNumberOfOutputPorts(3);
  this->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Segment");
  this->SetController(vtkMultiProcessController::GetGlobalController());
}

vtkVolumeParameterization::~vtkVolumeParameterization()
{
  this->SetController(nullptr);
}

//------------------------------------------------------------------------------
vtkUnstructuredGrid* vtkVolumeParameterization::GetPolycube()
{
  return vtkUnstructuredGrid::SafeDownCast(this->GetOutputDataObject(1));
}

vtkPartitionedDataSetCollection* vtkVolumeParameterization::GetBlocks()
{
  return vtkPartitionedDataSetCollection::SafeDownCast(this->GetOutputDataObject(2));
}

//------------------------------------------------------------------------------
int vtkVolumeParameterization::FillInputPortInformation(int port, vtkInformation* info)
{
  const char* const types[3] = { "vtkImageData", "vtkPolyData", "vtkUnstructuredGrid" };
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), types[port]);
  return 1;
}

int vtkVolumeParameterization::FillOutputPortInformation(int port, vtkInformation* info)
{
  const char* const types[3] = { "vtkImageData", "vtkUnstructuredGrid",
    "vtkPartitionedDataSetCollection" };
  info->Set(vtkDataObject::DATA_TYPE_NAME(), types[port]);
  return 1;
}

//------------------------------------------------------------------------------
int vtkVolumeParameterization::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  const bool gathering = ArePiecesShared(this->Controller, outputVector);
  if (!gathering)
  {
    RequestWholeImage(inputVector[0]->GetInformationObject(0));
  }
  for (int port = 1; port < 3; ++port)
  {
    RequestPiece(inputVector[port]->GetInformationObject(0), outputVector, gathering);
  }
  return 1;
}

//------------------------------------------------------------------------------
ImageSamples vtkVolumeParameterization::ReadImage(vtkImageData* input, std::string& fault)
{
  try
  {
    if (input->GetNumberOfPoints() > 0)
    {
      std::vector<vtkDataArray*> arrays{ ChosenLabels(input, this->GetInputArrayToProcess(0, input),
        this->GetInputArrayInformation(0)->Get(vtkDataObject::FIELD_NAME())) };
      if (arrays[0]->GetNumberOfComponents() != 1)
      {
        throw std::invalid_argument("The labels have " +
                                    std::to_string(arrays[0]->GetNumberOfComponents()) +
                                    " components; one is needed.");
      }
      for (const char* name : { "FrameU", "FrameV", "FrameW" })
      {
        arrays.push_back(input->GetPointData()->GetArray(name));
        if (!arrays.back() || arrays.back()->GetNumberOfComponents() != 3)
        {
          throw std::invalid_argument("The image does not have the point array " +
                                      std::string(name) +
                                      " of 3 components; it comes from Frame Field.");
        }
      }
      const std::string lack = MemoryFault(
        "The parameterization", BytesPerVoxel * static_cast<double>(input->GetNumberOfPoints()));
      if (!lack.empty())
      {
        throw std::invalid_argument(lack);
      }
      return ReadArrays(input, arrays);
    }
  }
  catch (const std::exception& error)
  {
    fault = error.what();
  }
  return {};
}

//------------------------------------------------------------------------------
int vtkVolumeParameterization::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkImageData* input = vtkImageData::GetData(inputVector[0]);
  vtkImageData* output = vtkImageData::GetData(outputVector, 0);
  const bool gathering = ArePiecesShared(this->Controller, outputVector);
  std::string fault;
  ImageSamples samples = this->ReadImage(input, fault);
  if (gathering && !GatherSamples(samples, fault, this->Controller))
  {
    if (!fault.empty())
    {
      vtkErrorMacro(<< fault);
    }
    return 0;
  }
  vtkNew<vtkImageData> whole;
  bool done = false;
  if (fault.empty() && (!gathering || this->Controller->GetLocalProcessId() == 0))
  {
    try
    {
      if (gathering)
      {
        vtkWarningMacro("Parameters are found on one process: the pieces of "
                        << this->Controller->GetNumberOfProcesses()
                        << " processes were gathered to process 0.");
      }
      this->Parameterize(samples, vtkPolyData::GetData(inputVector[1]),
        vtkUnstructuredGrid::GetData(inputVector[2]), whole, outputVector);
      done = true;
    }
    catch (const Aborted&) // the executive empties the outputs
    {
    }
    catch (const std::bad_alloc&)
    {
      fault = "Out of memory; crop or coarsen the image.";
    }
    catch (const std::exception& error)
    {
      fault = error.what();
    }
  }
  int goesOn = done ? 1 : 0;
  if (gathering)
  {
    this->Controller->Broadcast(&goesOn, 1, 0);
  }
  if (!fault.empty())
  {
    vtkErrorMacro(<< fault);
  }
  if (goesOn)
  {
    output->ShallowCopy(input);
    if (gathering)
    {
      ShareParameters(whole, output, this->Controller);
    }
    else
    {
      AddParameters(whole, output);
    }
  }
  return fault.empty() ? 1 : 0;
}

//------------------------------------------------------------------------------
void vtkVolumeParameterization::Parameterize(const ImageSamples& samples, vtkPolyData* patches,
  vtkUnstructuredGrid* polycube, vtkImageData* image, vtkInformationVector* outputVector)
{
  CheckExtent(samples);
  if (patches->GetNumberOfCells() == 0 || polycube->GetNumberOfCells() == 0)
  {
    throw std::invalid_argument("There are no patches, or no polycube; they come from Polycube "
                                "Domain, and under several processes must be on process 0.");
  }
  ParameterSettings settings;
  settings.Options.Epsilon = this->Epsilon;
  settings.Options.Gradient =
    this->Gradient == POLYNOMIAL ? ParameterGradient::Polynomial : ParameterGradient::Trilinear;
  settings.Options.Rounds = this->Rounds;
  settings.Options.Tolerance = this->Tolerance;
  settings.CellLength = this->CellLength;
  settings.RefinesThinParts = this->RefineThinParts;
  const ParameterDomain domain =
    ParameterizeDomain(samples, patches, polycube, settings, SMPExecution(this));
  if (domain.Report.End.Inverted > 0)
  {
    vtkWarningMacro(<< domain.Report.End.Inverted << " of " << domain.Report.End.Cells
                    << " cells of the block mesh are inverted; more cubes, other corners or finer "
                       "voxels may avoid that.");
  }
  for (const auto& [segment, thin] : domain.Thin)
  {
    if (thin.Share > MostThin)
    {
      vtkWarningMacro(
        << "Segment " << segment << " has " << 100.0 * thin.Share
        << " percent of its voxels in parts thinner than four voxels, where blocks may be flat or "
           "leave parts out; cells about as small as the parts are thin may help."
        << (thin.Refined ? " FrameParameter was solved for on voxels of half the size." : ""));
    }
  }
  image->SetExtent(const_cast<int*>(samples.Extent.data()));
  WriteParameters(domain, image);
  vtkUnstructuredGrid* lengths = vtkUnstructuredGrid::GetData(outputVector, 1);
  lengths->ShallowCopy(polycube);
  WriteLengths(domain, lengths);
  const BlockComplex& complex = domain.Complex;
  WriteBlockMesh(domain.Mesh, { complex.Segments, complex.Groups, complex.Origins },
    vtkNew<vtkPointData>(), vtkPartitionedDataSetCollection::GetData(outputVector, 2));
}

//------------------------------------------------------------------------------
void vtkVolumeParameterization::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Epsilon: " << this->Epsilon << "\n";
  os << indent << "Gradient: " << (this->Gradient == TRILINEAR ? "Trilinear" : "Polynomial")
     << "\n";
  os << indent << "Rounds: " << this->Rounds << "\n";
  os << indent << "RefineThinParts: " << this->RefineThinParts << "\n";
  os << indent << "Tolerance: " << this->Tolerance << "\n";
  os << indent << "CellLength: " << this->CellLength << "\n";
  os << indent << "Controller: " << this->Controller << "\n";
}
