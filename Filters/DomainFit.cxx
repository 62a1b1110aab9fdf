// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "DomainFit.h"

#include "ChainStep.h"
#include "DomainSamples.h"
#include "DomainSelection.h"
#include "PartErrors.h"
#include "SegmentPoints.h"
#include "TSplineGrid.h"
#include "vtkTSplineFit.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkIdList.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPartitionedDataSet.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkPointData.h"
#include "vtkStructuredGrid.h"
#include "vtkTable.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <stdexcept>

namespace trivariate
{
namespace
{
constexpr double ShareOfErrors = 0.1; // of the progress: the errors of the round trip
constexpr double MostMissed = 0.02;   // of a segment's voxels

// Takes parameters from the space of all blocks to that of some of them, `cells` among all.
void MoveParameters(vtkImageData* image, const BlockComplex& all, const BlockComplex& own,
  const std::vector<vtkIdType>& cells)
{
  std::map<Index, Index> numbers;
  for (std::size_t i = 0; i < cells.size(); ++i)
  {
    numbers[cells[i]] = static_cast<Index>(i);
  }
  vtkDataArray* parameter = image->GetPointData()->GetArray(ParameterArrayName);
  vtkDataArray* mask = image->GetPointData()->GetArray(ParameterMaskName);
  for (vtkIdType voxel = 0; voxel < image->GetNumberOfPoints(); ++voxel)
  {
    std::array<double, 3> p;
    parameter->GetTuple(voxel, p.data());
    const auto block = numbers.find(all.BlockAt(p));
    if (mask->GetTuple1(voxel) == 0.0 || block == numbers.end())
    {
      continue; // of another segment
    }
    for (int a = 0; a < 3; ++a)
    {
      p[a] += own.Origins[block->second][a] - all.Origins[block->first][a];
    }
    parameter->SetTuple(voxel, p.data());
  }
}

//------------------------------------------------------------------------------
// Segments over their blocks alone. `image` has the arrays to fit, Parameter and ParameterMask of
// the domains; its Parameter is changed to that of the blocks alone.
FittedPart FitOverBlocks(const FilledDomains& domains, vtkImageData* image,
  const std::set<int>& segments, const SegmentFitOptions& options, Chain& chain, double from,
  double to)
{
  for (const int segment : segments)
  {
    if (domains.Folded.count(segment) > 0)
    {
      throw std::runtime_error("its block mesh has folds.");
    }
  }
  vtkDataArray* owners = domains.Polycubes->GetCellData()->GetArray("Segment");
  std::vector<vtkIdType> cells;
  vtkNew<vtkPartitionedDataSetCollection> blocks;
  for (vtkIdType cell = 0; cell < domains.Polycubes->GetNumberOfCells(); ++cell)
  {
    if (segments.count(static_cast<int>(owners->GetTuple1(cell))) > 0)
    {
      blocks->SetPartition(static_cast<unsigned int>(cells.size()), 0,
        domains.Blocks->GetPartition(static_cast<unsigned int>(cell), 0));
      cells.push_back(cell);
    }
  }
  const vtkNew<vtkUnstructuredGrid> cubes = CubesOf(domains.Polycubes, cells);
  MoveParameters(image, ReadBlocks(domains.Polycubes), ReadBlocks(cubes), cells);

  vtkNew<vtkTSplineFit> fit;
  fit->SetInputData(0, image);
  fit->SetInputData(1, cubes);
  fit->SetInputData(2, blocks);
  FittedPart part = RunFit(fit, CutMaskName, "FitOverCubes", options, chain, from, to);
  const double folds = part.Rounds->GetFieldData()->GetArray("ShapeCells")->GetComponent(0, 1);
  if (folds > 0.0)
  {
    throw std::runtime_error(
      "the spline over cubes is folded in " + std::to_string(int(folds)) + " of its cells.");
  }
  return part;
}
}

//------------------------------------------------------------------------------
std::vector<std::set<int>> TouchingSegments(const FilledDomains& domains, int lowest)
{
  const BlockComplex blocks = ReadBlocks(domains.Polycubes);
  std::map<int, std::set<int>> touched; // by each segment
  for (Index b = 0; b < blocks.Size(); ++b)
  {
    for (int side = 0; side < 6; ++side)
    {
      const Index other = blocks.Twin({ b, side / 2, side % 2 }).Face.Block;
      const auto counts = [&](Index block)
      {
        const int segment = blocks.Segments[block];
        return segment >= lowest && domains.Folded.count(segment) == 0;
      };
      if (other >= 0 && blocks.Segments[b] != blocks.Segments[other] && counts(b) && counts(other))
      {
        touched[blocks.Segments[b]].insert(blocks.Segments[other]);
      }
    }
  }
  std::vector<std::set<int>> sets;
  while (!touched.empty())
  {
    std::set<int>& all = sets.emplace_back();
    std::set<int> open{ touched.begin()->first };
    while (!open.empty())
    {
      const int segment = *open.begin();
      open.erase(open.begin());
      if (all.insert(segment).second)
      {
        open.merge(touched[segment]);
        touched.erase(segment);
      }
    }
  }
  return sets;
}

//------------------------------------------------------------------------------
DomainFit FitOverDomain(const SegmentedImage& image, const PartNumbers& numbers,
  const FilledDomains& domains, const SegmentFitOptions& options, Chain& chain, double from,
  double to)
{
  DomainFit fit;
  const Part whole = UniteParts(image.Parts, numbers);
  const Cut cut = CutOut(image, numbers);
  for (const char* name : { ParameterArrayName, ParameterMaskName })
  {
    AddCropped(domains.Fields, domains.Fields->GetPointData()->GetArray(name), cut.Image);
  }
  std::set<int> labels;
  for (const std::int32_t number : numbers)
  {
    labels.insert(image.Parts[number].Label);
  }
  double at = to - ShareOfErrors * (to - from);
  FittedPart together;
  try
  {
    together = FitOverBlocks(domains, cut.Image, labels, options, chain, from, at);
  }
  catch (const std::runtime_error& reason)
  {
    fit.Why = reason.what();
    return fit;
  }
  together.Together = whole.Label;
  together.Range = whole.High - whole.Low;
  vtkDataArray* known = domains.Fields->GetPointData()->GetArray(ParameterMaskName);
  const auto all = static_cast<double>(cut.Voxels.size());
  double squares = 0.0;
  for (const std::int32_t number : numbers)
  {
    FittedPart& part = fit.Fitted.emplace_back(together);
    part.Model = SegmentPart(together.Model, image.Parts[number].Label);
    // What the fit did not know it did not see, though the spline may come near.
    std::vector<vtkIdType> voxels, missed;
    for (const vtkIdType voxel : cut.Voxels)
    {
      if (image.PartOf[voxel] == number)
      {
        (known->GetTuple1(voxel) != 0.0 ? voxels : missed).push_back(voxel);
      }
    }
    const double count = static_cast<double>(voxels.size() + missed.size());
    const double next = at + (to - at) * count / all;
    const PartErrors errors = MeasurePart(image, part.Model, voxels, chain, at, next);
    at = next;
    missed.insert(missed.end(), errors.Missed.begin(), errors.Missed.end());
    part.Squares = image.Arrays.size() == 1
                     ? errors.Squares.front()
                     : SquaresOf(part, count - static_cast<double>(missed.size()));
    squares += part.Squares;
    fit.Missed.insert(fit.Missed.end(), missed.begin(), missed.end());
    if (double(missed.size()) > MostMissed * count)
    {
      fit.Why = "the spline over cubes misses " + std::to_string(missed.size()) + " of " +
                std::to_string(static_cast<vtkIdType>(count)) + " voxels.";
    }
  }
  fit.Error = squares / (all - static_cast<double>(fit.Missed.size()));
  return fit;
}
}
