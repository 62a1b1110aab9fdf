// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// What segments, voxels and arrays that are not the usual ones become in the one click.
#include "ReconstructionPhantom.h"
#include "WarningLog.h"

#include "vtkPolycubeDomain.h"
#include "vtkSegmentBoundary.h"
#include "vtkTSplineSource.h"

#include <algorithm>
#include <array>
#include <functional>

using namespace trivariate_testing;

namespace
{
using Place = std::array<double, 3>;

// n^3 voxels with the point arrays Density and Material: density(label, place).
vtkNew<vtkImageData> Labelled(int n, const std::function<int(const Place&)>& labelAt,
  const std::function<double(int, const Place&)>& densityAt)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(n, n, n);
  vtkNew<vtkFloatArray> density;
  density->SetName("Density");
  vtkNew<vtkIntArray> labels;
  labels->SetName("Material");
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    Place x;
    image->GetPoint(i, x.data());
    labels->InsertNextValue(labelAt(x));
    density->InsertNextValue(static_cast<float>(densityAt(labelAt(x), x)));
  }
  image->GetPointData()->SetScalars(density);
  image->GetPointData()->AddArray(labels);
  return image;
}

double Waves(int, const Place& x)
{
  return 100.0 + 10.0 * std::sin(0.9 * x[0]) * std::cos(0.7 * x[1]);
}

// The domain found for one label.
vtkNew<vtkUnstructuredGrid> FoundFor(vtkImageData* image, int label)
{
  vtkNew<vtkSegmentBoundary> boundary;
  boundary->SetInputData(image);
  boundary->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Material");
  vtkNew<vtkPolycubeDomain> domain;
  domain->SetInputConnection(boundary->GetOutputPort());
  domain->AddSegment(label);
  domain->Update();
  vtkNew<vtkUnstructuredGrid> cubes;
  cubes->DeepCopy(domain->GetPolycube());
  return cubes;
}
}

//------------------------------------------------------------------------------
// A thin spike on a ball is left out by its cubes; the lowest label, a corner of the image far
// away, gets it.
TEST(TSplineReconstruction, StandsForVoxelsThatCubesLeaveOut)
{
  const auto image = Labelled(
    30,
    [](const Place& x)
    {
      const double spike = std::max(std::abs(x[0] - 16.0), std::abs(x[1] - 16.0));
      const bool isIn = std::hypot(x[0] - 16.0, x[1] - 16.0, x[2] - 14.0) < 8.0 ||
                        (spike < 1.1 && x[2] > 14.0 && x[2] < 27.0);
      return isIn ? 2 : std::max({ x[0], x[1], x[2] }) < 4.0 ? 0 : 1;
    },
    [](int label, const Place& x) {
      return label == 2 ? Waves(label, x) : label == 1 ? 20.0 + 0.3 * x[2] : 5.0;
    });
  auto reconstruction = Reconstruct(image);
  reconstruction->SetDomainToGiven();
  reconstruction->SetInputData(1, FoundFor(image, 2));
  reconstruction->SetMaximumNumberOfControlPoints(4000);
  reconstruction->Update();
  auto* segments = Output<vtkImageData>(reconstruction, 2)->GetPointData()->GetArray("Segment");
  vtkIdType given = 0;
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    const double label = image->GetPointData()->GetArray("Material")->GetTuple1(i);
    given += label != segments->GetTuple1(i) ? 1 : 0;
  }
  EXPECT_GT(given, 0);
  const auto report = ReportOn(reconstruction);
  ASSERT_EQ(report->GetNumberOfRows(), 4);
  EXPECT_EQ(report->GetValueByName(2, "Domain").ToString(), "LayeredCubes");
  for (vtkIdType row = 0; row < 4; ++row)
  {
    EXPECT_EQ(report->GetValueByName(row, "FoundPercent").ToDouble(), 100.0) << row;
    EXPECT_LE(report->GetValueByName(row, "RoundTripRMSPercent").ToDouble(),
      1.05 * report->GetValueByName(row, "RMSPercent").ToDouble())
      << row;
  }
}

