// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ErrorLog.h"
#include "vtkSegmentBoundary.h"

#include "vtkCallbackCommand.h"
#include "vtkCellData.h"
#include "vtkCommand.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkIdList.h"
#include "vtkImageData.h"
#include "vtkIntArray.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSMPTools.h"
#include "vtkShortArray.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkUnsignedCharArray.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <set>
#include <string>

namespace
{
using Function = std::function<double(const double*)>;

const double Radius = 9.0;

//------------------------------------------------------------------------------
// Sits askew in space, a mirror image, its extent far from zero; the ball is inside.
vtkNew<vtkImageData> SkewImage()
{
  vtkNew<vtkImageData> image;
  image->SetExtent(-7, 38, 100, 139, 3, 26);
  image->SetSpacing(0.5, 0.75, 1.0);
  const double c = std::cos(0.4), s = std::sin(0.4);
  const double direction[9] = { c, -s, 0.0, s, c, 0.0, 0.0, 0.0, -1.0 };
  image->SetDirectionMatrix(direction);
  double middle[3];
  image->TransformContinuousIndexToPhysicalPoint(15.3, 119.6, 14.2, middle);
  image->SetOrigin(-middle[0], -middle[1], -middle[2]);
  return image;
}

template <typename ArrayT>
ArrayT* AddSamples(vtkImageData* image, const char* name, const Function& f)
{
  vtkNew<ArrayT> array;
  array->SetName(name);
  array->SetNumberOfTuples(image->GetNumberOfPoints());
  for (vtkIdType id = 0; id < image->GetNumberOfPoints(); ++id)
  {
    array->SetComponent(id, 0, f(image->GetPoint(id)));
  }
  image->GetPointData()->AddArray(array);
  return array;
}

double BallLabel(const double* p)
{
  return vtkMath::Norm(p) < Radius ? (p[0] < 1.0 ? 1.0 : 3.0) : 0.0;
}

double BallDensity(const double* p)
{
  return 100.0 / (1.0 + std::exp(4.0 * (vtkMath::Norm(p) - Radius)));
}

vtkDataArray* CellLabels(vtkPolyData* surface)
{
  return surface->GetCellData()->GetArray("BoundaryLabels");
}

//------------------------------------------------------------------------------
// The volume inside of a segment's surface; every edge must be there once in each direction.
double ClosedVolume(vtkPolyData* surface, int segment)
{
  std::map<std::pair<vtkIdType, vtkIdType>, int> edges;
  double volume = 0.0;
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < surface->GetNumberOfCells(); ++cell)
  {
    const double* labels = CellLabels(surface)->GetTuple2(cell);
    if (labels[0] != segment && labels[1] != segment)
    {
      continue;
    }
    surface->GetCellPoints(cell, ids);
    std::array<vtkIdType, 3> v = { ids->GetId(0), ids->GetId(1), ids->GetId(2) };
    if (labels[1] == segment)
    {
      std::swap(v[1], v[2]);
    }
    double x[3][3];
    for (int i = 0; i < 3; ++i)
    {
      surface->GetPoint(v[i], x[i]);
      ++edges[{ v[i], v[(i + 1) % 3] }];
    }
    double cross[3];
    vtkMath::Cross(x[1], x[2], cross);
    volume += vtkMath::Dot(x[0], cross) / 6.0;
  }
  for (const auto& [edge, count] : edges)
  {
    EXPECT_EQ(count, 1);
    EXPECT_EQ(edges.count({ edge.second, edge.first }), 1u);
  }
  return volume;
}

std::set<std::pair<int, int>> PairsOf(vtkPolyData* surface)
{
  std::set<std::pair<int, int>> pairs;
  for (vtkIdType cell = 0; cell < surface->GetNumberOfCells(); ++cell)
  {
    const double* labels = CellLabels(surface)->GetTuple2(cell);
    pairs.insert({ static_cast<int>(labels[0]), static_cast<int>(labels[1]) });
  }
  return pairs;
}

