// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "LatticeSurface.h"

#include "Domain/SurfaceMesh.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>
#include <string>

namespace trivariate
{
namespace
{
// The plane of a patch; its axis is the one that DomainInput names.
LatticePlane PlaneOf(const DomainInput& input, Index patch)
{
  const int axis = input.PatchPlanes[patch][0];
  std::set<int> coordinates;
  for (const Index corner : input.Domain.Patches[patch].Corners)
  {
    coordinates.insert(input.Coordinates[corner][axis]);
  }
  if (coordinates.size() != 1)
  {
    throw std::invalid_argument("The corners of patch " + std::to_string(input.PatchIds[patch]) +
                                " do not have one DomainCoordinate along " + "uvw"[axis] +
                                "; patches and polycube come from one Polycube Domain.");
  }
  return { axis, *coordinates.begin() };
}

// Borders between two patches of one axis: there the third one is constant, too.
void AddLines(
  const DomainInput& input, const std::map<Index, LatticePlane>& planes, ParameterSurface& surface)
{
  std::map<std::pair<Index, Index>, Index> patchAt; // by the corners of a border
  for (const auto& [patch, plane] : planes)
  {
    const BlockPatch& disc = input.Domain.Patches[patch];
    const int axis = plane.Axis;
    for (int k = 0; k < 4; ++k)
    {
      const Index from = disc.Corners[k], to = disc.Corners[(k + 1) % 4];
      const auto [other, fresh] = patchAt.emplace(std::minmax(from, to), patch);
      if (fresh || planes.at(other->second).Axis != axis)
      {
        continue;
      }
      const LatticePoint &p = input.Coordinates[from], &q = input.Coordinates[to];
      for (int third = 0; third < 3; ++third)
      {
        if (third != axis && p[third] == q[third])
        {
          const std::vector<Index>& points = disc.Sides[k];
          for (std::size_t i = 0; i + 1 < points.size(); ++i)
          {
            surface.Lines.push_back({ points[i], points[i + 1] });
            surface.LinePlanes.push_back({ third, p[third] });
          }
        }
      }
    }
  }
}

// Leaves out the points that no triangle has.
void DropPoints(ParameterSurface& surface)
{
  std::vector<Index> numbers(surface.Points.size(), -1);
  std::vector<Eigen::Vector3d> points;
  const auto renumber = [&](Index& point)
  {
    if (numbers[point] < 0)
    {
      numbers[point] = static_cast<Index>(points.size());
      points.push_back(surface.Points[point]);
    }
    point = numbers[point];
  };
  for (Triangle& triangle : surface.Triangles)
  {
    std::for_each(triangle.begin(), triangle.end(), renumber);
  }
  for (std::array<Index, 2>& line : surface.Lines)
  {
    std::for_each(line.begin(), line.end(), renumber);
  }
  surface.Points = std::move(points);
}
}

//------------------------------------------------------------------------------
ParameterSurface LatticeSurfaceOf(
  vtkPolyData* patches, const DomainInput& input, int segment, const GridSpace& space)
{
  ParameterSurface surface;
  for (const Eigen::Vector3d& point : input.Domain.SurfacePoints)
  {
    surface.Points.push_back(space.FromSpace(point));
  }
  std::map<int, Index> patchOfId;
  for (std::size_t p = 0; p < input.PatchIds.size(); ++p)
  {
    patchOfId[input.PatchIds[p]] = static_cast<Index>(p);
  }
  vtkDataArray* patch = patches->GetCellData()->GetArray("Patch");
  vtkDataArray* owner = patches->GetCellData()->GetArray("Segment");
  std::map<Index, LatticePlane> planes;
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < patches->GetNumberOfCells(); ++cell)
  {
    if (static_cast<int>(owner->GetComponent(cell, 0)) != segment)
    {
      continue;
    }
    const Index number = patchOfId.at(static_cast<int>(patch->GetComponent(cell, 0)));
    if (planes.count(number) == 0)
    {
      planes[number] = PlaneOf(input, number);
    }
    patches->GetCellPoints(cell, ids);
    Triangle triangle = { ids->GetId(0), ids->GetId(1), ids->GetId(2) };
    if (space.IsMirrored())
    {
      std::swap(triangle[1], triangle[2]);
    }
    surface.Triangles.push_back(triangle);
    surface.Planes.push_back(planes[number]);
  }
  AddLines(input, planes, surface);
  DropPoints(surface);
  Index pieces = 0;
  SurfaceMesh(surface.Points, surface.Triangles).Components(pieces);
  return pieces == 1 ? surface : ParameterSurface();
}
}
