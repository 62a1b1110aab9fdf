// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ErrorLog.h"
#include "vtkReconstructionReport.h"
#include "vtkTSplineFit.h"
#include "vtkTSplineReconstruction.h"
#include "vtkTSplineSource.h"

#include "vtkCallbackCommand.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSMPTools.h"
#include "vtkTable.h"
#include "vtkUnstructuredGrid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <set>

namespace
{
double Radius(const double* x)
{
  return std::hypot(x[0] - 11.0, 0.5 * x[1] - 12.0, x[2] - 10.5);
}

// A bright egg with a wave in it, in a dark air with a slope; labels 0 and 3.
vtkNew<vtkImageData> Phantom()
{
  vtkNew<vtkImageData> image;
  image->SetExtent(2, 25, -1, 24, 0, 22);
  image->SetOrigin(-2.0, 2.0, 0.0);
  image->SetSpacing(1.0, 2.0, 1.0);
  vtkNew<vtkFloatArray> density;
  density->SetName("Density");
  vtkNew<vtkIntArray> labels;
  labels->SetName("Material");
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    double x[3];
    image->GetPoint(i, x);
    const bool inside = Radius(x) < 7.6;
    labels->InsertNextValue(inside ? 3 : 0);
    density->InsertNextValue(static_cast<float>(
      inside ? 100.0 + 10.0 * std::sin(0.9 * x[0]) * std::cos(0.4 * x[1]) : 0.3 * x[2]));
  }
  image->GetPointData()->SetScalars(density);
  image->GetPointData()->AddArray(labels);
  return image;
}

vtkSmartPointer<vtkTSplineReconstruction> Reconstruct(vtkImageData* image)
{
  auto reconstruction = vtkSmartPointer<vtkTSplineReconstruction>::New();
  reconstruction->SetInputData(image);
  reconstruction->SetInputArrayToProcess(
    0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Density");
  reconstruction->SetInputArrayToProcess(
    1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Material");
  reconstruction->SetMaximumNumberOfControlPoints(1500);
  return reconstruction;
}

template <typename DataT>
DataT* Output(vtkTSplineReconstruction* reconstruction, int port)
{
  return DataT::SafeDownCast(reconstruction->GetOutputDataObject(port));
}

void ExpectSame(vtkUnstructuredGrid* a, vtkUnstructuredGrid* b)
{
  ASSERT_EQ(a->GetNumberOfPoints(), b->GetNumberOfPoints());
  ASSERT_EQ(a->GetPointData()->GetNumberOfArrays(), b->GetPointData()->GetNumberOfArrays());
  for (int i = -1; i < a->GetPointData()->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* one = i < 0 ? a->GetPoints()->GetData() : a->GetPointData()->GetArray(i);
    vtkDataArray* other =
      i < 0 ? b->GetPoints()->GetData() : b->GetPointData()->GetArray(one->GetName());
    ASSERT_NE(other, nullptr);
    ASSERT_EQ(std::memcmp(one->GetVoidPointer(0), other->GetVoidPointer(0),
                one->GetDataTypeSize() * one->GetNumberOfValues()),
      0)
      << (i < 0 ? "points" : one->GetName());
  }
}
}

//------------------------------------------------------------------------------
TEST(TSplineReconstruction, StandsForEveryVoxelByASplineForEachSegment)
{
  const auto image = Phantom();
  auto reconstruction = Reconstruct(image);
  reconstruction->SetRMSTolerance(0.0);
  reconstruction->Update();
  auto* grid = reconstruction->GetOutput();
  EXPECT_LE(grid->GetNumberOfPoints(), 1500);
  EXPECT_GT(grid->GetNumberOfPoints(), 1000);
  std::set<double> segments;
  for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i)
  {
    segments.insert(grid->GetPointData()->GetArray("Segment")->GetTuple1(i));
  }
  EXPECT_EQ(segments, (std::set<double>{ 0.0, 3.0 }));

  vtkNew<vtkReconstructionReport> report;
  report->SetInputConnection(0, reconstruction->GetOutputPort(2));
  report->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Density");
  report->SetTSplineConnection(reconstruction->GetOutputPort());
  report->SetRoundsConnection(reconstruction->GetOutputPort(1));
  report->Update();
  vtkTable* table = report->GetOutput();
  ASSERT_EQ(table->GetNumberOfRows(), 3);
  const auto cell = [table](vtkIdType row, const char* name)
  { return table->GetValueByName(row, name).ToDouble(); };
  for (vtkIdType row = 0; row < 3; ++row)
  {
    EXPECT_EQ(cell(row, "FoundPercent"), 100.0);
    EXPECT_LT(cell(row, "RoundTripRMSPercent"), 0.5);
    EXPECT_NEAR(cell(row, "RMSPercent"), cell(row, "RoundTripRMSPercent"), 1e-9);
    EXPECT_TRUE(std::isnan(cell(row, "HausdorffVoxels"))); // boxes
    EXPECT_NEAR(cell(row, "MinimumScaledJacobian"), 1.0, 1e-9);
    EXPECT_GT(cell(row, "Seconds"), 0.0);
  }
  EXPECT_EQ(cell(0, "Voxels") + cell(1, "Voxels"), cell(2, "Voxels"));
  EXPECT_EQ(cell(2, "Blocks"), 2.0);
  EXPECT_GT(cell(1, "ControlPoints"), cell(0, "ControlPoints")); // the air is almost linear

  // No smooth spline over the whole box follows the jump with so few control points.
  vtkNew<vtkTSplineFit> whole;
  whole->SetInputData(image);
  whole->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Density");
  whole->SetMaximumNumberOfControlPoints(1500);
  whole->Update();
  auto* rounds = vtkTable::SafeDownCast(whole->GetOutputDataObject(1));
  EXPECT_GT(rounds->GetValueByName(rounds->GetNumberOfRows() - 1, "RMS").ToDouble(),
    5.0 * cell(2, "RoundTripRMSPercent"));
}

