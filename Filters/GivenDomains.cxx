// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "GivenDomains.h"

#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkDataArray.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>
#include <string>

namespace trivariate
{
namespace
{
constexpr double SnapLimit = 0.1; // of the diagonal of a segment's surface

std::string NameOf(int segment)
{
  return "Segment " + std::to_string(segment) + " of the given domain";
}

//------------------------------------------------------------------------------
// Hexahedra of a lattice.
class Grid
{
public:
  explicit Grid(vtkUnstructuredGrid* grid)
    : Data(grid)
    , Segments(Needed(grid->GetCellData(), "Segment", 1))
    , Coordinates(Needed(grid->GetPointData(), "DomainCoordinates", 3))
    , Patches(grid->GetCellData()->GetArray("Patch"))
    , CornerIds(grid->GetPointData()->GetArray("CornerId"))
  {
  }

  int SegmentOf(vtkIdType cell) const
  {
    return static_cast<int>(this->Segments->GetComponent(cell, 0));
  }

  bool IsCube(vtkIdType cell) const
  {
    return !this->Patches || this->Patches->GetComponent(cell, 0) < 0.0;
  }

  bool IsCorner(vtkIdType point) const
  {
    return !this->CornerIds || this->CornerIds->GetComponent(point, 0) >= 0.0;
  }

  LatticePoint At(vtkIdType point) const
  {
    LatticePoint at;
    for (int a = 0; a < 3; ++a)
    {
      at[a] = static_cast<int>(this->Coordinates->GetComponent(point, a));
    }
    return at;
  }

  Eigen::Vector3d PlaceOf(vtkIdType point) const
  {
    return Eigen::Vector3d(this->Data->GetPoint(point));
  }

  vtkNew<vtkIdList> PointsOf(vtkIdType cell) const
  {
    vtkNew<vtkIdList> points;
    this->Data->GetCellPoints(cell, points);
    return points;
  }

  // The low corner of a cube.
  LatticePoint CubeAt(vtkIdType cell) const
  {
    const vtkNew<vtkIdList> points = this->PointsOf(cell);
    LatticePoint low = this->At(points->GetId(0)), high = low;
    std::set<LatticePoint> all;
    for (const vtkIdType point : *points)
    {
      const LatticePoint at = this->At(point);
      all.insert(at);
      for (int a = 0; a < 3; ++a)
      {
        low[a] = std::min(low[a], at[a]);
        high[a] = std::max(high[a], at[a]);
      }
    }
    const LatticePoint above{ low[0] + 1, low[1] + 1, low[2] + 1 };
    if (all.size() != 8 || high != above)
    {
      throw std::invalid_argument(
        "Cell " + std::to_string(cell) +
        " of the given domain is no cube of the lattice: its eight points "
        "need the DomainCoordinates of the corners of a unit cube.");
    }
    return low;
  }

private:
  static vtkDataArray* Needed(vtkDataSetAttributes* attributes, const char* name, int components)
  {
    vtkDataArray* array = attributes->GetArray(name);
    if (!array || array->GetNumberOfComponents() != components)
    {
      throw std::invalid_argument("The given domain has no array " + std::string(name) + " of " +
                                  std::to_string(components) +
                                  " component(s), as Polycube Domain writes it.");
    }
    return array;
  }

  vtkUnstructuredGrid* Data;
  vtkDataArray *Segments, *Coordinates, *Patches, *CornerIds;
};

//------------------------------------------------------------------------------
GivenDomain ReadSegment(const Grid& grid, int segment, const std::vector<vtkIdType>& cells)
{
  std::vector<LatticePoint> cubes;
  std::map<LatticePoint, vtkIdType> corners;
  for (const vtkIdType cell : cells)
  {
    if (grid.IsCube(cell))
    {
      cubes.push_back(grid.CubeAt(cell));
    }
    const vtkNew<vtkIdList> points = grid.PointsOf(cell);
    for (const vtkIdType point : *points)
    {
      const LatticePoint at = grid.At(point);
      if (grid.IsCorner(point) && corners.emplace(at, point).first->second != point)
      {
        throw std::invalid_argument("The corner at " + trivariate::NameOf(at) + " is there twice.");
      }
    }
  }
  if (cubes.empty())
  {
    throw std::invalid_argument(
      "It has blocks along its surface, but no cubes; a shell cannot be given.");
  }
  const bool layered = cubes.size() < cells.size();
  GivenDomain domain{ segment, Polycube(std::move(cubes)), {}, layered };
  for (Index i = 0; i < domain.Cubes.NumberOfCorners; ++i)
  {
    const auto found = corners.find(domain.Cubes.Points[i]);
    if (found == corners.end())
    {
      throw std::invalid_argument(
        "The corner at " + trivariate::NameOf(domain.Cubes.Points[i]) + " has no place.");
    }
    domain.Corners.push_back(grid.PlaceOf(found->second));
  }
  return domain;
}

//------------------------------------------------------------------------------
// Runs `work`; what it throws gets the name of the segment in front.
template <typename Work>
void For(int segment, const Work& work)
{
  try
  {
    work();
  }
  catch (const std::invalid_argument& error)
  {
    throw std::invalid_argument(NameOf(segment) + ": " + error.what());
  }
  catch (const std::runtime_error& error)
  {
    throw std::runtime_error(NameOf(segment) + ": " + error.what());
  }
}
}

//------------------------------------------------------------------------------
std::vector<GivenDomain> ReadGivenDomains(vtkUnstructuredGrid* grid)
{
  if (!grid)
  {
    throw std::invalid_argument("There is no domain: the second input is not connected.");
  }
  if (grid->GetNumberOfCells() == 0)
  {
    throw std::invalid_argument("The given domain has no cubes.");
  }
  const Grid cells(grid);
  std::map<int, std::vector<vtkIdType>> segments;
  for (vtkIdType cell = 0; cell < grid->GetNumberOfCells(); ++cell)
  {
    if (grid->GetCellType(cell) != VTK_HEXAHEDRON)
    {
      throw std::invalid_argument(
        "Cell " + std::to_string(cell) + " of the given domain is no hexahedron.");
    }
    segments[cells.SegmentOf(cell)].push_back(cell);
  }
  std::vector<GivenDomain> domains;
  for (const auto& [segment, own] : segments)
  {
    For(segment,
      [&, label = segment, &list = own]() { domains.push_back(ReadSegment(cells, label, list)); });
  }
  return domains;
}

//------------------------------------------------------------------------------
DomainSet LayOutGivenDomains(
  const LabelledSurface& surface, const std::vector<GivenDomain>& given, const Execution& execution)
{
  DomainSet set;
  const double share = 1.0 / static_cast<double>(given.size());
  for (std::size_t i = 0; i < given.size(); ++i)
  {
    const GivenDomain& domain = given[i];
    const double from = share * static_cast<double>(i);
    DomainSettings settings;
    settings.Layered = domain.Layered;
    For(domain.Segment,
      [&]()
      {
        AddDomainFromCorners(surface, domain.Segment, domain.Cubes, domain.Corners, SnapLimit,
          settings, execution.Part(from, from + share), set);
      });
  }
  return set;
}
}
