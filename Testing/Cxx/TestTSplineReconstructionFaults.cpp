// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ErrorLog.h"
#include "ReconstructionPhantom.h"
#include "Stop.h"
#include "WarningLog.h"

#include "vtkPolyData.h"
#include "vtkSMPTools.h"

#include <ctime>
#include <functional>
#include <limits>
#include <memory>
#include <vector>

using namespace trivariate_testing;

namespace
{
//------------------------------------------------------------------------------
// With an array Density of 3 everywhere.
vtkNew<vtkImageData> Lattice(int nx, int ny, int nz, int components)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(nx, ny, nz);
  vtkNew<vtkFloatArray> density;
  density->SetName("Density");
  density->SetNumberOfComponents(components);
  density->SetNumberOfTuples(image->GetNumberOfPoints());
  density->Fill(3.0);
  image->GetPointData()->SetScalars(density);
  return image;
}

//------------------------------------------------------------------------------
// All arrays of numbers but times.
void ExpectSameArrays(vtkFieldData* a, vtkFieldData* b)
{
  ASSERT_GT(a->GetNumberOfArrays(), 0);
  ASSERT_EQ(a->GetNumberOfArrays(), b->GetNumberOfArrays());
  for (int i = 0; i < a->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* one = a->GetArray(i);
    if (!one || std::strcmp(one->GetName(), "Seconds") == 0)
    {
      continue;
    }
    vtkDataArray* other = b->GetArray(one->GetName());
    ASSERT_NE(other, nullptr) << one->GetName();
    ASSERT_EQ(one->GetNumberOfValues(), other->GetNumberOfValues()) << one->GetName();
    ASSERT_EQ(std::memcmp(one->GetVoidPointer(0), other->GetVoidPointer(0),
                one->GetDataTypeSize() * one->GetNumberOfValues()),
      0)
      << one->GetName();
  }
}

// The spline, the rounds of the fits, and the fields.
struct Results
{
  vtkNew<vtkUnstructuredGrid> Spline;
  vtkNew<vtkTable> Rounds;
  vtkNew<vtkImageData> Fields;

  explicit Results(vtkTSplineReconstruction* reconstruction)
  {
    this->Spline->DeepCopy(reconstruction->GetOutput());
    this->Rounds->DeepCopy(reconstruction->GetOutputDataObject(1));
    this->Fields->DeepCopy(reconstruction->GetOutputDataObject(6));
  }

  void ExpectSameAs(const Results& other) const
  {
    ExpectSame(this->Spline, other.Spline);
    ExpectSameArrays(this->Rounds->GetRowData(), other.Rounds->GetRowData());
    ExpectSameArrays(this->Fields->GetPointData(), other.Fields->GetPointData());
  }
};
}

//------------------------------------------------------------------------------
// Asked to stop in each step, it works for less than two seconds more where all of it takes many,
// starts no further step, and gives nothing; and then all, as if nothing had been.
TEST(TSplineReconstruction, StopsInEveryStepAndRunsAgain)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(48, 48, 48);
  vtkNew<vtkFloatArray> density;
  density->SetName("Density");
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    double x[3];
    image->GetPoint(i, x);
    const bool inside = std::hypot(x[0] - 23.0, 1.3 * (x[1] - 24.0), x[2] - 23.5) < 19.0;
    density->InsertNextValue(static_cast<float>(
      inside ? 100.0 + 10.0 * std::sin(0.9 * x[0]) * std::cos(0.4 * x[1]) : 0.3 * x[2]));
  }
  image->GetPointData()->SetScalars(density);
  std::unique_ptr<Results> first;
  for (const int threads : { 1, 2, 3 })
  {
    vtkSMPTools::LocalScope(vtkSMPTools::Config(threads, "STDThread", false),
      [&first, &image, threads]()
      {
        auto reconstruction = Reconstruct(image);
        reconstruction->SetInputArrayToProcess(
          1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "None");
        reconstruction->SetNumberOfSegments(2);
        reconstruction->SetDomainToAutomatic();
        // Segmentation, topology, surfaces, cubes, frames, parameters, and fits over box and cubes.
        const std::vector<double> places =
          threads == 1   ? std::vector<double>{ 0.1, 0.21, 0.24, 0.3, 0.36, 0.43, 0.55, 0.75 }
          : threads == 2 ? std::vector<double>{}
                         : std::vector<double>{ 0.43 };
        for (const double at : places)
        {
          const Stop stop(reconstruction, at);
          reconstruction->Update();
          EXPECT_TRUE(stop.WasAsked()) << at;
          EXPECT_LT(stop.ProcessorSeconds(), 2.0) << at;
          EXPECT_LT(stop.Where(), stop.AskedAt() + 0.01) << at; // no step has begun
          for (int port = 0; port < reconstruction->GetNumberOfOutputPorts(); ++port)
          {
            EXPECT_EQ(
              reconstruction->GetOutputDataObject(port)->GetNumberOfElements(vtkDataObject::POINT) +
                reconstruction->GetOutputDataObject(port)->GetNumberOfElements(vtkDataObject::ROW),
              0)
              << at << ", output " << port;
          }
        }
        reconstruction->Modified();
        const std::clock_t start = std::clock();
        reconstruction->Update();
        EXPECT_GT(double(std::clock() - start) / CLOCKS_PER_SEC, 5.0); // or two seconds say little
        EXPECT_EQ(reconstruction->GetProgress(), 1.0);
        auto results = std::make_unique<Results>(reconstruction);
        if (!first)
        {
          first = std::move(results);
          EXPECT_GT(first->Spline->GetNumberOfPoints(), 100);
          EXPECT_NE(first->Fields->GetPointData()->GetArray("Parameter"), nullptr);
          return;
        }
        results->ExpectSameAs(*first);
      });
  }
}

