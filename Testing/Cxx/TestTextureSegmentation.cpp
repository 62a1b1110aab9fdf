// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ErrorLog.h"
#include "vtkTextureSegmentation.h"

#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkSMPTools.h"
#include "vtkUnsignedCharArray.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace
{
constexpr int Size[3] = { 24, 22, 20 };

// A half of layers and a checkered half, the extent far from zero, with a density far from zero.
template <typename ArrayT = vtkDoubleArray>
vtkNew<vtkImageData> HalvesImage(double scale = 1.0, double offset = 1000.0)
{
  vtkNew<vtkImageData> image;
  image->SetExtent(-7, -7 + Size[0] - 1, 100, 100 + Size[1] - 1, 3, 3 + Size[2] - 1);
  image->SetSpacing(0.5, 1.25, 2.0);
  vtkNew<ArrayT> density;
  density->SetName("density");
  density->SetNumberOfTuples(image->GetNumberOfPoints());
  for (vtkIdType id = 0; id < image->GetNumberOfPoints(); ++id)
  {
    const int x = id % Size[0], y = id / Size[0] % Size[1], z = id / (Size[0] * Size[1]);
    const int parity = x < Size[0] / 2 ? z % 2 : (x + y + z) % 2;
    const double noise = std::sin(12.9898 * x * y + 78.233 * y * z + 37.719 * z * x);
    density->SetComponent(
      id, 0, offset + scale * (3.0 * parity + 0.4 * noise + (x < 12 ? 0 : 0.1)));
  }
  image->GetPointData()->SetScalars(density);
  vtkNew<vtkFloatArray> other;
  other->SetName("other");
  other->SetNumberOfTuples(image->GetNumberOfPoints());
  other->Fill(7.0);
  image->GetPointData()->AddArray(other);
  return image;
}

vtkIntArray* SegmentsOf(vtkImageData* image)
{
  return vtkIntArray::SafeDownCast(image->GetPointData()->GetArray("Segment"));
}

void ExpectHalves(vtkImageData* image)
{
  vtkIntArray* segment = SegmentsOf(image);
  ASSERT_NE(segment, nullptr);
  vtkIdType wrong = 0;
  for (vtkIdType id = 0; id < image->GetNumberOfPoints(); ++id)
  {
    wrong += segment->GetValue(id) != (id % Size[0] >= Size[0] / 2);
  }
  EXPECT_LE(wrong, image->GetNumberOfPoints() / 100);
}

// On a bad input there is exactly one error, and nothing comes out.
void ExpectFault(vtkTextureSegmentation* filter, ErrorLog& log, const std::string& words)
{
  filter->Modified();
  filter->Update();
  const std::string message = log.TakeOnly();
  EXPECT_NE(message.find(words), std::string::npos) << message;
  EXPECT_EQ(SegmentsOf(filter->GetOutput()), nullptr);
}

std::vector<std::string> WarningsOf(vtkTextureSegmentation* filter)
{
  std::vector<std::string> warnings;
  vtkNew<vtkCallbackCommand> collect;
  collect->SetClientData(&warnings);
  collect->SetCallback([](vtkObject*, unsigned long, void* all, void* text)
    { static_cast<std::vector<std::string>*>(all)->push_back(static_cast<char*>(text)); });
  filter->AddObserver(vtkCommand::WarningEvent, collect);
  filter->Update();
  filter->RemoveObserver(collect);
  return warnings;
}
}

//------------------------------------------------------------------------------
TEST(TextureSegmentation, AddsSegmentsToTheImage)
{
  vtkNew<vtkImageData> image = HalvesImage();
  vtkNew<vtkTextureSegmentation> filter;
  filter->SetInputData(image);
  filter->SetNumberOfSegments(2);
  filter->Update();
  vtkImageData* output = filter->GetOutput();
  ExpectHalves(output);
  EXPECT_EQ(output->GetPointData()->GetArray("density"), image->GetPointData()->GetScalars());
  EXPECT_EQ(output->GetPointData()->GetScalars(), image->GetPointData()->GetScalars());
  EXPECT_NE(output->GetPointData()->GetArray("other"), nullptr);
  EXPECT_EQ(output->GetPointData()->GetArray("Contrast"), nullptr);
  for (int a = 0; a < 6; ++a)
  {
    EXPECT_EQ(output->GetExtent()[a], image->GetExtent()[a]);
  }

  vtkFieldData* data = output->GetFieldData();
  vtkDataArray* centres = data->GetArray("SegmentCentres");
  ASSERT_NE(centres, nullptr);
  EXPECT_EQ(centres->GetNumberOfTuples(), 2);
  EXPECT_EQ(centres->GetNumberOfComponents(), filter->GetNumberOfTextureAttributes() + 1);
  EXPECT_STREQ(centres->GetComponentName(filter->GetNumberOfTextureAttributes()), "Density");
  vtkDataArray* means = data->GetArray("SegmentMeanDensity");
  vtkDataArray* sizes = data->GetArray("SegmentSize");
  for (int s = 0; s < 2; ++s)
  {
    EXPECT_NEAR(means->GetTuple1(s), 1001.5 + 0.1 * s, 0.06);
    EXPECT_NEAR(sizes->GetTuple1(s), Size[0] * Size[1] * Size[2] / 2, 150);
  }
  EXPECT_EQ(data->GetArray("SegmentCriterion")->GetComponent(0, 0), 2.0);
}

