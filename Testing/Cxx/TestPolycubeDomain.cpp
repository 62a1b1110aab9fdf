// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "DomainChecks.h"

#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkSMPTools.h"

#include <limits>

using namespace trivariate_testing;

//------------------------------------------------------------------------------
TEST(PolycubeDomain, FindsOneCubeWithALayer)
{
  // Alignments are .8312 and, of sharp edges, 1 and .9335.
  const std::pair<Label, double> shapes[] = {
    { [](const double* p) { return int(vtkMath::Norm(p) < 8.0); }, 0.82 },
    { [](const double* p) { return BoxLabel(p, 9, 7, 5); }, 0.95 },
    { [](const double* p) { return int(std::hypot(p[0], p[1]) < 7.0 && std::abs(p[2]) < 8.0); },
      0.88 },
  };
  for (const auto& [inside, aligned] : shapes)
  {
    const vtkNew<vtkPolyData> surface = SurfaceOf(11, inside);
    vtkNew<vtkPolycubeDomain> domain;
    domain->SetInputData(surface);
    domain->Update();
    EXPECT_EQ(domain->GetPolycube()->GetNumberOfPoints(), 16);
    EXPECT_EQ(domain->GetPolycube()->GetNumberOfCells(), 7);
    EXPECT_EQ(domain->GetBorders()->GetNumberOfCells(), 12);
    ExpectSound(domain, surface, { 1 });
    EXPECT_GT(LeastJacobian(domain->GetPolycube()), 0.25);
    const double* alignment = CellArray(domain->GetPolycube(), "Alignment")->GetRange();
    EXPECT_EQ(alignment[0], alignment[1]);
    EXPECT_GT(alignment[0], aligned);
    EXPECT_LT(alignment[0], 1.0);
    EXPECT_EQ(
      ValuesOf(CellArray(domain->GetPolycube(), "Block")), (std::set<int>{ 0, 1, 2, 3, 4, 5, 6 }));
    EXPECT_EQ(
      ValuesOf(CellArray(domain->GetPolycube(), "Patch")), (std::set<int>{ -1, 0, 1, 2, 3, 4, 5 }));

    domain->LayeredOff();
    domain->Update();
    EXPECT_EQ(domain->GetPolycube()->GetNumberOfPoints(), 8);
    EXPECT_EQ(domain->GetPolycube()->GetNumberOfCells(), 1);
    EXPECT_EQ(CellArray(domain->GetPolycube(), "Patch")->GetComponent(0, 0), -1);
    vtkDataArray* at = domain->GetPolycube()->GetPointData()->GetArray("DomainCoordinates");
    for (vtkIdType id = 0; id < 8; ++id)
    {
      EXPECT_EQ(at->GetComponent(id, 0) + 2 * at->GetComponent(id, 1) + 4 * at->GetComponent(id, 2),
        double(id));
    }
    ExpectSound(domain, surface, { 1 });
  }
}

// How far the inner corners of one cube are from the middle, at most.
double InnerRadius(vtkPolyData* surface, double depth)
{
  vtkNew<vtkPolycubeDomain> domain;
  domain->SetInputData(surface);
  domain->SetLayerDepth(depth);
  domain->Update();
  vtkPointSet* polycube = domain->GetPolycube();
  vtkDataArray* ids = polycube->GetPointData()->GetArray("CornerId");
  double most = 0.0;
  for (vtkIdType p = 0; p < polycube->GetNumberOfPoints(); ++p)
  {
    most =
      ids->GetComponent(p, 0) < 0 ? std::max(most, vtkMath::Norm(polycube->GetPoint(p))) : most;
  }
  return most;
}

// On a ball with a radius of 8 voxels.
TEST(PolycubeDomain, MakesLayersAsDeepAsVoxelsTell)
{
  const vtkNew<vtkPolyData> ball = Ball();
  const double* spacing = ball->GetFieldData()->GetArray("VoxelSpacing")->GetTuple3(0);
  EXPECT_EQ(std::vector<double>(spacing, spacing + 3), (std::vector<double>{ 1.0, 1.0, 1.0 }));
  const double radius = 7.8; // between voxels
  for (const double depth : { 1.0, 2.0, 3.0 })
  {
    EXPECT_NEAR(radius - InnerRadius(ball, depth), depth, 0.3);
  }
  // Half of the way, where the ball is too small for so much.
  EXPECT_GT(InnerRadius(ball, 20.0), 0.3 * radius);

  vtkNew<vtkDoubleArray> half;
  half->SetName("VoxelSpacing");
  half->SetNumberOfComponents(3);
  half->InsertNextTuple3(0.25, 0.5, 1.0);
  ball->GetFieldData()->Initialize();
  ball->GetFieldData()->AddArray(half);
  EXPECT_NEAR(radius - InnerRadius(ball, 4.0), 2.0, 0.3);
  // Without it in mean edges, as the automatic depth always is.
  const double automatic = InnerRadius(ball, 0.0);
  EXPECT_GT(std::abs(InnerRadius(ball, 2.5) - automatic), 0.5);
  ball->GetFieldData()->Initialize();
  EXPECT_NEAR(InnerRadius(ball, 2.5), automatic, 1e-9);
  EXPECT_EQ(InnerRadius(ball, 0.0), automatic);
}

