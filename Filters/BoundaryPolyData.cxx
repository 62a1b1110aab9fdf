// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "BoundaryPolyData.h"

#include "LabelledImage.h"
#include "SMPExecution.h"
#include "SegmentSurface.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkIdTypeArray.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace trivariate
{
void BoundaryToPolyData(const SegmentBoundary& boundary, const LabelledImage& image,
  const std::vector<int>& wanted, vtkPolyData* output)
{
  const std::set<int> chosen(wanted.begin(), wanted.end());
  const auto isChosen = [&chosen](int segment)
  { return segment >= 0 && (chosen.empty() ? segment > 0 : chosen.count(segment) > 0); };
  const bool mirrored = image.IsMirrored();

  std::vector<Triangle> triangles;
  vtkNew<vtkIntArray> labels;
  labels->SetName("BoundaryLabels");
  labels->SetNumberOfComponents(2);
  std::vector<Index> number(boundary.Points.size(), -1);
  std::vector<Index> used;
  for (std::size_t t = 0; t < boundary.Triangles.size(); ++t)
  {
    const auto& [low, high] = boundary.Labels[t];
    if (!isChosen(low) && !isChosen(high))
    {
      continue;
    }
    const bool swap = isChosen(high) && (low <= 0 || !isChosen(low));
    Triangle triangle = boundary.Triangles[t];
    if (swap != mirrored)
    {
      std::swap(triangle[1], triangle[2]);
    }
    for (Index& v : triangle)
    {
      if (number[v] < 0)
      {
        number[v] = static_cast<Index>(used.size());
        used.push_back(v);
      }
      v = number[v];
    }
    triangles.push_back(triangle);
    const int pair[2] = { swap ? high : low, swap ? low : high };
    labels->InsertNextTypedTuple(pair);
  }

  const vtkIdType count = static_cast<vtkIdType>(used.size());
  std::vector<Point> places(count);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(count);
  vtkNew<vtkUnsignedCharArray> junction;
  junction->SetName("Junction");
  junction->SetNumberOfTuples(count);
  for (vtkIdType id = 0; id < count; ++id)
  {
    places[id] = image.ToPhysical(boundary.Points[used[id]]);
    points->SetPoint(id, places[id].data());
    junction->SetValue(id, boundary.Junctions[used[id]]);
  }
  vtkNew<vtkFloatArray> normals;
  normals->SetName("Normals");
  normals->SetNumberOfComponents(3);
  normals->SetNumberOfTuples(count);
  Execution execution;
  execution.ParallelFor = SMPParallelFor;
  const std::vector<Point> directions = PointNormals(places, triangles, execution);
  for (vtkIdType id = 0; id < count; ++id)
  {
    normals->SetTuple(id, directions[id].data());
  }

  vtkNew<vtkIdTypeArray> connectivity;
  connectivity->SetNumberOfValues(3 * static_cast<vtkIdType>(triangles.size()));
  vtkIdType* id = connectivity->GetPointer(0);
  for (const Triangle& triangle : triangles)
  {
    id = std::copy(triangle.begin(), triangle.end(), id);
  }
  vtkNew<vtkCellArray> cells;
  cells->SetData(3, connectivity);
  output->SetPoints(points);
  output->SetPolys(cells);
  output->GetCellData()->AddArray(labels);
  output->GetPointData()->SetNormals(normals);
  output->GetPointData()->AddArray(junction);

  vtkNew<vtkDoubleArray> spacing;
  spacing->SetName(VoxelSpacingName);
  spacing->SetNumberOfComponents(3);
  const auto& m = image.IndexToPhysical;
  spacing->InsertNextTuple3(
    std::hypot(m[0], m[4], m[8]), std::hypot(m[1], m[5], m[9]), std::hypot(m[2], m[6], m[10]));
  output->GetFieldData()->AddArray(spacing);
}
}
