// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "BallDomain.h"
#include "ErrorLog.h"
#include "ReportChecks.h"
#include "vtkTSplineFit.h"

#include "vtkCallbackCommand.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkIntArray.h"
#include "vtkPolyData.h"
#include "vtkSMPTools.h"

#include <cmath>
#include <cstring>
#include <limits>

using namespace trivariate;

namespace
{
double RangeOf(vtkImageData* image)
{
  double range[2];
  image->GetPointData()->GetScalars()->GetRange(range);
  return range[1] - range[0];
}
}

//------------------------------------------------------------------------------
// A ball of two shells fitted by vtkTSplineFit under a mask, its indices a left hand.
TEST(ReconstructionReport, AgreesWithTheFit)
{
  auto image = Lattice(25, 25, 25);
  image->SetSpacing(0.5, 0.75, 0.5);
  const double direction[9] = { 1, 0, 0, 0, 1, 0, 0, 0, -1 };
  image->SetDirectionMatrix(direction);
  const auto radius = [](const double* x)
  { return std::hypot(x[0] / 0.5 - 12.0, x[1] / 0.75 - 12.0, x[2] / 0.5 + 12.0); };
  AddArray<vtkDoubleArray>(
    image, "Value", [radius](const double* x) { return std::tanh(9.0 - radius(x)); });
  AddArray<vtkIntArray>(
    image, "Segment", [radius](const double* x) { return radius(x) < 10.0 ? 1.0 : 0.0; });
  vtkNew<vtkTSplineFit> fit;
  fit->SetInputData(image);
  fit->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Value");
  fit->SetMaskArray("Segment");
  fit->SetMaximumNumberOfControlPoints(700);
  vtkNew<vtkReconstructionReport> report;
  report->SetInputData(image);
  report->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Value");
  report->SetTSplineConnection(fit->GetOutputPort());
  report->SetRoundsConnection(fit->GetOutputPort(1));
  report->Update();
  vtkTable* rounds = vtkTable::SafeDownCast(fit->GetOutputDataObject(1));
  const vtkIdType last = rounds->GetNumberOfRows() - 1;
  EXPECT_EQ(Cell(report, 2, "Seconds"), rounds->GetValueByName(last, "Seconds").ToDouble());
  EXPECT_EQ(
    Cell(report, 2, "ControlPoints"), rounds->GetValueByName(last, "ControlPoints").ToDouble());
  // The fit takes the range of what counts, the report that of the image.
  double range[2], own[2] = { 1.0, -1.0 };
  vtkDataArray* values = image->GetPointData()->GetArray("Value");
  values->GetRange(range);
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    if (image->GetPointData()->GetArray("Segment")->GetTuple1(i) == 1.0)
    {
      own[0] = std::min(own[0], values->GetTuple1(i));
      own[1] = std::max(own[1], values->GetTuple1(i));
    }
  }
  const double rms = rounds->GetValueByName(last, "RMS").ToDouble();
  const double scaled = rms * (own[1] - own[0]) / (range[1] - range[0]);
  EXPECT_GT(rms, 1e-4);
  EXPECT_NEAR(Cell(report, 1, "RoundTripRMSPercent"), scaled, 1e-6 * scaled);
  EXPECT_NEAR(Cell(report, 1, "RMSPercent"), scaled, 1e-6 * scaled);
  EXPECT_EQ(Cell(report, 1, "FoundPercent"), 100.0);
  EXPECT_NEAR(Cell(report, 2, "MinimumScaledJacobian"), 1.0, 1e-9);
}

