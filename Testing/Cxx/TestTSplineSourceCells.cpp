// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "SplineModels.h"
#include "TSpline/BisectionMesh.h"
#include "TSpline/Evaluator.h"

#include "vtkCellData.h"
#include "vtkGenericCell.h"
#include "vtkImageData.h"
#include "vtkMath.h"
#include "vtkMeshQuality.h"
#include "vtkPolyData.h"
#include "vtkTessellatorFilter.h"

#include <gtest/gtest.h>

#include <cstring>

namespace
{
using namespace trivariate;

const double Pi = std::acos(-1.0);

// The sum of the volumes of linear hexahedra or tetrahedra.
double Volume(vtkUnstructuredGrid* grid)
{
  vtkNew<vtkMeshQuality> quality;
  quality->SetInputData(grid);
  quality->SetHexQualityMeasureToVolume();
  quality->SetTetQualityMeasureToVolume();
  quality->Update();
  vtkDataArray* volumes = quality->GetOutput()->GetCellData()->GetArray("Quality");
  double sum = 0.0;
  for (vtkIdType i = 0; i < volumes->GetNumberOfTuples(); ++i)
  {
    EXPECT_GT(volumes->GetTuple1(i), 0.0);
    sum += volumes->GetTuple1(i);
  }
  return sum;
}

// What the arrays of the quarter annulus must be at a point in space.
void ExpectAnnulusValues(vtkDataSet* data, double tolerance)
{
  vtkDataArray* radial = PointArray(data, "Radial");
  vtkDataArray* linear = PointArray(data, "Linear");
  ASSERT_TRUE(radial && linear);
  ASSERT_EQ(data->GetPointData()->GetScalars(), radial);
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
  {
    double x[3];
    data->GetPoint(i, x);
    ASSERT_NEAR(radial->GetTuple1(i), x[0] * x[0] + x[1] * x[1], tolerance);
    ASSERT_NEAR(linear->GetComponent(i, 0), x[0] + 2.0 * x[1], tolerance);
    ASSERT_NEAR(linear->GetComponent(i, 1), x[2], tolerance);
  }
}

// Where the domain is an L, functions reach into the corner that is no part of it, but no cell, no
// surface and no point of an image is there; a copy through grid and file has the hole too.
TEST(TSplineSourceCells, LeaveOutTheHoleOfAnEll)
{
  for (int rounds = 0; rounds < 8; rounds += 4)
  {
    vtkNew<vtkUnstructuredGrid> grid;
    TSplineToGrid(Ell(rounds), grid);
    const TSplineModel again = TSplineFromGrid(grid);
    ASSERT_EQ(again.Spline.Holes.size(), 1u);
    EXPECT_EQ(again.Spline.KnotLines[0][again.Spline.Holes[0].Low[0]], 1.0);
    EXPECT_EQ(again.Spline.KnotLines[1][again.Spline.Holes[0].High[1]], 2.0);
    vtkNew<vtkTSplineSource> source;
    source->SetInputData(grid);
    source->SetOutputType(vtkTSplineSource::LINEAR_HEXES);
    source->SetSubdivisions(2);
    source->Update();
    EXPECT_NEAR(
      Volume(vtkUnstructuredGrid::SafeDownCast(source->GetOutputDataObject(0))), 3.0, 1e-12);

    vtkNew<vtkImageData> lattice;
    lattice->SetDimensions(9, 9, 5);
    lattice->SetOrigin(0.05, 0.05, 0.05);
    lattice->SetSpacing(0.24, 0.24, 0.22);
    source->SetOutputType(vtkTSplineSource::IMAGE);
    source->SetInputData(1, lattice);
    source->Update();
    auto* image = vtkImageData::SafeDownCast(source->GetOutputDataObject(0));
    vtkDataArray *bend = PointArray(image, "Bend"), *valid = PointArray(image, "vtkValidPointMask");
    ASSERT_TRUE(bend && valid);
    for (vtkIdType id = 0; id < image->GetNumberOfPoints(); ++id)
    {
      double x[3];
      image->GetPoint(id, x);
      const bool isInside = x[0] <= 1.0 || x[1] <= 1.0;
      EXPECT_EQ(valid->GetTuple1(id) != 0.0, isInside) << x[0] << " " << x[1];
      if (isInside)
      {
        EXPECT_NEAR(bend->GetTuple1(id), x[0] * x[0] + x[1] * x[2], 1e-10);
      }
    }
  }
}

TEST(TSplineSourceCells, LinearHexahedraConvergeToTheVolumeOfTheAnnulus)
{
  for (unsigned seed = 1; seed <= 3; ++seed)
  {
    const TSplineModel model = QuarterAnnulus(4, seed);
    const BezierMesh cells(model.Spline);
    double before = 0.0;
    for (const int n : { 1, 2, 4, 8 })
    {
      auto source = MakeSource(model, vtkTSplineSource::LINEAR_HEXES);
      source->SetSubdivisions(n);
      source->Update();
      auto* grid = vtkUnstructuredGrid::SafeDownCast(source->GetOutput());
      ASSERT_EQ(grid->GetNumberOfCells(), cells.Size() * n * n * n);
      const double error = 3.0 * Pi / 4.0 - Volume(grid);
      // Chords lie inside of the arc; halving them quarters the error.
      EXPECT_GT(error, 0.0);
      EXPECT_LT(error, 1.0 / (n * n));
      if (n > 1)
      {
        EXPECT_NEAR(before / error, 4.0, 0.5);
      }
      before = error;
    }
    EXPECT_LT(before, 4e-3);
  }
}

TEST(TSplineSourceCells, HexahedraCarryTheSplineAndItsCells)
{
  const TSplineModel model = QuarterAnnulus(6, 7);
  auto source = MakeSource(model, vtkTSplineSource::LINEAR_HEXES);
  source->SetSubdivisions(3);
  source->Update();
  auto* grid = vtkUnstructuredGrid::SafeDownCast(source->GetOutput());
  ExpectAnnulusValues(grid, 1e-13);
  vtkDataArray* parameter = PointArray(grid, "Parameter");
  for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i)
  {
    double x[3], u[3];
    grid->GetPoint(i, x);
    parameter->GetTuple(i, u);
    ASSERT_NEAR(std::hypot(x[0], x[1]), 1.0 + u[0], 1e-13);
    ASSERT_NEAR(x[2], u[2], 1e-13);
  }
  const BezierMesh cells(model.Spline);
  vtkDataArray* bounds = grid->GetCellData()->GetArray("ParametricBounds");
  vtkDataArray* level = grid->GetCellData()->GetArray("Level");
  for (vtkIdType i = 0; i < grid->GetNumberOfCells(); ++i)
  {
    double b[6];
    bounds->GetTuple(i, b);
    const auto expected = cells.Bounds(i / 27);
    ASSERT_EQ(std::memcmp(b, expected.data(), sizeof(b)), 0);
    // One root cell of volume 1, halved once a level.
    const double volume = (b[1] - b[0]) * (b[3] - b[2]) * (b[5] - b[4]);
    ASSERT_EQ(level->GetTuple1(i), -std::log2(volume));
    vtkNew<vtkIdList> ids;
    grid->GetCellPoints(i, ids);
    for (vtkIdType j = 0; j < 8; ++j)
    {
      for (int a = 0; a < 3; ++a)
      {
        const double u = parameter->GetComponent(ids->GetId(j), a);
        ASSERT_GE(u, b[2 * a] - 1e-14);
        ASSERT_LE(u, b[2 * a + 1] + 1e-14);
      }
    }
  }
}

