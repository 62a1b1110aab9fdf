// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The fit over a domain: a ball of seven blocks, from image, polycube and block meshes to the
// spline, and what source, writer and reader make of that.
#include "BallDomain.h"
#include "ErrorLog.h"
#include "vtkTSplineFit.h"
#include "vtkTSplineReader.h"
#include "vtkTSplineSource.h"
#include "vtkTSplineWriter.h"

#include "vtkDataArray.h"
#include "vtkIntArray.h"
#include "vtkMeshQuality.h"
#include "vtkTable.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <set>

namespace
{
using namespace trivariate_testing;

//------------------------------------------------------------------------------
vtkNew<vtkTSplineFit> MakeFit(const BallDomain& ball, int controlPoints, bool withMeshes = true)
{
  vtkNew<vtkTSplineFit> fit;
  fit->SetInputData(0, ball.Image);
  fit->SetInputData(1, ball.Polycube);
  if (withMeshes)
  {
    fit->SetInputData(2, ball.Meshes);
  }
  fit->SetMaximumNumberOfControlPoints(controlPoints);
  return fit;
}

double FieldNumber(vtkTable* table, const char* name, int component = 0)
{
  vtkDataArray* array = table->GetFieldData()->GetArray(name);
  EXPECT_NE(array, nullptr) << name;
  return array ? array->GetComponent(0, component) : 0.0;
}

double LastOf(vtkTable* table, const char* column)
{
  return table->GetValueByName(table->GetNumberOfRows() - 1, column).ToDouble();
}

//------------------------------------------------------------------------------
// All voxels are found in the image of the spline by the inverse map, with at most that error.
void ExpectImageOf(vtkTSplineFit* fit, const BallDomain& ball, double rms)
{
  vtkNew<vtkTSplineSource> source;
  source->SetInputConnection(fit->GetOutputPort());
  source->SetOutputType(vtkTSplineSource::IMAGE);
  source->SetInputData(1, ball.Image);
  source->Update();
  auto* image = vtkImageData::SafeDownCast(source->GetOutputDataObject(0));
  ASSERT_NE(image, nullptr);
  vtkDataArray* fitted = image->GetPointData()->GetArray("Density");
  vtkDataArray* input = ball.Image->GetPointData()->GetArray("Density");
  vtkDataArray* mask = ball.Image->GetPointData()->GetArray("ParameterMask");
  vtkDataArray* valid = image->GetPointData()->GetArray("vtkValidPointMask");
  ASSERT_TRUE(fitted && valid);
  ASSERT_EQ(fitted->GetNumberOfTuples(), input->GetNumberOfTuples());
  double squares = 0.0;
  int found = 0;
  for (vtkIdType id = 0; id < fitted->GetNumberOfTuples(); ++id)
  {
    if (mask->GetComponent(id, 0) != 0.0 && valid->GetComponent(id, 0) != 0.0)
    {
      squares += std::pow(fitted->GetComponent(id, 0) - input->GetComponent(id, 0), 2);
      ++found;
    }
  }
  EXPECT_EQ(found, ball.NumberOfVoxels);
  EXPECT_LT(std::sqrt(squares / found), rms);
}
}

