// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "DomainChecks.h"
#include "ParameterChain.h"
#include "ParameterChecks.h"
#include "Stop.h"

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIdTypeArray.h"
#include "vtkSMPTools.h"
#include "vtkUnsignedCharArray.h"

using namespace trivariate_testing;

namespace
{
// A quarter of a ring.
int BentBar(const double* p)
{
  const double r = std::hypot(p[0], p[1]);
  return r > 12.2 && r < 24.7 && p[0] > 0.5 && p[1] > 0.5 && std::abs(p[2]) < 6.4;
}
const int BarExtent[6] = { 0, 27, 0, 27, -9, 9 };

// Its corners by hand: along the radius, the arc, the axis. Geodesics alone would cut off the outer
// arc.
void PickCornersOfBar(ParameterChain& chain, bool mirrored)
{
  vtkNew<vtkPoints> points;
  for (int corner = 0; corner < 8; ++corner)
  {
    const double radius = corner & 1 ? 24.7 : 12.2;
    const double angle = corner & 2 ? std::acos(0.0) - 0.03 : 0.03;
    const double height = ((corner & 4) != 0) != mirrored ? 6.4 : -6.4;
    const double index[3] = { radius * std::cos(angle), radius * std::sin(angle), height };
    double place[3];
    chain.Image->TransformContinuousIndexToPhysicalPoint(index, place);
    points->InsertNextPoint(place);
  }
  vtkNew<vtkPolyData> corners;
  corners->SetPoints(points);
  chain.Domain->SetMode(vtkPolycubeDomain::MANUAL);
  chain.Domain->SetNumberOfCubes(1, 1, 1);
  chain.Domain->SetInputData(1, corners);
  chain.Domain->RelaxBordersOn();
}

int BallInBall(const double* p)
{
  const double r = vtkMath::Norm(p);
  return r < 5.2 ? 2 : r < 10.3 ? 1 : 0;
}
const int BallExtent[6] = { -13, 13, -13, 13, -13, 13 };
}

//------------------------------------------------------------------------------
TEST(VolumeParameterization, OneGridInABentBar)
{
  for (const int way : { 0, 1, 2, 3 })
  {
    const bool turned = way & 1;
    ParameterChain chain(BarExtent, BentBar, false, turned);
    if (way & 2)
    {
      PickCornersOfBar(chain, turned);
    }
    vtkImageData* image = chain.Update();
    ExpectParameters(chain, 0.1);
    EXPECT_EQ(image->GetPointData()->GetArray("Block")->GetRange()[1], 0.0);
    for (int axis = 0; axis < 3; ++axis)
    {
      EXPECT_LT(chain.Known("ParameterIterations", axis), 45.0);
      EXPECT_LT(chain.Known("ParameterResidual", axis), 1e-8);
      EXPECT_LT(chain.Known("ParameterDeviation", axis), 0.005);
      EXPECT_GT(
        chain.Known("ParameterLargestDeviation", axis), chain.Known("ParameterDeviation", axis));
    }
    // The sides of the bar, and an arc between the inner and the outer one.
    std::array<double, 3> lengths;
    for (int axis = 0; axis < 3; ++axis)
    {
      lengths[axis] = chain.Known("ParameterLengths", axis);
    }
    ExpectFollowsFrames(image, lengths);
    std::sort(lengths.begin(), lengths.end());
    EXPECT_NEAR(lengths[0], 12.5, 1.0);
    EXPECT_NEAR(lengths[1], 12.8, 1.0);
    EXPECT_GT(lengths[2], std::acos(0.0) * 13.0);
    EXPECT_LT(lengths[2], std::acos(0.0) * 24.0);
  }
}

//------------------------------------------------------------------------------
// What is solved for along the frames changes with how; the place in the block mesh does not.
TEST(VolumeParameterization, OptionsChangeWhatIsSolvedFor)
{
  ParameterChain chain(BarExtent, BentBar, false);
  const auto valuesOf = [&chain](const char* name)
  {
    vtkDataArray* array = chain.Update()->GetPointData()->GetArray(name);
    std::vector<double> values;
    for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
    {
      values.insert(values.end(), array->GetTuple3(i), array->GetTuple3(i) + 3);
    }
    return values;
  };
  const std::vector<double> places = valuesOf("Parameter"), solved = valuesOf("FrameParameter");
  const auto expect = [&](const char* option, double least, double most)
  {
    EXPECT_EQ(valuesOf("Parameter"), places) << option;
    double change = 0.0;
    const std::vector<double> changed = valuesOf("FrameParameter");
    for (std::size_t i = 0; i < solved.size(); ++i)
    {
      change = std::max(change, std::abs(changed[i] - solved[i]));
    }
    EXPECT_GT(change, least) << option;
    EXPECT_LT(change, most) << option;
  };
  vtkVolumeParameterization* filter = chain.Parameters;
  filter->SetTolerance(1e-4);
  expect("Tolerance", 1e-9, 1e-3);
  filter->SetRounds(2);
  expect("Rounds", 1e-3, 0.5);
  filter->SetRounds(0);
  filter->SetGradient(vtkVolumeParameterization::POLYNOMIAL);
  expect("Gradient", 1e-3, 0.5);
  filter->SetGradient(vtkVolumeParameterization::TRILINEAR);
  filter->SetEpsilon(0.05);
  expect("Epsilon", 0.01, 0.5);
}

