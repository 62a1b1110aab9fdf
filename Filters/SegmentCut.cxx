// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "SegmentCut.h"

#include "Fit/PointShares.h"

#include "vtkDataArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <map>
#include <utility>

namespace trivariate
{
//------------------------------------------------------------------------------
SegmentedImage::SegmentedImage(vtkImageData* image, std::vector<std::string> arrays)
  : Image(image)
  , Arrays(std::move(arrays))
{
  vtkDataArray* labels = image->GetPointData()->GetArray("Segment");
  vtkDataArray* values = this->Values();
  std::map<std::int32_t, Part> parts;
  const int* e = image->GetExtent();
  vtkIdType voxel = 0;
  for (int k = e[4]; k <= e[5]; ++k)
  {
    for (int j = e[2]; j <= e[3]; ++j)
    {
      for (int i = e[0]; i <= e[1]; ++i, ++voxel)
      {
        const auto label = static_cast<std::int32_t>(labels->GetTuple1(voxel));
        const double value = values->GetComponent(voxel, 0);
        const Part fresh{ label, { i, i, j, j, k, k }, value, value };
        Part& part = parts.emplace(label, fresh).first->second;
        const int at[3] = { i, j, k };
        for (int a = 0; a < 3; ++a)
        {
          part.Box[2 * a] = std::min(part.Box[2 * a], at[a]);
          part.Box[2 * a + 1] = std::max(part.Box[2 * a + 1], at[a]);
        }
        part.Low = std::min(part.Low, value);
        part.High = std::max(part.High, value);
      }
    }
  }
  std::map<std::int32_t, std::int32_t> number;
  for (auto& [label, part] : parts)
  {
    for (int a = 0; a < 3; ++a) // a volume has two points or more along each axis
    {
      if (part.Box[2 * a] == part.Box[2 * a + 1])
      {
        part.Box[2 * a] = std::min(part.Box[2 * a], e[2 * a + 1] - 1);
        part.Box[2 * a + 1] = part.Box[2 * a] + 1;
      }
    }
    number[label] = static_cast<std::int32_t>(this->Parts.size());
    this->Parts.push_back(part);
  }
  this->PartOf.resize(image->GetNumberOfPoints());
  for (voxel = 0; voxel < image->GetNumberOfPoints(); ++voxel)
  {
    this->PartOf[voxel] = number[static_cast<std::int32_t>(labels->GetTuple1(voxel))];
  }
}

//------------------------------------------------------------------------------
vtkDataArray* SegmentedImage::Values() const
{
  return this->Image->GetPointData()->GetArray(this->Arrays.front().c_str());
}

//------------------------------------------------------------------------------
std::vector<double> FindShares(const SegmentedImage& image, const Execution& execution)
{
  vtkDataArray* values = image.Values();
  std::vector<double> copy(values->GetNumberOfTuples());
  for (vtkIdType i = 0; i < values->GetNumberOfTuples(); ++i)
  {
    copy[i] = values->GetComponent(i, 0);
  }
  int size[3];
  image.Image->GetDimensions(size);
  return PointShares({ size[0], size[1], size[2] }, copy.data(), image.PartOf,
    static_cast<int>(image.Parts.size()), execution);
}

//------------------------------------------------------------------------------
Part UniteParts(const std::vector<Part>& parts, const PartNumbers& numbers)
{
  Part all = parts[numbers.front()];
  for (const std::int32_t number : numbers)
  {
    const Part& part = parts[number];
    for (int a = 0; a < 3; ++a)
    {
      all.Box[2 * a] = std::min(all.Box[2 * a], part.Box[2 * a]);
      all.Box[2 * a + 1] = std::max(all.Box[2 * a + 1], part.Box[2 * a + 1]);
    }
    all.Low = std::min(all.Low, part.Low);
    all.High = std::max(all.High, part.High);
  }
  return all;
}

//------------------------------------------------------------------------------
void AddCropped(vtkImageData* image, vtkDataArray* whole, vtkImageData* box)
{
  const auto array = vtk::TakeSmartPointer(whole->NewInstance());
  array->SetName(whole->GetName());
  array->SetNumberOfComponents(whole->GetNumberOfComponents());
  array->SetNumberOfTuples(box->GetNumberOfPoints());
  const int* e = box->GetExtent();
  const vtkIdType row = e[1] - e[0] + 1;
  vtkIdType to = 0;
  for (int k = e[4]; k <= e[5]; ++k)
  {
    for (int j = e[2]; j <= e[3]; ++j, to += row)
    {
      int ijk[3] = { e[0], j, k };
      array->InsertTuples(to, row, image->ComputePointId(ijk), whole);
    }
  }
  box->GetPointData()->AddArray(array);
}

//------------------------------------------------------------------------------
Cut CutOut(const SegmentedImage& segmented, const PartNumbers& numbers)
{
  vtkImageData* image = segmented.Image;
  const Part part = UniteParts(segmented.Parts, numbers);
  Cut cut{ vtkSmartPointer<vtkImageData>::New(), {} };
  cut.Image->SetOrigin(image->GetOrigin());
  cut.Image->SetSpacing(image->GetSpacing());
  cut.Image->SetDirectionMatrix(image->GetDirectionMatrix());
  cut.Image->SetExtent(const_cast<int*>(part.Box.data()));
  for (const std::string& name : segmented.Arrays)
  {
    AddCropped(image, image->GetPointData()->GetArray(name.c_str()), cut.Image);
  }
  vtkNew<vtkUnsignedCharArray> mask;
  mask->SetName(CutMaskName);
  mask->Allocate(cut.Image->GetNumberOfPoints());
  for (int k = part.Box[4]; k <= part.Box[5]; ++k)
  {
    for (int j = part.Box[2]; j <= part.Box[3]; ++j)
    {
      int ijk[3] = { part.Box[0], j, k };
      vtkIdType voxel = image->ComputePointId(ijk);
      for (int i = part.Box[0]; i <= part.Box[1]; ++i, ++voxel)
      {
        const bool isOwn =
          std::find(numbers.begin(), numbers.end(), segmented.PartOf[voxel]) != numbers.end();
        mask->InsertNextValue(isOwn);
        if (isOwn)
        {
          cut.Voxels.push_back(voxel);
        }
      }
    }
  }
  cut.Image->GetPointData()->AddArray(mask);
  return cut;
}
}
