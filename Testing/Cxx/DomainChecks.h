// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// Surfaces for tests of vtkPolycubeDomain, and what all of its outputs must be.
#ifndef DomainChecks_h
#define DomainChecks_h

#include "ErrorLog.h"
#include "vtkPolycubeDomain.h"
#include "vtkSegmentBoundary.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkIdList.h"
#include "vtkImageData.h"
#include "vtkIntArray.h"
#include "vtkMath.h"
#include "vtkMeshQuality.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <string>

namespace trivariate_testing
{
using Label = std::function<int(const double*)>;
using Place = std::array<double, 3>;

// The surfaces of the segments of an image of (2 n + 1)^3 voxels around the origin.
inline vtkNew<vtkPolyData> SurfaceOf(int n, const Label& label)
{
  vtkNew<vtkImageData> image;
  image->SetExtent(-n, n, -n, n, -n, n);
  vtkNew<vtkIntArray> labels;
  labels->SetName("Segment");
  for (vtkIdType id = 0; id < image->GetNumberOfPoints(); ++id)
  {
    labels->InsertNextValue(label(image->GetPoint(id)));
  }
  image->GetPointData()->AddArray(labels);
  vtkNew<vtkSegmentBoundary> boundary;
  boundary->SetInputData(image);
  boundary->UseDensityOff();
  boundary->Update();
  vtkNew<vtkPolyData> surface;
  surface->ShallowCopy(boundary->GetOutput());
  return surface;
}

inline vtkNew<vtkPolyData> Ball(double radius = 8.0)
{
  return SurfaceOf(11, [radius](const double* p) { return vtkMath::Norm(p) < radius ? 1 : 0; });
}

inline int BoxLabel(const double* p, double a, double b, double c)
{
  return std::abs(p[0]) < a && std::abs(p[1]) < b && std::abs(p[2]) < c;
}

inline vtkDataArray* CellArray(vtkDataSet* data, const char* name)
{
  return data->GetCellData()->GetArray(name);
}

inline std::set<int> ValuesOf(vtkDataArray* array)
{
  std::set<int> values;
  for (vtkIdType id = 0; id < array->GetNumberOfTuples(); ++id)
  {
    values.insert(static_cast<int>(array->GetComponent(id, 0)));
  }
  return values;
}

inline double LeastJacobian(vtkUnstructuredGrid* blocks)
{
  vtkNew<vtkMeshQuality> quality;
  quality->SetInputData(blocks);
  quality->SetHexQualityMeasureToScaledJacobian();
  quality->Update();
  return quality->GetOutput()->GetCellData()->GetArray("Quality")->GetRange()[0];
}

// The volume inside of the surface of one segment.
inline double VolumeOf(vtkPolyData* surface, int segment)
{
  vtkNew<vtkIdList> ids;
  double volume = 0.0;
  for (vtkIdType cell = 0; cell < surface->GetNumberOfCells(); ++cell)
  {
    double x[3][3], cross[3];
    surface->GetCellPoints(cell, ids);
    for (int i = 0; i < 3; ++i)
    {
      surface->GetPoint(ids->GetId(i), x[i]);
    }
    vtkMath::Cross(x[1], x[2], cross);
    vtkDataArray* labels = CellArray(surface, "BoundaryLabels");
    const int sign =
      (labels->GetComponent(cell, 0) == segment) - (labels->GetComponent(cell, 1) == segment);
    volume += sign * vtkMath::Dot(x[0], cross) / 6.0;
  }
  return volume;
}

// The patches of each segment make a closed surface around the volume that it had; each patch is a
// disc with one axis and side; names of corners agree in all three outputs.
inline void ExpectSound(
  vtkPolycubeDomain* domain, vtkPolyData* surface, const std::set<int>& segments)
{
  vtkPolyData* patches = domain->GetPatches();
  vtkUnstructuredGrid* blocks = domain->GetPolycube();
  vtkPolyData* borders = domain->GetBorders();
  EXPECT_NE(vtkIntArray::SafeDownCast(CellArray(patches, "Patch")), nullptr);
  EXPECT_NE(vtkSignedCharArray::SafeDownCast(CellArray(patches, "PatchAxis")), nullptr);
  EXPECT_NE(vtkSignedCharArray::SafeDownCast(CellArray(patches, "PatchSide")), nullptr);
  std::map<int, double> found;
  std::map<std::array<vtkIdType, 3>, int> edges; // segment, from, to
  std::map<std::array<int, 2>, std::set<vtkIdType>> points, sides;
  std::map<std::array<int, 2>, std::set<std::array<vtkIdType, 2>>> patchEdges;
  std::map<std::array<int, 2>, int> triangles;
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < patches->GetNumberOfCells(); ++cell)
  {
    const int segment = static_cast<int>(CellArray(patches, "Segment")->GetComponent(cell, 0));
    const int patch = static_cast<int>(CellArray(patches, "Patch")->GetComponent(cell, 0));
    EXPECT_EQ(CellArray(patches, "BoundaryLabels")->GetComponent(cell, 0), segment);
    sides[{ segment, patch }].insert(
      static_cast<vtkIdType>(2 * CellArray(patches, "PatchAxis")->GetComponent(cell, 0) +
                             CellArray(patches, "PatchSide")->GetComponent(cell, 0)));
    patches->GetCellPoints(cell, ids);
    double x[3][3], cross[3];
    for (int i = 0; i < 3; ++i)
    {
      const vtkIdType from = ids->GetId(i), to = ids->GetId((i + 1) % 3);
      patches->GetPoint(from, x[i]);
      ++edges[{ segment, from, to }];
      points[{ segment, patch }].insert(from);
      patchEdges[{ segment, patch }].insert({ std::min(from, to), std::max(from, to) });
    }
    ++triangles[{ segment, patch }];
    vtkMath::Cross(x[1], x[2], cross);
    found[segment] += vtkMath::Dot(x[0], cross) / 6.0;
  }
  for (const auto& [edge, count] : edges)
  {
    ASSERT_EQ(count, 1);
    ASSERT_EQ(edges.count({ edge[0], edge[2], edge[1] }), 1u);
  }
  for (const auto& [patch, used] : points)
  {
    EXPECT_EQ(long(used.size()) - long(patchEdges[patch].size()) + triangles[patch], 1);
    EXPECT_EQ(sides[patch].size(), 1u);
  }
  ASSERT_EQ(found.size(), segments.size());
  for (const int segment : segments)
  {
    EXPECT_NEAR(found[segment] / VolumeOf(surface, segment), 1.0, 1e-9) << segment;
  }

