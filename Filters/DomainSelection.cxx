// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "DomainSelection.h"

#include "Domain/InnerCorners.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCleanPolyData.h"
#include "vtkDataArray.h"
#include "vtkIdList.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>

namespace trivariate
{
namespace
{
// The cells of some segments.
std::vector<vtkIdType> CellsOf(vtkDataSet* data, const std::set<int>& segments)
{
  std::vector<vtkIdType> cells;
  vtkDataArray* owners = data->GetCellData()->GetArray("Segment");
  for (vtkIdType cell = 0; cell < data->GetNumberOfCells(); ++cell)
  {
    if (segments.count(static_cast<int>(owners->GetTuple1(cell))) > 0)
    {
      cells.push_back(cell);
    }
  }
  return cells;
}
}

//------------------------------------------------------------------------------
vtkNew<vtkUnstructuredGrid> CubesOf(
  vtkUnstructuredGrid* polycubes, const std::vector<vtkIdType>& cells)
{
  vtkNew<vtkUnstructuredGrid> cubes;
  cubes->SetPoints(polycubes->GetPoints());
  cubes->GetPointData()->ShallowCopy(polycubes->GetPointData());
  cubes->GetCellData()->CopyAllocate(polycubes->GetCellData());
  cubes->Allocate();
  for (const vtkIdType cell : cells)
  {
    vtkNew<vtkIdList> points;
    polycubes->GetCellPoints(cell, points);
    cubes->GetCellData()->CopyData(
      polycubes->GetCellData(), cell, cubes->InsertNextCell(polycubes->GetCellType(cell), points));
  }
  return cubes;
}

//------------------------------------------------------------------------------
vtkNew<vtkUnstructuredGrid> WithoutLayers(vtkUnstructuredGrid* polycubes)
{
  vtkDataArray* owners = polycubes->GetCellData()->GetArray("Segment");
  vtkDataArray* patches = polycubes->GetCellData()->GetArray("Patch");
  vtkDataArray* cornerIds = polycubes->GetPointData()->GetArray("CornerId");
  vtkDataArray* coordinates = polycubes->GetPointData()->GetArray("DomainCoordinates");
  const auto coordinatesOf = [coordinates](vtkIdType point)
  {
    std::array<double, 3> at;
    coordinates->GetTuple(point, at.data());
    return at;
  };
  // An inner corner has the coordinates of the one above it.
  std::map<double, std::map<std::array<double, 3>, vtkIdType>> cornerAt; // of each segment
  std::set<double> layered;
  std::vector<vtkIdType> cubes;
  vtkNew<vtkIdList> points;
  for (vtkIdType cell = 0; cell < polycubes->GetNumberOfCells(); ++cell)
  {
    if (patches->GetTuple1(cell) < 0.0)
    {
      cubes.push_back(cell);
      continue;
    }
    layered.insert(owners->GetTuple1(cell));
    polycubes->GetCellPoints(cell, points);
    for (const vtkIdType point : *points)
    {
      if (cornerIds->GetTuple1(point) >= 0.0)
      {
        cornerAt[owners->GetTuple1(cell)][coordinatesOf(point)] = point;
      }
    }
  }
  cubes.erase(std::remove_if(cubes.begin(), cubes.end(),
                [&](vtkIdType cell) { return layered.count(owners->GetTuple1(cell)) == 0; }),
    cubes.end());

  vtkNew<vtkUnstructuredGrid> alone = CubesOf(polycubes, cubes);
  for (vtkIdType cell = 0; cell < alone->GetNumberOfCells(); ++cell)
  {
    const double segment = alone->GetCellData()->GetArray("Segment")->GetTuple1(cell);
    const auto& corners = cornerAt.at(segment);
    alone->GetCellPoints(cell, points);
    for (vtkIdType& point : *points)
    {
      const auto above = corners.find(coordinatesOf(point));
      point = above == corners.end() ? point : above->second;
    }
    alone->GetCells()->ReplaceCellAtId(cell, points);
    // All of a segment are one group.
    const auto group = std::distance(layered.begin(), layered.find(segment));
    alone->GetCellData()->GetArray("Block")->SetTuple1(cell, static_cast<double>(group));
  }
  return alone;
}

//------------------------------------------------------------------------------
void LeaveOut(const std::set<int>& segments, vtkPolyData* patches, vtkUnstructuredGrid* polycubes)
{
  std::set<int> kept;
  vtkDataArray* owners = polycubes->GetCellData()->GetArray("Segment");
  for (vtkIdType cell = 0; cell < polycubes->GetNumberOfCells(); ++cell)
  {
    kept.insert(static_cast<int>(owners->GetTuple1(cell)));
  }
  for (const int segment : segments)
  {
    kept.erase(segment);
  }
  const std::vector<vtkIdType> cells = CellsOf(polycubes, kept);
  const std::vector<vtkIdType> triangles = CellsOf(patches, kept);
  if (static_cast<vtkIdType>(triangles.size()) == patches->GetNumberOfCells() &&
      static_cast<vtkIdType>(cells.size()) == polycubes->GetNumberOfCells())
  {
    return;
  }
  polycubes->ShallowCopy(CubesOf(polycubes, cells));
  vtkNew<vtkPolyData> theirs;
  theirs->SetPoints(patches->GetPoints());
  theirs->GetPointData()->ShallowCopy(patches->GetPointData());
  theirs->GetCellData()->CopyAllocate(patches->GetCellData());
  theirs->AllocateEstimate(patches->GetNumberOfCells(), 3);
  vtkNew<vtkIdList> points;
  for (const vtkIdType triangle : triangles)
  {
    patches->GetCellPoints(triangle, points);
    theirs->GetCellData()->CopyData(
      patches->GetCellData(), triangle, theirs->InsertNextCell(VTK_TRIANGLE, points));
  }
  vtkNew<vtkCleanPolyData> clean; // of points that no triangle has
  clean->PointMergingOff();
  clean->SetInputData(theirs);
  clean->Update();
  patches->ShallowCopy(clean->GetOutput());
}

//------------------------------------------------------------------------------
std::vector<std::string> LeaveOutInverted(vtkPolyData* patches, vtkUnstructuredGrid* polycubes)
{
  DomainBlocks blocks;
  for (vtkIdType p = 0; p < polycubes->GetNumberOfPoints(); ++p)
  {
    polycubes->GetPoint(p, blocks.Places.emplace_back().data());
  }
  vtkDataArray* owners = polycubes->GetCellData()->GetArray("Segment");
  const auto segmentOf = [owners](std::size_t block)
  { return static_cast<int>(owners->GetTuple1(static_cast<vtkIdType>(block))); };
  std::map<int, std::size_t> all, inverted; // blocks of each segment
  vtkNew<vtkIdList> points;
  for (vtkIdType cell = 0; cell < polycubes->GetNumberOfCells(); ++cell)
  {
    polycubes->GetCellPoints(cell, points);
    DomainBlock block{ {}, -1 };
    std::copy_n(points->begin(), 8, block.Points.begin());
    blocks.Blocks.push_back(block);
    ++all[segmentOf(cell)];
  }
  for (const std::size_t block : InvertedBlocks(blocks))
  {
    ++inverted[segmentOf(block)];
  }

  std::vector<std::string> why;
  std::set<int> unsound;
  for (const auto& [segment, count] : all)
  {
    if (2 * inverted[segment] < count)
    {
      continue;
    }
    unsound.insert(segment);
    why.push_back("Segment " + std::to_string(segment) + " is fitted over its bounding box: " +
                  std::to_string(inverted[segment]) + " of " + std::to_string(count) +
                  " blocks of its domain are inverted or flat between their corners.");
  }
  LeaveOut(unsound, patches, polycubes);
  return why;
}
}
