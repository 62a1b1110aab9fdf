// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ErrorLog.h"
#include "FrameChecks.h"

#include <limits>

using namespace trivariate_testing;

//------------------------------------------------------------------------------
TEST(FrameField, SaysWhatIsWrong)
{
  const vtkNew<vtkImageData> image = Ball(12, 9.3);
  Chain chain(image);
  vtkFrameField* field = chain.Field;
  ErrorLog log(field);
  const auto expectFault = [&](const std::string& text)
  {
    field->Modified();
    field->Update();
    const std::string error = log.TakeOnly();
    EXPECT_NE(error.find(text), std::string::npos) << error << "\nis not\n" << text;
    EXPECT_EQ(field->GetOutput()->GetPointData()->GetArray("FrameU"), nullptr);
    EXPECT_EQ(field->GetSingularGraph()->GetNumberOfCells(), 0);
    EXPECT_EQ(field->GetEnergies()->GetNumberOfRows(), 0);
  };
  // Segments.
  field->AddSegment(7);
  expectFault("There is no segment 7 among the 2 labels from 0 to 1.");
  field->ClearSegments();
  field->AddSegment(0);
  expectFault("Segment 0: It has no patches");
  field->ClearSegments();

  // Images.
  vtkNew<vtkImageData> flat, none, empty, blank;
  flat->SetDimensions(5, 5, 1);
  LabelSolid(flat, Box({ 0.5, 0.5, -1.0 }, { 3.0, 3.0, 2.0 }));
  field->SetInputData(flat);
  expectFault("5 x 5 x 1 points");
  field->SetInputData(none);
  expectFault("no points");
  empty->SetDimensions(5, 5, 5);
  field->SetInputData(empty);
  expectFault("does not have the point array of labels \"Segment\"");
  blank->SetDimensions(5, 5, 5);
  LabelSolid(blank, Box({ 10.5, 10.5, 10.5 }, { 3.0, 3.0, 3.0 }));
  field->SetInputData(blank);
  expectFault("There is no segment 1 among the 1 labels from 0 to 0.");
  field->SetInputConnection(1, nullptr);
  expectFault("All voxels have the label 0");

  // Patches.
  field->SetInputData(image);
  vtkNew<vtkPolyData> patches;
  field->SetInputData(1, patches);
  expectFault("no triangles");
  chain.Domain->Update();
  patches->DeepCopy(chain.Domain->GetOutput());
  patches->GetCellData()->RemoveArray("PatchAxis");
  patches->GetCellData()->RemoveArray("BoundaryLabels");
  expectFault("neither the cell array PatchAxis");
  patches->DeepCopy(chain.Domain->GetOutput());
  patches->GetCellData()->RemoveArray("PatchSide");
  expectFault("no cell array \"PatchSide\"");
  patches->DeepCopy(chain.Domain->GetOutput());
  patches->GetCellData()->GetArray("PatchAxis")->SetComponent(17, 0, 3.0);
  expectFault("\"PatchAxis\" is 3");
  patches->DeepCopy(chain.Domain->GetOutput());
  patches->GetPoints()->SetPoint(5, 0.0, std::numeric_limits<double>::infinity(), 0.0);
  expectFault("Point 5 is not finite");
  patches->DeepCopy(chain.Domain->GetOutput());
  for (vtkIdType id = 0; id < patches->GetNumberOfPoints(); ++id)
  {
    double x[3];
    patches->GetPoint(id, x);
    patches->GetPoints()->SetPoint(id, x[0] + 8.0, x[1], x[2]);
  }
  expectFault("the surface is of another image");
  // u from the high to the low side.
  patches->DeepCopy(chain.Domain->GetOutput());
  vtkDataArray* axis = patches->GetCellData()->GetArray("PatchAxis");
  vtkDataArray* side = patches->GetCellData()->GetArray("PatchSide");
  for (vtkIdType id = 0; id < patches->GetNumberOfCells(); ++id)
  {
    if (axis->GetComponent(id, 0) == 0.0)
    {
      side->SetComponent(id, 0, 1.0 - side->GetComponent(id, 0));
    }
  }
  expectFault("left-handed");

  // A start that needs patches.
  field->SetInputConnection(1, nullptr);
  field->SetStart(vtkFrameField::HARMONIC_COORDINATES);
  expectFault("need constraints with axes");
  field->SetStart(vtkFrameField::LINEAR);

  // And after all that good ones.
  field->SetInputConnection(1, chain.Domain->GetOutputPort());
  field->Update();
  ExpectFrames(field);
}