  std::map<int, Place> corners;
  for (vtkIdType id = 0; id < blocks->GetNumberOfPoints(); ++id)
  {
    const int corner =
      static_cast<int>(blocks->GetPointData()->GetArray("CornerId")->GetComponent(id, 0));
    if (corner >= 0)
    {
      const double* p = blocks->GetPoint(id);
      EXPECT_TRUE(corners.insert({ corner, { p[0], p[1], p[2] } }).second);
    }
  }
  vtkPolyData* const outputs[] = { patches, borders };
  for (vtkPolyData* output : outputs)
  {
    std::size_t named = 0;
    for (vtkIdType id = 0; id < output->GetNumberOfPoints(); ++id)
    {
      const int corner =
        static_cast<int>(output->GetPointData()->GetArray("CornerId")->GetComponent(id, 0));
      if (corner >= 0)
      {
        const double* p = output->GetPoint(id);
        EXPECT_EQ(corners.at(corner), (Place{ p[0], p[1], p[2] }));
        ++named;
      }
    }
    EXPECT_EQ(named, corners.size());
  }
  for (vtkIdType cell = 0; cell < borders->GetNumberOfCells(); ++cell)
  {
    borders->GetCellPoints(cell, ids);
    for (vtkIdType i = 0; i < ids->GetNumberOfIds(); ++i)
    {
      const bool end = i == 0 || i == ids->GetNumberOfIds() - 1;
      const double corner =
        borders->GetPointData()->GetArray("CornerId")->GetComponent(ids->GetId(i), 0);
      EXPECT_EQ(corner >= 0.0, end);
    }
  }
}

inline void ExpectFault(vtkPolycubeDomain* domain, ErrorLog& log, const std::string& text)
{
  domain->Modified();
  domain->Update();
  const std::string error = log.TakeOnly();
  EXPECT_NE(error.find(text), std::string::npos) << error << "\nis not\n" << text;
  EXPECT_EQ(domain->GetPatches()->GetNumberOfCells(), 0) << text;
  EXPECT_EQ(domain->GetPolycube()->GetNumberOfCells(), 0) << text;
}
}

#endif
