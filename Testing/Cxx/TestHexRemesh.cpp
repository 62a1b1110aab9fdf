// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "DomainChecks.h"
#include "WarningLog.h"
#include "vtkHexRemesh.h"

#include "vtkCallbackCommand.h"
#include "vtkCellLocator.h"
#include "vtkDoubleArray.h"
#include "vtkIdTypeArray.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkSMPTools.h"
#include "vtkStructuredGrid.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace
{
using namespace trivariate_testing;

// An image around the origin with the array "linear".
vtkNew<vtkImageData> LinearImage()
{
  vtkNew<vtkImageData> image;
  image->SetExtent(-12, 12, -12, 12, -12, 12);
  vtkNew<vtkDoubleArray> linear;
  linear->SetName("linear");
  linear->SetNumberOfComponents(2);
  vtkNew<vtkIntArray> segment;
  segment->SetName("Segment");
  for (vtkIdType id = 0; id < image->GetNumberOfPoints(); ++id)
  {
    const double* p = image->GetPoint(id);
    linear->InsertNextTuple2(p[0] + 2.0 * p[1], p[2]);
    segment->InsertNextValue(1);
  }
  image->GetPointData()->AddArray(linear);
  image->GetPointData()->AddArray(segment);
  vtkNew<vtkDoubleArray> solved; // not to be interpolated
  solved->SetName("FrameParameter");
  solved->SetNumberOfTuples(image->GetNumberOfPoints());
  solved->Fill(0.0);
  image->GetPointData()->AddArray(solved);
  return image;
}

struct Remeshed
{
  explicit Remeshed(vtkPolyData* surface, bool layered = true)
  {
    this->Domain->SetInputData(surface);
    this->Domain->SetLayered(layered);
    this->Filter->SetInputDataObject(0, LinearImage());
    this->Filter->SetInputConnection(1, this->Domain->GetOutputPort(0));
    this->Filter->SetInputConnection(2, this->Domain->GetOutputPort(1));
  }

  vtkStructuredGrid* Grid(unsigned int block)
  {
    return vtkStructuredGrid::SafeDownCast(this->Blocks()->GetPartition(block, 0));
  }

  vtkPartitionedDataSetCollection* Blocks()
  {
    return vtkPartitionedDataSetCollection::SafeDownCast(this->Filter->GetOutputDataObject(0));
  }

  vtkNew<vtkPolycubeDomain> Domain;
  vtkNew<vtkHexRemesh> Filter;
};

double VolumeOfCells(vtkUnstructuredGrid* grid, int segment)
{
  double volume = 0.0;
  for (vtkIdType cell = 0; cell < grid->GetNumberOfCells(); ++cell)
  {
    if (CellArray(grid, "Segment")->GetComponent(cell, 0) == segment)
    {
      volume += vtkMeshQuality::HexVolume(grid->GetCell(cell));
    }
  }
  return volume;
}
}

TEST(HexRemesh, FillsABall)
{
  const vtkNew<vtkPolyData> surface = Ball();
  Remeshed mesh(surface);
  mesh.Filter->SetEdgeLength(1.0);
  mesh.Filter->Update();
  vtkUnstructuredGrid* hexes = mesh.Filter->GetHexahedra();
  ASSERT_EQ(mesh.Blocks()->GetNumberOfPartitionedDataSets(), 7u);
  EXPECT_EQ(mesh.Filter->GetInvertedCells(), 0);
  EXPECT_GT(mesh.Filter->GetLeastScaledJacobian(), 0.3);
  EXPECT_GT(mesh.Filter->GetMeanScaledJacobian(), 0.9);
  EXPECT_NEAR(LeastJacobian(hexes), mesh.Filter->GetLeastScaledJacobian(), 1e-6);
  EXPECT_NEAR(VolumeOfCells(hexes, 1), VolumeOf(surface, 1), 0.003 * VolumeOf(surface, 1));

  // One number, one place, and the values of the image there.
  std::map<vtkIdType, Place> placeOf;
  vtkIdType cells = 0;
  for (unsigned int b = 0; b < 7; ++b)
  {
    vtkStructuredGrid* grid = mesh.Grid(b);
    ASSERT_NE(grid, nullptr);
    cells += grid->GetNumberOfCells();
    EXPECT_EQ(ValuesOf(CellArray(grid, "Segment")), std::set<int>{ 1 });
    EXPECT_EQ(ValuesOf(CellArray(grid, "Block")), std::set<int>{ int(b) });
    vtkDataArray* linear = grid->GetPointData()->GetArray("linear");
    ASSERT_NE(linear, nullptr);
    EXPECT_EQ(grid->GetPointData()->GetArray("Segment"), nullptr);
    EXPECT_EQ(grid->GetPointData()->GetArray("FrameParameter"), nullptr);
    for (vtkIdType p = 0; p < grid->GetNumberOfPoints(); ++p)
    {
      Place x;
      grid->GetPoint(p, x.data());
      const auto node =
        static_cast<vtkIdType>(grid->GetPointData()->GetArray("Node")->GetComponent(p, 0));
      EXPECT_EQ(placeOf.emplace(node, x).first->second, x);
      EXPECT_NEAR(linear->GetComponent(p, 0), x[0] + 2.0 * x[1], 1e-9);
      EXPECT_NEAR(linear->GetComponent(p, 1), x[2], 1e-9);
    }
  }
  EXPECT_EQ(cells, hexes->GetNumberOfCells());
  EXPECT_EQ(static_cast<vtkIdType>(placeOf.size()), hexes->GetNumberOfPoints());
}