std::set<std::array<double, 3>> PlacesOf(vtkPolyData* surface)
{
  std::set<std::array<double, 3>> places;
  for (vtkIdType id = 0; id < surface->GetNumberOfPoints(); ++id)
  {
    const double* p = surface->GetPoint(id);
    places.insert({ p[0], p[1], p[2] });
  }
  return places;
}

void ExpectFault(vtkSegmentBoundary* boundary, ErrorLog& log, const std::string& text)
{
  boundary->Modified();
  boundary->Update();
  EXPECT_NE(log.TakeOnly().find(text), std::string::npos) << text;
  EXPECT_EQ(boundary->GetOutput()->GetNumberOfPoints(), 0) << text;
}
}

//------------------------------------------------------------------------------
TEST(SegmentBoundaryFilter, MakesClosedSurfacesInSpace)
{
  vtkNew<vtkImageData> image = SkewImage();
  vtkDataArray* labels = AddSamples<vtkShortArray>(image, "Segment", BallLabel);
  vtkNew<vtkSegmentBoundary> boundary;
  boundary->SetInputData(image);
  boundary->Update();
  vtkPolyData* surface = boundary->GetOutput();
  EXPECT_NE(vtkIntArray::SafeDownCast(CellLabels(surface)), nullptr);
  EXPECT_NE(vtkFloatArray::SafeDownCast(surface->GetPointData()->GetNormals()), nullptr);
  const std::set<std::pair<int, int>> pairs = { { 1, 0 }, { 3, 0 }, { 1, 3 } };
  EXPECT_EQ(PairsOf(surface), pairs);
  for (int segment : { 1, 3 })
  {
    double count = 0.0;
    for (vtkIdType id = 0; id < labels->GetNumberOfTuples(); ++id)
    {
      count += labels->GetComponent(id, 0) == segment;
    }
    EXPECT_NEAR(ClosedVolume(surface, segment) / (count * 0.5 * 0.75 * 1.0), 1.0, 0.01);
  }

  auto* junction =
    vtkUnsignedCharArray::SafeDownCast(surface->GetPointData()->GetArray("Junction"));
  ASSERT_NE(junction, nullptr);
  vtkIdType onCurve = 0;
  for (vtkIdType id = 0; id < surface->GetNumberOfPoints(); ++id)
  {
    const double* p = surface->GetPoint(id);
    double normal[3];
    surface->GetPointData()->GetNormals()->GetTuple(id, normal);
    EXPECT_NEAR(vtkMath::Norm(normal), 1.0, 1e-5);
    onCurve += junction->GetValue(id) == 1;
    EXPECT_LT(junction->GetValue(id), 2);
    if (std::abs(p[0] - 1.0) > 1.0)
    {
      EXPECT_NEAR(vtkMath::Norm(p), Radius, 0.55);
      EXPECT_GT(vtkMath::Dot(p, normal), 0.7 * Radius);
    }
    else if (vtkMath::Norm(p) < Radius - 1.5)
    {
      EXPECT_GT(normal[0], 0.7); // from segment 1 to segment 3
    }
  }
  EXPECT_GT(onCurve, 40);
}

TEST(SegmentBoundaryFilter, LeavesTheSurfaceWhereItIsWhicheverSegmentsAreChosen)
{
  vtkNew<vtkImageData> image = SkewImage();
  AddSamples<vtkIntArray>(image, "Segment", BallLabel);
  vtkNew<vtkSegmentBoundary> boundary;
  boundary->SetInputData(image);
  for (int segment : { 0, 1, 3 })
  {
    boundary->AddSegment(segment);
  }
  EXPECT_EQ(boundary->GetNumberOfSegments(), 3);
  EXPECT_EQ(boundary->GetSegment(2), 3);
  EXPECT_EQ(boundary->GetSegment(3), -1);
  boundary->Update();
  const std::set<std::pair<int, int>> all = { { 0, -1 }, { 1, 0 }, { 3, 0 }, { 1, 3 } };
  EXPECT_EQ(PairsOf(boundary->GetOutput()), all);
  // The whole box, half a voxel wider than its points.
  EXPECT_NEAR(ClosedVolume(boundary->GetOutput(), -1), -46 * 40 * 24 * 0.375, 1e-6);
  const auto places = PlacesOf(boundary->GetOutput());
  const double volume = ClosedVolume(boundary->GetOutput(), 3);

  boundary->ClearSegments();
  boundary->AddSegment(3);
  boundary->Update();
  const std::set<std::pair<int, int>> some = { { 3, 0 }, { 3, 1 } };
  EXPECT_EQ(PairsOf(boundary->GetOutput()), some);
  EXPECT_NEAR(ClosedVolume(boundary->GetOutput(), 3), volume, 1e-6);
  for (const auto& place : PlacesOf(boundary->GetOutput()))
  {
    ASSERT_EQ(places.count(place), 1u);
  }
}

