// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ImageSamples.h"

#include "MemoryLimit.h"

#include "vtkArrayDispatch.h"
#include "vtkDataArray.h"
#include "vtkDataArrayRange.h"
#include "vtkImageData.h"
#include "vtkMatrix4x4.h"
#include "vtkPointData.h"

#include <algorithm>
#include <stdexcept>

namespace trivariate
{
namespace
{
//------------------------------------------------------------------------------
// Tuples to one block a component.
struct CopyComponents
{
  template <typename ArrayT>
  void operator()(ArrayT* array, double* blocks) const
  {
    const auto tuples = vtk::DataArrayTupleRange(array);
    for (int c = 0; c < array->GetNumberOfComponents(); ++c)
    {
      for (const auto tuple : tuples)
      {
        *blocks++ = static_cast<double>(tuple[c]);
      }
    }
  }
};

void Copy(vtkDataArray* array, double* blocks)
{
  const CopyComponents worker;
  if (!vtkArrayDispatch::Dispatch::Execute(array, worker, blocks))
  {
    worker(array, blocks);
  }
}

std::string NameOf(vtkDataArray* array)
{
  const char* name = array->GetName();
  return name && *name ? name : "ImageScalars";
}

//------------------------------------------------------------------------------
// The chosen array and the further ones, each once; throws when one is missing.
std::vector<vtkDataArray*> AttributeArrays(
  vtkImageData* image, vtkDataArray* chosen, const std::vector<std::string>& further)
{
  std::vector<vtkDataArray*> arrays = { chosen };
  for (const std::string& name : further)
  {
    vtkDataArray* array = image->GetPointData()->GetArray(name.c_str());
    if (!array)
    {
      throw std::invalid_argument("The image has no point array \"" + name + "\" to fit.");
    }
    if (std::find(arrays.begin(), arrays.end(), array) == arrays.end())
    {
      arrays.push_back(array);
    }
  }
  return arrays;
}

//------------------------------------------------------------------------------
vtkDataArray* MaskOf(vtkImageData* image, const std::string& name)
{
  if (name.empty() || name == "None")
  {
    return nullptr;
  }
  vtkDataArray* mask = image->GetPointData()->GetArray(name.c_str());
  if (!mask)
  {
    throw std::invalid_argument("The image has no point array \"" + name + "\" for a mask.");
  }
  return mask;
}

//------------------------------------------------------------------------------
void CheckTuples(vtkImageData* image, vtkDataArray* array)
{
  if (array->GetNumberOfTuples() != image->GetNumberOfPoints())
  {
    throw std::invalid_argument("The array \"" + NameOf(array) + "\" has " +
                                std::to_string(array->GetNumberOfTuples()) + " values for " +
                                std::to_string(image->GetNumberOfPoints()) +
                                " points; choose a point array of the image.");
  }
}

void CheckMemory(double values)
{
  const std::string fault = MemoryFault("The copy of the voxels", 8.0 * values);
  if (!fault.empty())
  {
    throw std::invalid_argument(fault);
  }
}
}

//------------------------------------------------------------------------------
Index ImageSamples::Count() const
{
  return std::max<Index>(0, this->Points(0)) * std::max<Index>(0, this->Points(1)) *
         std::max<Index>(0, this->Points(2));
}

int ImageSamples::Components() const
{
  int components = 0;
  for (const TSplineAttribute& attribute : this->Attributes)
  {
    components += attribute.Components;
  }
  return components;
}

GridSamples ImageSamples::View() const
{
  GridSamples view;
  view.Size = { this->Points(0), this->Points(1), this->Points(2) };
  view.Components = this->Components();
  view.Values = this->Values.data();
  view.Mask = this->Mask.empty() ? nullptr : this->Mask.data();
  return view;
}

std::array<double, 3> ImageSamples::ToPhysical(const double* parameter) const
{
  std::array<double, 3> point;
  for (int r = 0; r < 3; ++r)
  {
    const double* row = &this->IndexToPhysical[4 * r];
    point[r] = row[0] * (parameter[0] + this->Extent[0]) +
               row[1] * (parameter[1] + this->Extent[2]) +
               row[2] * (parameter[2] + this->Extent[4]) + row[3];
  }
  return point;
}

//------------------------------------------------------------------------------
ImageSamples ReadArrays(vtkImageData* image, const std::vector<vtkDataArray*>& arrays)
{
  ImageSamples samples;
  image->GetExtent(samples.Extent.data());
  const double* matrix = image->GetIndexToPhysicalMatrix()->GetData();
  std::copy_n(matrix, 16, samples.IndexToPhysical.begin());
  for (vtkDataArray* array : arrays)
  {
    CheckTuples(image, array);
    samples.Attributes.push_back({ NameOf(array), array->GetNumberOfComponents() });
  }
  const Index count = samples.Count();
  CheckMemory(2.0 * count * samples.Components()); // the samples and the core's residual
  samples.Values.resize(count * samples.Components());
  double* blocks = samples.Values.data();
  for (vtkDataArray* array : arrays)
  {
    Copy(array, blocks);
    blocks += count * array->GetNumberOfComponents();
  }
  return samples;
}

//------------------------------------------------------------------------------
ImageSamples ReadSamples(vtkImageData* image, vtkDataArray* chosen,
  const std::vector<std::string>& further, const std::string& maskName)
{
  const std::vector<vtkDataArray*> arrays = AttributeArrays(image, chosen, further);
  vtkDataArray* mask = MaskOf(image, maskName);
  for (vtkDataArray* array : arrays)
  {
    if (IsTSplineArrayName(NameOf(array)))
    {
      throw std::invalid_argument(
        "The array \"" + NameOf(array) +
        "\" has the name of an array that every T-spline grid has; rename it first.");
    }
  }
  ImageSamples samples = ReadArrays(image, arrays);
  if (mask)
  {
    CheckTuples(image, mask);
    if (mask->GetNumberOfComponents() != 1)
    {
      throw std::invalid_argument("The mask array \"" + NameOf(mask) + "\" has " +
                                  std::to_string(mask->GetNumberOfComponents()) +
                                  " components; one is needed.");
    }
    samples.Mask.resize(samples.Count());
    const auto values = vtk::DataArrayValueRange<1>(mask);
    std::transform(values.begin(), values.end(), samples.Mask.begin(),
      [](double value) { return static_cast<std::uint8_t>(value != 0.0); });
  }
  return samples;
}

//------------------------------------------------------------------------------
// What the core would say in parameters, said in the user's words.
void CheckExtent(const ImageSamples& samples)
{
  if (samples.Count() == 0)
  {
    throw std::invalid_argument("The image has no points.");
  }
  for (int a = 0; a < 3; ++a)
  {
    if (samples.Points(a) < 2)
    {
      throw std::invalid_argument("The image has " + std::to_string(samples.Points(0)) + " x " +
                                  std::to_string(samples.Points(1)) + " x " +
                                  std::to_string(samples.Points(2)) +
                                  " points; a volume needs two or more along each axis.");
    }
  }
}
}
