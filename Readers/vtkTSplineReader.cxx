// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTSplineReader.h"

#include "SMPExecution.h"
#include "File/TSplineFileReader.h"
#include "TSplineGrid.h"

#include "vtkErrorCode.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkUnstructuredGrid.h"
#include "vtksys/SystemInformation.hxx"

vtkStandardNewMacro(vtkTSplineReader);

namespace
{
// The model is a third of what reading needs: the output that is made from it is twice as large.
double MaximumModelBytes()
{
  vtksys::SystemInformation system;
  return 1024.0 * static_cast<double>(system.GetProcMemoryAvailable()) / 3.0;
}
}

//------------------------------------------------------------------------------
vtkTSplineReader::vtkTSplineReader()
{
  this->SetNumberOfInputPorts(0);
}

//------------------------------------------------------------------------------
vtkTSplineReader::~vtkTSplineReader()
{
  delete[] this->FileName;
}

//------------------------------------------------------------------------------
void vtkTSplineReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
}

//------------------------------------------------------------------------------
int vtkTSplineReader::CanReadFile(const char* fileName)
{
  return fileName && trivariate::IsTSplineFile(fileName) ? 1 : 0;
}

//------------------------------------------------------------------------------
int vtkTSplineReader::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  outputVector->GetInformationObject(0)->Set(vtkAlgorithm::CAN_HANDLE_PIECE_REQUEST(), 1);
  return 1;
}

//------------------------------------------------------------------------------
int vtkTSplineReader::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  this->SetErrorCode(vtkErrorCode::NoError);
  if (!this->FileName || !*this->FileName)
  {
    this->SetErrorCode(vtkErrorCode::NoFileNameError);
    vtkErrorMacro("No file to read; set FileName.");
    return 0;
  }
  vtkInformation* outInfo = outputVector->GetInformationObject(0);
  if (outInfo->Get(Pipeline::UPDATE_PIECE_NUMBER()) > 0)
  {
    return 1;
  }
  try
  {
    const trivariate::TSplineModel model = trivariate::ReadTSplineFile(
      this->FileName, MaximumModelBytes(), trivariate::SMPExecution(this));
    trivariate::TSplineToGrid(model, vtkUnstructuredGrid::GetData(outputVector));
  }
  catch (const trivariate::Aborted&)
  {
    return 1; // the output is empty and marked as aborted by the pipeline
  }
  catch (const std::exception& fault)
  {
    this->SetErrorCode(vtkErrorCode::FileFormatError);
    vtkErrorMacro("Cannot read the T-spline file \"" << this->FileName << "\": " << fault.what());
    return 0;
  }
  return 1;
}
