// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "SegmentPoints.h"

#include "TSpline/BezierMesh.h"
#include "TSpline/InverseMap.h"
#include "TSplinePoints.h"

#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <climits>
#include <stdexcept>
#include <string>
#include <vector>

namespace trivariate
{
namespace
{
constexpr const char* MaskName = "vtkValidPointMask";

// Some points of a data set as one of its own, which is evaluated in their place.
struct Selection
{
  vtkSmartPointer<vtkDataSet> Points;
  std::vector<vtkIdType> Ids; // of the points in the whole
  std::vector<vtkIdType> At;  // and in Points; empty: in order
};

Selection SelectPoints(vtkDataSet* whole, std::vector<vtkIdType> ids)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(static_cast<vtkIdType>(ids.size()));
  for (std::size_t i = 0; i < ids.size(); ++i)
  {
    double x[3];
    whole->GetPoint(ids[i], x);
    points->SetPoint(static_cast<vtkIdType>(i), x);
  }
  vtkNew<vtkPolyData> cloud;
  cloud->SetPoints(points);
  return { cloud.Get(), std::move(ids), {} };
}

// The box around the points: a lattice is evaluated far faster than points one by one.
Selection SelectBox(vtkImageData* whole, std::vector<vtkIdType> ids)
{
  int box[6] = { INT_MAX, INT_MIN, INT_MAX, INT_MIN, INT_MAX, INT_MIN };
  const auto indexOf = [whole](vtkIdType id)
  {
    const int* e = whole->GetExtent();
    const vtkIdType nx = e[1] - e[0] + 1, ny = e[3] - e[2] + 1;
    return std::array<int, 3>{ e[0] + static_cast<int>(id % nx),
      e[2] + static_cast<int>(id / nx % ny), e[4] + static_cast<int>(id / nx / ny) };
  };
  for (const vtkIdType id : ids)
  {
    const auto ijk = indexOf(id);
    for (int a = 0; a < 3; ++a)
    {
      box[2 * a] = std::min(box[2 * a], ijk[a]);
      box[2 * a + 1] = std::max(box[2 * a + 1], ijk[a]);
    }
  }
  vtkNew<vtkImageData> image;
  image->SetOrigin(whole->GetOrigin());
  image->SetSpacing(whole->GetSpacing());
  image->SetDirectionMatrix(whole->GetDirectionMatrix());
  image->SetExtent(box);
  Selection selection{ image.Get(), std::move(ids), {} };
  selection.At.reserve(selection.Ids.size());
  for (const vtkIdType id : selection.Ids)
  {
    auto ijk = indexOf(id);
    selection.At.push_back(image->ComputePointId(ijk.data()));
  }
  return selection;
}

//------------------------------------------------------------------------------
// Copies what was found at the selected points.
void Scatter(const Selection& selection, vtkDataSet* output)
{
  vtkPointData* from = selection.Points->GetPointData();
  vtkDataArray* mask = from->GetArray(MaskName);
  for (int a = 0; a < from->GetNumberOfArrays(); ++a)
  {
    vtkDataArray* source = from->GetArray(a);
    vtkDataArray* target = output->GetPointData()->GetArray(source->GetName());
    for (std::size_t i = 0; i < selection.Ids.size(); ++i)
    {
      const vtkIdType at = selection.At.empty() ? static_cast<vtkIdType>(i) : selection.At[i];
      if (mask->GetTuple1(at) != 0.0)
      {
        target->SetTuple(selection.Ids[i], at, source);
      }
    }
  }
}

//------------------------------------------------------------------------------
// Arrays of zeros for all points, like those of an empty set of points.
void AddZeros(const TSplineView& view, vtkDataSet* output, const Execution& execution)
{
  vtkNew<vtkPolyData> none;
  none->SetPoints(vtkNew<vtkPoints>());
  FillPoints(view, none, execution);
  vtkPointData* like = none->GetPointData();
  for (int a = 0; a < like->GetNumberOfArrays(); ++a)
  {
    const auto array = vtk::TakeSmartPointer(like->GetArray(a)->NewInstance());
    array->SetName(like->GetArray(a)->GetName());
    array->SetNumberOfComponents(like->GetArray(a)->GetNumberOfComponents());
    array->SetNumberOfTuples(output->GetNumberOfPoints());
    array->Fill(0.0);
    output->GetPointData()->AddArray(array);
  }
  if (like->GetScalars())
  {
    output->GetPointData()->SetActiveScalars(like->GetScalars()->GetName());
  }
}

void CheckLabels(vtkDataArray* labels, vtkDataSet* output)
{
  if (labels && labels->GetNumberOfTuples() != output->GetNumberOfPoints())
  {
    throw std::invalid_argument("The array \"" + std::string(labels->GetName()) + "\" has " +
                                std::to_string(labels->GetNumberOfTuples()) + " labels for " +
                                std::to_string(output->GetNumberOfPoints()) +
                                " points; it must be whole and on one process.");
  }
  if (labels && labels->GetNumberOfComponents() != 1)
  {
    throw std::invalid_argument("The array \"" + std::string(labels->GetName()) + "\" has " +
                                std::to_string(labels->GetNumberOfComponents()) +
                                " components; labels have one.");
  }
}
}

//------------------------------------------------------------------------------
double ReachIn(vtkDataSet* points)
{
  vtkImageData* image = vtkImageData::SafeDownCast(points);
  const double* spacing = image ? image->GetSpacing() : nullptr;
  return spacing ? LabelReach * *std::max_element(spacing, spacing + 3) : 0.0;
}

//------------------------------------------------------------------------------
bool GoBySegments(const TSplineModel& model, bool labelled)
{
  const std::vector<std::int32_t> segments = SegmentsOf(model);
  return segments.size() > 1 || (labelled && segments.front() != 0);
}

//------------------------------------------------------------------------------
void FillPointsOfSegments(
  const TSplineView& whole, vtkDataArray* labels, vtkDataSet* output, const Execution& execution)
{
  CheckLabels(labels, output);
  std::vector<std::int32_t> segments = SegmentsOf(whole.Model);
  std::reverse(segments.begin(), segments.end());
  for (std::size_t n = 0; n < segments.size(); ++n)
  {
    const Execution part = execution.Part(1.0 * n / segments.size(), (n + 1.0) / segments.size());
    const TSplineModel own = SegmentPart(whole.Model, segments[n]);
    const BezierMesh mesh(own.Spline, part.Part(0.0, 0.1));
    const TSplineView view{ own, mesh, whole.Gradients, whole.Jacobian,
      labels ? ReachIn(output) : 0.0 };
    if (n == 0)
    {
      AddZeros(view, output, part);
    }
    vtkDataArray* found = output->GetPointData()->GetArray(MaskName);
    std::vector<vtkIdType> ids;
    for (vtkIdType id = 0; id < output->GetNumberOfPoints(); ++id)
    {
      if (labels ? labels->GetTuple1(id) == segments[n] : found->GetTuple1(id) == 0.0)
      {
        ids.push_back(id);
      }
    }
    if (ids.empty())
    {
      continue;
    }
    vtkImageData* image = vtkImageData::SafeDownCast(output);
    const bool lattice = image && InverseMap(own.Spline, mesh, part.Part(0.1, 0.15)).Affine();
    const Selection selection =
      lattice ? SelectBox(image, std::move(ids)) : SelectPoints(output, std::move(ids));
    FillPoints(view, selection.Points, part.Part(0.15, 1.0));
    Scatter(selection, output);
  }
}
}
