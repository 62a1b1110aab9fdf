// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "DomainSelection.h"
#include "vtkFrameField.h"
#include "vtkPolycubeDomain.h"
#include "vtkSegmentBoundary.h"
#include "vtkVolumeParameterization.h"

#include "vtkCellData.h"
#include "vtkIdList.h"
#include "vtkImageData.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkUnstructuredGrid.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
// Two balls, segments 1 and 2, and what Polycube Domain makes of them.
struct TwoBalls
{
  vtkNew<vtkImageData> Image;
  vtkNew<vtkPolyData> Patches;
  vtkNew<vtkUnstructuredGrid> Polycubes;

  TwoBalls()
  {
    this->Image->SetDimensions(32, 17, 17);
    vtkNew<vtkIntArray> labels;
    labels->SetName("Segment");
    for (vtkIdType i = 0; i < this->Image->GetNumberOfPoints(); ++i)
    {
      double x[3];
      this->Image->GetPoint(i, x);
      const int ball = x[0] < 15.5 ? 1 : 2;
      const double radius = std::hypot(x[0] - (ball == 1 ? 8.0 : 23.3), x[1] - 8.1, x[2] - 8.3);
      labels->InsertNextValue(radius < 6.2 ? ball : 0);
    }
    this->Image->GetPointData()->SetScalars(labels);
    vtkNew<vtkSegmentBoundary> boundary;
    boundary->SetInputData(this->Image);
    vtkNew<vtkPolycubeDomain> domain;
    domain->SetInputConnection(boundary->GetOutputPort());
    domain->Update();
    this->Patches->DeepCopy(domain->GetPatches());
    this->Polycubes->DeepCopy(domain->GetPolycube());
  }

  vtkIdType CellsOf(vtkDataSet* data, int segment)
  {
    vtkIdType count = 0;
    for (vtkIdType cell = 0; cell < data->GetNumberOfCells(); ++cell)
    {
      count += data->GetCellData()->GetArray("Segment")->GetTuple1(cell) == segment;
    }
    return count;
  }

  // Makes the first blocks of a segment left-handed.
  void Mirror(int segment, int blocks)
  {
    vtkNew<vtkUnstructuredGrid> mirrored;
    mirrored->SetPoints(this->Polycubes->GetPoints());
    mirrored->GetPointData()->ShallowCopy(this->Polycubes->GetPointData());
    mirrored->GetCellData()->ShallowCopy(this->Polycubes->GetCellData());
    mirrored->Allocate();
    for (vtkIdType cell = 0; cell < this->Polycubes->GetNumberOfCells(); ++cell)
    {
      vtkNew<vtkIdList> points;
      this->Polycubes->GetCellPoints(cell, points);
      vtkIdType* p = points->GetPointer(0);
      if (this->Polycubes->GetCellData()->GetArray("Segment")->GetTuple1(cell) == segment &&
          blocks-- > 0)
      {
        std::swap(p[1], p[3]);
        std::swap(p[5], p[7]);
      }
      mirrored->InsertNextCell(VTK_HEXAHEDRON, points);
    }
    this->Polycubes->ShallowCopy(mirrored);
  }
};
}