TEST(SegmentBoundaryFilter, FindsTheDensity)
{
  vtkNew<vtkImageData> image = SkewImage();
  AddSamples<vtkIntArray>(
    image, "Segment", [](const double* p) { return vtkMath::Norm(p) < Radius ? 1.0 : 0.0; });
  AddSamples<vtkDoubleArray>(image, "density", BallDensity);
  AddSamples<vtkFloatArray>(
    image, "wrong", [](const double* p) { return vtkMath::Norm(p) < Radius + 0.4; });
  const auto error = [](vtkPolyData* surface)
  {
    double sum = 0.0;
    for (vtkIdType id = 0; id < surface->GetNumberOfPoints(); ++id)
    {
      sum += std::pow(vtkMath::Norm(surface->GetPoint(id)) - Radius, 2);
    }
    return std::sqrt(sum / surface->GetNumberOfPoints());
  };
  vtkNew<vtkSegmentBoundary> boundary;
  boundary->SetInputData(image);
  image->GetPointData()->SetActiveScalars("density");
  boundary->Update();
  const double active = error(boundary->GetOutput());
  EXPECT_LT(active, 0.03);

  image->GetPointData()->SetActiveScalars("Segment");
  boundary->Modified();
  boundary->Update();
  EXPECT_EQ(error(boundary->GetOutput()), active);

  boundary->SetInputArrayToProcess(1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "wrong");
  boundary->Update();
  EXPECT_GT(error(boundary->GetOutput()), 5.0 * active);

  boundary->UseDensityOff();
  boundary->Update();
  const double labels = error(boundary->GetOutput());
  EXPECT_GT(labels, active);
  EXPECT_LT(labels, 0.1);
  EXPECT_EQ(boundary->GetUseDensity(), false);
}

TEST(SegmentBoundaryFilter, DoesNotDependOnThreadsOrPieces)
{
  vtkNew<vtkImageData> image = SkewImage();
  AddSamples<vtkIntArray>(image, "Segment", BallLabel);
  AddSamples<vtkDoubleArray>(image, "density", BallDensity);
  const auto run = [&image](int threads, int pieces)
  {
    vtkSMPTools::Initialize(threads);
    vtkNew<vtkSegmentBoundary> boundary;
    boundary->SetInputData(image);
    boundary->UpdatePiece(0, pieces, 0);
    vtkNew<vtkPolyData> surface;
    surface->ShallowCopy(boundary->GetOutput());
    boundary->UpdatePiece(pieces - 1, pieces, 0);
    EXPECT_EQ(boundary->GetOutput()->GetNumberOfPoints() == 0, pieces > 1);
    vtkSMPTools::Initialize(0);
    return surface;
  };
  const vtkNew<vtkPolyData> one = run(1, 1);
  for (const auto& [threads, pieces] : { std::pair(2, 1), std::pair(3, 2) })
  {
    const vtkNew<vtkPolyData> other = run(threads, pieces);
    ASSERT_EQ(one->GetNumberOfPoints(), other->GetNumberOfPoints());
    for (vtkIdType id = 0; id < one->GetNumberOfPoints(); ++id)
    {
      double p[3], q[3];
      one->GetPoint(id, p);
      other->GetPoint(id, q);
      ASSERT_TRUE(p[0] == q[0] && p[1] == q[1] && p[2] == q[2]) << id;
    }
  }
}

