// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkHydrogenOrbitalSource.h"

#include "HydrogenOrbital.h"
#include "MemoryLimit.h"
#include "SMPExecution.h"

#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <cmath>
#include <exception>

vtkStandardNewMacro(vtkHydrogenOrbitalSource);

namespace
{
// Fills rows [begin, end) of the image's extent; a row is all x at one y and z.
void SampleRows(const trivariate::HydrogenOrbital& orbital, double factor, vtkImageData* image,
  float* density, trivariate::Index begin, trivariate::Index end)
{
  const int* extent = image->GetExtent();
  const double* origin = image->GetOrigin();
  const double* spacing = image->GetSpacing();
  const trivariate::Index columns = extent[1] - extent[0] + 1, rows = extent[3] - extent[2] + 1;
  for (trivariate::Index row = begin; row < end; ++row)
  {
    const double y = origin[1] + (extent[2] + row % rows) * spacing[1];
    const double z = origin[2] + (extent[4] + row / rows) * spacing[2];
    for (trivariate::Index i = 0; i < columns; ++i)
    {
      const double x = origin[0] + (extent[0] + i) * spacing[0];
      density[row * columns + i] = static_cast<float>(factor * orbital.Density(x, y, z));
    }
  }
}
}

vtkHydrogenOrbitalSource::vtkHydrogenOrbitalSource()
{
  this->SetNumberOfInputPorts(0);
}

int vtkHydrogenOrbitalSource::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  if (!(this->HalfWidth >= 0.0) || !std::isfinite(this->HalfWidth))
  {
    vtkErrorMacro("The half width is " << this->HalfWidth << " Bohr; it must be positive, or 0 to "
                                       << "let N decide.");
    return 0;
  }
  const double halfWidth = this->HalfWidth > 0.0
                             ? this->HalfWidth
                             : trivariate::HydrogenOrbital::DefaultHalfWidth(this->N);
  int extent[6];
  double origin[3], spacing[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    if (this->Dimensions[axis] < 2)
    {
      vtkErrorMacro("The image has " << this->Dimensions[axis] << " points along axis " << axis
                                     << "; it needs two or more.");
      return 0;
    }
    extent[2 * axis] = 0;
    extent[2 * axis + 1] = this->Dimensions[axis] - 1;
    origin[axis] = -halfWidth;
    spacing[axis] = 2.0 * halfWidth / (this->Dimensions[axis] - 1);
  }

  vtkInformation* outInfo = outputVector->GetInformationObject(0);
  outInfo->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent, 6);
  outInfo->Set(vtkDataObject::ORIGIN(), origin, 3);
  outInfo->Set(vtkDataObject::SPACING(), spacing, 3);
  vtkDataObject::SetPointDataActiveScalarInfo(outInfo, VTK_FLOAT, 1);
  outInfo->Set(vtkAlgorithm::CAN_PRODUCE_SUB_EXTENT(), 1);
  return 1;
}

int vtkHydrogenOrbitalSource::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  vtkInformation* outInfo = outputVector->GetInformationObject(0);
  vtkImageData* output = vtkImageData::GetData(outInfo);
  // VTK keeps the request of a run that failed: it may reach beyond the image of now.
  int extent[6], whole[6];
  outInfo->Get(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT(), extent);
  outInfo->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), whole);
  for (int side = 0; side < 6; ++side)
  {
    extent[side] =
      side % 2 ? std::min(extent[side], whole[side]) : std::max(extent[side], whole[side]);
  }
  output->SetExtent(extent);
  output->SetOrigin(outInfo->Get(vtkDataObject::ORIGIN()));
  output->SetSpacing(outInfo->Get(vtkDataObject::SPACING()));

  try
  {
    const trivariate::HydrogenOrbital orbital(this->N, this->L, this->M,
      this->RealForm ? trivariate::OrbitalForm::Real : trivariate::OrbitalForm::Complex);
    const double factor = this->ScaleToUnit ? 1.0 / orbital.MaximumDensity() : 1.0;

    const int* dimensions = output->GetDimensions();
    const double bytes = sizeof(float) * 1.0 * dimensions[0] * dimensions[1] * dimensions[2];
    const std::string fault = trivariate::MemoryFault("The image", bytes);
    if (!fault.empty())
    {
      vtkErrorMacro(<< fault);
      output->Initialize();
      return 0;
    }
    vtkNew<vtkFloatArray> density;
    density->SetName("Density");
    density->SetNumberOfTuples(output->GetNumberOfPoints());
    float* values = density->GetPointer(0);

    // In strides of about a million points, after each of which the user is heard.
    const trivariate::Index rows = trivariate::Index(dimensions[1]) * dimensions[2];
    const trivariate::Index stride = std::max(1, (1 << 20) / dimensions[0]);
    const trivariate::Execution execution = trivariate::SMPExecution(this);
    for (trivariate::Index first = 0; first < rows; first += stride)
    {
      execution.Check(static_cast<double>(first) / rows);
      execution.ParallelFor(std::min(stride, rows - first),
        [&orbital, factor, output, values, first](trivariate::Index begin, trivariate::Index end)
        { SampleRows(orbital, factor, output, values, first + begin, first + end); });
    }
    output->GetPointData()->SetScalars(density);
  }
  catch (const trivariate::Aborted&)
  {
    output->Initialize();
  }
  catch (const std::exception& fault)
  {
    vtkErrorMacro(<< fault.what());
    output->Initialize();
    return 0;
  }
  return 1;
}

void vtkHydrogenOrbitalSource::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "N: " << this->N << "\n";
  os << indent << "L: " << this->L << "\n";
  os << indent << "M: " << this->M << "\n";
  os << indent << "RealForm: " << this->RealForm << "\n";
  os << indent << "Dimensions: " << this->Dimensions[0] << " " << this->Dimensions[1] << " "
     << this->Dimensions[2] << "\n";
  os << indent << "HalfWidth: " << this->HalfWidth << "\n";
  os << indent << "ScaleToUnit: " << this->ScaleToUnit << "\n";
}