// The cells that bisection left, not the Bezier cells, from what the grid alone tells.
TEST(TSplineSourceCells, TMeshOfAnAnalysisSuitableSplineIsWhatBisectionLeft)
{
  for (unsigned seed = 1; seed <= 5; ++seed)
  {
    TSplineModel model;
    const KnotLine line = MakeUniformKnotLine(0.0, 33.0, 32);
    model.Spline = MakeTensorProduct({ line, line, line }, { 8, 8, 8 }, 0);
    model.RootCells = { 4, 4, 4 };
    RefineRandomly(model.Spline, 4, seed, MakeAnalysisSuitableRule(model.Spline));
    FinishModel(model);
    const auto expected = BisectionMesh::Recover(model.Spline, model.RootCells);
    ASSERT_GT(expected.size(), 64u);
    const BezierMesh bezier(model.Spline);
    ASSERT_LT(static_cast<Index>(expected.size()), bezier.Size());

    auto source = MakeSource(model, vtkTSplineSource::TMESH);
    source->Update();
    auto* grid = vtkUnstructuredGrid::SafeDownCast(source->GetOutput());
    ASSERT_EQ(grid->GetNumberOfCells(), static_cast<vtkIdType>(expected.size()));
    EXPECT_NEAR(Volume(grid), 33.0 * 33.0 * 33.0, 1e-8); // no gap, no overlap
    vtkDataArray* bounds = grid->GetCellData()->GetArray("ParametricBounds");
    vtkDataArray* level = grid->GetCellData()->GetArray("Level");
    for (vtkIdType i = 0; i < grid->GetNumberOfCells(); ++i)
    {
      double b[6], x[6];
      bounds->GetTuple(i, b);
      grid->GetCellBounds(i, x); // the geometry is the identity
      double volume = 1.0;
      for (int a = 0; a < 3; ++a)
      {
        EXPECT_NEAR(b[2 * a], line[expected[i].Low[a]], 1e-12);
        EXPECT_NEAR(b[2 * a + 1], line[expected[i].High[a]], 1e-12);
        EXPECT_NEAR(x[2 * a], b[2 * a], 1e-12);
        EXPECT_NEAR(x[2 * a + 1], b[2 * a + 1], 1e-12);
        volume *= (b[2 * a + 1] - b[2 * a]) / (33.0 / 4.0);
      }
      EXPECT_NEAR(level->GetTuple1(i), -std::log2(volume), 1e-9);
    }
  }
}

