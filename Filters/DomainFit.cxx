// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "DomainFit.h"

#include "ChainStep.h"
#include "DomainSamples.h"
#include "DomainSelection.h"
#include "Parameter/BlockCells.h"
#include "SMPExecution.h"
#include "SegmentPoints.h"
#include "TSpline/BezierMesh.h"
#include "TSplineGrid.h"
#include "TSplinePoints.h"
#include "vtkFrameField.h"
#include "vtkHexRemesh.h"
#include "vtkTSplineFit.h"
#include "vtkVolumeParameterization.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIdList.h"
#include "vtkIdTypeArray.h"
#include "vtkImageData.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPartitionedDataSet.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"
#include "vtkStructuredGrid.h"
#include "vtkTable.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <stdexcept>

namespace trivariate
{
namespace
{
// Where the steps end, as shares of their progress.
constexpr double Framed = 0.25, Parameterized = 0.85;

//------------------------------------------------------------------------------
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

// Of cells, in voxels: two, or longer where more cells would fill the image than are untangled
// within half a minute.
double CellLength(vtkImageData* image)
{
  constexpr double mostCells = 30000.0;
  return std::max(2.0, std::cbrt(static_cast<double>(image->GetNumberOfPoints()) / mostCells));
}

//------------------------------------------------------------------------------
// Segments with a cell that is inverted somewhere.
std::set<int> FoldedSegments(const FilledDomains& domains)
{
  std::set<int> folded;
  vtkDataArray* owners = domains.Polycubes->GetCellData()->GetArray("Segment");
  vtkNew<vtkIdList> ids;
  for (unsigned int b = 0; b < domains.Blocks->GetNumberOfPartitionedDataSets(); ++b)
  {
    auto* grid = vtkStructuredGrid::SafeDownCast(domains.Blocks->GetPartition(b, 0));
    std::vector<Eigen::Vector3d> places(grid->GetNumberOfPoints());
    for (std::size_t p = 0; p < places.size(); ++p)
    {
      grid->GetPoint(static_cast<vtkIdType>(p), places[p].data());
    }
    for (vtkIdType cell = 0; cell < grid->GetNumberOfCells(); ++cell)
    {
      grid->GetCellPoints(cell, ids);
      BlockPoints corners;
      std::copy_n(ids->begin(), 8, corners.begin());
      if (!(LeastDeterminant(places, corners) > 0.0))
      {
        folded.insert(static_cast<int>(owners->GetTuple1(b)));
      }
    }
  }
  return folded;
}

//------------------------------------------------------------------------------
// Parameters of the segments with cubes, from an image with frames.
FilledDomains Parameterize(vtkImageData* frames, vtkPolyData* patches,
  vtkUnstructuredGrid* polycubes, Chain& chain, double from, double to)
{
  vtkNew<vtkVolumeParameterization> parameters;
  parameters->SetController(nullptr);
  parameters->SetInputData(0, frames);
  parameters->SetInputData(1, patches);
  parameters->SetInputData(2, polycubes);
  parameters->SetCellLength(CellLength(frames));
  ChainStep(parameters, chain, from, to).Run();
  FilledDomains domains;
  domains.Fields = vtkImageData::SafeDownCast(parameters->GetOutputDataObject(0));
  domains.Polycubes = parameters->GetPolycube();
  domains.Blocks = parameters->GetBlocks();
  domains.Folded = FoldedSegments(domains);
  vtkDataArray* owners = domains.Polycubes->GetCellData()->GetArray("Segment");
  for (vtkIdType block = 0; block < domains.Polycubes->GetNumberOfCells(); ++block)
  {
    ++domains.BlocksOf[static_cast<int>(owners->GetTuple1(block))];
  }
  return domains;
}
}

//------------------------------------------------------------------------------
FilledDomains FillDomains(vtkImageData* image, vtkPolyData* patches, vtkUnstructuredGrid* polycubes,
  Chain& chain, double from, double to)
{
  const auto at = [from, to](double share) { return from + (to - from) * share; };
  vtkNew<vtkFrameField> frames;
  frames->SetController(nullptr);
  frames->SetInputData(0, image);
  frames->SetInputData(1, patches);
  ChainStep(frames, chain, from, at(Framed)).Run();
  FilledDomains domains = Parameterize(vtkImageData::SafeDownCast(frames->GetOutputDataObject(0)),
    patches, polycubes, chain, at(Framed), at(Parameterized));

  const double* spacing = image->GetSpacing();
  vtkNew<vtkHexRemesh> hexahedra;
  hexahedra->SetEdgeLength(CellLength(image) * std::cbrt(spacing[0] * spacing[1] * spacing[2]));
  hexahedra->SetInputDataObject(0, image);
  hexahedra->SetInputDataObject(1, patches);
  hexahedra->SetInputDataObject(2, polycubes);
  hexahedra->SetInputDataObject(3, domains.Blocks);
  ChainStep(hexahedra, chain, at(Parameterized), to).Run();
  domains.Hexahedra = hexahedra->GetHexahedra();
  // The remesher was given cells that are repaired already.
  domains.Hexahedra->GetFieldData()
    ->GetArray("InvertedCells")
    ->SetComponent(
      0, 0, domains.Fields->GetFieldData()->GetArray("InvertedCells")->GetComponent(0, 0));
  return domains;
}

//------------------------------------------------------------------------------
FilledDomains FillCubesAlone(
  const FilledDomains& filled, vtkPolyData* patches, Chain& chain, double from, double to)
{
  const vtkNew<vtkUnstructuredGrid> cubes = WithoutLayers(filled.Polycubes);
  vtkNew<vtkPolyData> theirs;
  theirs->ShallowCopy(patches);
  LeaveOutInverted(theirs, cubes);
  return cubes->GetNumberOfCells() > 0 ? Parameterize(filled.Fields, theirs, cubes, chain, from, to)
                                       : FilledDomains();
}

//------------------------------------------------------------------------------
FittedPart RunFit(vtkTSplineFit* fit, const char* mask, const std::string& step,
  const SegmentFitOptions& options, Chain& chain, double from, double to)
{
  fit->SetController(nullptr);
  fit->SetInputArrayToProcess(
    0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, options.Array.c_str());
  fit->SetMaskArray(mask);
  for (const std::string& name : options.Further)
  {
    fit->AddAttribute(name.c_str());
  }
  fit->SetMaximumNumberOfControlPoints(options.MaximumControlPoints);
  fit->SetRMSTolerance(options.RmsTolerance);
  ChainStep(fit, chain, from, to, step).Run();
  FittedPart part;
  part.Model = TSplineFromGrid(fit->GetOutput());
  part.Rounds = vtkTable::SafeDownCast(fit->GetOutputDataObject(1));
  return part;
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
FittedPart FitOverDomain(const FilledDomains& domains, vtkImageData* image, const char* mask,
  const std::set<int>& segments, const SegmentFitOptions& options, Chain& chain, double from,
  double to)
{
  for (const int segment : segments)
  {
    if (domains.Folded.count(segment) > 0)
    {
      throw std::runtime_error("Its block mesh has folds.");
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
  FittedPart part = RunFit(fit, mask, "FitOverCubes", options, chain, from, to);
  const bool layered = cubes->GetCellData()->GetArray("Patch")->GetRange()[1] >= 0.0;
  part.Domain = layered ? "LayeredCubes" : "Cubes";
  return part;
}

//------------------------------------------------------------------------------
double LastRms(vtkTable* rounds)
{
  return rounds->GetValueByName(rounds->GetNumberOfRows() - 1, "RMS").ToDouble();
}

//------------------------------------------------------------------------------
void AddRounds(const FittedPart& fitted, int segment, vtkTable* all)
{
  const char* names[] = { "Segment", "ControlPoints", "RMS", "MaximumError", "Seconds", "Range",
    "GradientJump" };
  vtkDataArray* jump = fitted.Rounds->GetFieldData()->GetArray("GradientJump");
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
        ->InsertNextTuple1(name == names[0]   ? segment
                           : name == names[5] ? fitted.Range
                           : name == names[6]
                             ? (jump ? jump->GetTuple1(0) : 0.0)
                             : fitted.Rounds->GetValueByName(row, name).ToDouble());
    }
    vtkStringArray::SafeDownCast(all->GetColumnByName("Domain"))->InsertNextValue(fitted.Domain);
  }
}

//------------------------------------------------------------------------------
PartErrors MeasurePart(vtkImageData* image, const std::string& array, const TSplineModel& model,
  const std::vector<vtkIdType>& voxels, Chain& chain, double from, double to)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(static_cast<vtkIdType>(voxels.size()));
  for (std::size_t i = 0; i < voxels.size(); ++i)
  {
    points->SetPoint(static_cast<vtkIdType>(i), image->GetPoint(voxels[i]));
  }
  vtkNew<vtkPolyData> cloud;
  cloud->SetPoints(points);
  const Execution execution = SMPExecution(chain.Filter, from, to);
  const BezierMesh mesh(model.Spline, execution.Part(0.0, 0.1));
  FillPoints({ model, mesh, false, false, ReachIn(image) }, cloud, execution.Part(0.1, 1.0));
  vtkDataArray* wanted = image->GetPointData()->GetArray(array.c_str());
  vtkDataArray* values = cloud->GetPointData()->GetArray(array.c_str());
  vtkDataArray* found = cloud->GetPointData()->GetArray("vtkValidPointMask");
  PartErrors errors;
  for (std::size_t i = 0; i < voxels.size(); ++i)
  {
    if (found->GetTuple1(static_cast<vtkIdType>(i)) == 0.0)
    {
      errors.Missed.push_back(voxels[i]);
      continue;
    }
    const double error =
      values->GetComponent(static_cast<vtkIdType>(i), 0) - wanted->GetComponent(voxels[i], 0);
    errors.Squares += error * error;
  }
  return errors;
}
}
