// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ImageSamples.h"

#include "MemoryLimit.h"

#include "vtkArrayDispatch.h"
#include "vtkCommunicator.h"
#include "vtkDataArray.h"
#include "vtkDataArrayRange.h"
#include "vtkImageData.h"
#include "vtkMatrix4x4.h"
#include "vtkMultiProcessController.h"
#include "vtkMultiProcessStream.h"

#include <algorithm>
#include <limits>
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

//------------------------------------------------------------------------------
// What a process must know of another's piece before the values are sent.
struct PieceHeader
{
  enum Field
  {
    FAULTY = 6,
    COMPONENTS,
    MASKED,
    LENGTH
  };
  std::array<int, LENGTH> Numbers;

  Index Count() const
  {
    Index count = 1;
    for (int a = 0; a < 3; ++a)
    {
      count *= std::max(0, this->Numbers[2 * a + 1] - this->Numbers[2 * a] + 1);
    }
    return count;
  }
};

//------------------------------------------------------------------------------
// Copies `components` blocks of a piece to their places in the blocks of the whole.
template <typename T>
void Assemble(const T* piece, const PieceHeader& header, int components, const ImageSamples& whole,
  std::vector<T>& values)
{
  const auto& e = header.Numbers;
  const Index row = e[1] - e[0] + 1;
  for (int c = 0; c < components; ++c)
  {
    for (int k = e[4]; k <= e[5]; ++k)
    {
      for (int j = e[2]; j <= e[3]; ++j, piece += row)
      {
        const Index at =
          e[0] - whole.Extent[0] +
          whole.Points(0) * (j - whole.Extent[2] +
                              whole.Points(1) * (k - whole.Extent[4] + whole.Points(2) * Index(c)));
        std::copy_n(piece, row, &values[at]);
      }
    }
  }
}

//------------------------------------------------------------------------------
// Sends everybody's numbers to process 0, one piece after another.
template <typename T>
std::vector<T> GatherToRoot(
  const std::vector<T>& own, std::vector<vtkIdType> lengths, vtkMultiProcessController* controller)
{
  std::vector<vtkIdType> offsets(lengths.size() + 1, 0);
  for (std::size_t p = 0; p < lengths.size(); ++p)
  {
    offsets[p + 1] = offsets[p] + lengths[p];
  }
  std::vector<T> all(controller->GetLocalProcessId() == 0 ? offsets.back() : 0);
  controller->GatherV(
    own.data(), all.data(), static_cast<vtkIdType>(own.size()), lengths.data(), offsets.data(), 0);
  return all;
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
ImageSamples ReadSamples(
  vtkImageData* image, const std::vector<vtkDataArray*>& arrays, vtkDataArray* mask)
{
  ImageSamples samples;
  image->GetExtent(samples.Extent.data());
  const double* matrix = image->GetIndexToPhysicalMatrix()->GetData();
  std::copy_n(matrix, 16, samples.IndexToPhysical.begin());
  for (vtkDataArray* array : arrays)
  {
    CheckTuples(image, array);
    const std::string name = NameOf(array);
    if (IsTSplineArrayName(name))
    {
      throw std::invalid_argument(
        "The array \"" + name +
        "\" has the name of an array that every T-spline grid has; rename it first.");
    }
    samples.Attributes.push_back({ name, array->GetNumberOfComponents() });
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
  if (mask)
  {
    CheckTuples(image, mask);
    if (mask->GetNumberOfComponents() != 1)
    {
      throw std::invalid_argument("The mask array \"" + NameOf(mask) + "\" has " +
                                  std::to_string(mask->GetNumberOfComponents()) +
                                  " components; one is needed.");
    }
    samples.Mask.resize(count);
    const auto values = vtk::DataArrayValueRange<1>(mask);
    std::transform(values.begin(), values.end(), samples.Mask.begin(),
      [](double value) { return static_cast<std::uint8_t>(value != 0.0); });
  }
  return samples;
}

//------------------------------------------------------------------------------
bool GatherSamples(ImageSamples& samples, std::string& fault, vtkMultiProcessController* controller)
{
  const int processes = controller->GetNumberOfProcesses();
  const int me = controller->GetLocalProcessId();
  PieceHeader own;
  std::copy(samples.Extent.begin(), samples.Extent.end(), own.Numbers.begin());
  own.Numbers[PieceHeader::FAULTY] = !fault.empty();
  own.Numbers[PieceHeader::COMPONENTS] = samples.Components();
  own.Numbers[PieceHeader::MASKED] = !samples.Mask.empty();
  std::vector<PieceHeader> headers(processes);
  controller->AllGather(own.Numbers.data(), headers.front().Numbers.data(), PieceHeader::LENGTH);

  ImageSamples whole;
  int first = -1; // a process whose piece is not empty: it knows the arrays
  for (int p = 0; p < processes; ++p)
  {
    const auto& e = headers[p].Numbers;
    if (e[PieceHeader::FAULTY])
    {
      fault = p == me ? fault : "";
      return false;
    }
    if (headers[p].Count() == 0)
    {
      continue;
    }
    const auto& reference = headers[first < 0 ? p : first].Numbers;
    if (e[PieceHeader::COMPONENTS] != reference[PieceHeader::COMPONENTS] ||
        e[PieceHeader::MASKED] != reference[PieceHeader::MASKED])
    {
      fault = me == 0 ? "The pieces of the image do not have the same arrays." : "";
      return false;
    }
    for (int a = 0; a < 3; ++a)
    {
      int* extent = &whole.Extent[2 * a];
      extent[0] = first < 0 ? e[2 * a] : std::min(extent[0], e[2 * a]);
      extent[1] = first < 0 ? e[2 * a + 1] : std::max(extent[1], e[2 * a + 1]);
    }
    first = first < 0 ? p : first;
  }
  if (first < 0)
  {
    samples = ImageSamples();
    return true;
  }

  controller->Broadcast(samples.IndexToPhysical.data(), 16, first);
  whole.IndexToPhysical = samples.IndexToPhysical;
  vtkMultiProcessStream names;
  for (const TSplineAttribute& attribute : samples.Attributes)
  {
    names << attribute.Name << attribute.Components;
  }
  controller->Broadcast(names, first);
  while (!names.Empty())
  {
    TSplineAttribute attribute;
    names >> attribute.Name >> attribute.Components;
    whole.Attributes.push_back(attribute);
  }

  const int components = whole.Components();
  const bool masked = headers[first].Numbers[PieceHeader::MASKED] != 0;
  std::vector<vtkIdType> counts, lengths;
  for (const PieceHeader& header : headers)
  {
    counts.push_back(masked ? header.Count() : 0);
    lengths.push_back(components * header.Count());
  }
  const std::vector<double> values = GatherToRoot(samples.Values, lengths, controller);
  const std::vector<std::uint8_t> mask = GatherToRoot(samples.Mask, counts, controller);
  samples = ImageSamples();
  if (me != 0)
  {
    return true;
  }
  // A hole between the pieces stays NaN, which the fit refuses.
  whole.Values.assign(components * whole.Count(), std::numeric_limits<double>::quiet_NaN());
  whole.Mask.assign(masked ? whole.Count() : 0, 1);
  const double* pieceValues = values.data();
  const std::uint8_t* pieceMask = mask.data();
  for (int p = 0; p < processes; ++p)
  {
    Assemble(pieceValues, headers[p], components, whole, whole.Values);
    Assemble(pieceMask, headers[p], masked ? 1 : 0, whole, whole.Mask);
    pieceValues += lengths[p];
    pieceMask += counts[p];
  }
  samples = std::move(whole);
  return true;
}
}