TEST(TSplineSourceCells, TMeshHasOneHexahedronACell)
{
  const TSplineModel model = QuarterAnnulus(5, 3);
  auto source = MakeSource(model, vtkTSplineSource::TMESH);
  source->SetSubdivisions(4); // no effect
  source->Update();
  auto* grid = vtkUnstructuredGrid::SafeDownCast(source->GetOutput());
  EXPECT_EQ(grid->GetNumberOfCells(), BezierMesh(model.Spline).Size());
  EXPECT_EQ(grid->GetCellType(0), VTK_HEXAHEDRON);
  ExpectAnnulusValues(grid, 1e-13);
}

TEST(TSplineSourceCells, BezierCellsAreTheSplineItself)
{
  for (unsigned seed = 1; seed <= 5; ++seed)
  {
    const TSplineModel model = QuarterAnnulus(4, seed);
    auto source = MakeSource(model, vtkTSplineSource::BEZIER_HEXES);
    source->Update();
    auto* grid = vtkUnstructuredGrid::SafeDownCast(source->GetOutput());
    const BezierMesh cells(model.Spline);
    const Evaluator evaluator(model.Spline, cells, { 0, 1, 2, 3 });
    ASSERT_EQ(grid->GetNumberOfCells(), cells.Size());
    vtkDataArray* radial = PointArray(grid, "Radial");
    vtkDataArray* bounds = grid->GetCellData()->GetArray("ParametricBounds");
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    vtkNew<vtkGenericCell> cell;
    std::vector<double> shape(64);
    for (vtkIdType i = 0; i < grid->GetNumberOfCells(); ++i)
    {
      ASSERT_EQ(grid->GetCellType(i), VTK_BEZIER_HEXAHEDRON);
      grid->GetCell(i, cell);
      const double r[3] = { share(random), share(random), share(random) };
      double u[3], b[6], expected[4], x[3], field = 0.0;
      bounds->GetTuple(i, b);
      for (int a = 0; a < 3; ++a)
      {
        u[a] = b[2 * a] + r[a] * (b[2 * a + 1] - b[2 * a]);
      }
      EvaluatorOutput output;
      output.Values = expected;
      ASSERT_TRUE(evaluator.Evaluate(u, output));
      int subId = 0;
      cell->EvaluateLocation(subId, r, x, shape.data());
      for (int j = 0; j < 64; ++j)
      {
        field += shape[j] * radial->GetTuple1(cell->GetPointId(j));
      }
      for (int a = 0; a < 3; ++a)
      {
        EXPECT_NEAR(x[a], expected[a], 1e-12);
      }
      EXPECT_NEAR(field, expected[3], 1e-12);
    }
  }
}

