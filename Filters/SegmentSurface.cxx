// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "SegmentSurface.h"

#include "vtkAppendPolyData.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkStaticCleanPolyData.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

namespace trivariate
{
namespace
{
// Of the surface's diagonal: single precision's rounding where pieces of a surface meet.
constexpr double SamePlace = 1e-6;

double VolumeOf(const std::vector<Eigen::Vector3d>& points, const std::vector<Triangle>& triangles)
{
  double volume = 0.0;
  for (const Triangle& c : triangles)
  {
    volume += points[c[0]].dot(points[c[1]].cross(points[c[2]])) / 6.0;
  }
  return volume;
}

vtkDataArray* LabelArray(vtkPolyData* input)
{
  vtkDataArray* labels = input->GetCellData()->GetArray("BoundaryLabels");
  if (labels && labels->GetNumberOfComponents() != 2)
  {
    throw std::invalid_argument("The array BoundaryLabels has " +
                                std::to_string(labels->GetNumberOfComponents()) +
                                " components; two are needed, the segments on both sides.");
  }
  return labels;
}

// Triangles and the points that they use, numbered anew.
SurfaceMesh MeshOf(
  const std::vector<Eigen::Vector3d>& points, const std::vector<Triangle>& triangles)
{
  std::vector<Index> number(points.size(), -1);
  std::vector<Eigen::Vector3d> used;
  std::vector<Triangle> renumbered = triangles;
  for (Triangle& triangle : renumbered)
  {
    for (Index& corner : triangle)
    {
      if (number[corner] < 0)
      {
        number[corner] = static_cast<Index>(used.size());
        used.push_back(points[corner]);
      }
      corner = number[corner];
    }
  }
  return SurfaceMesh(std::move(used), std::move(renumbered));
}

// 0 where it is not told, or is no size.
double VoxelOf(vtkPolyData* input)
{
  vtkDataArray* spacing = input->GetFieldData()->GetArray(VoxelSpacingName);
  if (!spacing || spacing->GetNumberOfComponents() != 3 || spacing->GetNumberOfTuples() != 1)
  {
    return 0.0;
  }
  double volume = 1.0;
  for (int a = 0; a < 3; ++a)
  {
    volume *= std::max(0.0, spacing->GetComponent(0, a));
  }
  return std::isfinite(volume) ? std::cbrt(volume) : 0.0;
}
}

//------------------------------------------------------------------------------
std::vector<Eigen::Vector3d> ReadPoints(vtkPointSet* input)
{
  std::vector<Eigen::Vector3d> points(input->GetNumberOfPoints());
  for (vtkIdType id = 0; id < input->GetNumberOfPoints(); ++id)
  {
    input->GetPoint(id, points[id].data());
    if (!points[id].allFinite())
    {
      throw std::invalid_argument("Point " + std::to_string(id) + " is not finite.");
    }
  }
  return points;
}

//------------------------------------------------------------------------------
std::vector<Triangle> ReadTriangles(vtkPolyData* input)
{
  const vtkIdType polygons = input->GetNumberOfPolys();
  if (polygons == 0)
  {
    throw std::invalid_argument("The surface has no triangles.");
  }
  if (input->GetNumberOfCells() != polygons ||
      input->GetPolys()->GetNumberOfConnectivityIds() != 3 * polygons ||
      input->GetPolys()->GetMaxCellSize() != 3)
  {
    throw std::invalid_argument(
      "The surface has cells other than triangles; make it triangles first (Triangulate).");
  }
  std::vector<Triangle> triangles;
  triangles.reserve(polygons);
  vtkCellArray* cells = input->GetPolys();
  for (vtkIdType cell = 0; cell < polygons; ++cell)
  {
    vtkIdType count = 0;
    const vtkIdType* ids = nullptr;
    cells->GetCellAtId(cell, count, ids);
    triangles.push_back({ ids[0], ids[1], ids[2] });
  }
  return triangles;
}

//------------------------------------------------------------------------------
LabelledSurface ReadSurface(vtkPolyData* input)
{
  LabelledSurface surface;
  surface.Triangles = ReadTriangles(input);
  surface.Points = ReadPoints(input);
  surface.Labels.assign(surface.Triangles.size(), { 1, 0 });
  surface.Voxel = VoxelOf(input);
  vtkDataArray* labels = LabelArray(input);
  for (std::size_t t = 0; labels && t < surface.Labels.size(); ++t)
  {
    const vtkIdType cell = static_cast<vtkIdType>(t);
    surface.Labels[t] = { static_cast<int>(labels->GetComponent(cell, 0)),
      static_cast<int>(labels->GetComponent(cell, 1)) };
  }
  if (!labels && VolumeOf(surface.Points, surface.Triangles) < 0.0)
  {
    for (Triangle& triangle : surface.Triangles)
    {
      std::swap(triangle[1], triangle[2]);
    }
  }
  return surface;
}

//------------------------------------------------------------------------------
std::vector<int> SegmentsIn(const LabelledSurface& surface)
{
  std::set<int> segments;
  for (const std::array<int, 2>& labels : surface.Labels)
  {
    segments.insert(labels.begin(), labels.end());
  }
  return std::vector<int>(segments.upper_bound(0), segments.end());
}

//------------------------------------------------------------------------------
std::vector<SurfacePiece> PiecesOf(const LabelledSurface& surface, int segment)
{
  std::vector<Triangle> triangles;
  std::vector<Index> origins;
  for (std::size_t t = 0; t < surface.Triangles.size(); ++t)
  {
    const auto& [inner, outer] = surface.Labels[t];
    if ((inner == segment) != (outer == segment))
    {
      Triangle triangle = surface.Triangles[t];
      if (outer == segment)
      {
        std::swap(triangle[1], triangle[2]);
      }
      triangles.push_back(triangle);
      origins.push_back(static_cast<Index>(t));
    }
  }
  if (triangles.empty())
  {
    std::string names;
    for (const int other : SegmentsIn(surface))
    {
      names += (names.empty() ? "" : ", ") + std::to_string(other);
    }
    throw std::invalid_argument("There is none such; the surface has: " + names + ".");
  }
  const SurfaceMesh whole = MeshOf(surface.Points, triangles);
  Index count = 0;
  const std::vector<Index> component = whole.Components(count);
  std::vector<std::vector<Triangle>> parts(count);
  std::vector<std::vector<Index>> partOrigins(count);
  for (std::size_t t = 0; t < triangles.size(); ++t)
  {
    parts[component[t]].push_back(triangles[t]);
    partOrigins[component[t]].push_back(origins[t]);
  }
  std::vector<SurfacePiece> pieces;
  for (Index part = 0; part < count; ++part)
  {
    pieces.push_back({ MeshOf(surface.Points, parts[part]), std::move(partOrigins[part]),
      VolumeOf(surface.Points, parts[part]) });
  }
  return pieces;
}

//------------------------------------------------------------------------------
void GatherSurface(vtkPolyData* input, vtkPolyData* whole, vtkMultiProcessController* controller)
{
  std::vector<vtkSmartPointer<vtkDataObject>> parts;
  controller->Gather(input, parts, 0);
  vtkNew<vtkAppendPolyData> append;
  vtkNew<vtkFieldData> fields; // which appending leaves out
  int filled = 0;
  for (vtkDataObject* part : parts)
  {
    vtkPolyData* surface = vtkPolyData::SafeDownCast(part);
    if (surface && surface->GetNumberOfPoints() > 0)
    {
      append->AddInputData(surface);
      fields->ShallowCopy(surface->GetFieldData());
      ++filled;
    }
  }
  if (filled == 0)
  {
    return;
  }
  append->Update();
  if (filled == 1)
  {
    whole->ShallowCopy(append->GetOutput());
    whole->SetFieldData(fields);
    return;
  }
  vtkNew<vtkStaticCleanPolyData> merge;
  merge->SetInputConnection(append->GetOutputPort());
  merge->SetTolerance(SamePlace);
  merge->Update();
  whole->ShallowCopy(merge->GetOutput());
  whole->SetFieldData(fields);
}
}
