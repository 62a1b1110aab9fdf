// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
// The T-spline grid is what DESIGN promises, and nothing is lost or let through on the way.
#include "RandomTSplineModel.h"
#include "TSplineGrid.h"

#include "vtkCellType.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkUnstructuredGrid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <stdexcept>

using namespace trivariate;

namespace
{
bool SameBits(const std::vector<double>& a, const std::vector<double>& b)
{
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

// The fault that TSplineFromGrid finds after `spoil` has changed a good grid.
std::string FaultAfter(const std::function<void(vtkUnstructuredGrid*)>& spoil)
{
  vtkNew<vtkUnstructuredGrid> grid;
  TSplineToGrid(RandomModel(1), grid);
  spoil(grid);
  try
  {
    TSplineFromGrid(grid);
  }
  catch (const std::invalid_argument& fault)
  {
    return fault.what();
  }
  return "none";
}

void SetValue(vtkUnstructuredGrid* grid, const char* name, vtkIdType i, int component, double value)
{
  grid->GetPointData()->GetArray(name)->SetComponent(i, component, value);
}
}

TEST(TSplineGrid, GivesBackTheModel)
{
  for (unsigned seed = 0; seed < 50; ++seed)
  {
    RandomModelOptions options;
    options.Functions = 10 + 7 * seed;
    options.Knots = 2 + seed % 9;
    for (unsigned a = 0; a < seed % 4; ++a)
    {
      options.Attributes.push_back({ "attribute " + std::to_string(a), 1 + static_cast<int>(a) });
    }
    const TSplineModel model = RandomModel(seed, options);
    vtkNew<vtkUnstructuredGrid> grid;
    TSplineToGrid(model, grid);
    const TSplineModel back = TSplineFromGrid(grid);
    EXPECT_EQ(back.Spline.KnotLines, model.Spline.KnotLines) << seed;
    EXPECT_EQ(back.Spline.Functions, model.Spline.Functions) << seed;
    EXPECT_TRUE(SameBits(back.Spline.Weights, model.Spline.Weights)) << seed;
    EXPECT_TRUE(SameBits(back.Spline.ControlPoints, model.Spline.ControlPoints)) << seed;
    EXPECT_EQ(back.Segment, model.Segment);
    EXPECT_EQ(back.Block, model.Block);
    EXPECT_EQ(back.RootCells, model.RootCells);
    ASSERT_EQ(back.Attributes.size(), model.Attributes.size());
    for (std::size_t a = 0; a < model.Attributes.size(); ++a)
    {
      EXPECT_EQ(back.Attributes[a].Name, model.Attributes[a].Name);
      EXPECT_EQ(back.Attributes[a].Components, model.Attributes[a].Components);
    }
  }
}

TEST(TSplineGrid, IsWhatTheTableOfArraysSays)
{
  RandomModelOptions options;
  options.Attributes = { { "density", 1 }, { "velocity", 3 } };
  const TSplineModel model = RandomModel(3, options);
  vtkNew<vtkUnstructuredGrid> grid;
  TSplineToGrid(model, grid);
  const vtkIdType n = model.Spline.Size();
  ASSERT_EQ(grid->GetNumberOfPoints(), n);
  ASSERT_EQ(grid->GetNumberOfCells(), n);
  EXPECT_EQ(grid->GetPoints()->GetDataType(), VTK_DOUBLE);
  for (vtkIdType i = 0; i < n; ++i)
  {
    vtkNew<vtkIdList> ids;
    grid->GetCellPoints(i, ids);
    ASSERT_EQ(grid->GetCellType(i), VTK_VERTEX);
    ASSERT_EQ(ids->GetNumberOfIds(), 1);
    ASSERT_EQ(ids->GetId(0), i);
    double point[3];
    grid->GetPoint(i, point);
    ASSERT_EQ(std::memcmp(point, model.Spline.ControlPoint(i), sizeof(point)), 0);
  }
  const struct
  {
    const char* Name;
    int Type;
    int Components;
  } arrays[] = { { "KnotsU", VTK_DOUBLE, 5 }, { "KnotsV", VTK_DOUBLE, 5 },
    { "KnotsW", VTK_DOUBLE, 5 }, { "Weight", VTK_DOUBLE, 1 }, { "Segment", VTK_INT, 1 },
    { "Block", VTK_INT, 1 }, { "density", VTK_DOUBLE, 1 }, { "velocity", VTK_DOUBLE, 3 } };
  EXPECT_EQ(grid->GetPointData()->GetNumberOfArrays(), 8);
  for (const auto& expected : arrays)
  {
    vtkDataArray* array = grid->GetPointData()->GetArray(expected.Name);
    ASSERT_TRUE(array) << expected.Name;
    EXPECT_EQ(array->GetDataType(), expected.Type) << expected.Name;
    EXPECT_EQ(array->GetNumberOfComponents(), expected.Components) << expected.Name;
    EXPECT_EQ(array->GetNumberOfTuples(), n) << expected.Name;
  }
  // Control values are not the field: nobody shall see them in colors by mistake.
  EXPECT_EQ(grid->GetPointData()->GetScalars(), nullptr);
}

TEST(TSplineGrid, TakesWhatFiltersAdd)
{
  vtkNew<vtkUnstructuredGrid> grid;
  const TSplineModel model = RandomModel(2);
  TSplineToGrid(model, grid);
  vtkPointData* data = grid->GetPointData();
  data->RemoveArray("Segment");
  data->RemoveArray("Block");
  vtkNew<vtkIdTypeArray> ids;
  ids->SetName("vtkOriginalPointIds");
  ids->SetNumberOfTuples(grid->GetNumberOfPoints());
  data->AddArray(ids);
  vtkNew<vtkFloatArray> half;
  half->SetName("half");
  half->SetNumberOfTuples(grid->GetNumberOfPoints());
  half->Fill(0.5);
  data->AddArray(half);
  const TSplineModel back = TSplineFromGrid(grid);
  ASSERT_EQ(back.Attributes.size(), 2u);
  EXPECT_EQ(back.Attributes[1].Name, "half");
  EXPECT_EQ(back.Spline.ControlPoint(7)[4], 0.5);
  EXPECT_EQ(back.Segment, std::vector<std::int32_t>(back.Segment.size(), 0));
  EXPECT_EQ(back.Block, std::vector<std::int32_t>(back.Block.size(), 0));
}

TEST(TSplineGrid, RefusesWhatIsNoTSpline)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  const struct
  {
    std::function<void(vtkUnstructuredGrid*)> Spoil;
    const char* Fault;
  } cases[] = {
    { [](vtkUnstructuredGrid*) {}, "none" },
    { [](vtkUnstructuredGrid* grid) { grid->Initialize(); }, "no control points" },
    { [](vtkUnstructuredGrid* grid) { grid->GetPointData()->RemoveArray("KnotsV"); },
      "no point array \"KnotsV\"" },
    { [](vtkUnstructuredGrid* grid) { grid->GetPointData()->RemoveArray("Weight"); },
      "no point array \"Weight\"" },
    { [](vtkUnstructuredGrid* grid)
      {
        vtkNew<vtkDoubleArray> knots;
        knots->SetName("KnotsU");
        knots->SetNumberOfComponents(4);
        knots->SetNumberOfTuples(grid->GetNumberOfPoints());
        grid->GetPointData()->AddArray(knots);
      },
      "\"KnotsU\" has 4 components; 5 are needed" },
    { [](vtkUnstructuredGrid* grid)
      { grid->GetPointData()->GetArray("Weight")->SetNumberOfTuples(5); },
      "has 5 tuples for 64 control points" },
    { [](vtkUnstructuredGrid* grid)
      { grid->GetPointData()->GetArray("density")->SetNumberOfTuples(5); },
      "has 5 tuples for 64 control points" },
    { [nan](vtkUnstructuredGrid* grid) { SetValue(grid, "KnotsW", 3, 2, nan); },
      "Control point 3 has a value in KnotsW that is not finite" },
    { [infinity](vtkUnstructuredGrid* grid) { SetValue(grid, "density", 63, 0, infinity); },
      "Control point 63 has a value in density that is not finite" },
    { [nan](vtkUnstructuredGrid* grid) { grid->GetPoints()->SetPoint(1, 0, nan, 0); },
      "Control point 1 has a value in X, Y, Z that is not finite" },
    { [](vtkUnstructuredGrid* grid) { SetValue(grid, "KnotsU", 9, 4, -100.0); },
      "The local knots in KnotsU of control point 9 decrease" },
    { [](vtkUnstructuredGrid* grid)
      {
        for (int k = 0; k < 5; ++k)
        {
          SetValue(grid, "KnotsU", 9, k, 1.0);
        }
      },
      "KnotsU of control point 9 decrease or are all equal" },
    { [](vtkUnstructuredGrid* grid) { SetValue(grid, "Weight", 4, 0, 0.0); },
      "function 4 has the weight 0" },
    { [](vtkUnstructuredGrid* grid) { SetValue(grid, "Weight", 4, 0, -1.0); },
      "function 4 has the weight -1" },
    { [nan](vtkUnstructuredGrid* grid)
      {
        vtkNew<vtkDoubleArray> labels;
        labels->SetName("Segment");
        labels->SetNumberOfTuples(grid->GetNumberOfPoints());
        labels->Fill(nan);
        grid->GetPointData()->AddArray(labels);
      },
      "a 32-bit integer is needed" },
    { [](vtkUnstructuredGrid* grid)
      { grid->GetPointData()->GetArray("density")->SetName(nullptr); },
      "A point array has no name" },
  };
  for (const auto& test : cases)
  {
    const std::string fault = FaultAfter(test.Spoil);
    EXPECT_NE(fault.find(test.Fault), std::string::npos) << fault << "\n" << test.Fault;
  }
}