//------------------------------------------------------------------------------
TEST(TSplineFitDomain, FitsABall)
{
  const BallDomain ball(28);
  const auto fit = MakeFit(ball, 1500);
  fit->Update();
  vtkUnstructuredGrid* grid = fit->GetOutput();
  vtkTable* rounds = vtkTable::SafeDownCast(fit->GetOutputDataObject(1));
  ASSERT_GT(rounds->GetNumberOfRows(), 1);
  EXPECT_LT(LastOf(rounds, "RMS"), 1.0);
  EXPECT_LE(FieldNumber(rounds, "ShapeDistance"), 0.1);
  EXPECT_GT(FieldNumber(rounds, "SmallestJacobian"), 0.0);
  EXPECT_EQ(FieldNumber(rounds, "ShapeCells", 1), 0.0);
  EXPECT_EQ(FieldNumber(rounds, "VoxelsInside", 1), ball.NumberOfVoxels);
  EXPECT_EQ(FieldNumber(rounds, "VoxelsInside"), ball.NumberOfVoxels);
  EXPECT_EQ(FieldNumber(rounds, "VoxelsNear"), 0.0);
  EXPECT_GT(FieldNumber(rounds, "GradientJump"), 0.0);
  EXPECT_LT(FieldNumber(rounds, "GradientJump"), FieldNumber(rounds, "GradientJump", 1));

  // Points that are one control point are at one place, with one weight and one density.
  vtkDataArray* shared = grid->GetPointData()->GetArray("SharedControlPoint");
  vtkDataArray* density = grid->GetPointData()->GetArray("Density");
  ASSERT_TRUE(shared && density);
  std::map<vtkIdType, vtkIdType> first;
  std::set<int> blocks;
  for (vtkIdType id = 0; id < grid->GetNumberOfPoints(); ++id)
  {
    const auto number = static_cast<vtkIdType>(shared->GetComponent(id, 0));
    const vtkIdType other = first.emplace(number, id).first->second;
    double a[3], b[3];
    grid->GetPoint(id, a);
    grid->GetPoint(other, b);
    EXPECT_TRUE(std::equal(a, a + 3, b));
    EXPECT_EQ(density->GetComponent(id, 0), density->GetComponent(other, 0));
    EXPECT_EQ(grid->GetPointData()->GetArray("Segment")->GetComponent(id, 0), 1.0);
    blocks.insert(static_cast<int>(grid->GetPointData()->GetArray("Block")->GetComponent(id, 0)));
  }
  EXPECT_EQ(blocks, (std::set<int>{ 0, 1, 2, 3, 4, 5, 6 }));
  EXPECT_EQ(static_cast<double>(first.size()), LastOf(rounds, "ControlPoints"));
  EXPECT_LE(first.size(), 1500u);
  EXPECT_GT(grid->GetNumberOfPoints(), static_cast<vtkIdType>(first.size()));
}

//------------------------------------------------------------------------------
// Hexahedra of all blocks fill the ball, and the image made by the inverse map is the input's.
TEST(TSplineFitDomain, IsEvaluatedOverAllBlocks)
{
  const BallDomain ball(28);
  const auto fit = MakeFit(ball, 1500);
  vtkNew<vtkTSplineSource> source;
  source->SetInputConnection(fit->GetOutputPort());
  source->SetOutputType(vtkTSplineSource::LINEAR_HEXES);
  source->SetSubdivisions(8);
  source->Update();
  vtkNew<vtkMeshQuality> quality;
  quality->SetInputDataObject(source->GetOutputDataObject(0));
  quality->SetHexQualityMeasureToVolume();
  quality->Update();
  vtkDataArray* volumes = quality->GetOutput()->GetCellData()->GetArray("Quality");
  double volume = 0.0, least = 1.0;
  for (vtkIdType cell = 0; cell < volumes->GetNumberOfTuples(); ++cell)
  {
    volume += volumes->GetComponent(cell, 0);
    least = std::min(least, volumes->GetComponent(cell, 0));
  }
  // The shape lies a quarter of a voxel outside of the surface, less what chords cut off.
  EXPECT_NEAR(volume, 4.18879 * std::pow(ball.Map.Radius + 0.25, 3), 0.02 * volume);
  EXPECT_GT(least, 0.0);

  ExpectImageOf(fit, ball, 0.01);
}

//------------------------------------------------------------------------------
TEST(TSplineFitDomain, IsWrittenAndRead)
{
  const BallDomain ball(20);
  const auto fit = MakeFit(ball, 400);
  const std::string path =
    (std::filesystem::temp_directory_path() / "TestTSplineFitDomain.tspline").string();
  vtkNew<vtkTSplineWriter> writer;
  writer->SetInputConnection(fit->GetOutputPort());
  writer->SetFileName(path.c_str());
  ASSERT_EQ(writer->Write(), 1);
  vtkNew<vtkTSplineReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  std::filesystem::remove(path);
  vtkUnstructuredGrid *before = fit->GetOutput(), *after = reader->GetOutput();
  ASSERT_EQ(after->GetNumberOfPoints(), before->GetNumberOfPoints());
  for (const char* name : { "KnotsU", "KnotsV", "KnotsW", "Weight", "Segment", "Block", "Density" })
  {
    vtkDataArray* a = before->GetPointData()->GetArray(name);
    vtkDataArray* b = after->GetPointData()->GetArray(name);
    ASSERT_TRUE(a && b) << name;
    for (vtkIdType id = 0; id < a->GetNumberOfTuples(); ++id)
    {
      for (int c = 0; c < a->GetNumberOfComponents(); ++c)
      {
        ASSERT_EQ(a->GetComponent(id, c), b->GetComponent(id, c)) << name;
      }
    }
  }
}

