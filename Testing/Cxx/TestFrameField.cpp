// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "FrameChecks.h"

#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkSMPTools.h"

using namespace trivariate_testing;

//------------------------------------------------------------------------------
TEST(FrameField, BoxesHaveConstantFrames)
{
  const Directions straight = { { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } } };
  vtkNew<vtkImageData> image;
  image->SetDimensions(20, 26, 18);
  for (const double shear : { 0.0, 4.0 })
  {
    const Solid box = Box({ 1.5, 1.5, 2.5 }, { 12.0, 20.0, 11.0 }, shear);
    LabelSolid(image, box);
    // The slanted sides of the sheared box bind nothing: no frame could follow both pairs.
    const vtkNew<vtkPolyData> patches =
      PatchesOf(box, 1, shear > 0.0 ? std::set<int>{ 0, 1 } : std::set<int>{});
    vtkNew<vtkFrameField> field;
    field->SetInputData(image);
    field->SetInputData(1, patches);
    field->Update();
    ExpectFrames(field);
    EXPECT_LT(FarthestFrom(field, [&](const double*) { return straight; }), 1e-6);
    EXPECT_LT(Known(field, "FrameAlignmentError"), 1e-3);
    EXPECT_EQ(field->GetSingularGraph()->GetNumberOfCells(), 0);
  }
}

//------------------------------------------------------------------------------
// In an image that is turned in space and has flat voxels.
TEST(FrameField, QuarterAnnulusHasPolarFrames)
{
  const Solid annulus = QuarterAnnulus(11.0, 30.0, 12.0);
  vtkNew<vtkImageData> image;
  image->SetDimensions(32, 32, 9);
  image->SetSpacing(1.0, 1.0, 1.6);
  image->SetOrigin(0.05, 31.1, 0.03); // y runs backwards, z upwards: a left-handed grid
  image->SetDirectionMatrix(1, 0, 0, 0, -1, 0, 0, 0, 1);
  LabelSolid(image, annulus);
  const vtkNew<vtkPolyData> patches = PatchesOf(annulus, 40);
  vtkNew<vtkFrameField> field;
  field->SetInputData(image);
  field->SetInputData(1, patches);
  field->Update();
  ExpectFrames(field);
  const auto polar = [](const double* x) -> Directions
  {
    const double r = std::hypot(x[0], x[1]), c = x[0] / r, s = x[1] / r;
    return { { { c, s, 0 }, { -s, c, 0 }, { 0, 0, 1 } } };
  };
  EXPECT_LT(FarthestFrom(field, polar), std::sin(vtkMath::RadiansFromDegrees(1.0)));
  EXPECT_LT(Known(field, "FrameAlignmentError"), 0.1);
  EXPECT_EQ(field->GetSingularGraph()->GetNumberOfCells(), 0);
}

//------------------------------------------------------------------------------
// Frames that turn with the bar would have the energy of that turn alone; the normals of its sides
// lean, farther from its middle line more.
TEST(FrameField, HelicalBarTurnsItsFrames)
{
  const double turn = 1.2, length = 40.0;
  const Solid bar = HelicalBar(16.0, length, turn);
  vtkNew<vtkImageData> image;
  image->SetExtent(-12, 12, -12, 12, 0, 40);
  image->SetOrigin(0.03, 0.04, 0.5);
  LabelSolid(image, bar);
  const vtkNew<vtkPolyData> patches = PatchesOf(bar, 40);
  vtkNew<vtkFrameField> field;
  field->SetInputData(image);
  field->SetInputData(1, patches);
  field->Update();
  ExpectFrames(field);
  EXPECT_LT(Known(field, "FrameAlignmentError"), 0.1);
  EXPECT_EQ(field->GetSingularGraph()->GetNumberOfCells(), 0);
  const double turned = Known(field, "FrameVoxels") * 20.0 / 3.0 * std::pow(turn / length, 2);
  EXPECT_LT(Known(field, "FrameEnergy"), 2.5 * turned);
  EXPECT_GT(Known(field, "FrameEnergy"), 0.8 * turned);
  // In the middle of the bar they are the bar's.
  const vtkIdType middle = image->FindPoint(0.03, 0.04, 20.5);
  const double angle = turn * 20.5 / length;
  EXPECT_NEAR(FrameAt(field, middle)[0][1], std::sin(angle), 0.01);
  EXPECT_NEAR(FrameAt(field, middle)[1][0], -std::sin(angle), 0.01);
}