//------------------------------------------------------------------------------
// Three quarters of a thin ring: voxels more than 1.5 voxels from its block mesh, which the fit
// does not know, are within 1.5 voxels of its spline.
TEST(TSplineReconstruction, KeepsTheRoundTripOfVoxelsWithoutParameter)
{
  const auto image = Labelled(
    30,
    [](const Place& p)
    {
      const double x = p[0] - 14.5, y = p[1] - 14.5, z = p[2] - 14.5;
      const bool isCut = y < -2.0 && std::abs(x) < 9.0;
      return std::hypot(std::hypot(x, y) - 8.0, z) < 3.4 && !isCut ? 1 : 0;
    },
    [](int label, const Place& x) { return label == 1 ? Waves(label, x) : 0.3 * x[2]; });
  auto reconstruction = Reconstruct(image);
  reconstruction->SetDomainToGiven();
  reconstruction->SetInputData(1, FoundFor(image, 1));
  reconstruction->SetMaximumNumberOfControlPoints(500);
  reconstruction->Update();
  const auto report = ReportOn(reconstruction);
  EXPECT_EQ(report->GetValueByName(2, "FoundPercent").ToDouble(), 100.0);
  EXPECT_LE(report->GetValueByName(1, "RoundTripRMSPercent").ToDouble(),
    1.05 * report->GetValueByName(1, "RMSPercent").ToDouble());
}

//------------------------------------------------------------------------------
TEST(TSplineReconstruction, LeavesABadSegmentOutOfTheDomains)
{
  const auto image = Labelled(
    28,
    [](const Place& x)
    {
      const double r = std::hypot(x[0] - 13.5, x[1] - 13.5, x[2] - 13.5);
      return x == Place{ 1.0, 1.0, 1.0 } ? 3 : r < 6.4 ? 2 : r < 11.8 ? 1 : 0;
    },
    [](int label, const Place& x)
    {
      const double r = std::hypot(x[0] - 13.5, x[1] - 13.5, x[2] - 13.5);
      return label == 2   ? 200.0 + 15.0 * std::cos(0.9 * r)
             : label == 1 ? 100.0 + 30.0 * std::cos(1.2 * r)
                          : 10.0;
    });
  auto reconstruction = Reconstruct(image);
  reconstruction->SetDomainToAutomatic();
  reconstruction->SetRMSTolerance(0.0);
  reconstruction->SetMaximumNumberOfControlPoints(2000);
  const WarningLog log(reconstruction);
  reconstruction->Update();
  EXPECT_TRUE(log.Says("Segment 3 is fitted over its bounding box")) << log.Text;
  EXPECT_FALSE(log.Says("No segment is fitted over cubes")) << log.Text;
  const auto report = ReportOn(reconstruction);
  EXPECT_EQ(report->GetValueByName(1, "Domain").ToString(), "LayeredCubes");
  EXPECT_EQ(report->GetValueByName(2, "Domain").ToString(), "LayeredCubes");
}

//------------------------------------------------------------------------------
// The density is almost constant in each segment, the array beside it is not.
TEST(TSplineReconstruction, MeetsTheToleranceOfEveryArray)
{
  const auto image = Labelled(
    20, [](const Place& x) { return std::hypot(x[0] - 9.5, x[1] - 9.5, x[2] - 9.5) < 6.5 ? 1 : 0; },
    [](int label, const Place& x) { return 100.0 * label + 0.001 * x[0]; });
  vtkNew<vtkFloatArray> wave;
  wave->SetName("Wave");
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    const double* x = image->GetPoint(i);
    wave->InsertNextValue(static_cast<float>(std::sin(0.9 * x[0]) * std::cos(0.7 * x[1])));
  }
  image->GetPointData()->AddArray(wave);
  auto reconstruction = Reconstruct(image);
  reconstruction->SetDomainToSegments();
  reconstruction->AddAttribute("Wave");
  reconstruction->SetRMSTolerance(1.0);
  reconstruction->SetMaximumNumberOfControlPoints(20000);
  reconstruction->Update();
  vtkNew<vtkTSplineSource> source;
  source->SetInputConnection(0, reconstruction->GetOutputPort());
  source->SetInputConnection(1, reconstruction->GetOutputPort(2));
  source->SetOutputType(vtkTSplineSource::IMAGE);
  source->Update();
  vtkDataArray* back =
    vtkImageData::SafeDownCast(source->GetOutputDataObject(0))->GetPointData()->GetArray("Wave");
  ASSERT_NE(back, nullptr);
  double squares = 0.0;
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    squares += std::pow(back->GetTuple1(i) - wave->GetValue(i), 2);
  }
  EXPECT_LT(std::sqrt(squares / image->GetNumberOfPoints()), 0.01 * 2.0);
}
