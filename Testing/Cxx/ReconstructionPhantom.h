// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// What tests of the reconstruction have in common: an egg of 24 x 26 x 23 voxels.
#ifndef ReconstructionPhantom_h
#define ReconstructionPhantom_h

#include "vtkReconstructionReport.h"
#include "vtkTSplineReconstruction.h"

#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkSmartPointer.h"
#include "vtkTable.h"
#include "vtkUnstructuredGrid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

namespace trivariate_testing
{
inline double Radius(const double* x)
{
  return std::hypot(x[0] - 11.0, 0.5 * x[1] - 12.0, x[2] - 10.5);
}

// A bright egg with a wave in it, in a dark air with a slope; labels 0 and 3.
inline vtkNew<vtkImageData> Phantom()
{
  vtkNew<vtkImageData> image;
  image->SetExtent(2, 25, -1, 24, 0, 22);
  image->SetOrigin(-2.0, 2.0, 0.0);
  image->SetSpacing(1.0, 2.0, 1.0);
  vtkNew<vtkFloatArray> density;
  density->SetName("Density");
  vtkNew<vtkIntArray> labels;
  labels->SetName("Material");
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    double x[3];
    image->GetPoint(i, x);
    const bool inside = Radius(x) < 7.6;
    labels->InsertNextValue(inside ? 3 : 0);
    density->InsertNextValue(static_cast<float>(
      inside ? 100.0 + 10.0 * std::sin(0.9 * x[0]) * std::cos(0.4 * x[1]) : 0.3 * x[2]));
  }
  image->GetPointData()->SetScalars(density);
  image->GetPointData()->AddArray(labels);
  return image;
}

inline vtkSmartPointer<vtkTSplineReconstruction> Reconstruct(vtkImageData* image)
{
  auto reconstruction = vtkSmartPointer<vtkTSplineReconstruction>::New();
  reconstruction->SetInputData(image);
  reconstruction->SetInputArrayToProcess(
    0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Density");
  reconstruction->SetInputArrayToProcess(
    1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Material");
  reconstruction->SetMaximumNumberOfControlPoints(1500);
  return reconstruction;
}

// The report on a reconstruction, with all that it tells, on one of its images.
inline vtkNew<vtkTable> ReportOn(vtkTSplineReconstruction* reconstruction, int image = 2)
{
  vtkNew<vtkReconstructionReport> report;
  report->SetInputConnection(0, reconstruction->GetOutputPort(image));
  report->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Density");
  report->SetTSplineConnection(reconstruction->GetOutputPort());
  report->SetSurfacesConnection(reconstruction->GetOutputPort(4));
  report->SetRoundsConnection(reconstruction->GetOutputPort(1));
  report->Update();
  vtkNew<vtkTable> table;
  table->DeepCopy(report->GetOutput());
  return table;
}

template <typename DataT>
DataT* Output(vtkTSplineReconstruction* reconstruction, int port)
{
  return DataT::SafeDownCast(reconstruction->GetOutputDataObject(port));
}

inline void ExpectSame(vtkUnstructuredGrid* a, vtkUnstructuredGrid* b)
{
  ASSERT_EQ(a->GetNumberOfPoints(), b->GetNumberOfPoints());
  ASSERT_EQ(a->GetPointData()->GetNumberOfArrays(), b->GetPointData()->GetNumberOfArrays());
  for (int i = -1; i < a->GetPointData()->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* one = i < 0 ? a->GetPoints()->GetData() : a->GetPointData()->GetArray(i);
    vtkDataArray* other =
      i < 0 ? b->GetPoints()->GetData() : b->GetPointData()->GetArray(one->GetName());
    ASSERT_NE(other, nullptr);
    ASSERT_EQ(std::memcmp(one->GetVoidPointer(0), other->GetVoidPointer(0),
                one->GetDataTypeSize() * one->GetNumberOfValues()),
      0)
      << (i < 0 ? "points" : one->GetName());
  }
}
}

#endif
