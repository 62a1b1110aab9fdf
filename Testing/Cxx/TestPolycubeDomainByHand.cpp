// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "DomainChecks.h"
#include "Stop.h"

#include "vtkDoubleArray.h"
#include "vtkPoints.h"

#include <ctime>
#include <limits>
#include <vector>

using namespace trivariate_testing;

namespace
{
// Voxels x, y in [-8, 8), z in [-4, 4), without the quarter x, y >= 0.
int LLabel(const double* p)
{
  const bool inside = p[0] >= -8 && p[0] < 8 && p[1] >= -8 && p[1] < 8 && p[2] >= -4 && p[2] < 4;
  return inside && (p[0] < 0 || p[1] < 0) ? 1 : 0;
}

std::vector<Place> StartCornersOf(vtkPolycubeDomain* domain)
{
  vtkDoubleArray* array = domain->GetStartCorners();
  std::vector<Place> corners(array->GetNumberOfTuples());
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
  {
    array->GetTypedTuple(i, corners[i].data());
  }
  return corners;
}

void SetCorners(vtkPolycubeDomain* domain, const std::vector<Place>& corners)
{
  domain->ClearCornerPositions();
  for (const Place& corner : corners)
  {
    domain->AddCornerPosition(corner.data());
  }
}
}

//------------------------------------------------------------------------------
TEST(PolycubeDomain, StartsFromTheCornersFound)
{
  const vtkNew<vtkPolyData> surface = Ball();
  vtkNew<vtkPolycubeDomain> domain;
  EXPECT_EQ(StartCornersOf(domain).size(), 1u);
  domain->SetInputData(surface);
  domain->Update();
  const std::vector<Place> start = StartCornersOf(domain);
  ASSERT_EQ(start.size(), 8u);
  for (int corner = 0; corner < 8; ++corner)
  {
    const double* p = domain->GetPolycube()->GetPoint(corner);
    EXPECT_EQ(start[corner], (Place{ p[0], p[1], p[2] }));
  }
  domain->SetModeToManual();
  domain->Update();
  EXPECT_EQ(domain->GetPolycube()->GetPointData()->GetArray("SnapDistance"), nullptr);
  for (int corner = 0; corner < 8; ++corner)
  {
    const double* p = domain->GetPolycube()->GetPoint(corner);
    for (int axis = 0; axis < 3; ++axis)
    {
      EXPECT_NEAR(start[corner][axis], p[axis], 1e-9);
    }
  }

  // One corner dragged, off the surface.
  std::vector<Place> moved = start;
  moved[5] = { 1.1 * start[5][0], 1.1 * start[5][1], 0.7 * start[5][2] };
  SetCorners(domain, moved);
  EXPECT_EQ(domain->GetNumberOfCornerPositions(), 8);
  domain->Update();
  ExpectSound(domain, surface, { 1 });
  vtkDataArray* snapped = domain->GetPolycube()->GetPointData()->GetArray("SnapDistance");
  ASSERT_NE(snapped, nullptr);
  EXPECT_GT(snapped->GetComponent(5, 0), 0.01);
  EXPECT_NEAR(snapped->GetComponent(0, 0), 0.0, 1e-6);
  EXPECT_NEAR(domain->GetPolycube()->GetPoint(5)[2], moved[5][2], 0.5);

  // The same from a second input.
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const Place& corner : moved)
  {
    points->InsertNextPoint(corner.data());
  }
  vtkNew<vtkPolyData> picked;
  picked->SetPoints(points);
  vtkNew<vtkPolyData> before;
  before->DeepCopy(domain->GetPatches());
  domain->ClearCornerPositions();
  domain->SetInputData(1, picked);
  domain->Update();
  EXPECT_EQ(domain->GetPatches()->GetNumberOfCells(), before->GetNumberOfCells());

  domain->SetInputData(1, nullptr);
  domain->SetNumberOfCubes(1, 1, 3);
  EXPECT_EQ(StartCornersOf(domain).size(), 16u);
  domain->Update();
  EXPECT_EQ(domain->GetPolycube()->GetNumberOfCells(), 3 + 14);
  ExpectSound(domain, surface, { 1 });
}

