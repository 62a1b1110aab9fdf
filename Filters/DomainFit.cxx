// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "DomainFit.h"

#include "ChainStep.h"
#include "SMPExecution.h"
#include "TSpline/BezierMesh.h"
#include "TSplineGrid.h"
#include "TSplinePoints.h"
#include "vtkFrameField.h"
#include "vtkPolycubeDomain.h"
#include "vtkSegmentBoundary.h"
#include "vtkTSplineFit.h"
#include "vtkVolumeParameterization.h"

#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkTable.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <stdexcept>

namespace trivariate
{
namespace
{
// Where the steps end, as shares of their progress.
constexpr double Bounded = 0.05, LaidOut = 0.2, Framed = 0.3, Parameterized = 0.6;
}

//------------------------------------------------------------------------------
FittedPart FitOverDomain(vtkImageData* image, int label, const SegmentFitOptions& options,
  vtkAlgorithm* chain, double from, double to)
{
  const auto run = [chain, from, to](vtkAlgorithm* algorithm, double begin, double end)
  { ChainStep(algorithm, chain, from + (to - from) * begin, from + (to - from) * end).Run(); };
  vtkNew<vtkSegmentBoundary> boundary;
  boundary->SetController(nullptr);
  boundary->SetInputData(image);
  boundary->AddSegment(label);
  run(boundary, 0.0, Bounded);

  vtkNew<vtkPolycubeDomain> domain;
  domain->SetController(nullptr);
  domain->SetInputData(boundary->GetOutput());
  domain->AddSegment(label);
  run(domain, Bounded, LaidOut);

  vtkNew<vtkFrameField> frames;
  frames->SetController(nullptr);
  frames->SetInputData(0, image);
  frames->SetInputData(1, domain->GetPatches());
  frames->AddSegment(label);
  run(frames, LaidOut, Framed);

  vtkNew<vtkVolumeParameterization> parameters;
  parameters->SetController(nullptr);
  parameters->SetInputData(0, frames->GetOutputDataObject(0));
  parameters->SetInputData(1, domain->GetPatches());
  parameters->SetInputData(2, domain->GetPolycube());
  run(parameters, Framed, Parameterized);
  vtkDataObject* parameterized = parameters->GetOutputDataObject(0);
  vtkDataArray* inverted = parameterized->GetFieldData()->GetArray("InvertedCells");
  if (inverted && inverted->GetComponent(0, 1) > 0.0) // in the end
  {
    throw std::runtime_error("Its block mesh has folds.");
  }

  vtkNew<vtkTSplineFit> fit;
  fit->SetController(nullptr);
  fit->SetInputData(0, parameterized);
  fit->SetInputData(1, parameters->GetPolycube());
  fit->SetInputData(2, parameters->GetBlocks());
  fit->SetInputArrayToProcess(
    0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, options.Array.c_str());
  for (const std::string& name : options.Further)
  {
    fit->AddAttribute(name.c_str());
  }
  fit->SetMaximumNumberOfControlPoints(options.MaximumControlPoints);
  fit->SetRMSTolerance(options.RmsTolerance);
  run(fit, Parameterized, 1.0);
  FittedPart part;
  part.Model = TSplineFromGrid(fit->GetOutput());
  part.Model.Segment.assign(part.Model.Spline.Size(), label);
  part.Rounds = vtkTable::SafeDownCast(fit->GetOutputDataObject(1));
  return part;
}

//------------------------------------------------------------------------------
PartErrors MeasurePart(vtkImageData* image, const std::string& array, const TSplineModel& model,
  const std::vector<vtkIdType>& voxels, vtkAlgorithm* chain, double from, double to)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(static_cast<vtkIdType>(voxels.size()));
  for (std::size_t i = 0; i < voxels.size(); ++i)
  {
    points->SetPoint(static_cast<vtkIdType>(i), image->GetPoint(voxels[i]));
  }
  vtkNew<vtkPolyData> cloud;
  cloud->SetPoints(points);
  const Execution execution = SMPExecution(chain, from, to);
  const BezierMesh mesh(model.Spline, execution.Part(0.0, 0.1));
  FillPoints({ model, mesh, false, false }, cloud, execution.Part(0.1, 1.0));
  vtkDataArray* wanted = image->GetPointData()->GetArray(array.c_str());
  vtkDataArray* values = cloud->GetPointData()->GetArray(array.c_str());
  vtkDataArray* found = cloud->GetPointData()->GetArray("vtkValidPointMask");
  PartErrors errors;
  for (std::size_t i = 0; i < voxels.size(); ++i)
  {
    if (found->GetTuple1(static_cast<vtkIdType>(i)) == 0.0)
    {
      errors.Missed.push_back(voxels[i]);
      continue;
    }
    const double error =
      values->GetComponent(static_cast<vtkIdType>(i), 0) - wanted->GetComponent(voxels[i], 0);
    errors.Squares += error * error;
  }
  return errors;
}
}