//------------------------------------------------------------------------------
TEST(TSplineReconstruction, SaysWhatIsWrong)
{
  const auto image = Phantom();
  auto reconstruction = Reconstruct(image);
  reconstruction->SetDomainToSegments();
  ErrorLog log(reconstruction);
  const auto expect = [&reconstruction, &log](const char* words)
  {
    reconstruction->Modified();
    reconstruction->Update();
    const std::string text = log.TakeOnly();
    EXPECT_NE(text.find(words), std::string::npos) << text;
    EXPECT_EQ(reconstruction->GetOutput()->GetNumberOfPoints(), 0) << words;
  };
  reconstruction->SetInputArrayToProcess(
    1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "absent");
  expect("no point array \"absent\" of labels");
  reconstruction->SetInputArrayToProcess(
    1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Material");
  reconstruction->AddAttribute("absent");
  expect("no point array \"absent\" to fit");
  reconstruction->ClearAttributes();
  vtkDataArray* labels = image->GetPointData()->GetArray("Material");
  labels->SetTuple1(3, -4.0);
  image->Modified();
  expect("The array \"Material\" is -4 at voxel (5, -1, 0); labels are whole numbers");
  labels->SetTuple1(3, 0.0);
  for (const double label : { 0.5, std::numeric_limits<double>::quiet_NaN(), 1e10 })
  {
    vtkNew<vtkFloatArray> others;
    others->DeepCopy(labels);
    others->SetName("Others");
    others->SetTuple1(77, label);
    image->GetPointData()->AddArray(others);
    reconstruction->SetInputArrayToProcess(
      1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Others");
    expect("The array \"Others\" is ");
    expect("labels are whole numbers");
  }
  reconstruction->SetInputArrayToProcess(
    1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Material");
  image->GetPointData()->GetArray("Density")->SetTuple1(
    77, std::numeric_limits<double>::infinity());
  image->Modified();
  expect("finite");
  const auto slice = Lattice(12, 9, 1, 1);
  for (const int domain : { vtkTSplineReconstruction::BOX, vtkTSplineReconstruction::SEGMENTS,
         vtkTSplineReconstruction::AUTOMATIC })
  {
    reconstruction->SetDomain(domain);
    reconstruction->SetInputArrayToProcess(
      1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "None");
    reconstruction->SetInputData(slice);
    expect("12 x 9 x 1 points");
  }
  reconstruction->SetInputData(Lattice(12, 2, 9, 1)); // thick enough for a box, not for a texture
  expect("12 x 2 x 9 points; to be split by texture it needs three or more along each axis");
  const auto vectors = Lattice(12, 9, 8, 3); // fitted over a box, but without a texture
  reconstruction->SetInputData(vectors);
  expect("has 3 components");
  vtkNew<vtkImageData> empty;
  reconstruction->SetInputData(empty);
  expect("no points");
}

//------------------------------------------------------------------------------
// The window of the texture is as large as there is room for.
TEST(TSplineReconstruction, TakesAnImageThatIsSmallerThanTheWindow)
{
  const auto image = Lattice(4, 3, 5, 1);
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    image->GetPointData()->GetScalars()->SetTuple1(i, static_cast<double>(i % 7));
  }
  auto reconstruction = Reconstruct(image);
  reconstruction->SetInputArrayToProcess(1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "None");
  reconstruction->SetDomainToAutomatic();
  ErrorLog errors(reconstruction);
  reconstruction->Update();
  EXPECT_EQ(errors.TakeOnly(), "0 errors");
  const auto report = ReportOn(reconstruction);
  const vtkIdType last = report->GetNumberOfRows() - 1;
  EXPECT_EQ(report->GetValueByName(last, "FoundPercent").ToDouble(), 100.0);
  EXPECT_LT(report->GetValueByName(last, "RoundTripRMSPercent").ToDouble(), 1.0);
}

//------------------------------------------------------------------------------
// A constant image is one segment, or the labels', and comes back as it is.
TEST(TSplineReconstruction, StandsForAConstantImage)
{
  const auto image = Lattice(16, 17, 15, 1);
  vtkNew<vtkIntArray> labels;
  labels->SetName("Material");
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    double x[3];
    image->GetPoint(i, x);
    labels->InsertNextValue(std::hypot(x[0] - 7.0, x[1] - 8.0, x[2] - 7.0) < 5.0);
  }
  image->GetPointData()->AddArray(labels);
  for (const char* name : { "None", "Material" })
  {
    auto reconstruction = Reconstruct(image);
    reconstruction->SetInputArrayToProcess(1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, name);
    reconstruction->SetDomainToAutomatic();
    ErrorLog errors(reconstruction);
    WarningLog warnings(reconstruction);
    reconstruction->Update();
    EXPECT_EQ(errors.TakeOnly(), "0 errors");
    const auto report = ReportOn(reconstruction);
    const vtkIdType last = report->GetNumberOfRows() - 1;
    ASSERT_GE(last, 1) << name;
    EXPECT_LT(report->GetValueByName(last, "RoundTripRMSPercent").ToDouble(), 1e-9) << name;
    EXPECT_EQ(report->GetValueByName(last, "FoundPercent").ToDouble(), 100.0) << name;
  }
}
