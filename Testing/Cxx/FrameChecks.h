// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// What all outputs of vtkFrameField must be, and the filters before it.
#ifndef FrameChecks_h
#define FrameChecks_h

#include "FrameShapes.h"
#include "vtkFrameField.h"
#include "vtkPolycubeDomain.h"
#include "vtkSegmentBoundary.h"

#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkTable.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace trivariate_testing
{
using Directions = std::array<std::array<double, 3>, 3>;

inline vtkFloatArray* FrameArray(vtkFrameField* field, int axis)
{
  const char* const names[3] = { "FrameU", "FrameV", "FrameW" };
  return vtkFloatArray::SafeDownCast(field->GetOutput()->GetPointData()->GetArray(names[axis]));
}

inline Directions FrameAt(vtkFrameField* field, vtkIdType id)
{
  Directions frame;
  for (int axis = 0; axis < 3; ++axis)
  {
    FrameArray(field, axis)->GetTuple(id, frame[axis].data());
  }
  return frame;
}

inline bool IsInside(vtkFrameField* field, vtkIdType id)
{
  return field->GetOutput()->GetPointData()->GetArray("Segment")->GetComponent(id, 0) > 0.0;
}

inline double Known(vtkFrameField* field, const char* name, vtkIdType row = 0)
{
  return vtkDataArray::SafeDownCast(field->GetOutput()->GetFieldData()->GetAbstractArray(name))
    ->GetComponent(row, 0);
}

// Orthonormal and right-handed inside, zero outside.
inline void ExpectFrames(vtkFrameField* field)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    ASSERT_NE(FrameArray(field, axis), nullptr);
    ASSERT_EQ(FrameArray(field, axis)->GetNumberOfComponents(), 3);
  }
  for (vtkIdType id = 0; id < field->GetOutput()->GetNumberOfPoints(); ++id)
  {
    const Directions f = FrameAt(field, id);
    const double length = IsInside(field, id) ? 1.0 : 0.0;
    for (int a = 0; a < 3; ++a)
    {
      for (int b = a; b < 3; ++b)
      {
        ASSERT_NEAR(vtkMath::Dot(f[a].data(), f[b].data()), a == b ? length : 0.0, 1e-6) << id;
      }
    }
    ASSERT_NEAR(vtkMath::Determinant3x3(f[0].data(), f[1].data(), f[2].data()), length, 1e-6);
  }
}

// The largest entry of the differences to wanted(point) inside.
inline double FarthestFrom(
  vtkFrameField* field, const std::function<Directions(const double*)>& wanted)
{
  double largest = 0.0;
  for (vtkIdType id = 0; id < field->GetOutput()->GetNumberOfPoints(); ++id)
  {
    if (IsInside(field, id))
    {
      const Directions found = FrameAt(field, id);
      const Directions there = wanted(field->GetOutput()->GetPoint(id));
      for (int a = 0; a < 3; ++a)
      {
        for (int b = 0; b < 3; ++b)
        {
          largest = std::max(largest, std::abs(found[a][b] - there[a][b]));
        }
      }
    }
  }
  return largest;
}

inline vtkNew<vtkImageData> Ball(int n, double radius, double inner = 0.0)
{
  vtkNew<vtkImageData> image;
  image->SetExtent(-n, n, -n, n, -n, n);
  vtkNew<vtkIntArray> labels;
  labels->SetName("Segment");
  for (vtkIdType id = 0; id < image->GetNumberOfPoints(); ++id)
  {
    const double r = vtkMath::Norm(image->GetPoint(id));
    labels->InsertNextValue(r < inner ? 2 : r < radius ? 1 : 0);
  }
  image->GetPointData()->AddArray(labels);
  return image;
}

// Frames of the domains that are found in an image.
struct Chain
{
  explicit Chain(vtkImageData* image)
  {
    this->Boundary->SetInputData(image);
    this->Boundary->UseDensityOff();
    this->Domain->SetInputConnection(this->Boundary->GetOutputPort());
    this->Field->SetInputData(image);
    this->Field->SetInputConnection(1, this->Domain->GetOutputPort());
  }
  vtkNew<vtkSegmentBoundary> Boundary;
  vtkNew<vtkPolycubeDomain> Domain;
  vtkNew<vtkFrameField> Field;
};
}

#endif