TEST(TSplineSourceCells, BezierCellsHaveTheVolumeOfTheAnnulus)
{
  auto source = MakeSource(QuarterAnnulus(1, 1), vtkTSplineSource::BEZIER_HEXES);
  source->Update();
  auto* grid = vtkUnstructuredGrid::SafeDownCast(source->GetOutput());
  vtkNew<vtkTessellatorFilter> tessellator;
  tessellator->SetInputData(grid);
  tessellator->SetOutputDimension(3);
  tessellator->SetChordError(2e-3);
  tessellator->SetMaximumNumberOfSubdivisions(3);
  tessellator->Update();
  EXPECT_NEAR(Volume(tessellator->GetOutput()), 3.0 * Pi / 4.0, 0.01);

  // The active attributes and the twins that survive a move between processes.
  vtkDataArray* weights = grid->GetPointData()->GetRationalWeights();
  vtkDataArray* plain = PointArray(grid, "BezierWeights");
  ASSERT_TRUE(weights && plain && weights != plain);
  for (vtkIdType i = 0; i < weights->GetNumberOfTuples(); ++i)
  {
    ASSERT_EQ(weights->GetTuple1(i), plain->GetTuple1(i));
  }
  vtkDataArray* degrees = grid->GetCellData()->GetHigherOrderDegrees();
  vtkDataArray* plainDegrees = grid->GetCellData()->GetArray("BezierDegrees");
  ASSERT_TRUE(degrees && plainDegrees);
  for (int a = 0; a < 3; ++a)
  {
    EXPECT_EQ(degrees->GetComponent(0, a), 3.0);
    EXPECT_EQ(plainDegrees->GetComponent(0, a), 3.0);
  }
}

TEST(TSplineSourceCells, SurfacesLieWhereTheyShould)
{
  auto source = MakeSource(QuarterAnnulus(4, 2), vtkTSplineSource::ISO_SURFACES);
  EXPECT_EQ(source->GetNumberOfSurfaces(0), 1);
  EXPECT_EQ(source->GetSurface(0, 0), 0.5);
  source->RemoveAllSurfacesU();
  source->RemoveAllSurfacesV();
  source->RemoveAllSurfacesW();
  source->AddSurfaceU(0.3);
  source->AddSurfaceU(1.0);
  source->AddSurfaceW(0.0);
  source->SetSubdivisions(6);
  source->Update();
  auto* surfaces = vtkPolyData::SafeDownCast(source->GetOutput());
  ExpectAnnulusValues(surfaces, 1e-13);
  vtkDataArray* direction = surfaces->GetCellData()->GetArray("SurfaceDirection");
  vtkDataArray* value = surfaces->GetCellData()->GetArray("SurfaceParameter");
  double areas[3] = { 0.0, 0.0, 0.0 }; // of u = 0.3, u = 1, w = 0
  for (vtkIdType i = 0; i < surfaces->GetNumberOfCells(); ++i)
  {
    vtkCell* quad = surfaces->GetCell(i);
    ASSERT_EQ(quad->GetCellType(), VTK_QUAD);
    double corners[4][3], a[3], b[3], normal[3];
    for (int j = 0; j < 4; ++j)
    {
      quad->GetPoints()->GetPoint(j, corners[j]);
      if (direction->GetTuple1(i) == 0.0)
      {
        ASSERT_NEAR(std::hypot(corners[j][0], corners[j][1]), 1.0 + value->GetTuple1(i), 1e-13);
      }
      else
      {
        ASSERT_EQ(corners[j][2], 0.0);
      }
    }
    vtkMath::Subtract(corners[2], corners[0], a);
    vtkMath::Subtract(corners[3], corners[1], b);
    vtkMath::Cross(a, b, normal);
    if (direction->GetTuple1(i) == 0.0) // looks outwards
    {
      EXPECT_GT(normal[0] * corners[0][0] + normal[1] * corners[0][1], 0.0);
    }
    else // looks up
    {
      EXPECT_GT(normal[2], 0.0);
    }
    const int which = direction->GetTuple1(i) == 2.0 ? 2 : (value->GetTuple1(i) == 1.0 ? 1 : 0);
    areas[which] += 0.5 * vtkMath::Norm(normal);
  }
  EXPECT_NEAR(areas[0], 1.3 * Pi / 2.0, 5e-3);
  EXPECT_NEAR(areas[1], 2.0 * Pi / 2.0, 5e-3);
  EXPECT_NEAR(areas[2], 3.0 * Pi / 4.0, 8e-3);
}
}
