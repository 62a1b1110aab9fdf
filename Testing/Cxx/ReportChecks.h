// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// What tests of the report have in common.
#ifndef ReportChecks_h
#define ReportChecks_h

#include "SplineModels.h"
#include "vtkReconstructionReport.h"

#include "vtkAppendFilter.h"
#include "vtkImageData.h"
#include "vtkTable.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>

namespace trivariate
{
using Function = std::function<double(const double*)>;

template <typename ArrayT>
ArrayT* AddArray(vtkImageData* image, const char* name, const Function& f)
{
  vtkNew<ArrayT> array;
  array->SetName(name);
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    double x[3];
    image->GetPoint(i, x);
    array->InsertNextValue(static_cast<typename ArrayT::ValueType>(f(x)));
  }
  image->GetPointData()->AddArray(array);
  return array;
}

// The image with the spline's attributes at its points.
inline vtkNew<vtkImageData> Sampled(vtkUnstructuredGrid* grid, vtkImageData* lattice)
{
  vtkNew<vtkTSplineSource> source;
  source->SetInputData(grid);
  source->SetInputData(1, lattice);
  source->SetOutputType(vtkTSplineSource::IMAGE);
  source->Update();
  vtkNew<vtkImageData> image;
  image->ShallowCopy(source->GetOutput());
  return image;
}

// The lattice of the integers in the box of a spline with whole-numbered ends.
inline vtkNew<vtkImageData> Lattice(int nx, int ny, int nz)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(nx, ny, nz);
  return image;
}

inline vtkSmartPointer<vtkReconstructionReport> MakeReport(
  vtkImageData* image, const char* name, vtkUnstructuredGrid* grid)
{
  auto report = vtkSmartPointer<vtkReconstructionReport>::New();
  report->SetInputData(0, image);
  report->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, name);
  report->SetInputData(1, grid);
  return report;
}

inline double Cell(vtkReconstructionReport* report, vtkIdType row, const char* column)
{
  vtkTable* table = report->GetOutput();
  EXPECT_NE(table->GetColumnByName(column), nullptr) << column;
  return table->GetValueByName(row, column).ToDouble();
}

inline std::string DomainIn(vtkReconstructionReport* report, vtkIdType row)
{
  return report->GetOutput()->GetValueByName(row, "Domain").ToString();
}

// Two splines in one parameter space, the second one 100 further along u.
inline vtkSmartPointer<vtkUnstructuredGrid> Together(TSplineModel first, TSplineModel second)
{
  vtkNew<vtkAppendFilter> append;
  append->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  for (double& knot : second.Spline.KnotLines[0])
  {
    knot += 100.0;
  }
  second.Block.assign(second.Spline.Size(), 1);
  append->AddInputData(MakeGrid(first));
  append->AddInputData(MakeGrid(second));
  append->Update();
  return append->GetOutput();
}

inline TSplineModel Moved(TSplineModel model, double x, int segment)
{
  for (Index i = 0; i < model.Spline.Size(); ++i)
  {
    model.Spline.ControlPoint(i)[0] += x;
  }
  model.Segment.assign(model.Spline.Size(), segment);
  return model;
}
}

#endif