// Corners to start from are sought once for a surface, also where one cube is not what was found.
TEST(PolycubeDomain, SeeksCornersOnce)
{
  const vtkNew<vtkPolyData> surface = SurfaceOf(11, LLabel);
  vtkNew<vtkPolycubeDomain> domain;
  domain->SetInputData(surface);
  domain->Update();
  ASSERT_GT(domain->GetPolycube()->GetNumberOfCells(), 7) << "more than one cube";
  const auto seconds = [&domain](int w)
  {
    domain->SetNumberOfCubes(1, 1, w);
    const std::clock_t begin = std::clock();
    EXPECT_EQ(StartCornersOf(domain).size(), 4u * (w + 1));
    return double(std::clock() - begin) / CLOCKS_PER_SEC;
  };
  const double first = seconds(2);
  EXPECT_LT(seconds(2), 0.2 * first);
  EXPECT_LT(seconds(3), 0.2 * first);
}

TEST(PolycubeDomain, LaysOutAnLByHand)
{
  const vtkNew<vtkPolyData> surface = SurfaceOf(11, LLabel);
  vtkNew<vtkPolycubeDomain> domain;
  domain->SetInputData(surface);
  domain->SetModeToManual();
  domain->SetNumberOfCubes(2, 2, 1);
  domain->AddSwitchedOffCube(3);
  EXPECT_EQ(domain->GetSwitchedOffCube(0), 3);
  EXPECT_EQ(domain->GetSwitchedOffCube(1), -1);
  std::vector<Place> corners;
  for (const double z : { -4.5, 3.5 })
  {
    for (const double y : { -8.5, -0.5, 7.5 })
    {
      for (const double x : { -8.5, -0.5, 7.5 })
      {
        if (x < 7.0 || y < 7.0)
        {
          corners.push_back({ x, y, z });
        }
      }
    }
  }
  SetCorners(domain, corners);
  domain->Update();
  EXPECT_EQ(domain->GetPolycube()->GetNumberOfCells(), 3 + 14);
  ExpectSound(domain, surface, { 1 });
  EXPECT_GT(LeastJacobian(domain->GetPolycube()), 0.2);
  domain->LayeredOff();
  domain->Update();
  EXPECT_EQ(ValuesOf(CellArray(domain->GetPolycube(), "Block")), std::set<int>{ 0 });
  EXPECT_GT(LeastJacobian(domain->GetPolycube()), 0.9);
  // Normals point along the axes.
  vtkNew<vtkIdList> ids;
  double aligned = 0.0, area = 0.0;
  for (vtkIdType cell = 0; cell < domain->GetPatches()->GetNumberOfCells(); ++cell)
  {
    double x[3][3], normal[3];
    domain->GetPatches()->GetCellPoints(cell, ids);
    for (int i = 0; i < 3; ++i)
    {
      domain->GetPatches()->GetPoint(ids->GetId(i), x[i]);
    }
    vtkMath::Subtract(x[1], x[0], x[1]);
    vtkMath::Subtract(x[2], x[0], x[2]);
    vtkMath::Cross(x[1], x[2], normal);
    const int axis =
      static_cast<int>(CellArray(domain->GetPatches(), "PatchAxis")->GetComponent(cell, 0));
    const double side = CellArray(domain->GetPatches(), "PatchSide")->GetComponent(cell, 0);
    aligned += (2.0 * side - 1.0) * normal[axis];
    area += vtkMath::Norm(normal);
  }
  EXPECT_GT(aligned / area, 0.95);
}