//------------------------------------------------------------------------------
// A fit over a domain moves the parameters of voxels away from where the array has them; what it
// ends with is told by its rounds, and is that of the round trip.
TEST(ReconstructionReport, TakesErrorsOverADomainFromTheFit)
{
  const trivariate_testing::BallDomain ball(24);
  vtkNew<vtkImageData> image;
  image->ShallowCopy(ball.Image);
  vtkDataArray* mask = image->GetPointData()->GetArray("ParameterMask");
  vtkNew<vtkIntArray> labels;
  labels->SetName("Segment");
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    labels->InsertNextValue(mask->GetTuple1(i) != 0.0);
  }
  image->GetPointData()->AddArray(labels);
  vtkNew<vtkTSplineFit> fit;
  fit->SetInputData(0, image);
  fit->SetInputData(1, ball.Polycube);
  fit->SetInputData(2, ball.Meshes);
  fit->SetMaximumNumberOfControlPoints(1000);
  vtkNew<vtkReconstructionReport> report;
  report->SetInputData(image);
  report->SetTSplineConnection(fit->GetOutputPort());
  report->SetRoundsConnection(fit->GetOutputPort(1));
  report->Update();
  ASSERT_EQ(report->GetOutput()->GetNumberOfRows(), 3);
  vtkTable* rounds = vtkTable::SafeDownCast(fit->GetOutputDataObject(1));
  vtkFieldData* field = rounds->GetFieldData();
  const double wanted = field->GetArray("FittedSegmentRMS")->GetTuple1(0) *
                        field->GetArray("FittedRange")->GetTuple1(0) / RangeOf(image);
  EXPECT_NEAR(Cell(report, 1, "RMSPercent"), wanted, 1e-12);
  EXPECT_NEAR(Cell(report, 1, "RMSPercent"), Cell(report, 1, "RoundTripRMSPercent"), 0.05 * wanted);
  EXPECT_GT(Cell(report, 2, "GradientJumpPercent"), 0.0);
  EXPECT_EQ(DomainIn(report, 1), "Cubes");
  EXPECT_TRUE(std::isnan(Cell(report, 0, "RMSPercent"))); // what lies around the ball
  EXPECT_TRUE(std::isnan(Cell(report, 0, "ControlPoints")));
  EXPECT_EQ(Cell(report, 0, "FoundPercent"), 0.0);
  EXPECT_EQ(DomainIn(report, 0), "None");
  EXPECT_EQ(Cell(report, 1, "FoundPercent"), 100.0);
  EXPECT_EQ(Cell(report, 1, "ControlPoints"), Cell(report, 2, "ControlPoints"));
  // What the fit counts: points once, and coordinates on the net that they were fitted on.
  const double distinct = Cell(report, 2, "DistinctControlPoints");
  EXPECT_EQ(
    distinct, rounds->GetValueByName(rounds->GetNumberOfRows() - 1, "ControlPoints").ToDouble());
  EXPECT_GT(Cell(report, 2, "ControlPoints"), distinct);
  EXPECT_EQ(Cell(report, 2, "NumbersStored"), 4.0 * distinct);
  EXPECT_EQ(field->GetArray("NumbersFitted")->GetTuple1(0),
    3.0 * field->GetArray("ShapeControlPoints")->GetTuple1(0) + distinct);

  // With blocks along the surface, of which only the polycube tells.
  const vtkIdType cubes = ball.Polycube->GetNumberOfCells();
  const auto patches = trivariate_testing::NamedArray<vtkIntArray>("Patch", 1, cubes);
  for (vtkIdType cell = 0; cell < cubes; ++cell)
  {
    patches->SetValue(cell, cell > 0 ? static_cast<int>(cell) : -1);
  }
  ball.Polycube->GetCellData()->AddArray(patches);
  fit->Modified();
  report->Update();
  EXPECT_EQ(DomainIn(report, 1), "LayeredCubes");

  // Where nothing tells what the fit ended with, the array's parameters count.
  report->SetInputConnection(3, nullptr);
  report->Update();
  EXPECT_GT(Cell(report, 1, "RMSPercent"), 1.5 * wanted);
}

//------------------------------------------------------------------------------
// Parameters of an image are not those of a fit without domain.
TEST(ReconstructionReport, KnowsTheParametersInABox)
{
  const trivariate_testing::BallDomain ball(20);
  vtkNew<vtkTSplineFit> fit;
  fit->SetInputData(ball.Image);
  fit->SetMaximumNumberOfControlPoints(500);
  vtkNew<vtkReconstructionReport> report;
  report->SetInputData(ball.Image);
  report->SetTSplineConnection(fit->GetOutputPort());
  report->Update();
  EXPECT_GT(Cell(report, 1, "RMSPercent"), 0.0);
  EXPECT_EQ(Cell(report, 1, "RMSPercent"), Cell(report, 1, "RoundTripRMSPercent"));
}