TEST(DomainSelection, LeavesOutWhatIsMostlyInverted)
{
  TwoBalls balls;
  const vtkIdType triangles = balls.CellsOf(balls.Patches, 2);
  ASSERT_EQ(balls.CellsOf(balls.Polycubes, 1), 7);
  ASSERT_EQ(balls.CellsOf(balls.Polycubes, 2), 7);
  const double x = balls.Patches->GetBounds()[1];
  balls.Mirror(1, 4);
  const std::vector<std::string> why = trivariate::LeaveOutInverted(balls.Patches, balls.Polycubes);
  ASSERT_EQ(why.size(), 1u);
  EXPECT_NE(
    why[0].find("Segment 1 is fitted over its bounding box: 4 of 7 blocks"), std::string::npos)
    << why[0];
  EXPECT_EQ(balls.CellsOf(balls.Polycubes, 1), 0);
  EXPECT_EQ(balls.CellsOf(balls.Polycubes, 2), 7);
  EXPECT_EQ(balls.Patches->GetNumberOfCells(), triangles);
  EXPECT_EQ(balls.CellsOf(balls.Patches, 2), triangles);
  EXPECT_EQ(balls.Patches->GetNumberOfPoints(), triangles / 2 + 2); // a sphere's, and no others
  EXPECT_EQ(balls.Patches->GetBounds()[1], x);

  // What is left is a domain.
  vtkNew<vtkFrameField> frames;
  frames->SetInputData(0, balls.Image);
  frames->SetInputData(1, balls.Patches);
  vtkNew<vtkVolumeParameterization> parameters;
  parameters->SetInputConnection(0, frames->GetOutputPort());
  parameters->SetInputData(1, balls.Patches);
  parameters->SetInputData(2, balls.Polycubes);
  parameters->Update();
  vtkDataArray* mask = vtkImageData::SafeDownCast(parameters->GetOutputDataObject(0))
                         ->GetPointData()
                         ->GetArray("ParameterMask");
  ASSERT_NE(mask, nullptr);
  vtkDataArray* labels = balls.Image->GetPointData()->GetScalars();
  vtkIdType missing = 0, others = 0;
  for (vtkIdType i = 0; i < labels->GetNumberOfTuples(); ++i)
  {
    missing += labels->GetTuple1(i) == 2.0 && mask->GetTuple1(i) == 0.0;
    others += labels->GetTuple1(i) != 2.0 && mask->GetTuple1(i) != 0.0;
  }
  EXPECT_EQ(others, 0);
  EXPECT_LT(missing, 10);
}

// Cubes over the surface's corners, one for each ball, right-handed and as large as those.
TEST(DomainSelection, TakesLayersOff)
{
  TwoBalls balls;
  const vtkNew<vtkUnstructuredGrid> cubes = trivariate::WithoutLayers(balls.Polycubes);
  ASSERT_EQ(cubes->GetNumberOfCells(), 2);
  vtkPointData* data = cubes->GetPointData();
  for (vtkIdType cell = 0; cell < 2; ++cell)
  {
    EXPECT_EQ(cubes->GetCellData()->GetArray("Segment")->GetTuple1(cell), cell + 1.0);
    EXPECT_EQ(cubes->GetCellData()->GetArray("Patch")->GetTuple1(cell), -1.0);
    vtkNew<vtkIdList> points;
    cubes->GetCellPoints(cell, points);
    const double x[3] = { cell == 0 ? 8.0 : 23.3, 8.1, 8.3 };
    for (const vtkIdType point : *points)
    {
      EXPECT_GE(data->GetArray("CornerId")->GetTuple1(point), 0.0);
      const double* p = cubes->GetPoint(point);
      EXPECT_NEAR(std::hypot(p[0] - x[0], p[1] - x[1], p[2] - x[2]), 6.2, 0.7);
    }
  }
  EXPECT_TRUE(trivariate::LeaveOutInverted(balls.Patches, cubes).empty());
  EXPECT_EQ(cubes->GetNumberOfCells(), 2);
  EXPECT_NE(cubes->GetCellData()->GetArray("Block")->GetTuple1(0),
    cubes->GetCellData()->GetArray("Block")->GetTuple1(1));
  EXPECT_EQ(trivariate::WithoutLayers(cubes)->GetNumberOfCells(), 0); // they have none
}

TEST(DomainSelection, KeepsWhatIsMostlySound)
{
  TwoBalls balls;
  balls.Mirror(2, 3);
  const vtkIdType triangles = balls.Patches->GetNumberOfCells();
  EXPECT_TRUE(trivariate::LeaveOutInverted(balls.Patches, balls.Polycubes).empty());
  EXPECT_EQ(balls.Polycubes->GetNumberOfCells(), 14);
  EXPECT_EQ(balls.Patches->GetNumberOfCells(), triangles);

  balls.Mirror(1, 7);
  balls.Mirror(2, 7); // of which three are right again
  EXPECT_EQ(trivariate::LeaveOutInverted(balls.Patches, balls.Polycubes).size(), 2u);
  EXPECT_EQ(balls.Polycubes->GetNumberOfCells(), 0);
  EXPECT_EQ(balls.Patches->GetNumberOfCells(), 0);
}
