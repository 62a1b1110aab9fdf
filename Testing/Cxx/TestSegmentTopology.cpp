// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ErrorLog.h"
#include "vtkSegmentTopology.h"

#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkIdTypeArray.h"
#include "vtkImageData.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace
{
// A ball of label 2 with a tunnel, around it a larger one of label 1 with a speck and a pore.
vtkNew<vtkImageData> Balls()
{
  vtkNew<vtkImageData> image;
  image->SetExtent(-16, 16, 3, 35, 0, 32);
  vtkNew<vtkIntArray> labels;
  labels->SetName("Segment");
  vtkNew<vtkFloatArray> density;
  density->SetName("Density");
  for (vtkIdType id = 0; id < image->GetNumberOfPoints(); ++id)
  {
    const double* p = image->GetPoint(id);
    const double x = p[0], y = p[1] - 19.0, z = p[2] - 16.0;
    const double r = std::sqrt(x * x + y * y + z * z);
    int label = r < 7.5 && std::hypot(x, y) > 1.2 ? 2 : r < 13.0 ? 1 : 0;
    label = x == 0.0 && y == 10.0 && z == 0.0 ? 0 : label;   // a pore
    label = x == 15.0 && y == 15.0 && z == 15.0 ? 1 : label; // a speck
    labels->InsertNextValue(label);
    density->InsertNextValue(static_cast<float>(r));
  }
  image->GetPointData()->SetScalars(density);
  image->GetPointData()->AddArray(labels);
  return image;
}

vtkIdType FieldValue(vtkDataObject* data, const char* name, vtkIdType i)
{
  return vtkIdTypeArray::SafeDownCast(data->GetFieldData()->GetAbstractArray(name))->GetValue(i);
}
}

TEST(SegmentTopologyFilter, MakesSegmentsWhole)
{
  vtkNew<vtkImageData> image = Balls();
  vtkNew<vtkSegmentTopology> topology;
  topology->SetInputData(image);
  topology->SetLargestCavity(10);
  topology->Update();
  vtkImageData* output = topology->GetOutput();
  auto* labels = vtkIntArray::SafeDownCast(output->GetPointData()->GetArray("Segment"));
  ASSERT_NE(labels, nullptr);
  EXPECT_STREQ(output->GetPointData()->GetScalars()->GetName(), "Density") << "passed on";
  EXPECT_EQ(FieldValue(output, "TopologySegment", 0), 2);
  EXPECT_EQ(FieldValue(output, "TopologySegment", 1), 1);
  EXPECT_EQ(FieldValue(output, "TopologyEuler", 0), 1);
  EXPECT_LE(FieldValue(output, "TopologyClosed", 0), 9) << "a plug of the tunnel";
  EXPECT_EQ(FieldValue(output, "TopologyPieces", 1), 1);
  EXPECT_EQ(FieldValue(output, "TopologyCavities", 1), 1);
  EXPECT_EQ(FieldValue(output, "TopologyEuler", 1), 2) << "a shell around segment 2";
  int at[3] = { 0, 29, 16 };
  EXPECT_EQ(labels->GetValue(output->ComputePointId(at)), 1) << "the pore";
  int speck[3] = { 15, 34, 31 };
  EXPECT_EQ(labels->GetValue(output->ComputePointId(speck)), 0);
  // The input is as it was.
  EXPECT_EQ(
    image->GetPointData()->GetArray("Segment")->GetComponent(image->ComputePointId(at), 0), 0.0);
}

TEST(SegmentTopologyFilter, LeavesSegmentsThatAreNotChosenAlone)
{
  vtkNew<vtkImageData> image = Balls();
  vtkNew<vtkSegmentTopology> topology;
  topology->SetInputData(image);
  topology->AddSegment(2);
  topology->Update();
  auto* before = image->GetPointData()->GetArray("Segment");
  auto* after = topology->GetOutput()->GetPointData()->GetArray("Segment");
  vtkIdType changed = 0;
  for (vtkIdType i = 0; i < after->GetNumberOfTuples(); ++i)
  {
    if (before->GetComponent(i, 0) != after->GetComponent(i, 0))
    {
      EXPECT_EQ(after->GetComponent(i, 0), 2.0) << "a plug of the tunnel";
      ++changed;
    }
  }
  EXPECT_GT(changed, 0);
  EXPECT_LE(changed, 9);
}