//------------------------------------------------------------------------------
// Corners that are given need no search, so that it is begun when start corners are asked for.
TEST(PolycubeDomain, StopsTheSearchForStartCorners)
{
  const vtkNew<vtkPolyData> surface = Ball();
  vtkNew<vtkPolycubeDomain> domain;
  domain->SetInputData(surface);
  domain->Update();
  const std::vector<Place> corners = StartCornersOf(domain);
  vtkNew<vtkPolycubeDomain> manual;
  manual->SetInputData(surface);
  manual->SetModeToManual();
  manual->SetNumberOfCubes(1, 1, 1);
  SetCorners(manual, corners);
  manual->Update();
  const vtkIdType triangles = manual->GetPatches()->GetNumberOfCells();
  {
    Stop stop(manual, 0.01);
    EXPECT_EQ(StartCornersOf(manual), (std::vector<Place>{ Place{ 0.0, 0.0, 0.0 } }));
    EXPECT_TRUE(stop.WasAsked());
    EXPECT_LT(stop.Where() - stop.AskedAt(), 0.1);
    EXPECT_EQ(manual->GetAbortExecute(), 0);
  }
  manual->SetAbortExecute(1); // of a run that is over
  EXPECT_EQ(StartCornersOf(manual), corners);
  EXPECT_EQ(manual->GetProgress(), 1.0);
  manual->SetNumberOfCubes(2, 1, 1); // of which nothing is known yet
  EXPECT_EQ(StartCornersOf(manual).size(), 12u);
  manual->SetNumberOfCubes(1, 1, 1);
  EXPECT_EQ(manual->GetPatches()->GetNumberOfCells(), triangles);
  manual->Modified();
  manual->Update();
  EXPECT_EQ(manual->GetPatches()->GetNumberOfCells(), triangles);
  EXPECT_EQ(StartCornersOf(manual), corners);
}

//------------------------------------------------------------------------------
TEST(PolycubeDomain, SaysWhatIsWrongWithCorners)
{
  const vtkNew<vtkPolyData> ball = Ball();
  vtkNew<vtkPolycubeDomain> domain;
  domain->SetInputData(ball);
  domain->Update();
  const std::vector<Place> start = StartCornersOf(domain);
  ErrorLog log(domain);
  domain->SetModeToManual();

  SetCorners(domain, std::vector<Place>(start.begin(), start.begin() + 7));
  ExpectFault(domain, log, "8 corners; 7 were given");
  std::vector<Place> wrong = start;
  wrong.push_back(start[0]);
  SetCorners(domain, wrong);
  ExpectFault(domain, log, "8 corners; 9 were given");
  wrong = start;
  wrong[3] = wrong[6];
  SetCorners(domain, wrong);
  ExpectFault(domain, log, "at the same place");
  wrong = start;
  for (double& x : wrong[2])
  {
    x *= 2.0;
  }
  SetCorners(domain, wrong);
  ExpectFault(domain, log, "away from the surface");
  domain->SetSnapLimit(1.0);
  domain->Update();
  EXPECT_EQ(domain->GetPolycube()->GetNumberOfCells(), 7);
  domain->SetSnapLimit(0.1);
  wrong = start;
  for (int i = 0; i < 4; ++i)
  {
    std::swap(wrong[i], wrong[4 + i]);
  }
  SetCorners(domain, wrong);
  ExpectFault(domain, log, "mirrored");
  wrong = start;
  wrong[1][2] = std::numeric_limits<double>::infinity();
  SetCorners(domain, wrong);
  ExpectFault(domain, log, "not finite");

  SetCorners(domain, start);
  domain->AddSwitchedOffCube(0);
  ExpectFault(domain, log, "only where NumberOfCubes is given");
  domain->SetNumberOfCubes(2, 1, 1);
  domain->AddSwitchedOffCube(2);
  ExpectFault(domain, log, "no cube 2");
  domain->ClearSwitchedOffCubes();
  domain->SetNumberOfCubes(2, 0, 1);
  ExpectFault(domain, log, "at least one cube along each axis");
  domain->SetNumberOfCubes(3, 3, 1);
  domain->AddSwitchedOffCube(4);
  domain->ClearCornerPositions();
  ExpectFault(domain, log, "Euler characteristic");

  const vtkNew<vtkPolyData> two =
    SurfaceOf(12, [](const double* p) { return BoxLabel(p, 10, 6, 6) ? (p[0] < 1.0 ? 2 : 5) : 0; });
  domain->SetInputData(two);
  ExpectFault(domain, log, "for one segment; of 2, 5 enter one as Segments");
}