//------------------------------------------------------------------------------
TEST(TSplineReconstruction, MeetsTheToleranceInEachSegment)
{
  auto reconstruction = Reconstruct(Phantom());
  reconstruction->SetMaximumNumberOfControlPoints(20000);
  reconstruction->SetRMSTolerance(0.8);
  reconstruction->Update();
  vtkNew<vtkReconstructionReport> report;
  report->SetInputConnection(0, reconstruction->GetOutputPort(2));
  report->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Density");
  report->SetTSplineConnection(reconstruction->GetOutputPort());
  report->Update();
  for (vtkIdType row = 0; row < 3; ++row)
  {
    EXPECT_LE(report->GetOutput()->GetValueByName(row, "RoundTripRMSPercent").ToDouble(), 0.8);
  }
  EXPECT_LT(reconstruction->GetOutput()->GetNumberOfPoints(), 1500);
}

//------------------------------------------------------------------------------
TEST(TSplineReconstruction, FindsSegmentsSurfacesAndDomains)
{
  auto reconstruction = Reconstruct(Phantom());
  reconstruction->SetInputArrayToProcess(1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "None");
  reconstruction->SetNumberOfSegments(2);
  reconstruction->SetMaximumNumberOfControlPoints(300);
  reconstruction->Update();
  auto* image = Output<vtkImageData>(reconstruction, 2);
  vtkDataArray* labels = image->GetPointData()->GetArray("Segment");
  ASSERT_NE(labels, nullptr);
  vtkIdType wrong = 0;
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    double x[3];
    image->GetPoint(i, x);
    wrong += labels->GetTuple1(i) != (Radius(x) < 7.6);
  }
  EXPECT_LT(wrong, 30);
  EXPECT_GT(Output<vtkPolyData>(reconstruction, 3)->GetNumberOfCells(), 500);
  EXPECT_GT(Output<vtkPolyData>(reconstruction, 4)->GetNumberOfCells(), 500);
  EXPECT_GE(Output<vtkUnstructuredGrid>(reconstruction, 5)->GetNumberOfCells(), 7);
  EXPECT_GT(Output<vtkTable>(reconstruction, 1)->GetNumberOfRows(), 2);
  EXPECT_LE(reconstruction->GetOutput()->GetNumberOfPoints(), 300);
}

//------------------------------------------------------------------------------
// Over its cubes or over its box: whichever is better stands for every voxel, and is told of.
TEST(TSplineReconstruction, TakesTheBetterOfCubesAndBox)
{
  const auto run = [](int domain)
  {
    auto reconstruction = Reconstruct(Phantom());
    reconstruction->SetDomain(domain);
    reconstruction->SetRMSTolerance(0.0);
    vtkNew<vtkReconstructionReport> report;
    report->SetInputConnection(0, reconstruction->GetOutputPort(2));
    report->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Density");
    report->SetTSplineConnection(reconstruction->GetOutputPort());
    report->Update();
    vtkNew<vtkTable> table;
    table->DeepCopy(report->GetOutput());
    return table;
  };
  const vtkNew<vtkTable> boxes = run(vtkTSplineReconstruction::SEGMENTS);
  const vtkNew<vtkTable> best = run(vtkTSplineReconstruction::AUTOMATIC);
  ASSERT_EQ(best->GetNumberOfRows(), 3);
  for (vtkIdType row = 0; row < 3; ++row)
  {
    EXPECT_EQ(best->GetValueByName(row, "FoundPercent").ToDouble(), 100.0);
  }
  EXPECT_LE(best->GetValueByName(1, "RoundTripRMSPercent").ToDouble(),
    1.0001 * boxes->GetValueByName(1, "RoundTripRMSPercent").ToDouble());
}