// Nodes leave the surface so that straight cells hold what lies outside of their chords.
TEST(HexRemesh, HoldsTheVolume)
{
  const vtkNew<vtkPolyData> surface = Ball();
  const double volume = VolumeOf(surface, 1);
  Remeshed mesh(surface);
  const WarningLog warnings(mesh.Filter);
  for (const auto& [edge, share] : { std::pair(2.0, 0.002), { 1.0, 0.002 }, { 0.5, 0.002 } })
  {
    mesh.Filter->SetEdgeLength(edge);
    mesh.Filter->Update();
    vtkUnstructuredGrid* cells = mesh.Filter->GetHexahedra();
    EXPECT_NEAR(VolumeOfCells(cells, 1), volume, share * volume) << edge;
    for (const char* distance : { "PatchDistance", "FaceDistance" })
    {
      EXPECT_LT(cells->GetFieldData()->GetArray(distance)->GetComponent(0, 1), 0.5) << edge;
    }
  }
  EXPECT_EQ(warnings.Text, "");
}

// Of shapes with other proportions and with sharp edges surface and cells are nowhere half a voxel
// apart either.
TEST(HexRemesh, IsOnTheSurface)
{
  const auto ellipsoid = [](const double* p)
  { return std::pow(p[0] / 9.6, 2) + std::pow(p[1] / 6.3, 2) + std::pow(p[2] / 7.4, 2) < 1.0; };
  const auto cylinder = [](const double* p)
  { return std::hypot(p[0], p[1]) < 6.4 && std::abs(p[2]) < 8.5; };
  const auto box = [](const double* p)
  { return std::abs(p[0]) < 8.5 && std::abs(p[1]) < 5.5 && std::abs(p[2]) < 6.5; };
  for (const std::function<int(const double*)>& shape :
    std::vector<std::function<int(const double*)>>{ ellipsoid, cylinder, box })
  {
    const vtkNew<vtkPolyData> surface = SurfaceOf(11, shape);
    Remeshed mesh(surface);
    const WarningLog warnings(mesh.Filter);
    mesh.Filter->SetEdgeLength(1.0);
    mesh.Filter->Update();
    vtkUnstructuredGrid* cells = mesh.Filter->GetHexahedra();
    EXPECT_EQ(mesh.Filter->GetInvertedCells(), 0);
    EXPECT_EQ(warnings.Text, "");
    EXPECT_NEAR(VolumeOfCells(cells, 1), VolumeOf(surface, 1), 0.005 * VolumeOf(surface, 1));
    for (const char* distance : { "PatchDistance", "FaceDistance" })
    {
      EXPECT_LT(cells->GetFieldData()->GetArray(distance)->GetComponent(0, 1), 0.5) << distance;
    }
  }
}

TEST(HexRemesh, WarnsOfLimbsThatItDoesNotReach)
{
  const vtkNew<vtkPolyData> surface = SurfaceOf(11, [](const double* p)
    { return vtkMath::Norm(p) < 4.5 || (std::hypot(p[0], p[1]) < 0.8 && std::abs(p[2]) < 10.5); });
  Remeshed mesh(surface);
  const WarningLog warnings(mesh.Filter);
  mesh.Filter->SetEdgeLength(1.5);
  mesh.Filter->Update();
  EXPECT_TRUE(warnings.Says("from the surface, more than they are long (1.5)")) << warnings.Text;
}

