// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// Labels, their surfaces, domains, frames and parameters: the filters up to
/// vtkVolumeParameterization.
#ifndef ParameterChain_h
#define ParameterChain_h

#include "DomainChecks.h"
#include "vtkFrameField.h"
#include "vtkVolumeParameterization.h"

#include "vtkFieldData.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkStructuredGrid.h"

namespace trivariate_testing
{
struct ParameterChain
{
  vtkNew<vtkImageData> Image;
  vtkNew<vtkSegmentBoundary> Boundary;
  vtkNew<vtkPolycubeDomain> Domain;
  vtkNew<vtkFrameField> Field;
  vtkNew<vtkVolumeParameterization> Parameters;

  ParameterChain(const int extent[6], const Label& label, bool layered, bool turned = false)
  {
    this->Image->SetExtent(const_cast<int*>(extent));
    if (turned)
    {
      this->Image->SetOrigin(3.0, -2.0, 1.0);
      this->Image->SetDirectionMatrix(0, 1, 0, 1, 0, 0, 0, 0, 1); // left-handed
    }
    vtkNew<vtkIntArray> labels;
    labels->SetName("Segment");
    for (int k = extent[4]; k <= extent[5]; ++k)
    {
      for (int j = extent[2]; j <= extent[3]; ++j)
      {
        for (int i = extent[0]; i <= extent[1]; ++i)
        {
          const double index[3] = { double(i), double(j), double(k) };
          labels->InsertNextValue(label(index));
        }
      }
    }
    this->Image->GetPointData()->AddArray(labels);
    this->Boundary->SetInputData(this->Image);
    this->Boundary->UseDensityOff();
    this->Domain->SetInputConnection(this->Boundary->GetOutputPort());
    this->Domain->SetLayered(layered);
    this->Field->SetInputData(this->Image);
    this->Field->SetInputConnection(1, this->Domain->GetOutputPort());
    this->Parameters->SetCellLength(1.0);
    this->Parameters->SetInputConnection(this->Field->GetOutputPort());
    this->Parameters->SetInputConnection(1, this->Domain->GetOutputPort(0));
    this->Parameters->SetInputConnection(2, this->Domain->GetOutputPort(1));
  }

  vtkImageData* Update()
  {
    this->Parameters->Update();
    return this->Parameters->GetOutput();
  }

  double Known(const char* name, int component = 0)
  {
    vtkDataArray* array = this->Parameters->GetOutput()->GetFieldData()->GetArray(name);
    return array ? array->GetComponent(0, component) : vtkMath::Nan();
  }

  vtkStructuredGrid* Block(unsigned int block)
  {
    return vtkStructuredGrid::SafeDownCast(
      this->Parameters->GetBlocks()->GetPartitionAsDataObject(block, 0));
  }
};
}

#endif