//------------------------------------------------------------------------------
// The paper's Figure 2 in space.
TEST(FrameField, PatchesKeepABallFreeOfSingularCurves)
{
  const vtkNew<vtkImageData> image = Ball(15, 12.3);
  Chain aligned(image);
  aligned.Field->Update();
  ExpectFrames(aligned.Field);
  EXPECT_EQ(aligned.Field->GetSingularGraph()->GetNumberOfCells(), 0);
  EXPECT_EQ(Known(aligned.Field, "FrameSingularPlaquettes"), 0.0);
  EXPECT_LT(Known(aligned.Field, "FrameAlignmentError"), 0.1);
  EXPECT_EQ(Known(aligned.Field, "FrameSegment"), 1.0);

  vtkNew<vtkFrameField> alone;
  alone->SetInputData(image);
  vtkNew<vtkFrameField> surface;
  surface->SetInputData(image);
  surface->SetInputConnection(1, aligned.Boundary->GetOutputPort());
  for (vtkFrameField* field : { alone.Get(), surface.Get() })
  {
    field->Update();
    ExpectFrames(field);
    vtkPolyData* graph = field->GetSingularGraph();
    EXPECT_GT(graph->GetNumberOfCells(), 3);
    EXPECT_GT(Known(field, "FrameSingularPlaquettes"), 50.0);
    EXPECT_LT(Known(field, "FrameAlignmentError"), 0.1);
    EXPECT_LT(Known(field, "FrameEnergy"), Known(aligned.Field, "FrameEnergy"));
    ASSERT_NE(graph->GetCellData()->GetArray("Segment"), nullptr);
    for (vtkIdType id = 0; id < graph->GetNumberOfPoints(); ++id)
    {
      EXPECT_LT(vtkMath::Norm(graph->GetPoint(id)), 12.3);
    }
  }
  EXPECT_EQ(Known(alone, "FrameEnergy"), Known(surface, "FrameEnergy"));
}

//------------------------------------------------------------------------------
TEST(FrameField, TellsOfItsSweeps)
{
  const vtkNew<vtkImageData> image = Ball(13, 10.3);
  Chain chain(image);
  chain.Field->Update();
  vtkTable* sweeps = chain.Field->GetEnergies();
  const vtkIdType last = sweeps->GetNumberOfRows() - 1;
  ASSERT_GT(last, 5);
  EXPECT_EQ(sweeps->GetValueByName(0, "Segment").ToInt(), 1);
  EXPECT_GT(sweeps->GetValueByName(0, "Level").ToInt(), 0);
  EXPECT_EQ(sweeps->GetValueByName(0, "Sweep").ToInt(), 0);
  EXPECT_EQ(sweeps->GetValueByName(last, "Level").ToInt(), 0);
  EXPECT_LE(sweeps->GetValueByName(last, "Sweep").ToInt(), 15);
  EXPECT_EQ(
    sweeps->GetValueByName(last, "HarmonicEnergy").ToDouble(), Known(chain.Field, "FrameEnergy"));

  // The paper's way from the principal axes comes near, in more sweeps; options reach the core.
  const double energy = Known(chain.Field, "FrameEnergy");
  chain.Field->SetStep(vtkFrameField::REGISTRATION);
  chain.Field->SetStart(vtkFrameField::PRINCIPAL_AXES);
  chain.Field->CoarseToFineOff();
  chain.Field->RelaxedOff();
  chain.Field->SetSweeps(1000);
  chain.Field->SetEnergyDrop(1e-6);
  chain.Field->Update();
  sweeps = chain.Field->GetEnergies();
  EXPECT_EQ(sweeps->GetValueByName(0, "Level").ToInt(), 0);
  EXPECT_GT(sweeps->GetNumberOfRows(), 30);
  EXPECT_NEAR(Known(chain.Field, "FrameEnergy") / energy, 1.0, 0.01);

  // The energy of crosses itself is a little lower at its own minimum.
  chain.Field->SetStep(vtkFrameField::QUARTIC);
  chain.Field->SetStart(vtkFrameField::HARMONIC_COORDINATES);
  chain.Field->Update();
  EXPECT_LT(Known(chain.Field, "FrameEnergy"), energy);
  EXPECT_GT(Known(chain.Field, "FrameEnergy"), 0.95 * energy);
}

