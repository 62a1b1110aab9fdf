// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ReconstructionPhantom.h"
#include "vtkReconstructionReport.h"
#include "vtkTSplineFit.h"

#include "vtkCallbackCommand.h"
#include "vtkTable.h"

#include <set>

using namespace trivariate_testing;

//------------------------------------------------------------------------------
TEST(TSplineReconstruction, StandsForEveryVoxelByASplineForEachSegment)
{
  const auto image = Phantom();
  auto reconstruction = Reconstruct(image);
  reconstruction->SetDomainToSegments();
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
  reconstruction->SetDomainToSegments();
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
// However many of the outputs are asked for.
TEST(TSplineReconstruction, RunsOnceForAllOutputs)
{
  for (const int domain : { vtkTSplineReconstruction::BOX, vtkTSplineReconstruction::SEGMENTS,
         vtkTSplineReconstruction::AUTOMATIC })
  {
    auto reconstruction = Reconstruct(Phantom());
    reconstruction->SetDomain(domain);
    reconstruction->SetMaximumNumberOfControlPoints(200);
    int runs = 0;
    vtkNew<vtkCallbackCommand> count;
    count->SetClientData(&runs);
    count->SetCallback([](vtkObject*, unsigned long, void* n, void*) { ++*static_cast<int*>(n); });
    reconstruction->AddObserver(vtkCommand::StartEvent, count);
    for (int port = 0; port < reconstruction->GetNumberOfOutputPorts(); ++port)
    {
      reconstruction->Update(port);
    }
    EXPECT_EQ(runs, 1) << domain;
  }
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
