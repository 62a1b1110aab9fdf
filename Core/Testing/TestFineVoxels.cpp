// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Parameter/FineVoxels.h"

#include "ParameterShapes.h"
#include "ThreadedExecution.h"
#include "WatchedExecution.h"

#include <gtest/gtest.h>

using namespace trivariate;

namespace
{
// Its wall is as thick as two and a half voxels.
ParameterShape ThinTube()
{
  return QuarterTube(18, 12.2, 2.5, 9.0);
}

// Root mean square over the voxels of the segment, in parts of the ranges.
double ErrorOf(const ParameterShape& shape, const VoxelParameter& solved)
{
  const std::vector<std::uint8_t> mask = MaskOf(shape);
  double sum = 0.0, count = 0.0;
  for (Index id = 0; id < static_cast<Index>(mask.size()); ++id)
  {
    if (mask[id] != 0)
    {
      const Eigen::Vector3d x = VoxelPlace(shape, id);
      const Index at = solved.At({ Index(x[0]), Index(x[1]), Index(x[2]) });
      EXPECT_EQ(solved.Known[at], 2);
      const Eigen::Map<const Eigen::Vector3d> found(&solved.Values[3 * at]);
      sum += (found - shape.Parameter(x)).squaredNorm() / 3.0;
      count += 1.0;
    }
  }
  return std::sqrt(sum / count);
}
}

TEST(FineVoxels, AreCloserInThinParts)
{
  const ParameterShape shape = ThinTube();
  const std::vector<std::uint8_t> mask = MaskOf(shape);
  const ParameterVoxels voxels = VoxelsOf(shape, mask);
  const ParameterSurface surface = SurfaceOf(shape, 40);
  const VoxelParameter coarse = SolveVoxelParameter(voxels, surface, {}, {});
  const VoxelParameter fine = SolveOnFineVoxels(voxels, surface, {}, ThreadedExecution(1));
  EXPECT_LT(ErrorOf(shape, fine), 0.6 * ErrorOf(shape, coarse)) << ErrorOf(shape, coarse);
  EXPECT_EQ(fine.Spacing, voxels.Spacing);
  EXPECT_NEAR(fine.Lengths[0].back(), 2.5, 0.01);
  EXPECT_EQ(SolveOnFineVoxels(voxels, surface, {}, ThreadedExecution(3)).Values, fine.Values);
}

TEST(FineVoxels, ReproduceLinearParameters)
{
  const ParameterShape shape = SlantedBox(13);
  const std::vector<std::uint8_t> mask = MaskOf(shape);
  const VoxelParameter fine =
    SolveOnFineVoxels(VoxelsOf(shape, mask), SurfaceOf(shape, 20), {}, {});
  EXPECT_LT(ErrorOf(shape, fine), 1e-7);
}

TEST(FineVoxels, RefuseAForeignSurfaceAndAreStopped)
{
  const ParameterShape shape = ThinTube();
  const std::vector<std::uint8_t> mask = MaskOf(shape);
  const ParameterVoxels voxels = VoxelsOf(shape, mask);
  ParameterSurface surface = SurfaceOf(shape, 40);
  Watch watch;
  EXPECT_THROW(SolveOnFineVoxels(voxels, surface, {}, watch.Until(0.3)), Aborted);
  for (Eigen::Vector3d& point : surface.Points)
  {
    point[0] += 100.0;
  }
  EXPECT_THROW(SolveOnFineVoxels(voxels, surface, {}, {}), std::invalid_argument);
}
