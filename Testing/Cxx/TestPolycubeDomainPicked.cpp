// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
// Corners picked for several segments at once.
#include "DomainChecks.h"
#include "WarningLog.h"

#include "vtkDoubleArray.h"
#include "vtkPoints.h"

#include <vector>

using namespace trivariate_testing;

namespace
{
struct Corner
{
  Place At;
  int Segment;
};

// Of a box from `low` to `high`, one cube.
void AddBox(const Place& low, const Place& high, int segment, std::vector<Corner>& corners)
{
  for (int i = 0; i < 8; ++i)
  {
    corners.push_back(
      { { i & 1 ? high[0] : low[0], i & 2 ? high[1] : low[1], i & 4 ? high[2] : low[2] },
        segment });
  }
}

vtkNew<vtkPolyData> Points(const std::vector<Corner>& corners, bool named = true)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkIntArray> segments;
  segments->SetName("Segment");
  for (const Corner& corner : corners)
  {
    points->InsertNextPoint(corner.At.data());
    segments->InsertNextValue(corner.Segment);
  }
  vtkNew<vtkPolyData> picked;
  picked->SetPoints(points);
  if (named)
  {
    picked->GetPointData()->AddArray(segments);
  }
  return picked;
}

// Segment 2 is x in [-9, -2], 5 is x in [2, 9], apart or with a common face.
vtkNew<vtkPolyData> Boxes(bool apart)
{
  return SurfaceOf(11,
    [apart](const double* p)
    {
      const bool inside = BoxLabel(p, 9.1, 5.1, 5.1) && (!apart || std::abs(p[0]) > 1.9);
      return !inside ? 0 : p[0] < 0.5 ? 2 : 5;
    });
}

std::vector<Corner> BothBoxes()
{
  std::vector<Corner> corners;
  AddBox({ -9.5, -5.5, -5.5 }, { -1.5, 5.5, 5.5 }, 2, corners);
  AddBox({ 1.5, -5.5, -5.5 }, { 9.5, 5.5, 5.5 }, 5, corners);
  return corners;
}

double DistanceTo(vtkPolyData* patches, const Place& place)
{
  double least = VTK_DOUBLE_MAX;
  for (vtkIdType p = 0; p < patches->GetNumberOfPoints(); ++p)
  {
    if (patches->GetPointData()->GetArray("CornerId")->GetComponent(p, 0) >= 0.0)
    {
      least = std::min(
        least, std::sqrt(vtkMath::Distance2BetweenPoints(patches->GetPoint(p), place.data())));
    }
  }
  return least;
}
}

//------------------------------------------------------------------------------
TEST(PolycubeDomain, TakesCornersOfSeveralSegments)
{
  const vtkNew<vtkPolyData> surface = Boxes(true);
  vtkNew<vtkPolycubeDomain> domain;
  domain->SetInputData(surface);
  domain->SetModeToManual();
  domain->SetNumberOfCubes(1, 1, 1);
  // Mixed up: the order counts within each segment only.
  std::vector<Corner> corners = BothBoxes(), mixed;
  corners[7].At[2] = 2.5;
  for (int i = 0; i < 8; ++i)
  {
    mixed.push_back(corners[8 + i]);
    mixed.push_back(corners[i]);
  }
  domain->SetInputData(1, Points(mixed));
  domain->Update();
  EXPECT_EQ(domain->GetPolycube()->GetNumberOfCells(), 14);
  ExpectSound(domain, surface, { 2, 5 });
  for (const Corner& corner : corners)
  {
    EXPECT_LT(DistanceTo(domain->GetPatches(), corner.At), 1.2);
  }
  EXPECT_GT(LeastJacobian(domain->GetPolycube()), 0.1);
  ASSERT_NE(domain->GetPolycube()->GetPointData()->GetArray("SnapDistance"), nullptr);
  EXPECT_LT(domain->GetPolycube()->GetPointData()->GetArray("SnapDistance")->GetRange()[1], 1.2);
}

TEST(PolycubeDomain, FindsDomainsOfSegmentsWithoutCorners)
{
  const vtkNew<vtkPolyData> surface = Boxes(true);
  vtkNew<vtkPolycubeDomain> domain;
  domain->SetInputData(surface);
  domain->SetModeToManual();
  domain->SetNumberOfCubes(1, 1, 2);
  std::vector<Corner> corners;
  AddBox({ -9.5, -5.5, -5.5 }, { -1.5, 5.5, 0.0 }, 2, corners);
  AddBox({ -9.5, -5.5, 0.0 }, { -1.5, 5.5, 5.5 }, 2, corners);
  corners.erase(corners.begin() + 4, corners.begin() + 8);
  domain->SetInputData(1, Points(corners));
  domain->Update();
  ExpectSound(domain, surface, { 2, 5 });
  std::map<int, int> blocks;
  vtkDataArray* owners = CellArray(domain->GetPolycube(), "Segment");
  for (vtkIdType cell = 0; cell < owners->GetNumberOfTuples(); ++cell)
  {
    ++blocks[static_cast<int>(owners->GetComponent(cell, 0))];
  }
  EXPECT_EQ(blocks[2], 2 + 10);
  EXPECT_EQ(blocks[5], 1 + 6);
}

TEST(PolycubeDomain, WarnsThatPickedCornersAreNotShared)
{
  const vtkNew<vtkPolyData> surface = Boxes(false);
  vtkNew<vtkPolycubeDomain> domain;
  domain->SetInputData(surface);
  domain->SetModeToManual();
  domain->SetNumberOfCubes(1, 1, 1);
  std::vector<Corner> corners;
  AddBox({ -9.5, -5.5, -5.5 }, { 0.5, 5.5, 5.5 }, 2, corners);
  domain->SetInputData(1, Points(corners));
  const WarningLog log(domain);
  domain->Update();
  EXPECT_TRUE(log.Says("2 and 5 touch but have separate domains there: corners are picked for 2."))
    << log.Text;
  EXPECT_EQ(ValuesOf(CellArray(domain->GetPolycube(), "Segment")), (std::set<int>{ 2, 5 }));
}

//------------------------------------------------------------------------------
TEST(PolycubeDomain, SaysWhatIsWrongWithCornersOfSegments)
{
  const vtkNew<vtkPolyData> surface = Boxes(true);
  vtkNew<vtkPolycubeDomain> domain;
  domain->SetInputData(surface);
  domain->SetModeToManual();
  domain->SetNumberOfCubes(1, 1, 1);
  ErrorLog log(domain);
  const std::vector<Corner> corners = BothBoxes();

  domain->SetInputData(1, Points(corners, false));
  ExpectFault(domain, log, "of 2, 5 enter one as Segments");
  ExpectFault(domain, log, "their array Segment says whose each is");
  std::vector<Corner> wrong = corners;
  wrong[3].Segment = 7;
  domain->SetInputData(1, Points(wrong));
  ExpectFault(domain, log, "Corner 3 is of segment 7, which is not among those");
  wrong = corners;
  wrong[12].At[0] = 30.0;
  domain->SetInputData(1, Points(wrong));
  ExpectFault(domain, log, "Segment 5: ");
  ExpectFault(domain, log, "away from the surface");
  wrong = corners;
  wrong.pop_back();
  domain->SetInputData(1, Points(wrong));
  ExpectFault(domain, log, "Segment 5: ");
  ExpectFault(domain, log, "8 corners; 7 were given");
  domain->SetInputData(1, Points({}));
  ExpectFault(domain, log, "has no corners");
  domain->AddSegment(2);
  domain->SetInputData(1, Points({}, false));
  ExpectFault(domain, log, "has no corners");
}