//------------------------------------------------------------------------------
TEST(TSplineReconstruction, OverTheBoxIsTheFit)
{
  const auto image = Phantom();
  auto reconstruction = Reconstruct(image);
  reconstruction->SetDomainToBox();
  reconstruction->SetMaximumNumberOfControlPoints(600);
  reconstruction->AddAttribute("Material");
  reconstruction->Update();
  vtkNew<vtkTSplineFit> fit;
  fit->SetInputData(image);
  fit->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Density");
  fit->AddAttribute("Material");
  fit->SetMaximumNumberOfControlPoints(600);
  fit->SetRMSTolerance(0.1);
  fit->Update();
  ExpectSame(reconstruction->GetOutput(), fit->GetOutput());
}

//------------------------------------------------------------------------------
TEST(TSplineReconstruction, StopsInEveryStepAndRunsAgain)
{
  vtkSmartPointer<vtkUnstructuredGrid> first;
  for (const int threads : { 1, 3 })
  {
    vtkSMPTools::LocalScope(vtkSMPTools::Config(threads, "STDThread", false),
      [&first]()
      {
        auto reconstruction = Reconstruct(Phantom());
        reconstruction->SetInputArrayToProcess(
          1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "None");
        reconstruction->SetNumberOfSegments(2);
        reconstruction->SetMaximumNumberOfControlPoints(250);
        for (const double at : { 0.05, 0.31, 0.36, 0.42, 0.55, 0.75 })
        {
          vtkNew<vtkCallbackCommand> stop;
          double where = at;
          stop->SetClientData(&where);
          stop->SetCallback(
            [](vtkObject* caller, unsigned long, void* wanted, void*)
            {
              auto* algorithm = static_cast<vtkAlgorithm*>(caller);
              double& where = *static_cast<double*>(wanted);
              const double now = algorithm->GetProgress();
              if (now >= where && now < 1.0) // the executive ends with 1
              {
                where = now;
                algorithm->SetAbortExecute(1);
              }
            });
          const unsigned long tag = reconstruction->AddObserver(vtkCommand::ProgressEvent, stop);
          reconstruction->Update();
          EXPECT_EQ(reconstruction->GetOutput()->GetNumberOfPoints(), 0) << at;
          EXPECT_EQ(Output<vtkPolyData>(reconstruction, 3)->GetNumberOfCells(), 0) << at;
          EXPECT_LT(where, at + 0.3);
          reconstruction->RemoveObserver(tag);
          reconstruction->SetAbortExecute(0);
        }
        reconstruction->Modified();
        reconstruction->Update();
        EXPECT_EQ(reconstruction->GetProgress(), 1.0);
        if (!first)
        {
          first = vtkSmartPointer<vtkUnstructuredGrid>::New();
          first->DeepCopy(reconstruction->GetOutput());
          EXPECT_GT(first->GetNumberOfPoints(), 100);
        }
        ExpectSame(first, reconstruction->GetOutput());
      });
  }
}

//------------------------------------------------------------------------------
TEST(TSplineReconstruction, SaysWhatIsWrong)
{
  const auto image = Phantom();
  auto reconstruction = Reconstruct(image);
  ErrorLog log(reconstruction);
  const auto expect = [&reconstruction, &log](const char* words)
  {
    reconstruction->Modified();
    reconstruction->Update();
    const std::string text = log.TakeOnly();
    EXPECT_NE(text.find(words), std::string::npos) << text;
    EXPECT_EQ(reconstruction->GetOutput()->GetNumberOfPoints(), 0) << words;
  };
  reconstruction->SetInputArrayToProcess(
    1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "absent");
  expect("no point array \"absent\" of labels");
  reconstruction->SetInputArrayToProcess(
    1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Material");
  reconstruction->AddAttribute("absent");
  expect("no point array \"absent\" to fit");
  reconstruction->ClearAttributes();
  vtkDataArray* labels = image->GetPointData()->GetArray("Material");
  labels->SetTuple1(3, -4.0);
  image->Modified();
  expect("labels are whole numbers");
  labels->SetTuple1(3, 0.0);
  image->GetPointData()->GetArray("Density")->SetTuple1(
    77, std::numeric_limits<double>::infinity());
  image->Modified();
  expect("finite");
  vtkNew<vtkImageData> empty;
  reconstruction->SetInputData(empty);
  expect("no points");
}
