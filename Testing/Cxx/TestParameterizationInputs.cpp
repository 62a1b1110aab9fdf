// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
// Images, segments and domains that are not the usual ones.
#include "ErrorLog.h"
#include "ParameterChain.h"
#include "ParameterChecks.h"
#include "WarningLog.h"

using namespace trivariate_testing;

namespace
{
const int Extent[6] = { -12, 12, -12, 12, -12, 12 };

int BallLabel(const double* p)
{
  return vtkMath::Norm(p) < 8.3 ? 1 : 0;
}
}

//------------------------------------------------------------------------------
TEST(VolumeParameterization, KnowsTheSpacing)
{
  const int flat[6] = { -12, 12, -12, 12, -6, 6 };
  ParameterChain chain(
    flat, [](const double* p) { return std::hypot(p[0], p[1], 2.0 * p[2]) < 8.3 ? 1 : 0; }, true);
  chain.Image->SetSpacing(1.0, 1.0, 2.0);
  chain.Update();
  ExpectParameters(chain, 0.1);
}

//------------------------------------------------------------------------------
TEST(VolumeParameterization, GoesToTheBorderOfTheImage)
{
  const int cut[6] = { -4, 12, -12, 12, -12, 12 };
  ParameterChain chain(cut, BallLabel, true);
  chain.Update();
  ExpectParameters(chain, 0.1);
}

//------------------------------------------------------------------------------
// Voxels that the surface does not go around.
TEST(VolumeParameterization, RefusesASegmentInPieces)
{
  ParameterChain chain(Extent, BallLabel, true);
  chain.Field->Update();
  vtkNew<vtkImageData> more;
  more->DeepCopy(chain.Field->GetOutput());
  int corner[3] = { 11, 11, 11 };
  const vtkIdType id = more->ComputePointId(corner);
  more->GetPointData()->GetArray("Segment")->SetTuple1(id, 1.0);
  for (int axis = 0; axis < 3; ++axis)
  {
    const char* const names[3] = { "FrameU", "FrameV", "FrameW" };
    more->GetPointData()->GetArray(names[axis])->SetComponent(id, axis, 1.0);
  }
  chain.Parameters->SetInputData(more);
  ErrorLog log(chain.Parameters);
  chain.Parameters->Update();
  const std::string error = log.TakeOnly();
  EXPECT_NE(error.find("Segment 1"), std::string::npos) << error;
  EXPECT_NE(error.find("piece"), std::string::npos) << error;
}

//------------------------------------------------------------------------------
TEST(VolumeParameterization, RefusesThePatchesOfAnotherPolycube)
{
  ParameterChain ball(Extent, BallLabel, false);
  ParameterChain ell(
    Extent,
    [](const double* p)
    {
      const bool isIn = std::abs(p[0]) < 9 && std::abs(p[1]) < 9 && std::abs(p[2]) < 5;
      return isIn && (p[0] < -1 || p[1] < -1) ? 1 : 0;
    },
    false);
  ell.Domain->Update();
  ASSERT_EQ(vtkDataSet::SafeDownCast(ell.Domain->GetOutputDataObject(1))->GetNumberOfCells(), 3);
  const auto expect = [](ParameterChain& chain, ParameterChain& other, const std::string& text)
  {
    chain.Parameters->SetInputConnection(2, other.Domain->GetOutputPort(1));
    ErrorLog log(chain.Parameters);
    chain.Parameters->Update();
    const std::string error = log.TakeOnly();
    EXPECT_NE(error.find(text), std::string::npos) << error;
    EXPECT_EQ(chain.Parameters->GetBlocks()->GetNumberOfPartitionedDataSets(), 0U);
  };
  expect(ball, ell, "is not the face of a block");
  expect(ell, ball, "corners instead of four");
}