//------------------------------------------------------------------------------
TEST(VolumeParameterization, LayersInABall)
{
  ParameterChain chain(
    BallExtent, [](const double* p) { return BallInBall(p) != 0; }, true);
  chain.Update();
  ExpectParameters(chain, 0.1);
  EXPECT_EQ(ValuesOf(CellArray(chain.Parameters->GetPolycube(), "Block")).size(), 7U);
}

//------------------------------------------------------------------------------
// Faces that two blocks have in common have the same points, bit by bit, of two segments too.
TEST(VolumeParameterization, SegmentsShareTheirInterface)
{
  ParameterChain chain(BallExtent, BallInBall, true);
  chain.Update();
  ExpectParameters(chain, 0.1);
  std::map<Place, std::set<int>> owners;
  const vtkIdType blocks = chain.Parameters->GetPolycube()->GetNumberOfCells();
  vtkIdType onInterface = 0;
  for (vtkIdType b = 0; b < blocks; ++b)
  {
    vtkStructuredGrid* grid = chain.Block(b);
    for (vtkIdType id = 0; id < grid->GetNumberOfPoints(); ++id)
    {
      const double* p = grid->GetPoint(id);
      owners[{ p[0], p[1], p[2] }].insert(
        static_cast<int>(CellArray(grid, "Segment")->GetComponent(0, 0)));
    }
  }
  for (const auto& [place, segments] : owners)
  {
    if (segments.size() == 2)
    {
      EXPECT_NEAR(vtkMath::Norm(place.data()), 5.0, 0.8);
      ++onInterface;
    }
    else if (*segments.begin() == 2)
    {
      EXPECT_LT(vtkMath::Norm(place.data()), 5.4);
    }
    else
    {
      EXPECT_GT(vtkMath::Norm(place.data()), 4.6);
    }
  }
  EXPECT_GT(onInterface, 50);
}

//------------------------------------------------------------------------------
TEST(VolumeParameterization, IsTheSameOnOneThread)
{
  ParameterChain chain(BarExtent, BentBar, false);
  vtkNew<vtkImageData> threaded;
  threaded->DeepCopy(chain.Update());
  chain.Parameters->Modified();
  const vtkSMPTools::Config one{ 1, "STDThread", false };
  vtkSMPTools::LocalScope(one, [&chain]() { chain.Update(); });
  vtkDataArray* a = threaded->GetPointData()->GetArray("Parameter");
  vtkDataArray* b = chain.Parameters->GetOutput()->GetPointData()->GetArray("Parameter");
  for (vtkIdType id = 0; id < a->GetNumberOfTuples(); ++id)
  {
    for (int c = 0; c < 3; ++c)
    {
      ASSERT_EQ(a->GetComponent(id, c), b->GetComponent(id, c)) << id;
    }
  }
}

//------------------------------------------------------------------------------
// While it solves, and while it meshes.
TEST(VolumeParameterization, StopsWhenAbortedAndRunsAgain)
{
  ParameterChain chain(BarExtent, BentBar, false);
  chain.Field->Update();
  for (const double share : { 0.1, 0.35 })
  {
    const Stop stop(chain.Parameters, share);
    chain.Parameters->Modified();
    chain.Parameters->Update();
    EXPECT_TRUE(stop.WasAsked());
    EXPECT_NE(chain.Parameters->GetAbortExecute(), 0);
    EXPECT_EQ(chain.Parameters->GetBlocks()->GetNumberOfPartitionedDataSets(), 0U);
  }
  chain.Parameters->Modified();
  chain.Update();
  ExpectParameters(chain, 0.1);
}

//------------------------------------------------------------------------------
TEST(VolumeParameterization, SaysWhatIsWrong)
{
  ParameterChain chain(BarExtent, BentBar, false);
  ErrorLog log(chain.Parameters);
  const auto expect = [&](const std::string& text)
  {
    chain.Parameters->Modified();
    chain.Parameters->Update();
    const std::string error = log.TakeOnly();
    EXPECT_NE(error.find(text), std::string::npos) << error << "\nis not\n" << text;
    EXPECT_EQ(chain.Parameters->GetPolycube()->GetNumberOfCells(), 0) << text;
  };
  chain.Parameters->SetInputData(chain.Image);
  expect("does not have the point array FrameU");

  chain.Parameters->SetInputConnection(chain.Field->GetOutputPort());
  vtkNew<vtkUnstructuredGrid> nothing;
  chain.Parameters->SetInputData(2, nothing);
  expect("There are no patches, or no polycube");

  chain.Parameters->SetInputConnection(2, chain.Domain->GetOutputPort(1));
  chain.Field->Update();
  vtkNew<vtkImageData> elsewhere;
  elsewhere->DeepCopy(chain.Field->GetOutput());
  elsewhere->SetOrigin(100.0, 0.0, 0.0);
  chain.Parameters->SetInputData(elsewhere);
  expect("it is not the surface of this segment");

  vtkNew<vtkImageData> fine; // a bar of a hundred thousand voxels along each axis
  fine->DeepCopy(chain.Field->GetOutput());
  fine->SetSpacing(1e-4, 1e-4, 1e-4);
  chain.Parameters->SetInputData(fine);
  expect("The block mesh (a larger CellLength needs less) would need ");

  vtkNew<vtkImageData> still;
  still->DeepCopy(chain.Field->GetOutput());
  still->GetPointData()->GetArray("FrameV")->Fill(0.0);
  chain.Parameters->SetInputData(still);
  expect("The frame of voxel");
}
