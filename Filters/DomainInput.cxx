// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "DomainInput.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkDataArray.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkUnstructuredGrid.h"

#include <map>
#include <stdexcept>
#include <string>

namespace trivariate
{
namespace
{
// An array of whole numbers, checked.
class Numbers
{
public:
  Numbers(vtkDataSetAttributes* attributes, const char* name, int components, const char* where)
    : Array(attributes->GetArray(name))
  {
    if (!this->Array || this->Array->GetNumberOfComponents() != components)
    {
      throw std::invalid_argument("The " + std::string(where) + " have no array " + name + " of " +
                                  std::to_string(components) +
                                  " component(s); they come from Polycube Domain.");
    }
  }

  int operator()(vtkIdType id, int component = 0) const
  {
    return static_cast<int>(this->Array->GetComponent(id, component));
  }

private:
  vtkDataArray* Array;
};

std::vector<Eigen::Vector3d> PointsOf(vtkPointSet* data)
{
  std::vector<Eigen::Vector3d> points(data->GetNumberOfPoints());
  for (std::size_t p = 0; p < points.size(); ++p)
  {
    data->GetPoint(static_cast<vtkIdType>(p), points[p].data());
  }
  return points;
}

void ReadBlocks(vtkUnstructuredGrid* polycube, DomainParts& parts, std::vector<int>& groups)
{
  const Numbers segment(polycube->GetCellData(), "Segment", 1, "cells of the polycube");
  const Numbers group(polycube->GetCellData(), "Block", 1, "cells of the polycube");
  parts.Points = PointsOf(polycube);
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < polycube->GetNumberOfCells(); ++cell)
  {
    if (polycube->GetCellType(cell) != VTK_HEXAHEDRON)
    {
      throw std::invalid_argument(
        "Cell " + std::to_string(cell) + " of the polycube is no hexahedron.");
    }
    polycube->GetCellPoints(cell, ids);
    BlockPoints& block = parts.Blocks.emplace_back();
    for (int i = 0; i < 8; ++i)
    {
      block[i] = ids->GetId(i);
    }
    parts.Segments.push_back(segment(cell));
    groups.push_back(group(cell));
  }
}
}

//------------------------------------------------------------------------------
DomainInput ReadDomain(vtkPolyData* patches, vtkUnstructuredGrid* polycube)
{
  DomainParts parts;
  std::vector<int> groups;
  ReadBlocks(polycube, parts, groups);
  const Numbers coordinate(
    polycube->GetPointData(), "DomainCoordinates", 3, "points of the polycube");
  const Numbers cornerOfPoint(polycube->GetPointData(), "CornerId", 1, "points of the polycube");
  std::vector<LatticePoint> coordinates;
  std::map<int, Index> pointOfCorner;
  for (vtkIdType p = 0; p < polycube->GetNumberOfPoints(); ++p)
  {
    coordinates.push_back({ coordinate(p, 0), coordinate(p, 1), coordinate(p, 2) });
    if (cornerOfPoint(p) >= 0)
    {
      pointOfCorner[cornerOfPoint(p)] = p;
    }
  }

  const Numbers corner(patches->GetPointData(), "CornerId", 1, "points of the patches");
  parts.SurfacePoints = PointsOf(patches);
  vtkDataArray* parameter = patches->GetPointData()->GetArray("Parameter");
  if (parameter && parameter->GetNumberOfComponents() == 3)
  {
    parts.Parameters.resize(parts.SurfacePoints.size());
    for (vtkIdType p = 0; p < patches->GetNumberOfPoints(); ++p)
    {
      parameter->GetTuple(p, parts.Parameters[p].data());
    }
  }
  for (vtkIdType p = 0; p < patches->GetNumberOfPoints(); ++p)
  {
    const auto found = pointOfCorner.find(corner(p));
    parts.CornerOf.push_back(found == pointOfCorner.end() ? -1 : found->second);
  }

  const Numbers patch(patches->GetCellData(), "Patch", 1, "triangles of the patches");
  const Numbers axis(patches->GetCellData(), "PatchAxis", 1, "triangles of the patches");
  const Numbers side(patches->GetCellData(), "PatchSide", 1, "triangles of the patches");
  const Numbers owner(patches->GetCellData(), "Segment", 1, "triangles of the patches");
  std::map<int, std::pair<Index, int>> numberAndOwner;
  std::vector<int> patchIds;
  std::vector<std::array<int, 2>> planes;
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < patches->GetNumberOfCells(); ++cell)
  {
    patches->GetCellPoints(cell, ids);
    if (ids->GetNumberOfIds() != 3)
    {
      throw std::invalid_argument(
        "Cell " + std::to_string(cell) + " of the patches is no triangle.");
    }
    const auto [found, added] = numberAndOwner.emplace(
      patch(cell), std::make_pair(static_cast<Index>(patchIds.size()), owner(cell)));
    if (added)
    {
      patchIds.push_back(patch(cell));
      planes.push_back({ axis(cell), side(cell) });
    }
    if (found->second.second == owner(cell))
    {
      parts.Triangles.push_back({ ids->GetId(0), ids->GetId(1), ids->GetId(2) });
      parts.PatchOf.push_back(found->second.first);
    }
  }
  return { BlockDomain(std::move(parts)), std::move(groups), std::move(coordinates),
    std::move(patchIds), std::move(planes) };
}
}
