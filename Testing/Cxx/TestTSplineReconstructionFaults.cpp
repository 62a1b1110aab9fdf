// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ErrorLog.h"
#include "ReconstructionPhantom.h"
#include "Stop.h"

#include "vtkPolyData.h"
#include "vtkSMPTools.h"

#include <ctime>
#include <functional>
#include <limits>
#include <vector>

using namespace trivariate_testing;

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
  vtkSmartPointer<vtkUnstructuredGrid> first;
  for (const int threads : { 1, 3 })
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
          threads > 1 ? std::vector<double>{ 0.43 }
                      : std::vector<double>{ 0.1, 0.21, 0.24, 0.3, 0.36, 0.43, 0.55, 0.75 };
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
        if (!first)
        {
          first = vtkSmartPointer<vtkUnstructuredGrid>::New();
          first->DeepCopy(reconstruction->GetOutput());
          EXPECT_GT(first->GetNumberOfPoints(), 100);
        }
        ExpectSame(first, reconstruction->GetOutput());
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
  expect("labels are whole numbers");
  labels->SetTuple1(3, 0.0);
  image->GetPointData()->GetArray("Density")->SetTuple1(
    77, std::numeric_limits<double>::infinity());
  image->Modified();
  expect("finite");
  vtkNew<vtkImageData> empty;
  reconstruction->SetInputData(empty);
  expect("no points");
}
