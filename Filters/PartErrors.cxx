// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "PartErrors.h"

#include "ChainStep.h"
#include "SMPExecution.h"
#include "SegmentPoints.h"
#include "TSpline/BezierMesh.h"
#include "TSplinePoints.h"

#include "vtkDataArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace trivariate
{
//------------------------------------------------------------------------------
PartErrors MeasurePart(const SegmentedImage& image, const TSplineModel& model,
  const std::vector<vtkIdType>& voxels, Chain& chain, double from, double to)
{
  const auto count = static_cast<vtkIdType>(voxels.size());
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(count);
  for (vtkIdType i = 0; i < count; ++i)
  {
    points->SetPoint(i, image.Image->GetPoint(voxels[i]));
  }
  vtkNew<vtkPolyData> cloud;
  cloud->SetPoints(points);
  const Execution execution = SMPExecution(chain.Filter, from, to);
  const BezierMesh mesh(model.Spline, execution.Part(0.0, 0.1));
  FillPoints({ model, mesh, false, false, ReachIn(image.Image) }, cloud, execution.Part(0.1, 1.0));
  vtkDataArray* found = cloud->GetPointData()->GetArray("vtkValidPointMask");
  PartErrors errors;
  for (vtkIdType i = 0; i < count; ++i)
  {
    if (found->GetTuple1(i) == 0.0)
    {
      errors.Missed.push_back(voxels[i]);
    }
  }
  for (const std::string& name : image.Arrays)
  {
    vtkDataArray* wanted = image.Image->GetPointData()->GetArray(name.c_str());
    vtkDataArray* values = cloud->GetPointData()->GetArray(name.c_str());
    double most = 0.0;
    for (int component = 0; component < wanted->GetNumberOfComponents(); ++component)
    {
      double squares = 0.0;
      for (vtkIdType i = 0; i < count; ++i)
      {
        const double error =
          values->GetComponent(i, component) - wanted->GetComponent(voxels[i], component);
        squares += found->GetTuple1(i) == 0.0 ? 0.0 : error * error;
      }
      most = std::max(most, squares);
    }
    errors.Squares.push_back(most);
  }
  return errors;
}

//------------------------------------------------------------------------------
double WorstRms(
  const SegmentedImage& image, const std::vector<TSplineModel>& models, Chain& chain, double at)
{
  std::vector<std::vector<vtkIdType>> voxels(models.size());
  for (std::size_t voxel = 0; voxel < image.PartOf.size(); ++voxel)
  {
    voxels[image.PartOf[voxel]].push_back(static_cast<vtkIdType>(voxel));
  }
  std::vector<double> squares(image.Arrays.size(), 0.0);
  auto found = static_cast<double>(image.PartOf.size());
  for (std::size_t part = 0; part < models.size(); ++part)
  {
    const PartErrors errors = MeasurePart(image, models[part], voxels[part], chain, at, at);
    std::transform(
      squares.begin(), squares.end(), errors.Squares.begin(), squares.begin(), std::plus<double>());
    found -= static_cast<double>(errors.Missed.size());
  }
  const std::vector<double> ranges = image.WholeRanges();
  double worst = 0.0;
  for (std::size_t array = 0; array < ranges.size(); ++array)
  {
    worst = ranges[array] > 0.0
              ? std::max(worst, 100.0 * std::sqrt(squares[array] / found) / ranges[array])
              : worst;
  }
  return worst;
}
}