TEST(HexRemesh, SharesTheNodesBetweenSegments)
{
  const vtkNew<vtkPolyData> surface = SurfaceOf(11,
    [](const double* p) { return vtkMath::Norm(p) < 4.5   ? 2
                                 : vtkMath::Norm(p) < 9.5 ? 1
                                                          : 0; });
  Remeshed mesh(surface);
  mesh.Filter->SetEdgeLength(1.0);
  mesh.Filter->Update();
  vtkUnstructuredGrid* hexes = mesh.Filter->GetHexahedra();
  EXPECT_EQ(mesh.Filter->GetInvertedCells(), 0);
  EXPECT_EQ(ValuesOf(CellArray(hexes, "Segment")), (std::set<int>{ 1, 2 }));
  for (const int segment : { 1, 2 })
  {
    const double volume = VolumeOf(surface, segment);
    EXPECT_NEAR(VolumeOfCells(hexes, segment), volume, 0.02 * volume);
  }
  // Each inner face has two cells: the boundary of all is only that of the outer surface.
  std::set<vtkIdType> inner, outer;
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < hexes->GetNumberOfCells(); ++cell)
  {
    hexes->GetCellPoints(cell, ids);
    const bool isInner = CellArray(hexes, "Segment")->GetComponent(cell, 0) == 2;
    for (vtkIdType i = 0; i < 8; ++i)
    {
      (isInner ? inner : outer).insert(ids->GetId(i));
    }
  }
  int shared = 0;
  for (const vtkIdType node : inner)
  {
    shared += outer.count(node) > 0;
    if (outer.count(node))
    {
      EXPECT_NEAR(vtkMath::Norm(hexes->GetPoint(node)), 4.5, 0.8);
    }
  }
  EXPECT_GT(shared, 100);
}

// Of two cubes; the second one is left-handed, and its sharp edges hold it so.
TEST(HexRemesh, NamesTheSegmentOfInvertedCells)
{
  const vtkNew<vtkPolyData> surface = SurfaceOf(11,
    [](const double* p)
    {
      const bool inside = std::abs(p[1]) < 4 && std::abs(p[2]) < 4 && std::abs(p[0]) < 10;
      return inside && std::abs(p[0]) > 2 ? (p[0] < 0 ? 1 : 2) : 0;
    });
  Remeshed mesh(surface, false);
  mesh.Domain->Update();
  vtkNew<vtkUnstructuredGrid> polycube;
  polycube->DeepCopy(mesh.Domain->GetPolycube());
  ASSERT_EQ(polycube->GetNumberOfCells(), 2);
  ASSERT_EQ(CellArray(polycube, "Segment")->GetComponent(1, 0), 2);
  vtkNew<vtkIdList> ids;
  polycube->GetCellPoints(1, ids);
  const std::vector<vtkIdType> was(ids->begin(), ids->end());
  std::rotate_copy(was.begin(), was.begin() + 4, was.end(), ids->begin());
  polycube->GetCells()->ReplaceCellAtId(1, ids);
  mesh.Filter->SetInputDataObject(2, polycube);
  mesh.Filter->SetCellsPerBlock(4);
  const WarningLog warnings(mesh.Filter);
  mesh.Filter->Update();
  EXPECT_GT(mesh.Filter->GetInvertedCells(), 32);
  EXPECT_TRUE(warnings.Says(
    "cells are inverted (segment 2: " + std::to_string(mesh.Filter->GetInvertedCells()) + ")."))
    << warnings.Text;
}

TEST(HexRemesh, ResamplesGivenMeshes)
{
  const vtkNew<vtkPolyData> surface = Ball();
  Remeshed coarse(surface);
  coarse.Filter->SetEdgeLength(2.0);
  coarse.Filter->Update();
  Remeshed fine(surface);
  fine.Filter->SetInputConnection(3, coarse.Filter->GetOutputPort(0));
  fine.Filter->SetCellsPerBlock(6);
  fine.Filter->Update();
  EXPECT_EQ(fine.Filter->GetHexahedra()->GetNumberOfCells(), 7 * 216);
  EXPECT_EQ(fine.Filter->GetInvertedCells(), 0);
  vtkNew<vtkCellLocator> locator;
  locator->SetDataSet(fine.Domain->GetPatches());
  locator->BuildLocator();
  // The ends of the first layer's grid on its patch are on the surface, to 0.45 voxels.
  for (unsigned int b = 1; b < 7; ++b)
  {
    vtkStructuredGrid* grid = fine.Grid(b);
    int near = 0;
    for (vtkIdType p = 0; p < grid->GetNumberOfPoints(); ++p)
    {
      double x[3], nearest[3], square;
      vtkIdType cell;
      int sub;
      grid->GetPoint(p, x);
      locator->FindClosestPoint(x, nearest, cell, sub, square);
      near += square < 0.45 * 0.45 + 1e-9;
    }
    EXPECT_GE(near, 49);
  }
}

TEST(HexRemesh, IsTheSameOnOneThread)
{
  const vtkNew<vtkPolyData> surface = Ball();
  Remeshed threaded(surface), alone(surface);
  threaded.Filter->Update();
  const vtkSMPTools::Config one{ 1, "STDThread", false };
  vtkSMPTools::LocalScope(one, [&alone]() { alone.Filter->Update(); });
  vtkUnstructuredGrid *a = threaded.Filter->GetHexahedra(), *b = alone.Filter->GetHexahedra();
  ASSERT_EQ(a->GetNumberOfPoints(), b->GetNumberOfPoints());
  for (vtkIdType p = 0; p < a->GetNumberOfPoints(); ++p)
  {
    for (int c = 0; c < 3; ++c)
    {
      ASSERT_EQ(a->GetPoint(p)[c], b->GetPoint(p)[c]) << p;
    }
  }
}