TEST(TextureSegmentation, GivesAttributesOnRequest)
{
  vtkNew<vtkImageData> image = HalvesImage();
  vtkNew<vtkTextureSegmentation> filter;
  filter->SetInputData(image);
  filter->SetNumberOfSegments(2);
  filter->SetOutputAttributes(true);
  filter->ClearTextureAttributes();
  filter->AddTextureAttribute("Contrast");
  filter->AddTextureAttribute("AngularSecondMoment");
  filter->AddTextureAttribute("Contrast");
  filter->SetDirectionRange(true);
  filter->Update();
  ExpectHalves(filter->GetOutput());
  for (const char* name :
    { "Contrast", "AngularSecondMoment", "ContrastRange", "AngularSecondMomentRange" })
  {
    vtkDataArray* array = filter->GetOutput()->GetPointData()->GetArray(name);
    ASSERT_NE(array, nullptr) << name;
    double range[2];
    array->GetRange(range);
    EXPECT_GE(range[0], 0.0);
    EXPECT_LE(range[1], 1.0);
    EXPECT_LT(range[0], range[1]);
  }
  EXPECT_EQ(filter->GetOutput()->GetPointData()->GetNumberOfArrays(), 2 + 1 + 4);
}

TEST(TextureSegmentation, DoesNotDependOnTheTypeOfTheValues)
{
  vtkNew<vtkTextureSegmentation> filter;
  filter->SetNumberOfSegments(2);
  filter->SetInputData(HalvesImage<vtkUnsignedCharArray>(20.0, 50.0));
  filter->Update();
  ExpectHalves(filter->GetOutput());
  filter->SetInputData(HalvesImage<vtkIntArray>(1000.0, 1e9));
  filter->Update();
  ExpectHalves(filter->GetOutput());
  filter->SetInputData(HalvesImage<vtkFloatArray>(1e-20, 0.0));
  filter->Update();
  ExpectHalves(filter->GetOutput());
}

TEST(TextureSegmentation, TakesTheGreyLevelsThatItIsGiven)
{
  vtkNew<vtkImageData> image = HalvesImage();
  vtkNew<vtkTextureSegmentation> filter;
  filter->SetInputData(image);
  filter->SetNumberOfSegments(2);
  filter->SetAutomaticGreyLevelRange(false);
  filter->SetGreyLevelRange(1000.0, 1003.0);
  filter->SetGreyLevels(4);
  filter->Update();
  ExpectHalves(filter->GetOutput());
  // Levels that see no difference see no texture.
  filter->SetGreyLevelRange(0.0, 1.0);
  filter->SetOutputAttributes(true);
  filter->Update();
  double range[2];
  filter->GetOutput()->GetPointData()->GetArray("Contrast")->GetRange(range);
  EXPECT_EQ(range[0], 0.0);
  EXPECT_EQ(range[1], 0.0);
}

//------------------------------------------------------------------------------
TEST(TextureSegmentation, DoesNotDependOnThreads)
{
  vtkNew<vtkImageData> image = HalvesImage();
  std::vector<std::vector<int>> labels;
  for (const int threads : { 1, 2, 5 })
  {
    vtkNew<vtkTextureSegmentation> filter;
    filter->SetInputData(image);
    filter->SetNumberOfSegments(2);
    vtkSMPTools::LocalScope(
      vtkSMPTools::Config{ threads, "STDThread", false }, [&]() { filter->Update(); });
    vtkIntArray* segment = SegmentsOf(filter->GetOutput());
    labels.emplace_back(segment->GetPointer(0), segment->GetPointer(segment->GetNumberOfValues()));
  }
  EXPECT_EQ(labels[0], labels[1]);
  EXPECT_EQ(labels[0], labels[2]);
}

TEST(TextureSegmentation, WarnsWhenThereAreFewerSegments)
{
  vtkNew<vtkImageData> image = HalvesImage(0.0);
  vtkNew<vtkTextureSegmentation> filter;
  filter->SetInputData(image);
  filter->SetNumberOfSegments(4);
  const std::vector<std::string> warnings = WarningsOf(filter);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings.front().find("All values are 1000"), std::string::npos) << warnings.front();
  int range[2];
  SegmentsOf(filter->GetOutput())->GetValueRange(range);
  EXPECT_EQ(range[1], 0);

  // Two values, and nothing else to tell by.
  vtkDataArray* density = image->GetPointData()->GetArray("density");
  for (vtkIdType id = 0; id < image->GetNumberOfPoints(); ++id)
  {
    density->SetComponent(id, 0, 2 * id < image->GetNumberOfPoints() ? 3.0 : 7.0);
  }
  image->Modified();
  filter->ClearTextureAttributes();
  const std::vector<std::string> again = WarningsOf(filter);
  ASSERT_EQ(again.size(), 1u);
  EXPECT_NE(again.front().find("2 segments that differ, not 4"), std::string::npos)
    << again.front();
  SegmentsOf(filter->GetOutput())->GetValueRange(range);
  EXPECT_EQ(range[1], 1);
}

