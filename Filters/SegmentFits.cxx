// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "SegmentFits.h"

#include "ChainStep.h"
#include "DomainFit.h"
#include "DomainSamples.h"
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
#include "vtkStringArray.h"
#include "vtkTable.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
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
// Adds what an array has in a box of the image to the image that is the box.
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
// A part with the voxels that are its own.
struct Cut
{
  vtkSmartPointer<vtkImageData> Image; // the part's box with the arrays to fit, and the mask
  std::vector<vtkIdType> Voxels;       // of the whole image
};

Cut CutOut(vtkImageData* image, const Part& part, std::int32_t number,
  const std::vector<std::int32_t>& partOf, const SegmentFitOptions& options)
{
  Cut cut{ vtkSmartPointer<vtkImageData>::New(), {} };
  cut.Image->SetOrigin(image->GetOrigin());
  cut.Image->SetSpacing(image->GetSpacing());
  cut.Image->SetDirectionMatrix(image->GetDirectionMatrix());
  cut.Image->SetExtent(const_cast<int*>(part.Box.data()));
  AddCropped(image, image->GetPointData()->GetArray(options.Array.c_str()), cut.Image);
  for (const std::string& name : options.Further)
  {
    AddCropped(image, image->GetPointData()->GetArray(name.c_str()), cut.Image);
  }
  vtkNew<vtkUnsignedCharArray> mask;
  mask->SetName(MaskName);
  mask->Allocate(cut.Image->GetNumberOfPoints());
  for (int k = part.Box[4]; k <= part.Box[5]; ++k)
  {
    for (int j = part.Box[2]; j <= part.Box[3]; ++j)
    {
      int ijk[3] = { part.Box[0], j, k };
      vtkIdType voxel = image->ComputePointId(ijk);
      for (int i = part.Box[0]; i <= part.Box[1]; ++i, ++voxel)
      {
        mask->InsertNextValue(partOf[voxel] == number);
        if (partOf[voxel] == number)
        {
          cut.Voxels.push_back(voxel);
        }
      }
    }
  }
  cut.Image->GetPointData()->AddArray(mask);
  return cut;
}

//------------------------------------------------------------------------------
FittedPart FitOverBox(const Cut& cut, const Part& part, const SegmentFitOptions& options,
  Chain& chain, double from, double to)
{
  vtkNew<vtkTSplineFit> fit;
  fit->SetInputData(cut.Image);
  FittedPart fitted = RunFit(fit, MaskName, part.Label, "FitOverBox", options, chain, from, to);
  // Its geometry is affine: the error of the round trip is that of the fit.
  const double range = part.High - part.Low;
  const double rms = range > 0.0 ? LastRms(fitted.Rounds) / 100.0 * range : 0.0;
  fitted.Squares = rms * rms * static_cast<double>(cut.Voxels.size());
  fitted.Domain = "SegmentBox";
  return fitted;
}

//------------------------------------------------------------------------------
struct CubesFit
{
  FittedPart Fitted;
  std::vector<vtkIdType> Missed; // voxels that the spline does not pass through
  std::string Why;               // there is none; empty: there is one
};

CubesFit FitCubes(vtkImageData* image, const Cut& cut, const Part& part,
  const FilledDomains& domains, const SegmentFitOptions& options, Chain& chain, double from,
  double to)
{
  CubesFit cubes;
  for (const char* name : { ParameterArrayName, ParameterMaskName })
  {
    AddCropped(domains.Fields, domains.Fields->GetPointData()->GetArray(name), cut.Image);
  }
  const double fitted = to - 0.1 * (to - from);
  try
  {
    cubes.Fitted =
      FitOverDomain(domains, cut.Image, MaskName, part.Label, options, chain, from, fitted);
  }
  catch (const std::runtime_error& reason)
  {
    cubes.Why = reason.what();
    return cubes;
  }
  PartErrors errors =
    MeasurePart(image, options.Array, cubes.Fitted.Model, cut.Voxels, chain, fitted, to);
  cubes.Fitted.Squares = errors.Squares;
  cubes.Missed = std::move(errors.Missed);
  if (double(cubes.Missed.size()) > MostMissed * double(cut.Voxels.size()))
  {
    cubes.Why = "the spline over its cubes misses " + std::to_string(cubes.Missed.size()) + " of " +
                std::to_string(cut.Voxels.size()) + " voxels.";
  }
  return cubes;
}