TEST(HexRemesh, StopsWhenAbortedAndRunsAgain)
{
  const vtkNew<vtkPolyData> surface = Ball();
  Remeshed mesh(surface);
  vtkNew<vtkCallbackCommand> stop;
  stop->SetCallback(
    [](vtkObject* caller, unsigned long, void*, void*)
    {
      auto* filter = vtkAlgorithm::SafeDownCast(caller);
      filter->SetAbortExecute(filter->GetProgress() > 0.1);
    });
  const unsigned long observer = mesh.Filter->AddObserver(vtkCommand::ProgressEvent, stop);
  mesh.Filter->Update();
  EXPECT_NE(mesh.Filter->GetAbortExecute(), 0);
  EXPECT_EQ(mesh.Filter->GetHexahedra()->GetNumberOfCells(), 0);
  mesh.Filter->RemoveObserver(observer);
  mesh.Filter->SetAbortExecute(0);
  mesh.Filter->Modified();
  mesh.Filter->Update();
  EXPECT_GT(mesh.Filter->GetHexahedra()->GetNumberOfCells(), 100);
  EXPECT_EQ(mesh.Filter->GetInvertedCells(), 0);
}

TEST(HexRemesh, SaysWhatIsWrong)
{
  const vtkNew<vtkPolyData> surface = Ball();
  {
    Remeshed mesh(surface);
    ErrorLog errors(mesh.Filter);
    mesh.Filter->SetMostCells(10);
    mesh.Filter->Update();
    EXPECT_NE(errors.TakeOnly().find("choose a larger EdgeLength"), std::string::npos);
    mesh.Filter->SetCellsPerBlock(6);
    mesh.Filter->Update();
    EXPECT_NE(errors.TakeOnly().find("choose fewer CellsPerBlock"), std::string::npos);
    mesh.Filter->SetCellsPerBlock(0);
    for (const double tiny : { 1e-4, 1e-8, 1e-20, 1e-300 })
    {
      mesh.Filter->SetEdgeLength(tiny);
      mesh.Filter->Update();
      const std::string error = errors.TakeOnly();
      EXPECT_NE(error.find("choose a larger EdgeLength"), std::string::npos) << tiny;
      EXPECT_EQ(error.find("have -"), std::string::npos) << error;
    }
  }
  {
    Remeshed mesh(surface);
    mesh.Filter->Update();
    EXPECT_GT(mesh.Filter->GetMeanScaledJacobian(), 0.0);
    ErrorLog errors(mesh.Filter);
    const vtkNew<vtkImageData> elsewhere = LinearImage();
    elsewhere->SetOrigin(9.0, 0.0, 0.0);
    vtkNew<vtkImageData> empty;
    for (const auto& [image, words] :
      { std::pair(elsewhere.Get(), "voxels out of the image"), { empty.Get(), "has no points" } })
    {
      mesh.Filter->SetInputDataObject(0, image);
      mesh.Filter->Update();
      EXPECT_NE(errors.TakeOnly().find(words), std::string::npos);
      EXPECT_EQ(mesh.Filter->GetMeanScaledJacobian(), 0.0);
      EXPECT_EQ(mesh.Filter->GetHexahedra()->GetNumberOfCells(), 0);
    }
  }
  {
    Remeshed mesh(surface);
    const vtkNew<vtkImageData> holes = LinearImage();
    vtkDataArray* linear = holes->GetPointData()->GetArray("linear");
    linear->SetComponent(holes->GetNumberOfPoints() / 2, 1, std::nan("")); // in the middle
    const WarningLog warnings(mesh.Filter);
    mesh.Filter->SetInputDataObject(0, holes);
    mesh.Filter->Update();
    EXPECT_TRUE(warnings.Says("The array \"linear\" is not finite at ")) << warnings.Text;
  }
  {
    Remeshed mesh(surface);
    ErrorLog errors(mesh.Filter);
    vtkNew<vtkUnstructuredGrid> empty;
    mesh.Filter->SetInputDataObject(2, empty);
    mesh.Filter->Update();
    EXPECT_NE(errors.TakeOnly().find("come from Polycube Domain"), std::string::npos);
  }
  {
    Remeshed mesh(surface);
    ErrorLog errors(mesh.Filter);
    vtkNew<vtkPartitionedDataSetCollection> none;
    mesh.Filter->SetInputDataObject(3, none);
    mesh.Filter->Update();
    EXPECT_NE(errors.TakeOnly().find("0 block meshes for 7 blocks"), std::string::npos);
  }
}
