// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTSplineWriter.h"

#include "AtomicFile.h"
#include "SMPExecution.h"
#include "File/TSplineFileWriter.h"
#include "TSplineGrid.h"

#include "vtkAppendFilter.h"
#include "vtkErrorCode.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkUnstructuredGrid.h"

#include <cerrno>
#include <system_error>
#include <vector>

vtkStandardNewMacro(vtkTSplineWriter);

namespace
{
unsigned long ErrorCodeOf(const std::system_error& fault)
{
  switch (fault.code().value())
  {
    case ENOSPC:
    case EDQUOT:
    case EFBIG:
      return vtkErrorCode::OutOfDiskSpaceError;
    default:
      return vtkErrorCode::CannotOpenFileError;
  }
}
}

//------------------------------------------------------------------------------
vtkTSplineWriter::vtkTSplineWriter()
  : Controller(vtkMultiProcessController::GetGlobalController())
{
}

//------------------------------------------------------------------------------
vtkTSplineWriter::~vtkTSplineWriter()
{
  delete[] this->FileName;
}

//------------------------------------------------------------------------------
void vtkTSplineWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
  os << indent << "CompressionLevel: " << this->CompressionLevel << "\n";
  os << indent << "Controller: " << this->Controller.Get() << "\n";
}

//------------------------------------------------------------------------------
void vtkTSplineWriter::SetController(vtkMultiProcessController* controller)
{
  if (this->Controller != controller)
  {
    this->Controller = controller;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
vtkMultiProcessController* vtkTSplineWriter::GetController()
{
  return this->Controller;
}

//------------------------------------------------------------------------------
vtkUnstructuredGrid* vtkTSplineWriter::GetInput()
{
  return vtkUnstructuredGrid::SafeDownCast(this->Superclass::GetInput());
}

//------------------------------------------------------------------------------
int vtkTSplineWriter::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkUnstructuredGrid");
  return 1;
}

//------------------------------------------------------------------------------
// Each process asks for its own piece, without ghosts: every control point is written once.
vtkTypeBool vtkTSplineWriter::ProcessRequest(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  if (request->Has(Pipeline::REQUEST_UPDATE_EXTENT()) && this->Controller)
  {
    vtkInformation* info = inputVector[0]->GetInformationObject(0);
    info->Set(Pipeline::UPDATE_PIECE_NUMBER(), this->Controller->GetLocalProcessId());
    info->Set(Pipeline::UPDATE_NUMBER_OF_PIECES(), this->Controller->GetNumberOfProcesses());
    info->Set(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
    return 1;
  }
  return this->Superclass::ProcessRequest(request, inputVector, outputVector);
}

//------------------------------------------------------------------------------
// All pieces on process 0, nothing elsewhere.
vtkSmartPointer<vtkUnstructuredGrid> vtkTSplineWriter::GatherInput()
{
  if (!this->Controller || this->Controller->GetNumberOfProcesses() < 2)
  {
    return this->GetInput();
  }
  std::vector<vtkSmartPointer<vtkDataObject>> pieces;
  this->Controller->Gather(this->GetInput(), pieces, 0);
  vtkNew<vtkAppendFilter> append;
  vtkUnstructuredGrid* first = nullptr;
  for (vtkDataObject* piece : pieces)
  {
    auto* grid = vtkUnstructuredGrid::SafeDownCast(piece);
    if (grid && grid->GetNumberOfPoints() > 0)
    {
      first = first ? first : grid;
      append->AddInputData(grid);
    }
  }
  if (append->GetNumberOfInputConnections(0) < 2)
  {
    return first; // the usual case: what vtkTSplineFit or vtkTSplineReader left on one process
  }
  append->SetContainerAlgorithm(this);
  append->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  append->Update();
  vtkSmartPointer<vtkUnstructuredGrid> all = append->GetOutput();
  all->GetFieldData()->ShallowCopy(first->GetFieldData());
  return all;
}

//------------------------------------------------------------------------------
void vtkTSplineWriter::WriteGrid(vtkUnstructuredGrid* grid)
{
  try
  {
    if (!grid || grid->GetNumberOfPoints() == 0)
    {
      throw std::invalid_argument("The input is empty: there is no T-spline to write.");
    }
    const std::vector<char> bytes = trivariate::TSplineFileImage(trivariate::TSplineFromGrid(grid),
      this->CompressionLevel, trivariate::SMPExecution(this, 0.0, 0.9));
    trivariate::ReplaceFile(
      this->FileName, bytes.data(), bytes.size(), trivariate::SMPExecution(this, 0.9, 1.0));
  }
  catch (const trivariate::Aborted&)
  {
    this->SetErrorCode(vtkErrorCode::UserError);
  }
  catch (const std::system_error& fault)
  {
    this->SetErrorCode(ErrorCodeOf(fault));
    vtkErrorMacro("Cannot write \"" << this->FileName << "\": " << fault.what() << ".");
  }
  catch (const std::exception& fault)
  {
    this->SetErrorCode(vtkErrorCode::UnknownError);
    vtkErrorMacro("Cannot write \"" << this->FileName << "\": " << fault.what());
  }
}

//------------------------------------------------------------------------------
void vtkTSplineWriter::WriteData()
{
  if (!this->FileName || !*this->FileName)
  {
    this->SetErrorCode(vtkErrorCode::NoFileNameError);
    vtkErrorMacro("No file to write; set FileName.");
    return;
  }
  const vtkSmartPointer<vtkUnstructuredGrid> grid = this->GatherInput();
  const bool several = this->Controller && this->Controller->GetNumberOfProcesses() > 1;
  if (!several || this->Controller->GetLocalProcessId() == 0)
  {
    this->WriteGrid(grid);
  }
  if (several)
  {
    unsigned long code = this->GetErrorCode();
    this->Controller->Broadcast(&code, 1, 0);
    this->SetErrorCode(code);
  }
}