TEST(PolycubeDomain, TakesAnyClosedSurface)
{
  const vtkNew<vtkPolyData> surface = Ball();
  for (const bool turned : { false, true })
  {
    vtkNew<vtkPolyData> plain;
    plain->SetPoints(surface->GetPoints());
    vtkNew<vtkCellArray> cells;
    vtkNew<vtkIdList> ids;
    for (vtkIdType cell = 0; cell < surface->GetNumberOfCells(); ++cell)
    {
      surface->GetCellPoints(cell, ids);
      cells->InsertNextCell(
        { ids->GetId(0), ids->GetId(turned ? 2 : 1), ids->GetId(turned ? 1 : 2) });
    }
    plain->SetPolys(cells);
    vtkNew<vtkPolycubeDomain> domain;
    domain->SetInputData(plain);
    domain->Update();
    ExpectSound(domain, surface, { 1 });
    EXPECT_EQ(CellArray(domain->GetPatches(), "BoundaryLabels")->GetComponent(0, 1), 0.0);
  }
}

TEST(PolycubeDomain, TurnsEachSegmentsSurfaceOutward)
{
  const vtkNew<vtkPolyData> surface =
    SurfaceOf(12, [](const double* p) { return BoxLabel(p, 10, 6, 6) ? (p[0] < 1.0 ? 2 : 5) : 0; });
  vtkNew<vtkPolycubeDomain> domain;
  domain->SetInputData(surface);
  domain->Update();
  ExpectSound(domain, surface, { 2, 5 });
  EXPECT_EQ(domain->GetPolycube()->GetNumberOfCells(), 14);

  domain->AddSegment(5);
  domain->Update();
  EXPECT_EQ(domain->GetNumberOfSegments(), 1);
  EXPECT_EQ(domain->GetSegment(0), 5);
  EXPECT_EQ(domain->GetSegment(1), -1);
  ExpectSound(domain, surface, { 5 });
  EXPECT_EQ(ValuesOf(CellArray(domain->GetPolycube(), "Segment")), std::set<int>{ 5 });

  domain->AddSegment(2); // named twice: once is enough
  domain->AddSegment(5);
  domain->Update();
  ExpectSound(domain, surface, { 2, 5 });
  EXPECT_EQ(domain->GetPolycube()->GetNumberOfCells(), 14);
  EXPECT_EQ(domain->GetPolycube()->GetNumberOfPoints(), 4 * 8 - 4);
}

TEST(PolycubeDomain, SharesTheSurfaceBetweenNestedSegments)
{
  const vtkNew<vtkPolyData> surface = SurfaceOf(14,
    [](const double* p)
    {
      const double r = vtkMath::Norm(p);
      return r < 5.0 ? 3 : r < 9.0 ? 1 : r < 13.0 ? 2 : 0;
    });
  vtkNew<vtkPolycubeDomain> domain;
  domain->SetInputData(surface);
  domain->Update();
  ExpectSound(domain, surface, { 3, 1, 2 });
  vtkUnstructuredGrid* blocks = domain->GetPolycube();
  EXPECT_EQ(blocks->GetNumberOfPoints(), 4 * 8);
  EXPECT_EQ(blocks->GetNumberOfCells(), 7 + 6 + 6);
  EXPECT_GT(LeastJacobian(blocks), 0.2);
  EXPECT_EQ(domain->GetBorders()->GetNumberOfCells(), 36);
  // A patch between two segments bounds both, of one at the low and of the other at the high end.
  std::map<int, std::set<std::array<int, 3>>> owners;
  for (vtkIdType cell = 0; cell < domain->GetPatches()->GetNumberOfCells(); ++cell)
  {
    const auto value = [&](const char* name)
    { return static_cast<int>(CellArray(domain->GetPatches(), name)->GetComponent(cell, 0)); };
    owners[value("Patch")].insert({ value("Segment"), value("PatchAxis"), value("PatchSide") });
  }
  EXPECT_EQ(owners.size(), 18u);
  int shared = 0;
  for (const auto& [patch, sides] : owners)
  {
    shared += sides.size() == 2;
    if (sides.size() == 2)
    {
      EXPECT_EQ((*sides.begin())[1], (*sides.rbegin())[1]);
      EXPECT_NE((*sides.begin())[2], (*sides.rbegin())[2]);
    }
  }
  EXPECT_EQ(shared, 12);

  // A shell around what has no domain of its own.
  domain->AddSegment(1);
  domain->Update();
  ExpectSound(domain, surface, { 1 });
  EXPECT_EQ(domain->GetPolycube()->GetNumberOfCells(), 6);
  EXPECT_EQ(domain->GetPolycube()->GetNumberOfPoints(), 16);
}

