// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// Segments with a common surface in the one click.
#include "ReconstructionPhantom.h"
#include "Stop.h"
#include "WarningLog.h"

#include "vtkCellData.h"
#include "vtkSMPTools.h"

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <set>
#include <string>

using namespace trivariate_testing;

namespace
{
// A ball, label 2, inside of a shell, label 1, and 10 outside; density(label, place, radius).
vtkNew<vtkImageData> BallInShell(const std::function<double(int, const double*, double)>& densityAt)
{
  vtkNew<vtkImageData> image;
  constexpr int N = 28;
  image->SetDimensions(N, N, N);
  image->SetOrigin(-0.5 * (N - 1), -0.5 * (N - 1), -0.5 * (N - 1));
  vtkNew<vtkFloatArray> density;
  density->SetName("Density");
  vtkNew<vtkIntArray> labels;
  labels->SetName("Material");
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    double x[3];
    image->GetPoint(i, x);
    const double r = std::hypot(x[0], x[1], x[2]);
    const int label = r < 6.4 ? 2 : r < 11.8 ? 1 : 0;
    labels->InsertNextValue(label);
    density->InsertNextValue(static_cast<float>(label > 0 ? densityAt(label, x, r) : 10.0));
  }
  image->GetPointData()->SetScalars(density);
  image->GetPointData()->AddArray(labels);
  return image;
}

double Rings(int label, const double*, double r)
{
  return label == 2 ? 200.0 + 15.0 * std::cos(0.9 * r) : 100.0 + 30.0 * std::cos(1.2 * r);
}

vtkSmartPointer<vtkTSplineReconstruction> ReconstructTogether(vtkImageData* image)
{
  auto reconstruction = Reconstruct(image);
  reconstruction->SetDomainToAutomatic();
  reconstruction->SetRMSTolerance(0.0);
  reconstruction->SetMaximumNumberOfControlPoints(2000);
  return reconstruction;
}
}

//------------------------------------------------------------------------------
// They share the surface between them and are fitted together. Their control points there are the
// same to the last bit, densities jump.
TEST(TSplineReconstruction, FitsSegmentsThatTouchTogether)
{
  const auto image = BallInShell(Rings);
  auto reconstruction = ReconstructTogether(image);
  reconstruction->Update();

  const auto report = ReportOn(reconstruction);
  ASSERT_EQ(report->GetNumberOfRows(), 4);
  for (const vtkIdType row : { 1, 2 })
  {
    EXPECT_EQ(report->GetValueByName(row, "Domain").ToString(), "LayeredCubes");
    EXPECT_EQ(report->GetValueByName(row, "FoundPercent").ToDouble(), 100.0);
    EXPECT_GT(report->GetValueByName(row, "GradientJumpPercent").ToDouble(), 0.0);
    EXPECT_LT(report->GetValueByName(row, "GradientJumpPercent").ToDouble(), 5.0);
  }
  EXPECT_LT(report->GetValueByName(3, "RoundTripRMSPercent").ToDouble(), 0.2);
  EXPECT_LE(report->GetValueByName(3, "RoundTripRMSPercent").ToDouble(),
    1.05 * report->GetValueByName(3, "RMSPercent").ToDouble());

  std::map<double, std::set<std::array<double, 3>>> places;
  auto* spline = reconstruction->GetOutput();
  for (vtkIdType p = 0; p < spline->GetNumberOfPoints(); ++p)
  {
    std::array<double, 3> x;
    spline->GetPoint(p, x.data());
    places[spline->GetPointData()->GetArray("Segment")->GetTuple1(p)].insert(x);
  }
  const auto common = std::count_if(places[1].begin(), places[1].end(),
    [&places](const std::array<double, 3>& x) { return places[2].count(x) > 0; });
  EXPECT_GE(common, 56); // 4 x 4 on each face of a cube, or more

  // Each voxel has its parameter in blocks of its own segment.
  auto* fields = Output<vtkImageData>(reconstruction, 6);
  auto* cubes = Output<vtkUnstructuredGrid>(reconstruction, 5);
  std::map<double, double> segmentOf;
  for (vtkIdType cube = 0; cube < cubes->GetNumberOfCells(); ++cube)
  {
    segmentOf[cubes->GetCellData()->GetArray("Block")->GetTuple1(cube)] =
      cubes->GetCellData()->GetArray("Segment")->GetTuple1(cube);
  }
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    const double block = fields->GetPointData()->GetArray("Block")->GetTuple1(i);
    const double label = image->GetPointData()->GetArray("Material")->GetTuple1(i);
    EXPECT_EQ(block < 0.0 ? 0.0 : segmentOf.at(block), label);
  }
}

//------------------------------------------------------------------------------
TEST(TSplineReconstruction, StopsInAFitOfSeveralSegmentsAndIsTheSameOnAnyThreads)
{
  const auto image = BallInShell(Rings);
  vtkSmartPointer<vtkUnstructuredGrid> first;
  for (const int threads : { 1, 3 })
  {
    vtkSMPTools::LocalScope(vtkSMPTools::Config(threads, "STDThread", false),
      [&]()
      {
        auto reconstruction = ReconstructTogether(image);
        if (first)
        {
          const Stop stop(reconstruction, 0.72);
          reconstruction->Update();
          EXPECT_TRUE(stop.WasAsked());
          EXPECT_LT(stop.ProcessorSeconds(), 2.0);
          EXPECT_LT(stop.Where(), stop.AskedAt() + 0.01); // no step has begun
          EXPECT_EQ(reconstruction->GetOutput()->GetNumberOfPoints(), 0);
        }
        reconstruction->Modified();
        reconstruction->Update();
        if (!first)
        {
          first = vtkSmartPointer<vtkUnstructuredGrid>::New();
          first->DeepCopy(reconstruction->GetOutput());
          EXPECT_GT(first->GetNumberOfPoints(), 1000);
        }
        ExpectSame(first, reconstruction->GetOutput());
      });
  }
}

//------------------------------------------------------------------------------
// Where densities are quadratic boxes are exact and no fit over cubes is; a warning says so.
TEST(TSplineReconstruction, FitsSegmentsThatTouchApartWhereBoxesAreBetter)
{
  const auto image = BallInShell([](int label, const double* x, double)
    { return label == 2 ? 200.0 + 0.5 * x[1] * x[1] : 100.0 + 0.3 * x[0] * x[2]; });
  auto reconstruction = ReconstructTogether(image);
  const WarningLog log(reconstruction);
  reconstruction->Update();
  EXPECT_TRUE(log.Says("Segments 1 and 2 are not fitted together over common faces: boxes are as "
                       "good with ")) // a trial with few control points tells
    << log.Text;
  EXPECT_TRUE(log.Says("Segment 1 is fitted over its bounding box: ")) << log.Text;
  EXPECT_TRUE(log.Says("Segment 2 is fitted over its bounding box: boxes are ")) << log.Text;
  const auto report = ReportOn(reconstruction);
  for (const vtkIdType row : { 1, 2 })
  {
    EXPECT_EQ(report->GetValueByName(row, "Domain").ToString(), "SegmentBox");
  }
  EXPECT_LT(report->GetValueByName(3, "RoundTripRMSPercent").ToDouble(), 1e-4);
}
