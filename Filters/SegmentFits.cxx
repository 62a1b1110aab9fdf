// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "SegmentFits.h"

#include "ChainStep.h"
#include "DomainFit.h"
#include "Fit/PointShares.h"
#include "SMPExecution.h"
#include "TSplineGrid.h"
#include "vtkTSplineFit.h"

#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkIdTypeArray.h"
#include "vtkImageData.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkTable.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <stdexcept>

namespace trivariate
{
namespace
{
constexpr const char* MaskName = "vtkSegmentMask";
constexpr int FewestControlPoints = 64;
constexpr double ShareOfShares = 0.02; // of the progress: to look what each segment needs
constexpr double ShareOfBox = 0.2;     // of a segment's progress: the fit over its box
constexpr double MostMissed = 0.02;    // of a segment's voxels by a spline over a domain

using Extent = std::array<int, 6>;

// A segment: where it is, and how its values range.
struct Part
{
  std::int32_t Label;
  Extent Box;
  double Low, High;
};

//------------------------------------------------------------------------------
// Parts by ascending label, and the number of its part for each voxel.
std::vector<Part> FindParts(
  vtkImageData* image, vtkDataArray* values, std::vector<std::int32_t>& partOf)
{
  vtkDataArray* labels = image->GetPointData()->GetArray("Segment");
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
  std::vector<Part> list;
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
    number[label] = static_cast<std::int32_t>(list.size());
    list.push_back(part);
  }
  partOf.resize(image->GetNumberOfPoints());
  for (voxel = 0; voxel < image->GetNumberOfPoints(); ++voxel)
  {
    partOf[voxel] = number[static_cast<std::int32_t>(labels->GetTuple1(voxel))];
  }
  return list;
}

//------------------------------------------------------------------------------
// The arrays in the part's box, and a mask of its voxels.
vtkSmartPointer<vtkImageData> Crop(vtkImageData* image, const Part& part, std::int32_t number,
  const std::vector<std::int32_t>& partOf, const SegmentFitOptions& options)
{
  auto cropped = vtkSmartPointer<vtkImageData>::New();
  cropped->SetOrigin(image->GetOrigin());
  cropped->SetSpacing(image->GetSpacing());
  cropped->SetDirectionMatrix(image->GetDirectionMatrix());
  cropped->SetExtent(const_cast<int*>(part.Box.data()));
  const vtkIdType row = part.Box[1] - part.Box[0] + 1;
  vtkNew<vtkUnsignedCharArray> mask;
  mask->SetName(MaskName);
  mask->SetNumberOfValues(cropped->GetNumberOfPoints());
  std::vector<std::string> names = options.Further;
  names.insert(names.begin(), options.Array);
  for (const std::string& name : names)
  {
    vtkDataArray* whole = image->GetPointData()->GetArray(name.c_str());
    const auto array = vtk::TakeSmartPointer(whole->NewInstance());
    array->SetName(name.c_str());
    array->SetNumberOfComponents(whole->GetNumberOfComponents());
    array->SetNumberOfTuples(cropped->GetNumberOfPoints());
    cropped->GetPointData()->AddArray(array);
  }
  vtkIdType to = 0;
  for (int k = part.Box[4]; k <= part.Box[5]; ++k)
  {
    for (int j = part.Box[2]; j <= part.Box[3]; ++j, to += row)
    {
      int ijk[3] = { part.Box[0], j, k };
      const vtkIdType from = image->ComputePointId(ijk);
      for (const std::string& name : names)
      {
        cropped->GetPointData()
          ->GetArray(name.c_str())
          ->InsertTuples(to, row, from, image->GetPointData()->GetArray(name.c_str()));
      }
      for (vtkIdType i = 0; i < row; ++i)
      {
        mask->SetValue(to + i, partOf[from + i] == number);
      }
    }
  }
  cropped->GetPointData()->AddArray(mask);
  return cropped;
}

//------------------------------------------------------------------------------
FittedPart FitOverBox(vtkImageData* image, const Part& part, std::int32_t number,
  const std::vector<std::int32_t>& partOf, const SegmentFitOptions& options, vtkAlgorithm* chain,
  double from, double to)
{
  vtkNew<vtkTSplineFit> fit;
  fit->SetController(nullptr);
  fit->SetInputData(Crop(image, part, number, partOf, options));
  fit->SetInputArrayToProcess(
    0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, options.Array.c_str());
  fit->SetMaskArray(MaskName);
  for (const std::string& name : options.Further)
  {
    fit->AddAttribute(name.c_str());
  }
  fit->SetRMSTolerance(options.RmsTolerance);
  fit->SetMaximumNumberOfControlPoints(options.MaximumControlPoints);
  ChainStep(fit, chain, from, to).Run();
  FittedPart fitted;
  fitted.Model = TSplineFromGrid(fit->GetOutput());
  fitted.Model.Segment.assign(fitted.Model.Spline.Size(), part.Label);
  fitted.Rounds = vtkTable::SafeDownCast(fit->GetOutputDataObject(1));
  return fitted;
}

//------------------------------------------------------------------------------
// Puts a fit over a domain in place of that over the box if it is better; otherwise says why not.
// Voxels that it misses go to part 0.
std::string TryDomain(vtkImageData* image, const Part& part, std::int32_t number,
  const SegmentFitOptions& options, vtkAlgorithm* chain, double from, double to,
  std::vector<std::int32_t>& partOf, FittedPart& fitted)
{
  std::vector<vtkIdType> voxels;
  for (std::size_t voxel = 0; voxel < partOf.size(); ++voxel)
  {
    if (partOf[voxel] == number)
    {
      voxels.push_back(static_cast<vtkIdType>(voxel));
    }
  }
  FittedPart aligned;
  const double middle = from + 0.9 * (to - from);
  try
  {
    aligned = FitOverDomain(image, part.Label, options, chain, from, middle);
  }
  catch (const std::runtime_error& reason)
  {
    return reason.what();
  }
  const PartErrors box =
    MeasurePart(image, options.Array, fitted.Model, voxels, chain, middle, middle);
  const PartErrors errors =
    MeasurePart(image, options.Array, aligned.Model, voxels, chain, middle, to);
  const double all = static_cast<double>(voxels.size());
  const double missed = static_cast<double>(errors.Missed.size());
  if (missed > MostMissed * all)
  {
    return "the spline over its cubes misses " + std::to_string(errors.Missed.size()) + " of " +
           std::to_string(voxels.size()) + " voxels.";
  }
  if (errors.Squares / (all - missed) >= box.Squares / all)
  {
    return "with as many control points that is more accurate than its cubes.";
  }
  for (const vtkIdType voxel : errors.Missed)
  {
    partOf[voxel] = 0;
  }
  fitted = std::move(aligned);
  return "";
}

//------------------------------------------------------------------------------
void AddRounds(vtkTable* rounds, std::int32_t segment, vtkTable* all)
{
  const char* names[] = { "Segment", "ControlPoints", "RMS", "MaximumError", "Seconds" };
  if (all->GetNumberOfColumns() == 0)
  {
    for (const char* name : names)
    {
      vtkSmartPointer<vtkDataArray> column = vtkSmartPointer<vtkDoubleArray>::New();
      if (name == names[0])
      {
        column = vtkSmartPointer<vtkIntArray>::New();
      }
      else if (name == names[1])
      {
        column = vtkSmartPointer<vtkIdTypeArray>::New();
      }
      column->SetName(name);
      all->AddColumn(column);
    }
  }
  for (vtkIdType row = 0; row < rounds->GetNumberOfRows(); ++row)
  {
    for (const char* name : names)
    {
      vtkDataArray::SafeDownCast(all->GetColumnByName(name))
        ->InsertNextTuple1(
          name == names[0] ? segment : rounds->GetValueByName(row, name).ToDouble());
    }
  }
}
}