//------------------------------------------------------------------------------
TEST(TSplineFitDomain, DoesWithoutMeshes)
{
  const BallDomain ball(20);
  const auto fit = MakeFit(ball, 600, false);
  fit->Update();
  vtkTable* rounds = vtkTable::SafeDownCast(fit->GetOutputDataObject(1));
  EXPECT_LT(LastOf(rounds, "RMS"), 6.0);
}

//------------------------------------------------------------------------------
// Refined for analysis the weights are one, and every voxel is found again.
TEST(TSplineFitDomain, IsRefinedForAnalysis)
{
  const BallDomain ball(20);
  const auto fit = MakeFit(ball, 900);
  fit->SetRefinementRule(vtkTSplineFit::ANALYSIS_SUITABLE);
  fit->Update();
  vtkTable* rounds = vtkTable::SafeDownCast(fit->GetOutputDataObject(1));
  EXPECT_LT(LastOf(rounds, "RMS"), 2.0);
  EXPECT_LE(LastOf(rounds, "ControlPoints"), 900.0);
  EXPECT_EQ(FieldNumber(rounds, "ShapeCells", 1), 0.0);
  EXPECT_EQ(FieldNumber(rounds, "VoxelsInside"), ball.NumberOfVoxels);
  const double* weights = fit->GetOutput()->GetPointData()->GetArray("Weight")->GetRange();
  EXPECT_EQ(weights[0], 1.0);
  EXPECT_EQ(weights[1], 1.0);
  ExpectImageOf(fit, ball, 0.02);
}

//------------------------------------------------------------------------------
TEST(TSplineFitDomain, RefusesWhatDoesNotBelongTogether)
{
  const BallDomain ball(20);
  const auto messageOf = [](vtkTSplineFit* fit)
  {
    ErrorLog log(fit);
    fit->Update();
    EXPECT_EQ(fit->GetOutput()->GetNumberOfPoints(), 0);
    return log.TakeOnly();
  };
  auto fit = MakeFit(ball, 600);
  fit->SetRefinementRule(vtkTSplineFit::UNIFORM);
  EXPECT_NE(messageOf(fit).find("compact or the analysis-suitable"), std::string::npos);
  fit = MakeFit(ball, 231);
  EXPECT_NE(messageOf(fit).find("at least 232"), std::string::npos);
  fit = MakeFit(ball, 600);
  fit->SetLargestShapeDistance(0.001);
  EXPECT_NE(messageOf(fit).find("The shape stays 0."), std::string::npos);

  vtkNew<vtkImageData> image;
  image->ShallowCopy(ball.Image);
  image->GetPointData()->RemoveArray("ParameterMask");
  fit = MakeFit(ball, 600);
  fit->SetInputData(0, image);
  EXPECT_NE(messageOf(fit).find("no point array \"ParameterMask\""), std::string::npos);

  vtkNew<vtkUnstructuredGrid> polycube;
  polycube->ShallowCopy(ball.Polycube);
  polycube->GetCellData()->RemoveArray("Block");
  fit = MakeFit(ball, 600);
  fit->SetInputData(1, polycube);
  EXPECT_NE(messageOf(fit).find("no array Block"), std::string::npos);

  vtkNew<vtkPartitionedDataSetCollection> meshes;
  meshes->ShallowCopy(ball.Meshes);
  meshes->SetNumberOfPartitionedDataSets(3);
  fit = MakeFit(ball, 600);
  fit->SetInputData(2, meshes);
  EXPECT_NE(messageOf(fit).find("3 block meshes for 7"), std::string::npos);
}
