// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
// Segments with parts thinner than four voxels.
#include "ErrorLog.h"
#include "ParameterChain.h"
#include "WarningLog.h"

using namespace trivariate_testing;

namespace
{
const int BallExtent[6] = { -13, 13, -13, 13, -13, 13 };

int PlainBall(const double* p)
{
  return vtkMath::Norm(p) < 6.3 ? 1 : 0;
}

// With a fin of two voxels around it, which is thinner than cells need.
int FinnedBall(const double* p)
{
  return PlainBall(p) != 0 || (std::hypot(p[0], p[1]) < 9.3 && p[2] > -1.5 && p[2] < 0.5) ? 1 : 0;
}
}

//------------------------------------------------------------------------------
TEST(VolumeParameterization, SolvesForThinPartsOnAFinerGrid)
{
  const auto expect = [](const Label& label, bool isWanted, bool isThin)
  {
    ParameterChain chain(BallExtent, label, true);
    chain.Parameters->SetCellLength(3.0); // the voxels warn, not the cells
    chain.Parameters->SetRefineThinParts(isWanted);
    const WarningLog log(chain.Parameters);
    chain.Update();
    EXPECT_EQ(log.Says("parts thinner than four voxels"), isThin) << log.Text;
    EXPECT_EQ(log.Says("voxels of half the size"), isThin && isWanted) << log.Text;
    EXPECT_EQ(chain.Known("ParameterRefined"), isThin && isWanted ? 1.0 : 0.0);
    EXPECT_GT(chain.Parameters->GetBlocks()->GetNumberOfPartitionedDataSets(), 0U);
    return chain.Known("ParameterDeviation");
  };
  const double finer = expect(FinnedBall, true, true), asGiven = expect(FinnedBall, false, true);
  EXPECT_LT(finer, 0.8 * asGiven);
  expect(PlainBall, true, false);
}

//------------------------------------------------------------------------------
// What is wrong is told in voxels of the image, not of the finer grid.
TEST(VolumeParameterization, NamesVoxelsOfTheImageInThinParts)
{
  ParameterChain chain(BallExtent, FinnedBall, true);
  chain.Field->Update();
  vtkNew<vtkImageData> still;
  still->DeepCopy(chain.Field->GetOutput());
  int middle[3] = { 0, 0, 0 };
  still->GetPointData()->GetArray("FrameV")->SetTuple3(
    still->ComputePointId(middle), 0.0, 0.0, 0.0);
  chain.Parameters->SetInputData(still);
  ErrorLog log(chain.Parameters);
  chain.Parameters->Update();
  const std::string error = log.TakeOnly();
  EXPECT_NE(error.find("The frame of voxel (13, 13, 13) has"), std::string::npos) << error;
}