//------------------------------------------------------------------------------
TSplineModel FitSegments(vtkImageData* image, const SegmentFitOptions& options, vtkTable* rounds,
  std::vector<std::string>& why, vtkAlgorithm* chain, double from, double to)
{
  vtkDataArray* values = image->GetPointData()->GetArray(options.Array.c_str());
  std::vector<std::int32_t> partOf;
  const std::vector<Part> parts = FindParts(image, values, partOf);
  std::vector<double> shares;
  {
    std::vector<double> copy(image->GetNumberOfPoints());
    for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
    {
      copy[i] = values->GetComponent(i, 0);
    }
    int size[3];
    image->GetDimensions(size);
    shares = PointShares({ size[0], size[1], size[2] }, copy.data(), partOf,
      static_cast<int>(parts.size()), SMPExecution(chain, from, from + ShareOfShares));
  }
  double low = parts.front().Low, high = parts.front().High;
  for (const Part& part : parts)
  {
    low = std::min(low, part.Low);
    high = std::max(high, part.High);
  }

  // Those with a small share first, the lowest label last: it gets the voxels that others miss.
  std::vector<std::size_t> order(parts.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::stable_sort(order.begin(), order.end(),
    [&shares](std::size_t a, std::size_t b)
    { return a == 0 || b == 0 ? b == 0 && a != 0 : shares[a] < shares[b]; });
  double left = options.MaximumControlPoints, open = 1.0, done = 0.0;
  auto waiting = static_cast<double>(parts.size());
  std::vector<FittedPart> fitted(parts.size());
  for (const std::size_t p : order)
  {
    const auto number = static_cast<std::int32_t>(p);
    SegmentFitOptions own = options;
    // As many as its share, but those after it must have some.
    --waiting;
    const double most = left - FewestControlPoints * waiting;
    const double wanted = open > 0.0 ? std::min(most, left * shares[p] / open) : most;
    own.MaximumControlPoints = std::max(FewestControlPoints, static_cast<int>(wanted));
    const double range = parts[p].High - parts[p].Low;
    own.RmsTolerance =
      range > 0.0 ? std::min(100.0, options.RmsTolerance * (high - low) / range) : 0.0;
    const bool tries = options.OverDomains && p > 0;
    const double begin = from + ShareOfShares + (to - from - ShareOfShares) * done;
    const double end = begin + (to - from - ShareOfShares) * shares[p];
    const double middle = tries ? begin + ShareOfBox * (end - begin) : end;
    fitted[p] = FitOverBox(image, parts[p], number, partOf, own, chain, begin, middle);
    if (tries)
    {
      const std::string reason =
        TryDomain(image, parts[p], number, own, chain, middle, end, partOf, fitted[p]);
      if (!reason.empty())
      {
        why.push_back("Segment " + std::to_string(parts[p].Label) +
                      " is fitted over its bounding box: " + reason);
      }
    }
    done += shares[p];
    left -= static_cast<double>(fitted[p].Model.Spline.Size());
    open -= shares[p];
  }
  TSplineModel whole;
  for (std::size_t p = 0; p < parts.size(); ++p)
  {
    whole = JoinParts(whole, fitted[p].Model);
    AddRounds(fitted[p].Rounds, parts[p].Label, rounds);
  }
  vtkDataArray* labels = image->GetPointData()->GetArray("Segment");
  for (vtkIdType voxel = 0; options.OverDomains && voxel < image->GetNumberOfPoints(); ++voxel)
  {
    labels->SetTuple1(voxel, parts[partOf[voxel]].Label);
  }
  return whole;
}
}
