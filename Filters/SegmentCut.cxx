// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "SegmentCut.h"

#include "Fit/PointShares.h"

#include "vtkDataArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

namespace trivariate
{
namespace
{
constexpr int Most = std::numeric_limits<int>::max();
constexpr double Infinite = std::numeric_limits<double>::infinity();

// A part of no voxels.
Part Fresh(std::int32_t label, std::size_t arrays)
{
  return { label, { Most, -Most, Most, -Most, Most, -Most }, Infinite, -Infinite,
    std::vector<std::array<double, 2>>(arrays - 1, { Infinite, -Infinite }) };
}

std::vector<double> RangesOf(const Part& part)
{
  std::vector<double> ranges{ part.High - part.Low };
  for (const auto& [low, high] : part.Further)
  {
    ranges.push_back(high - low);
  }
  return ranges;
}

void Include(std::array<double, 2>& range, double value)
{
  range[0] = std::min(range[0], value);
  range[1] = std::max(range[1], value);
}
}

//------------------------------------------------------------------------------
SegmentedImage::SegmentedImage(vtkImageData* image, std::vector<std::string> arrays)
  : Image(image)
  , Arrays(std::move(arrays))
{
  vtkDataArray* labels = image->GetPointData()->GetArray("Segment");
  std::map<std::int32_t, Part> parts;
  Part* last = nullptr; // that of the voxel before
  const int* e = image->GetExtent();
  vtkIdType voxel = 0;
  for (int k = e[4]; k <= e[5]; ++k)
  {
    for (int j = e[2]; j <= e[3]; ++j)
    {
      for (int i = e[0]; i <= e[1]; ++i, ++voxel)
      {
        const auto label = static_cast<std::int32_t>(labels->GetTuple1(voxel));
        if (!last || last->Label != label)
        {
          last = &parts.emplace(label, Fresh(label, this->Arrays.size())).first->second;
        }
        this->Widen(*last, voxel, { i, j, k });
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
void SegmentedImage::Widen(Part& part, vtkIdType voxel, const std::array<int, 3>& at) const
{
  for (int a = 0; a < 3; ++a)
  {
    part.Box[2 * a] = std::min(part.Box[2 * a], at[a]);
    part.Box[2 * a + 1] = std::max(part.Box[2 * a + 1], at[a]);
  }
  const double value = this->Values()->GetComponent(voxel, 0);
  part.Low = std::min(part.Low, value);
  part.High = std::max(part.High, value);
  for (std::size_t f = 0; f < part.Further.size(); ++f)
  {
    vtkDataArray* array = this->Image->GetPointData()->GetArray(this->Arrays[f + 1].c_str());
    for (int component = 0; component < array->GetNumberOfComponents(); ++component)
    {
      Include(part.Further[f], array->GetComponent(voxel, component));
    }
  }
}

//------------------------------------------------------------------------------
void SegmentedImage::GiveToFirst(vtkIdType voxel)
{
  int size[3];
  this->Image->GetDimensions(size);
  const int* e = this->Image->GetExtent();
  const vtkIdType row = voxel / size[0];
  this->Widen(this->Parts.front(), voxel,
    { e[0] + int(voxel % size[0]), e[2] + int(row % size[1]), e[4] + int(row / size[1]) });
  this->PartOf[voxel] = 0;
}

//------------------------------------------------------------------------------
PartNumbers SegmentedImage::AllParts() const
{
  PartNumbers all(this->Parts.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

//------------------------------------------------------------------------------
std::vector<double> SegmentedImage::WholeRanges() const
{
  return RangesOf(UniteParts(this->Parts, this->AllParts()));
}

//------------------------------------------------------------------------------
double SegmentedImage::ToleranceIn(const Part& part, double tolerance) const
{
  const std::vector<double> whole = this->WholeRanges(), own = RangesOf(part);
  double least = 0.0;
  for (std::size_t array = 0; array < whole.size(); ++array)
  {
    const double here = own[array] > 0.0 ? tolerance * whole[array] / own[array] : 0.0;
    least = least == 0.0 || (here > 0.0 && here < least) ? here : least;
  }
  return least;
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
    for (std::size_t f = 0; f < all.Further.size(); ++f)
    {
      Include(all.Further[f], part.Further[f][0]);
      Include(all.Further[f], part.Further[f][1]);
    }
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