//------------------------------------------------------------------------------
TEST(TextureSegmentation, SaysWhatIsWrong)
{
  vtkNew<vtkTextureSegmentation> filter;
  ErrorLog log(filter);
  vtkNew<vtkImageData> empty;
  filter->SetInputData(empty);
  ExpectFault(filter, log, "The image has no points.");

  vtkNew<vtkImageData> image = HalvesImage();
  filter->SetInputData(image);
  filter->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "absent");
  ExpectFault(filter, log, "does not have the point array \"absent\"");
  filter->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "density");

  vtkDataArray* density = image->GetPointData()->GetArray("density");
  for (const double bad : { std::nan(""), std::numeric_limits<double>::infinity(), 1e300 })
  {
    const double before = density->GetComponent(24 * 22 * 2 + 24 * 3 + 5, 0);
    density->SetComponent(24 * 22 * 2 + 24 * 3 + 5, 0, bad);
    ExpectFault(filter, log, "at the point (-2, 103, 5)");
    density->SetComponent(24 * 22 * 2 + 24 * 3 + 5, 0, before);
  }

  filter->AddTextureAttribute("Roughness");
  ExpectFault(filter, log, "no texture attribute \"Roughness\"");
  filter->ClearTextureAttributes();
  filter->SetDensityWeight(0.0);
  ExpectFault(filter, log, "nothing to tell segments by");
  filter->SetDensityWeight(1.0);
  filter->SetAutomaticGreyLevelRange(false);
  filter->SetGreyLevelRange(3.0, 3.0);
  ExpectFault(filter, log, "grey-level range is empty");
  filter->SetGreyLevelRange(-std::numeric_limits<double>::infinity(), 3.0);
  ExpectFault(filter, log, "grey-level range from -inf to 3 is not finite");
  filter->SetAutomaticGreyLevelRange(true);

  filter->SetGradientWeight(1.0);
  image->SetSpacing(0.5, 0.0, 1.0);
  ExpectFault(filter, log, "no gradient in an image with the spacing 0.5, 0, 1");
  filter->SetGradientWeight(0.0);

  vtkNew<vtkDoubleArray> vectors;
  vectors->SetName("density");
  vectors->SetNumberOfComponents(3);
  vectors->SetNumberOfTuples(image->GetNumberOfPoints());
  vectors->Fill(0.0);
  image->GetPointData()->AddArray(vectors);
  ExpectFault(filter, log, "has 3 components; one is needed");
  vectors->SetNumberOfComponents(1);
  vectors->SetNumberOfTuples(5);
  ExpectFault(filter, log, "has 5 values for 10560 points");

  vtkNew<vtkImageData> thin;
  thin->SetDimensions(9, 8, 1);
  thin->AllocateScalars(VTK_DOUBLE, 1);
  thin->GetPointData()->GetScalars()->SetName("density");
  filter->SetInputData(thin);
  ExpectFault(filter, log, "9 x 8 x 1 points; a volume needs two or more");
  thin->SetDimensions(9, 8, 6);
  thin->AllocateScalars(VTK_DOUBLE, 1);
  thin->GetPointData()->GetScalars()->SetName("density");
  thin->GetPointData()->GetScalars()->Fill(1.0);
  filter->SetWindowRadius(3);
  ExpectFault(filter, log, "WindowRadius of 3 has 7 points along each axis");
}

TEST(TextureSegmentation, StopsWhenAborted)
{
  vtkNew<vtkImageData> image = HalvesImage();
  vtkNew<vtkTextureSegmentation> filter;
  filter->SetInputData(image);
  double last = -1.0;
  vtkNew<vtkCallbackCommand> stop;
  stop->SetClientData(&last);
  stop->SetCallback(
    [](vtkObject* caller, unsigned long, void* seen, void* progress)
    {
      *static_cast<double*>(seen) = *static_cast<double*>(progress);
      if (*static_cast<double*>(progress) > 0.5 && *static_cast<double*>(progress) < 1.0)
      {
        static_cast<vtkAlgorithm*>(caller)->SetAbortExecuteAndUpdateTime();
      }
    });
  filter->AddObserver(vtkCommand::ProgressEvent, stop);
  filter->Update();
  EXPECT_GT(last, 0.5);
  EXPECT_EQ(SegmentsOf(filter->GetOutput()), nullptr);
}