TEST(SegmentBoundaryFilter, StopsWhenAborted)
{
  vtkNew<vtkImageData> image = SkewImage();
  AddSamples<vtkIntArray>(image, "Segment", BallLabel);
  vtkNew<vtkSegmentBoundary> boundary;
  boundary->SetInputData(image);
  vtkNew<vtkCallbackCommand> stop;
  stop->SetCallback(
    [](vtkObject* caller, unsigned long, void*, void*)
    {
      auto* filter = vtkAlgorithm::SafeDownCast(caller);
      filter->SetAbortExecute(filter->GetProgress() > 0.4);
    });
  boundary->AddObserver(vtkCommand::ProgressEvent, stop);
  boundary->Update();
  EXPECT_EQ(boundary->GetOutput()->GetNumberOfPoints(), 0);
  EXPECT_NE(boundary->GetAbortExecute(), 0);
}

//------------------------------------------------------------------------------
TEST(SegmentBoundaryFilter, SaysWhatIsWrongWithTheInput)
{
  vtkNew<vtkSegmentBoundary> boundary;
  ErrorLog log(boundary);
  vtkNew<vtkImageData> image;
  boundary->SetInputData(image);
  ExpectFault(boundary, log, "no points");

  image->SetDimensions(6, 5, 4);
  ExpectFault(boundary, log, "does not have the point array of labels");

  vtkDataArray* labels =
    AddSamples<vtkDoubleArray>(image, "Segment", [](const double* p) { return p[0] > 2.0; });
  boundary->AddSegment(7);
  ExpectFault(boundary, log, "no segment 7 among the 2 labels from 0 to 1");
  boundary->ClearSegments();
  boundary->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "absent");
  ExpectFault(boundary, log, "the point array of labels \"absent\"");
  boundary->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Segment");

  for (double wrong : { 0.5, -1.0, 3e9, std::numeric_limits<double>::quiet_NaN() })
  {
    labels->SetComponent(6 * 5 * 1 + 6 * 2 + 3, 0, wrong);
    ExpectFault(boundary, log, "voxel (3, 2, 1); labels are whole numbers");
  }
  labels->SetComponent(6 * 5 * 1 + 6 * 2 + 3, 0, 1.0);

  vtkDataArray* density =
    AddSamples<vtkDoubleArray>(image, "density", [](const double* p) { return p[0]; });
  density->SetComponent(0, 0, std::numeric_limits<double>::infinity());
  ExpectFault(boundary, log, "voxel (0, 0, 0); the density must be finite");
  density->SetComponent(0, 0, 0.0);
  boundary->SetInputArrayToProcess(1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "absent");
  ExpectFault(boundary, log, "no point array \"absent\" for a density");
  boundary->SetInputArrayToProcess(1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "density");

  vtkNew<vtkIntArray> pairs;
  pairs->SetName("pairs");
  pairs->SetNumberOfComponents(2);
  pairs->SetNumberOfTuples(120);
  pairs->Fill(0);
  image->GetPointData()->AddArray(pairs);
  boundary->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "pairs");
  ExpectFault(boundary, log, "2 components");
  boundary->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Segment");

  labels->Fill(4);
  ExpectFault(boundary, log, "All voxels have the label 4");

  image->SetDimensions(30, 4, 1);
  ExpectFault(boundary, log, "30 x 4 x 1 points");
  image->SetDimensions(7, 5, 4);
  ExpectFault(boundary, log, "120 values for 140 points");

  // And after all that a good one.
  image->SetDimensions(6, 5, 4);
  labels->SetComponent(0, 0, 5);
  boundary->Modified();
  boundary->Update();
  EXPECT_GT(boundary->GetOutput()->GetNumberOfCells(), 0);

  // Colours are no density, nor are ghosts.
  image->GetPointData()->RemoveArray("density");
  image->GetPointData()->SetActiveScalars("pairs");
  AddSamples<vtkDoubleArray>(
    image, vtkDataSetAttributes::GhostArrayName(), [](const double*) { return std::nan(""); });
  boundary->SetInputArrayToProcess(1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Automatic");
  boundary->Update();
  EXPECT_GT(boundary->GetOutput()->GetNumberOfCells(), 0);
}
