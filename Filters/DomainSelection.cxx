// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "DomainSelection.h"

#include "Domain/InnerCorners.h"

#include "vtkCellData.h"
#include "vtkCleanPolyData.h"
#include "vtkDataArray.h"
#include "vtkIdList.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <map>
#include <set>

namespace trivariate
{
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
std::vector<std::string> LeaveOutInverted(vtkPolyData* patches, vtkUnstructuredGrid* polycubes)
{
  DomainBlocks all;
  for (vtkIdType p = 0; p < polycubes->GetNumberOfPoints(); ++p)
  {
    polycubes->GetPoint(p, all.Places.emplace_back().data());
  }
  std::map<int, DomainBlocks> blocksOf;
  vtkDataArray* owners = polycubes->GetCellData()->GetArray("Segment");
  for (vtkIdType cell = 0; cell < polycubes->GetNumberOfCells(); ++cell)
  {
    vtkNew<vtkIdList> points;
    polycubes->GetCellPoints(cell, points);
    DomainBlock block{ {}, -1 };
    std::copy_n(points->begin(), 8, block.Points.begin());
    DomainBlocks& blocks = blocksOf[static_cast<int>(owners->GetTuple1(cell))];
    blocks.Blocks.push_back(block);
  }

  std::vector<std::string> why;
  std::set<int> out;
  for (auto& [segment, blocks] : blocksOf)
  {
    blocks.Places = all.Places;
    const std::size_t inverted = InvertedBlocks(blocks).size();
    if (2 * inverted >= blocks.Blocks.size())
    {
      out.insert(segment);
      why.push_back("Segment " + std::to_string(segment) + " is fitted over its bounding box: " +
                    std::to_string(inverted) + " of " + std::to_string(blocks.Blocks.size()) +
                    " blocks of its domain are inverted or flat between their corners.");
    }
  }
  if (out.empty())
  {
    return why;
  }
  std::vector<vtkIdType> cells;
  for (vtkIdType cell = 0; cell < polycubes->GetNumberOfCells(); ++cell)
  {
    if (out.count(static_cast<int>(owners->GetTuple1(cell))) == 0)
    {
      cells.push_back(cell);
    }
  }
  polycubes->ShallowCopy(CubesOf(polycubes, cells));
  vtkNew<vtkPolyData> kept;
  kept->SetPoints(patches->GetPoints());
  kept->GetPointData()->ShallowCopy(patches->GetPointData());
  kept->GetCellData()->CopyAllocate(patches->GetCellData());
  kept->AllocateEstimate(patches->GetNumberOfCells(), 3);
  vtkDataArray* seenFrom = patches->GetCellData()->GetArray("Segment");
  for (vtkIdType cell = 0; cell < patches->GetNumberOfCells(); ++cell)
  {
    if (out.count(static_cast<int>(seenFrom->GetTuple1(cell))) == 0)
    {
      vtkNew<vtkIdList> points;
      patches->GetCellPoints(cell, points);
      kept->GetCellData()->CopyData(
        patches->GetCellData(), cell, kept->InsertNextCell(VTK_TRIANGLE, points));
    }
  }
  vtkNew<vtkCleanPolyData> clean; // of points that no triangle has
  clean->PointMergingOff();
  clean->SetInputData(kept);
  clean->Update();
  patches->ShallowCopy(clean->GetOutput());
  return why;
}
}