//------------------------------------------------------------------------------
TEST(PolycubeDomain, DoesNotDependOnThreadsOrPieces)
{
  const vtkNew<vtkPolyData> surface = Ball();
  const auto run = [&surface](int threads, int pieces)
  {
    vtkSMPTools::Initialize(threads);
    vtkNew<vtkPolycubeDomain> domain;
    domain->SetInputData(surface);
    domain->UpdatePiece(0, pieces, 0);
    vtkNew<vtkUnstructuredGrid> blocks;
    blocks->DeepCopy(domain->GetPolycube());
    domain->UpdatePiece(pieces - 1, pieces, 0);
    EXPECT_EQ(domain->GetPatches()->GetNumberOfPoints() == 0, pieces > 1);
    vtkSMPTools::Initialize(0);
    return blocks;
  };
  const vtkNew<vtkUnstructuredGrid> one = run(1, 1);
  for (const auto& [threads, pieces] : { std::pair(2, 1), std::pair(3, 2) })
  {
    const vtkNew<vtkUnstructuredGrid> other = run(threads, pieces);
    ASSERT_EQ(one->GetNumberOfPoints(), other->GetNumberOfPoints());
    for (vtkIdType id = 0; id < one->GetNumberOfPoints(); ++id)
    {
      for (int i = 0; i < 3; ++i)
      {
        ASSERT_EQ(one->GetPoint(id)[i], other->GetPoint(id)[i]);
      }
    }
  }
}

TEST(PolycubeDomain, ReportsProgressAndStops)
{
  const vtkNew<vtkPolyData> surface = Ball();
  vtkNew<vtkPolycubeDomain> domain;
  domain->SetInputData(surface);
  vtkNew<vtkCallbackCommand> stop;
  stop->SetCallback(
    [](vtkObject* caller, unsigned long, void*, void*)
    {
      auto* algorithm = static_cast<vtkAlgorithm*>(caller);
      if (algorithm->GetProgress() > 0.0)
      {
        algorithm->SetAbortExecute(1);
      }
    });
  domain->AddObserver(vtkCommand::ProgressEvent, stop);
  domain->Update();
  EXPECT_EQ(domain->GetPatches()->GetNumberOfCells(), 0);
  // Nor is a search begun now, which nothing could stop.
  EXPECT_EQ(domain->GetStartCorners()->GetNumberOfTuples(), 1);
}

TEST(PolycubeDomain, SaysWhatIsWrongWithASurface)
{
  vtkNew<vtkPolycubeDomain> domain;
  ErrorLog log(domain);
  vtkNew<vtkPolyData> empty;
  domain->SetInputData(empty);
  ExpectFault(domain, log, "no triangles");

  const vtkNew<vtkPolyData> ball = Ball();
  vtkNew<vtkPolyData> lines;
  lines->DeepCopy(ball);
  lines->SetLines(ball->GetPolys());
  domain->SetInputData(lines);
  ExpectFault(domain, log, "other than triangles");

  vtkNew<vtkPolyData> open;
  open->SetPoints(ball->GetPoints());
  vtkNew<vtkCellArray> some;
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 1; cell < ball->GetNumberOfCells(); ++cell)
  {
    ball->GetCellPoints(cell, ids);
    some->InsertNextCell(ids);
  }
  open->SetPolys(some);
  domain->SetInputData(open);
  ExpectFault(domain, log, "Segment 1: ");

  vtkNew<vtkPolyData> winged; // three triangles at an edge
  winged->DeepCopy(ball);
  ball->GetCellPoints(0, ids);
  winged->GetPolys()->InsertNextCell({ ids->GetId(0), ids->GetId(1), ids->GetId(2) });
  winged->GetCellData()->Initialize();
  domain->SetInputData(winged);
  ExpectFault(domain, log, "Segment 1: ");

  vtkNew<vtkPolyData> astray;
  astray->DeepCopy(ball);
  astray->GetPoints()->SetPoint(17, 0.0, std::numeric_limits<double>::quiet_NaN(), 0.0);
  domain->SetInputData(astray);
  ExpectFault(domain, log, "Point 17 is not finite");

  domain->SetInputData(ball);
  domain->AddSegment(7);
  ExpectFault(domain, log, "Segment 7: There is none such; the surface has: 1.");
  domain->ClearSegments();
  domain->AddSegment(0);
  ExpectFault(domain, log, "Segment 0: Its surface is seen from inside");
  domain->SetModeToManual();
  ExpectFault(domain, log, "Segment 0: Its surface is seen from inside");
  domain->SetModeToAutomatic();
  domain->ClearSegments();

  const vtkNew<vtkPolyData> two = SurfaceOf(
    11, [](const double* p) { return int(std::hypot(std::abs(p[0]) - 6.0, p[1], p[2]) < 4.0); });
  domain->SetInputData(two);
  ExpectFault(domain, log, "2 pieces, 0 of them around cavities");

  // And after all that a good one.
  domain->SetInputData(ball);
  domain->Update();
  EXPECT_EQ(domain->GetPolycube()->GetNumberOfCells(), 7);
}
