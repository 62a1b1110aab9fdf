// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "LabelledImage.h"

#include "FilterRun.h"
#include "GatherSamples.h"
#include "MemoryLimit.h"

#include "vtkArrayDispatch.h"
#include "vtkDataArray.h"
#include "vtkDataArrayRange.h"
#include "vtkImageData.h"
#include "vtkMatrix4x4.h"
#include "vtkPointData.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace trivariate
{
namespace
{
constexpr double BytesPerFace = 600.0; // of the surface in the making

//------------------------------------------------------------------------------
std::string NameOf(vtkDataArray* array)
{
  const char* name = array->GetName();
  return name && *name ? name : "ImageScalars";
}

//------------------------------------------------------------------------------
// "0.5 at voxel (1, 2, 3)" for the error of the value with number id.
std::string ValueAt(double value, Index id, const std::array<int, 6>& extent)
{
  const Index nx = extent[1] - extent[0] + 1, ny = extent[3] - extent[2] + 1;
  std::ostringstream text;
  text << value << " at voxel (" << id % nx + extent[0] << ", " << id / nx % ny + extent[2] << ", "
       << id / (nx * ny) + extent[4] << ")";
  return text.str();
}

//------------------------------------------------------------------------------
// Copies values that pass a check; returns the number of the first that does not, or the size.
template <typename T>
struct CopyChecked
{
  template <typename ArrayT, typename Check>
  void operator()(ArrayT* array, std::vector<T>& values, const Check& check, Index& fault) const
  {
    fault = 0;
    for (const auto value : vtk::DataArrayValueRange<1>(array))
    {
      if (!check(static_cast<double>(value)))
      {
        return;
      }
      values[fault++] = static_cast<T>(value);
    }
  }
};

template <typename T, typename Check>
void Copy(vtkDataArray* array, const LabelledImage& image, Index count, const Check& check,
  const std::string& wanted, std::vector<T>& values)
{
  if (array->GetNumberOfComponents() != 1)
  {
    throw std::invalid_argument("The array \"" + NameOf(array) + "\" has " +
                                std::to_string(array->GetNumberOfComponents()) +
                                " components; one is needed.");
  }
  if (array->GetNumberOfTuples() != count)
  {
    throw std::invalid_argument(
      "The array \"" + NameOf(array) + "\" has " + std::to_string(array->GetNumberOfTuples()) +
      " values for " + std::to_string(count) + " points; choose a point array of the image.");
  }
  values.resize(count);
  Index fault = 0;
  const CopyChecked<T> worker;
  if (!vtkArrayDispatch::Dispatch::Execute(array, worker, values, check, fault))
  {
    worker(array, values, check, fault);
  }
  if (fault < count)
  {
    throw std::invalid_argument("The array \"" + NameOf(array) + "\" is " +
                                ValueAt(array->GetComponent(fault, 0), fault, image.Extent) + "; " +
                                wanted);
  }
}

//------------------------------------------------------------------------------
// How many faces of voxels lie between different labels or at the border of the volume, at most.
double CountFaces(const LabelVolume& labels)
{
  const auto& n = labels.Size;
  const std::int32_t* p = labels.Labels;
  Index faces = n[0] * n[1] + n[1] * n[2] + n[2] * n[0];
  for (Index k = 0; k < n[2]; ++k)
  {
    for (Index j = 0; j < n[1]; ++j)
    {
      for (Index i = 0; i < n[0]; ++i, ++p)
      {
        faces += (i == 0 || p[0] != p[-1]) + (j == 0 || p[0] != p[-n[0]]) +
                 (k == 0 || p[0] != p[-n[0] * n[1]]);
      }
    }
  }
  return static_cast<double>(faces);
}

// The labels that occur.
std::set<int> LabelsOf(const std::vector<std::int32_t>& labels)
{
  std::set<int> present;
  for (std::size_t id = 0; id < labels.size(); ++id)
  {
    if (id == 0 || labels[id] != labels[id - 1])
    {
      present.insert(labels[id]);
    }
  }
  return present;
}
}

//------------------------------------------------------------------------------
LabelVolume LabelledImage::View() const
{
  return { this->Labels.data(),
    { this->Extent[1] - this->Extent[0] + 1, this->Extent[3] - this->Extent[2] + 1,
      this->Extent[5] - this->Extent[4] + 1 } };
}

std::array<double, 3> LabelledImage::ToPhysical(const std::array<double, 3>& index) const
{
  std::array<double, 3> point;
  for (int r = 0; r < 3; ++r)
  {
    const double* row = &this->IndexToPhysical[4 * r];
    point[r] = row[3];
    for (int a = 0; a < 3; ++a)
    {
      point[r] += row[a] * (index[a] + this->Extent[2 * a]);
    }
  }
  return point;
}

bool LabelledImage::IsMirrored() const
{
  const auto& m = this->IndexToPhysical;
  return m[0] * (m[5] * m[10] - m[6] * m[9]) - m[1] * (m[4] * m[10] - m[6] * m[8]) +
           m[2] * (m[4] * m[9] - m[5] * m[8]) <
         0.0;
}

//------------------------------------------------------------------------------
vtkDataArray* ChosenLabels(vtkImageData* image, vtkDataArray* chosen, const char* name)
{
  const std::string wanted = name ? name : "";
  const std::string known = wanted.empty() || wanted == "Automatic" ? "Segment" : wanted;
  vtkDataArray* labels = chosen ? chosen : image->GetPointData()->GetArray(known.c_str());
  if (!labels)
  {
    throw std::invalid_argument("The image does not have the point array of labels \"" + known +
                                "\"; choose another, or make one by Texture Segmentation.");
  }
  return labels;
}

//------------------------------------------------------------------------------
LabelledImage ReadLabels(vtkImageData* image, vtkDataArray* labels, vtkDataArray* density)
{
  LabelledImage result;
  image->GetExtent(result.Extent.data());
  std::copy_n(image->GetIndexToPhysicalMatrix()->GetData(), 16, result.IndexToPhysical.begin());
  const Index count = image->GetNumberOfPoints();
  const std::string fault =
    MemoryFault("The copy of the labels", (density ? 8.0 : 4.0) * static_cast<double>(count));
  if (!fault.empty())
  {
    throw std::invalid_argument(fault);
  }
  const auto isLabel = [](double x)
  { return x >= 0.0 && x <= std::numeric_limits<std::int32_t>::max() && x == std::floor(x); };
  Copy(labels, result, count, isLabel, "labels are whole numbers from 0 to 2147483647.",
    result.Labels);
  if (density)
  {
    const auto isFinite = [](double x) { return std::isfinite(static_cast<float>(x)); };
    Copy(
      density, result, count, isFinite, "the density must be finite everywhere.", result.Density);
  }
  return result;
}

//------------------------------------------------------------------------------
bool GatherLabels(LabelledImage& image, std::string& fault, vtkMultiProcessController* controller)
{
  // Doubles hold both kinds of numbers exactly.
  ImageSamples samples;
  const std::string lack = FaultOf(
    [&]()
    {
      samples.Values.assign(image.Labels.begin(), image.Labels.end());
      samples.Values.insert(samples.Values.end(), image.Density.begin(), image.Density.end());
    });
  fault = fault.empty() ? lack : fault;
  samples.Extent = image.Extent;
  samples.IndexToPhysical = image.IndexToPhysical;
  samples.Attributes = { { "Labels", 1 } };
  if (!image.Density.empty())
  {
    samples.Attributes.push_back({ "Density", 1 });
  }
  image = LabelledImage();
  if (!GatherSamples(samples, fault, controller))
  {
    return false;
  }
  image.Extent = samples.Extent;
  image.IndexToPhysical = samples.IndexToPhysical;
  const auto density = samples.Values.begin() + samples.Count();
  image.Labels.reserve(samples.Count());
  for (auto value = samples.Values.begin(); value != density; ++value)
  {
    if (!std::isfinite(*value))
    {
      throw std::invalid_argument("The pieces of the image leave holes between them.");
    }
    image.Labels.push_back(static_cast<std::int32_t>(*value));
  }
  image.Density.assign(density, samples.Values.end());
  return true;
}

//------------------------------------------------------------------------------
std::set<int> CheckSegments(const LabelledImage& image, const std::vector<int>& wanted)
{
  const LabelVolume labels = image.View();
  if (*std::min_element(labels.Size.begin(), labels.Size.end()) < 2)
  {
    std::ostringstream text;
    text << "The image has " << labels.Size[0] << " x " << labels.Size[1] << " x " << labels.Size[2]
         << " points; a volume needs two or more along each axis.";
    throw std::invalid_argument(text.str());
  }
  const std::set<int> present = LabelsOf(image.Labels);
  CheckPresent(present, wanted);
  return present;
}

//------------------------------------------------------------------------------
void CheckPresent(const std::set<int>& labels, const std::vector<int>& wanted)
{
  for (const int segment : wanted)
  {
    if (labels.count(segment) == 0)
    {
      throw std::invalid_argument("There is no segment " + std::to_string(segment) + " among the " +
                                  std::to_string(labels.size()) + " labels from " +
                                  std::to_string(*labels.begin()) + " to " +
                                  std::to_string(*labels.rbegin()) + ".");
    }
  }
}

//------------------------------------------------------------------------------
void CheckLabels(const LabelledImage& image, const std::vector<int>& wanted)
{
  const std::set<int> present = CheckSegments(image, wanted);
  if (present.size() == 1)
  {
    throw std::invalid_argument("All voxels have the label " + std::to_string(*present.begin()) +
                                "; a boundary lies between two segments.");
  }
  const std::string fault = MemoryFault("The surface", BytesPerFace * CountFaces(image.View()));
  if (!fault.empty())
  {
    throw std::invalid_argument(fault);
  }
}
}