//------------------------------------------------------------------------------
// The fit over the box, and `why` it is that one; or that over cubes if it is better, and the
// voxels that it misses, which are those of part 0 then.
FittedPart FitPart(vtkImageData* image, const Part& part, std::int32_t number,
  const SegmentFitOptions& options, Chain& chain, double from, double to,
  std::vector<std::int32_t>& partOf, std::string& why)
{
  const Cut cut = CutOut(image, part, number, partOf, options);
  std::vector<const FilledDomains*> candidates;
  for (const FilledDomains& domains : options.Domains)
  {
    if (number > 0 && domains.BlocksOf.count(part.Label) > 0)
    {
      candidates.push_back(&domains);
    }
  }
  if (candidates.empty())
  {
    return FitOverBox(cut, part, options, chain, from, to);
  }
  const double boxed = from + ShareOfBox * (to - from);
  const double each = (to - boxed) / static_cast<double>(candidates.size());
  const auto all = static_cast<double>(cut.Voxels.size());
  double least = std::numeric_limits<double>::infinity(); // squared error of a voxel
  FittedPart best;
  std::vector<vtkIdType> missed;
  bool overCubes = false;
  if (options.Compared)
  {
    best = FitOverBox(cut, part, options, chain, from, boxed);
    least = best.Squares / all;
  }
  for (std::size_t i = 0; i < candidates.size(); ++i)
  {
    const double begin = boxed + each * static_cast<double>(i);
    CubesFit cubes =
      FitCubes(image, cut, part, *candidates[i], options, chain, begin, begin + each);
    const double error = cubes.Fitted.Squares / (all - static_cast<double>(cubes.Missed.size()));
    if (cubes.Why.empty() && error >= least)
    {
      cubes.Why = "with as many control points that is more accurate than its cubes.";
    }
    if (cubes.Why.empty())
    {
      best = std::move(cubes.Fitted);
      missed = std::move(cubes.Missed);
      least = error;
      overCubes = true;
    }
    why = why.empty() ? cubes.Why : why;
  }
  why = overCubes ? "" : why;
  if (!best.Rounds)
  {
    return FitOverBox(cut, part, options, chain, to, to);
  }
  for (const vtkIdType voxel : missed)
  {
    partOf[voxel] = 0;
  }
  return best;
}

//------------------------------------------------------------------------------
void AddRounds(const FittedPart& fitted, const Part& part, vtkTable* all)
{
  const char* names[] = { "Segment", "ControlPoints", "RMS", "MaximumError", "Seconds", "Range" };
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
    vtkNew<vtkStringArray> domains;
    domains->SetName("Domain");
    all->AddColumn(domains);
  }
  for (vtkIdType row = 0; row < fitted.Rounds->GetNumberOfRows(); ++row)
  {
    for (const char* name : names)
    {
      vtkDataArray::SafeDownCast(all->GetColumnByName(name))
        ->InsertNextTuple1(name == names[0] ? part.Label
                           : name == names[5]
                             ? part.High - part.Low
                             : fitted.Rounds->GetValueByName(row, name).ToDouble());
    }
    vtkStringArray::SafeDownCast(all->GetColumnByName("Domain"))->InsertNextValue(fitted.Domain);
  }
}
}

//------------------------------------------------------------------------------
SegmentFits FitSegments(vtkImageData* image, const SegmentFitOptions& options, vtkTable* rounds,
  std::vector<std::string>& why, Chain& chain, double from, double to)
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
      static_cast<int>(parts.size()), SMPExecution(chain.Filter, from, from + ShareOfShares));
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
  const auto fewest = [&options, &parts](std::size_t p)
  {
    // Over a domain that is wanted every block needs some.
    int blocks = 1;
    for (const FilledDomains& domains : options.Domains)
    {
      const auto domain = domains.BlocksOf.find(parts[p].Label);
      const bool wanted = !options.Compared && domain != domains.BlocksOf.end();
      blocks = std::max(blocks, wanted ? domain->second : 1);
    }
    return FewestControlPoints * blocks;
  };
  double left = options.MaximumControlPoints, open = 1.0, done = 0.0, reserved = 0.0;
  for (const std::size_t p : order)
  {
    reserved += fewest(p);
  }
  std::vector<FittedPart> fitted(parts.size());
  for (const std::size_t p : order)
  {
    const auto number = static_cast<std::int32_t>(p);
    SegmentFitOptions own = options;
    // As many as its share, but those after it must have some.
    reserved -= fewest(p);
    const double most = left - reserved;
    const double wanted = open > 0.0 ? std::min(most, left * shares[p] / open) : most;
    own.MaximumControlPoints = std::max(fewest(p), static_cast<int>(wanted));
    const double range = parts[p].High - parts[p].Low;
    own.RmsTolerance =
      range > 0.0 ? std::min(100.0, options.RmsTolerance * (high - low) / range) : 0.0;
    const double begin = from + ShareOfShares + (to - from - ShareOfShares) * done;
    const double end = begin + (to - from - ShareOfShares) * shares[p];
    std::string reason;
    fitted[p] = FitPart(image, parts[p], number, own, chain, begin, end, partOf, reason);
    if (!reason.empty())
    {
      why.push_back("Segment " + std::to_string(parts[p].Label) +
                    " is fitted over its bounding box: " + reason);
    }
    done += shares[p];
    left -= static_cast<double>(fitted[p].Model.Spline.Size());
    open -= shares[p];
  }
  SegmentFits whole{ {}, 0.0 };
  double squares = 0.0;
  for (std::size_t p = 0; p < parts.size(); ++p)
  {
    whole.Model = JoinParts(whole.Model, fitted[p].Model);
    squares += fitted[p].Squares;
    AddRounds(fitted[p], parts[p], rounds);
  }
  vtkDataArray* labels = image->GetPointData()->GetArray("Segment");
  for (vtkIdType voxel = 0; voxel < image->GetNumberOfPoints(); ++voxel)
  {
    labels->SetTuple1(voxel, parts[partOf[voxel]].Label);
  }
  if (high > low)
  {
    const auto voxels = static_cast<double>(image->GetNumberOfPoints());
    whole.RmsPercent = 100.0 * std::sqrt(squares / voxels) / (high - low);
  }
  return whole;
}
}