//------------------------------------------------------------------------------
// Both segments are bound at the surface between them, each on its side, in the same directions.
TEST(FrameField, SegmentsShareTheirSurface)
{
  const vtkNew<vtkImageData> image = Ball(15, 13.3, 7.3);
  Chain chain(image);
  chain.Field->Update();
  ExpectFrames(chain.Field);
  EXPECT_EQ(Known(chain.Field, "FrameSegment", 0), 1.0);
  EXPECT_EQ(Known(chain.Field, "FrameSegment", 1), 2.0);
  const auto largest = [&chain](vtkIdType id)
  {
    const double* x = chain.Field->GetOutput()->GetPoint(id);
    double along = 0.0;
    for (const auto& direction : FrameAt(chain.Field, id))
    {
      along = std::max(along, std::abs(vtkMath::Dot(direction.data(), x)) / vtkMath::Norm(x));
    }
    return along;
  };
  double square = 0.0;
  int count = 0;
  for (vtkIdType id = 0; id < image->GetNumberOfPoints(); ++id)
  {
    const double r = vtkMath::Norm(image->GetPoint(id));
    if (std::abs(r - 7.3) < 0.4)
    {
      square += 1.0 - std::pow(largest(id), 2);
      ++count;
    }
  }
  EXPECT_GT(count, 300);
  EXPECT_LT(std::sqrt(square / count), 0.25); // all but the borders of patches

  chain.Field->AddSegment(2);
  chain.Field->Update();
  EXPECT_EQ(Known(chain.Field, "FrameSegment"), 2.0);
  EXPECT_EQ(
    chain.Field->GetOutput()->GetFieldData()->GetAbstractArray("FrameSegment")->GetNumberOfTuples(),
    1);
  const vtkIdType outside = image->FindPoint(10.0, 0.0, 0.0);
  EXPECT_EQ(FrameAt(chain.Field, outside), Directions());
}

//------------------------------------------------------------------------------
TEST(FrameField, DoesNotDependOnThreadsOrPieces)
{
  const vtkNew<vtkImageData> image = Ball(14, 11.3);
  for (const bool aligned : { true, false })
  {
    std::vector<vtkSmartPointer<vtkFloatArray>> results;
    for (const auto& [threads, pieces] : { std::pair(1, 1), std::pair(2, 1), std::pair(3, 2) })
    {
      vtkSMPTools::Initialize(threads);
      Chain chain(image);
      if (!aligned)
      {
        chain.Field->SetInputConnection(1, nullptr);
      }
      chain.Field->UpdatePiece(0, pieces, 0);
      results.push_back(FrameArray(chain.Field, 0));
    }
    vtkSMPTools::Initialize(0);
    for (const auto& result : results)
    {
      ASSERT_EQ(result->GetNumberOfValues(), results[0]->GetNumberOfValues());
      EXPECT_TRUE(std::equal(result->GetPointer(0),
        result->GetPointer(0) + result->GetNumberOfValues(), results[0]->GetPointer(0)));
    }
  }
}

//------------------------------------------------------------------------------
TEST(FrameField, ReportsProgressAndStops)
{
  const vtkNew<vtkImageData> image = Ball(13, 10.3);
  vtkNew<vtkFrameField> field;
  field->SetInputData(image);
  double last = 0.0;
  vtkNew<vtkCallbackCommand> watch;
  watch->SetClientData(&last);
  watch->SetCallback(
    [](vtkObject* caller, unsigned long, void* last, void*)
    {
      auto* algorithm = static_cast<vtkAlgorithm*>(caller);
      EXPECT_GE(algorithm->GetProgress(), *static_cast<double*>(last));
      *static_cast<double*>(last) = algorithm->GetProgress();
      if (algorithm->GetProgress() > 0.5)
      {
        algorithm->SetAbortExecute(1);
      }
    });
  field->AddObserver(vtkCommand::ProgressEvent, watch);
  field->Update();
  EXPECT_GT(last, 0.5);
  EXPECT_EQ(field->GetOutput()->GetPointData()->GetArray("FrameU"), nullptr);
  EXPECT_EQ(field->GetSingularGraph()->GetNumberOfCells(), 0);
}
