// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ErrorLog.h"
#include "SplineModels.h"

#include "vtkDoubleArray.h"
#include "vtkImageData.h"
#include "vtkPolyData.h"
#include "vtkSMPTools.h"

#include <gtest/gtest.h>

#include <limits>

namespace
{
using namespace trivariate;

TEST(TSplineSource, OutputTypeFollowsAndThreadsDoNotMatter)
{
  const TSplineModel model = QuarterAnnulus(4, 6);
  auto source = MakeSource(model, vtkTSplineSource::IMAGE);
  source->SetDimensions(20, 20, 20);
  const int types[5] = { VTK_IMAGE_DATA, VTK_UNSTRUCTURED_GRID, VTK_UNSTRUCTURED_GRID,
    VTK_POLY_DATA, VTK_UNSTRUCTURED_GRID };
  for (int type = 0; type < 5; ++type)
  {
    source->SetOutputType(type);
    std::vector<double> expected;
    for (const int threads : { 1, 2, 5 })
    {
      vtkSMPTools::Initialize(threads);
      source->Modified();
      source->Update();
      ASSERT_EQ(source->GetOutput()->GetDataObjectType(), types[type]);
      vtkDataArray* array = PointArray(source->GetOutput(), "Radial");
      auto* radial = vtkDoubleArray::SafeDownCast(array);
      const std::vector<double> values(radial->Begin(), radial->End());
      if (expected.empty())
      {
        expected = values;
      }
      EXPECT_TRUE(values == expected);
    }
  }
  vtkSMPTools::Initialize(0);
}

TEST(TSplineSource, FunctionsLeftOutLeaveFiniteNumbers)
{
  // Half of the functions gone, as after a fit to some of the voxels: the denominator vanishes at
  // corners of cells that one function only just reaches.
  TSplineModel model = RandomBox({ 4, 4, 4 }, 0, 1);
  TSplineModel part = model;
  part.Spline.Functions.clear();
  part.Spline.Weights.clear();
  part.Spline.ControlPoints.clear();
  for (Index i = 0; i < model.Spline.Size(); ++i)
  {
    const double* p = model.Spline.ControlPoint(i);
    if (p[0] + p[1] + p[2] < 30.0)
    {
      part.Spline.Functions.push_back(model.Spline.Functions[i]);
      part.Spline.Weights.push_back(1.0);
      part.Spline.ControlPoints.insert(part.Spline.ControlPoints.end(), p, p + 4);
    }
  }
  FinishModel(part);
  for (const int type : { vtkTSplineSource::IMAGE, vtkTSplineSource::LINEAR_HEXES,
         vtkTSplineSource::BEZIER_HEXES, vtkTSplineSource::ISO_SURFACES })
  {
    auto source = MakeSource(part, type);
    ErrorLog errors(source);
    source->Update();
    EXPECT_EQ(errors.TakeOnly(), "0 errors");
    auto* data = vtkDataSet::SafeDownCast(source->GetOutput());
    ASSERT_GT(data->GetNumberOfPoints(), 0);
    vtkDataArray* value = PointArray(data, "Value");
    for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
    {
      ASSERT_TRUE(std::isfinite(value->GetTuple1(i))) << type;
      for (int a = 0; a < 3; ++a)
      {
        ASSERT_TRUE(std::isfinite(data->GetPoint(i)[a])) << type;
      }
    }
  }
}

TEST(TSplineSource, SaysWhatIsWrongOnce)
{
  const TSplineModel model = QuarterAnnulus();
  auto source = MakeSource(model, vtkTSplineSource::LINEAR_HEXES);
  ErrorLog errors(source);
  const auto expectError = [&source, &errors](const std::string& part)
  {
    source->Update();
    const std::string error = errors.TakeOnly();
    EXPECT_NE(error.find(part), std::string::npos) << error;
    auto* data = vtkDataSet::SafeDownCast(source->GetOutput());
    EXPECT_EQ(data->GetNumberOfPoints(), 0);
    EXPECT_EQ(data->GetPointData()->GetNumberOfArrays(), 0);
  };
  const auto setBroken = [&source, &model](const auto& breakIt)
  {
    auto grid = MakeGrid(model);
    breakIt(grid);
    source->SetInputData(grid);
  };

  setBroken([](vtkUnstructuredGrid* grid) { grid->Initialize(); });
  expectError("no ");
  setBroken([](vtkUnstructuredGrid* grid) { grid->GetPointData()->RemoveArray("KnotsV"); });
  expectError("KnotsV");
  setBroken([](vtkUnstructuredGrid* grid)
    { grid->GetPointData()->GetArray("Weight")->SetTuple1(3, -1.0); });
  expectError("eight");
  setBroken([](vtkUnstructuredGrid* grid)
    { grid->GetPoints()->SetPoint(5, std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0); });
  expectError("");
  source->SetInputData(MakeGrid(model));

  source->SetOutputType(vtkTSplineSource::POINTS);
  expectError("no second input");
  source->SetOutputType(vtkTSplineSource::IMAGE);
  vtkNew<vtkPolyData> cloud;
  source->SetInputData(1, cloud);
  expectError("vtkPolyData");
  source->SetInputConnection(1, nullptr);
  source->SetDimensions(5, 5, 1);
  expectError("1 points along an axis");
  source->SetDimensions(300000, 300000, 300000);
  expectError("memory");
  source->SetDimensions(4, 4, 4);
  source->SetOutputType(vtkTSplineSource::ISO_SURFACES);
  source->AddSurfaceV(1.5);
  expectError("1.5");
  source->SetOutputType(vtkTSplineSource::IMAGE);
  source->Update();
  EXPECT_EQ(errors.TakeOnly(), "0 errors");
  EXPECT_EQ(vtkDataSet::SafeDownCast(source->GetOutput())->GetNumberOfPoints(), 64);
}

TEST(TSplineSource, StopsWhenAsked)
{
  auto source = MakeSource(QuarterAnnulus(4, 6), vtkTSplineSource::LINEAR_HEXES);
  vtkNew<vtkCallbackCommand> abort;
  abort->SetCallback([](vtkObject* caller, unsigned long, void*, void*)
    { static_cast<vtkAlgorithm*>(caller)->SetAbortExecute(true); });
  source->AddObserver(vtkCommand::ProgressEvent, abort);
  source->Update();
  EXPECT_EQ(vtkDataSet::SafeDownCast(source->GetOutput())->GetNumberOfPoints(), 0);
}
}