//------------------------------------------------------------------------------
TEST(ReconstructionReport, IsTheSameOnAnyNumberOfThreads)
{
  const TSplineModel model = QuarterAnnulus(6, 2);
  auto image = Lattice(30, 30, 10);
  image->SetSpacing(0.06, 0.06, 0.1);
  AddArray<vtkDoubleArray>(image, "Radial", [](const double* x) { return x[0] + x[1] * x[2]; });
  vtkNew<vtkTable> first;
  for (const int threads : { 1, 2, 5 })
  {
    vtkSMPTools::LocalScope(vtkSMPTools::Config(threads, "STDThread", false),
      [&]()
      {
        auto report = MakeReport(image, "Radial", MakeGrid(model));
        report->Update();
        if (threads == 1)
        {
          first->DeepCopy(report->GetOutput());
        }
        for (vtkIdType column = 0; column < first->GetNumberOfColumns(); ++column)
        {
          const double a = first->GetValue(1, column).ToDouble();
          const double b = report->GetOutput()->GetValue(1, column).ToDouble();
          EXPECT_EQ(std::memcmp(&a, &b, sizeof a), 0) << first->GetColumnName(column);
        }
      });
  }
}

//------------------------------------------------------------------------------
TEST(ReconstructionReport, StopsAndRunsAgain)
{
  const auto grid = MakeGrid(QuarterAnnulus(3, 2));
  auto image = Lattice(30, 30, 10);
  image->SetSpacing(0.06, 0.06, 0.1);
  AddArray<vtkDoubleArray>(image, "Radial", [](const double* x) { return x[0]; });
  for (const double at : { 0.0, 0.2, 0.45, 0.6 })
  {
    auto report = MakeReport(image, "Radial", grid);
    vtkNew<vtkCallbackCommand> stop;
    double where = at;
    stop->SetClientData(&where);
    stop->SetCallback(
      [](vtkObject* caller, unsigned long, void* wanted, void*)
      {
        auto* algorithm = static_cast<vtkAlgorithm*>(caller);
        if (algorithm->GetProgress() >= *static_cast<double*>(wanted))
        {
          algorithm->SetAbortExecute(1);
        }
      });
    const unsigned long observer = report->AddObserver(vtkCommand::ProgressEvent, stop);
    report->Update();
    EXPECT_EQ(report->GetOutput()->GetNumberOfRows(), 0) << at;
    report->RemoveObserver(observer);
    report->SetAbortExecute(0);
    report->Modified();
    report->Update();
    EXPECT_EQ(report->GetOutput()->GetNumberOfRows(), 2) << at;
  }
}

//------------------------------------------------------------------------------
TEST(ReconstructionReport, SaysWhatIsWrong)
{
  const auto grid = MakeGrid(RandomBox({ 1, 1, 1 }, 1, 1));
  auto image = Lattice(9, 9, 9);
  vtkDoubleArray* values =
    AddArray<vtkDoubleArray>(image, "Value", [](const double* x) { return x[0]; });
  AddArray<vtkDoubleArray>(image, "Other", [](const double* x) { return x[0]; });
  auto report = MakeReport(image, "Value", grid);
  ErrorLog log(report);
  const auto expect = [&report, &log](const char* words)
  {
    report->Modified();
    report->Update();
    const std::string text = log.TakeOnly();
    EXPECT_NE(text.find(words), std::string::npos) << text;
    EXPECT_EQ(report->GetOutput()->GetNumberOfRows(), 0) << words;
  };
  const auto choose = [&report](int index, const char* name)
  { report->SetInputArrayToProcess(index, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, name); };
  choose(0, "absent");
  expect("does not have the point array");
  choose(0, "Other");
  expect("no attribute \"Other\" to compare with; it has: Value");
  choose(0, "Value");
  values->SetValue(5, std::numeric_limits<double>::quiet_NaN());
  expect("at voxel 5");
  values->SetValue(5, 0.0);
  report->SetInputData(1, Together(Moved(RandomBox({ 1, 1, 1 }, 1, 1), 0.0, 1),
                            Moved(RandomBox({ 1, 1, 1 }, 1, 1), 0.0, 4)));
  expect("The T-spline has 2 segments, but the image has no point array \"Segment\"");
  report->SetInputData(1, grid);
  choose(1, "absent");
  expect("no point array \"absent\" of labels");
  choose(1, "Other");
  image->GetPointData()->GetArray("Other")->SetTuple1(3, 0.25);
  expect("the label 0.25");
  choose(1, "Automatic");
  grid->GetPointData()->RemoveArray("Weight");
  expect("Weight");
  vtkNew<vtkImageData> empty;
  report->SetInputData(empty);
  expect("no points");
}