TEST(SegmentTopologyFilter, SaysWhatIsWrongWithTheInput)
{
  vtkNew<vtkSegmentTopology> topology;
  ErrorLog log(topology);
  vtkNew<vtkImageData> empty;
  topology->SetInputData(empty);
  topology->Update();
  EXPECT_NE(log.TakeOnly().find("no points"), std::string::npos);

  vtkNew<vtkImageData> image = Balls();
  topology->SetInputData(image);
  topology->AddSegment(7);
  topology->Update();
  EXPECT_NE(log.TakeOnly().find("no segment 7"), std::string::npos);
  topology->ClearSegments();

  topology->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Density");
  topology->Update();
  EXPECT_NE(log.TakeOnly().find("whole numbers"), std::string::npos);

  image->GetPointData()->GetArray("Density")->FillComponent(
    0, std::numeric_limits<double>::quiet_NaN());
  topology->Modified();
  topology->Update();
  EXPECT_NE(log.TakeOnly().find("whole numbers"), std::string::npos);

  topology->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Absent");
  topology->Update();
  EXPECT_NE(log.TakeOnly().find("array of labels \"Absent\""), std::string::npos);
  image->GetPointData()->RemoveArray("Segment");
  topology->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Automatic");
  topology->Update();
  EXPECT_NE(log.TakeOnly().find("array of labels \"Segment\""), std::string::npos);
}

// The inner segment is a small cavity of the outer one, which is made whole after it.
TEST(SegmentTopologyFilter, WarnsOfASegmentThatIsGone)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(9, 9, 9);
  vtkNew<vtkIntArray> labels;
  labels->SetName("Segment");
  for (vtkIdType id = 0; id < image->GetNumberOfPoints(); ++id)
  {
    const double* p = image->GetPoint(id);
    const double r = std::max({ std::abs(p[0] - 4), std::abs(p[1] - 4), std::abs(p[2] - 4) });
    labels->InsertNextValue(r < 2.0 ? 2 : r < 4.0 ? 1 : 0);
  }
  image->GetPointData()->AddArray(labels);
  vtkNew<vtkSegmentTopology> topology;
  topology->SetInputData(image);
  std::vector<std::string> warnings;
  vtkNew<vtkCallbackCommand> collect;
  collect->SetClientData(&warnings);
  collect->SetCallback([](vtkObject*, unsigned long, void* seen, void* text)
    { static_cast<std::vector<std::string>*>(seen)->push_back(static_cast<char*>(text)); });
  topology->AddObserver(vtkCommand::WarningEvent, collect);
  topology->Update();
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings.front().find("Segment 2 is gone"), std::string::npos);

  warnings.clear();
  topology->SetLargestCavity(20);
  topology->Update();
  EXPECT_TRUE(warnings.empty());
}

TEST(SegmentTopologyFilter, TakesImagesOneVoxelThickAndOfOneLabel)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(9, 8, 1);
  vtkNew<vtkIntArray> labels;
  labels->SetName("Segment");
  labels->SetNumberOfValues(72);
  labels->FillValue(3);
  image->GetPointData()->AddArray(labels);
  vtkNew<vtkSegmentTopology> topology;
  topology->SetInputData(image);
  topology->Update();
  auto* after = topology->GetOutput()->GetPointData()->GetArray("Segment");
  EXPECT_EQ(after->GetRange()[0], 3.0);
  EXPECT_EQ(FieldValue(topology->GetOutput(), "TopologyEuler", 0), 1);
}
