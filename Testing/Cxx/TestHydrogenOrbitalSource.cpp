// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ErrorLog.h"
#include "vtkHydrogenOrbitalSource.h"

#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkPointData.h"
#include "vtkSMPTools.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

namespace
{
std::vector<float> Values(vtkImageData* image)
{
  auto* density = vtkFloatArray::SafeDownCast(image->GetPointData()->GetScalars());
  EXPECT_TRUE(density && density->GetName() == std::string("Density"));
  return { density->Begin(), density->End() };
}

TEST(HydrogenOrbitalSource, DefaultIsANormalisedImage)
{
  vtkNew<vtkHydrogenOrbitalSource> source;
  source->Update();
  vtkImageData* image = source->GetOutput();
  double bounds[6];
  image->GetBounds(bounds);
  for (int a = 0; a < 3; ++a)
  {
    EXPECT_EQ(image->GetDimensions()[a], 64);
    EXPECT_DOUBLE_EQ(bounds[2 * a], -48.0);
    EXPECT_DOUBLE_EQ(bounds[2 * a + 1], 48.0);
  }
  double sum = 0.0;
  for (const float value : Values(image))
  {
    sum += value;
  }
  // The rest, 5e-4, lies outside of the cube.
  EXPECT_NEAR(sum * std::pow(image->GetSpacing()[0], 3), 1.0, 1e-3);
}

TEST(HydrogenOrbitalSource, GroundStateHasItsKnownValues)
{
  vtkNew<vtkHydrogenOrbitalSource> source;
  source->SetN(1);
  source->SetL(0);
  source->SetHalfWidth(3.0);
  source->SetDimensions(7, 5, 9);
  source->Update();
  const std::vector<float> values = Values(source->GetOutput());
  for (vtkIdType id = 0; id < source->GetOutput()->GetNumberOfPoints(); ++id)
  {
    double x[3];
    source->GetOutput()->GetPoint(id, x);
    const double r = std::sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
    const double expected = std::exp(-2.0 * r) / std::acos(-1.0);
    EXPECT_NEAR(values[id], expected, 1e-7 * expected);
  }
  source->ScaleToUnitOn();
  source->Update();
  EXPECT_FLOAT_EQ(Values(source->GetOutput())[7 * 5 * 4 + 7 * 2 + 3], 1.0f); // the nucleus
}

TEST(HydrogenOrbitalSource, PiecesEqualTheWholeBitByBit)
{
  vtkNew<vtkHydrogenOrbitalSource> source;
  source->SetN(5);
  source->SetL(3);
  source->SetM(-2);
  source->RealFormOn();
  source->ScaleToUnitOn();
  source->SetDimensions(23, 31, 17);
  source->Update();
  vtkNew<vtkImageData> whole;
  whole->DeepCopy(source->GetOutput());
  const std::vector<float> expected = Values(whole);
  for (int pieces = 2; pieces <= 7; ++pieces)
  {
    for (int piece = 0; piece < pieces; ++piece)
    {
      vtkNew<vtkHydrogenOrbitalSource> part;
      part->SetN(5);
      part->SetL(3);
      part->SetM(-2);
      part->RealFormOn();
      part->ScaleToUnitOn();
      part->SetDimensions(23, 31, 17);
      part->UpdatePiece(piece, pieces, piece % 3);
      vtkImageData* image = part->GetOutput();
      const std::vector<float> values = Values(image);
      const int* extent = image->GetExtent();
      ASSERT_LT(image->GetNumberOfPoints(), whole->GetNumberOfPoints());
      std::size_t i = 0;
      for (int z = extent[4]; z <= extent[5]; ++z)
      {
        for (int y = extent[2]; y <= extent[3]; ++y)
        {
          const float* row = &expected[(z * 31 + y) * 23 + extent[0]];
          const int count = extent[1] - extent[0] + 1;
          ASSERT_EQ(std::memcmp(row, &values[i], count * sizeof(float)), 0);
          i += count;
        }
      }
      EXPECT_EQ(i, values.size());
    }
  }
}

TEST(HydrogenOrbitalSource, DoesNotDependOnThreads)
{
  std::vector<float> expected;
  for (const int threads : { 1, 2, 5 })
  {
    vtkSMPTools::Initialize(threads);
    vtkNew<vtkHydrogenOrbitalSource> source;
    source->Update();
    const std::vector<float> values = Values(source->GetOutput());
    if (expected.empty())
    {
      expected = values;
    }
    EXPECT_EQ(values, expected);
  }
  vtkSMPTools::Initialize(0);
}

TEST(HydrogenOrbitalSource, SaysWhatIsWrongOnce)
{
  vtkNew<vtkHydrogenOrbitalSource> source;
  ErrorLog errors(source);
  const auto expectError = [&source, &errors](const std::string& part)
  {
    source->Update();
    EXPECT_NE(errors.TakeOnly().find(part), std::string::npos) << part;
    vtkImageData* output = source->GetOutput();
    EXPECT_EQ(output->GetPointData()->GetNumberOfArrays(), 0);
  };
  source->SetL(4);
  expectError("quantum number l is 4; with n = 4 it must be 0 to 3");
  source->SetL(2);
  source->SetM(-3);
  expectError("quantum number m is -3");
  source->SetM(0);
  source->SetDimensions(8, 1, 8);
  expectError("1 points along axis 1");
  source->SetDimensions(300000, 300000, 300000);
  expectError("memory");
  source->SetDimensions(8, 8, 8);
  for (const double wrong :
    { -1.0, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN() })
  {
    source->SetHalfWidth(wrong);
    expectError("half width");
  }
  source->SetHalfWidth(1e-3);
  source->Update();
  EXPECT_EQ(errors.TakeOnly(), "0 errors");
  EXPECT_EQ(Values(source->GetOutput()).size(), 512u);
  source->SetN(99); // clamped
  EXPECT_EQ(source->GetN(), 16);
}

TEST(HydrogenOrbitalSource, StopsWhenAsked)
{
  vtkNew<vtkHydrogenOrbitalSource> source;
  source->SetDimensions(200, 200, 200);
  vtkNew<vtkCallbackCommand> abort;
  abort->SetCallback([](vtkObject* caller, unsigned long, void*, void*)
    { static_cast<vtkAlgorithm*>(caller)->SetAbortExecute(true); });
  source->AddObserver(vtkCommand::ProgressEvent, abort);
  source->Update();
  EXPECT_EQ(source->GetOutput()->GetNumberOfPoints(), 0);
}
}
