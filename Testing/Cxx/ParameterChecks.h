// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// What the parameters that vtkVolumeParameterization solves for must be.
#ifndef ParameterChecks_h
#define ParameterChecks_h

#include "ParameterChain.h"

#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkImageData.h"
#include "vtkMath.h"
#include "vtkMatrix3x3.h"
#include "vtkPointData.h"
#include "vtkUnsignedCharArray.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

namespace trivariate_testing
{
// Their gradients, times the lengths of the domain, are the frames. Of one segment, on all voxels
// whose label is not 0.
inline void ExpectFollowsFrames(vtkImageData* image, const std::array<double, 3>& lengths)
{
  const auto arrayOf = [image](const char* name) { return image->GetPointData()->GetArray(name); };
  vtkDataArray *solved = arrayOf("FrameParameter"), *mask = arrayOf("FrameParameterMask");
  vtkDataArray* segment = arrayOf("Segment");
  vtkDataArray* const frames[3] = { arrayOf("FrameU"), arrayOf("FrameV"), arrayOf("FrameW") };
  ASSERT_TRUE(solved && mask);
  int n[3];
  image->GetDimensions(n);
  const vtkIdType step[3] = { 1, n[0], vtkIdType(n[0]) * n[1] };
  double sum = 0.0, least = 1.0;
  vtkIdType inner = 0;
  for (vtkIdType id = 0; id < image->GetNumberOfPoints(); ++id)
  {
    ASSERT_EQ(mask->GetTuple1(id), segment->GetTuple1(id) != 0.0);
    bool isInner = true;
    for (const vtkIdType s : step)
    {
      isInner = isInner && id >= s && id + s < image->GetNumberOfPoints() &&
                mask->GetTuple1(id - s) != 0.0 && mask->GetTuple1(id + s) != 0.0;
    }
    for (int axis = 0; axis < 3 && isInner; ++axis)
    {
      double slope[3], gradient[3];
      for (int a = 0; a < 3; ++a)
      {
        slope[a] =
          0.5 * lengths[axis] *
          (solved->GetComponent(id + step[a], axis) - solved->GetComponent(id - step[a], axis));
      }
      image->GetDirectionMatrix()->MultiplyPoint(slope, gradient);
      const double cosine =
        vtkMath::Dot(frames[axis]->GetTuple3(id), gradient) / vtkMath::Norm(gradient);
      sum += cosine;
      least = std::min(least, cosine);
      ++inner;
    }
  }
  EXPECT_GT(inner, 5000);
  EXPECT_GT(sum / static_cast<double>(inner), 0.99);
  EXPECT_GT(least, 0.8);
}

// Arrays fit each other; each voxel lies where its parameter is in the blocks; cells are sound and
// fill the segments.
inline void ExpectParameters(ParameterChain& chain, double leastJacobian)
{
  vtkImageData* image = chain.Parameters->GetOutput();
  vtkDataArray* segment = image->GetPointData()->GetArray("Segment");
  const auto parameter = vtkDoubleArray::SafeDownCast(image->GetPointData()->GetArray("Parameter"));
  const auto mask =
    vtkUnsignedCharArray::SafeDownCast(image->GetPointData()->GetArray("ParameterMask"));
  const auto block = vtkIntArray::SafeDownCast(image->GetPointData()->GetArray("Block"));
  ASSERT_TRUE(parameter && mask && block);
  EXPECT_EQ(chain.Known("InvertedCells", 1), 0.0);

  vtkUnstructuredGrid* polycube = chain.Parameters->GetPolycube();
  const vtkIdType blocks = polycube->GetNumberOfCells();
  ASSERT_EQ(chain.Parameters->GetBlocks()->GetNumberOfPartitionedDataSets(), blocks);
  double volume = 0.0;
  for (vtkIdType b = 0; b < blocks; ++b)
  {
    vtkStructuredGrid* grid = chain.Block(b);
    ASSERT_NE(grid, nullptr);
    EXPECT_EQ(CellArray(grid, "Block")->GetComponent(0, 0),
      CellArray(polycube, "Block")->GetComponent(b, 0));
    vtkNew<vtkMeshQuality> quality;
    quality->SetInputData(grid);
    quality->SetHexQualityMeasureToScaledJacobian();
    quality->Update();
    EXPECT_GT(CellArray(quality->GetOutput(), "Quality")->GetRange()[0], leastJacobian) << b;
    quality->SetHexQualityMeasureToVolume();
    quality->Update();
    for (vtkIdType cell = 0; cell < grid->GetNumberOfCells(); ++cell)
    {
      volume += CellArray(quality->GetOutput(), "Quality")->GetComponent(cell, 0);
    }
  }

  double voxels = 0.0, known = 0.0, farthest = 0.0;
  for (vtkIdType id = 0; id < image->GetNumberOfPoints(); ++id)
  {
    EXPECT_EQ(mask->GetValue(id) != 0, block->GetValue(id) >= 0);
    double p[3];
    parameter->GetTypedTuple(id, p);
    EXPECT_TRUE(std::isfinite(p[0] + p[1] + p[2]));
    if (segment->GetComponent(id, 0) <= 0.0)
    {
      EXPECT_EQ(mask->GetValue(id), 0);
      continue;
    }
    voxels += 1.0;
    known += mask->GetValue(id);
    double nearest = VTK_DOUBLE_MAX;
    for (vtkIdType b = 0; b < blocks && mask->GetValue(id) != 0; ++b)
    {
      vtkStructuredGrid* grid = chain.Block(b);
      vtkDataArray* own = grid->GetPointData()->GetArray("Parameter");
      int n[3], cell[3];
      grid->GetDimensions(n);
      double at[3], x[3] = { 0.0, 0.0, 0.0 };
      bool inside = true;
      for (int a = 0; a < 3; ++a)
      {
        const double low = own->GetComponent(0, a);
        inside = inside && p[a] >= low && p[a] <= low + 1.0;
        cell[a] = std::clamp(int((p[a] - low) * (n[a] - 1)), 0, n[a] - 2);
        at[a] = (p[a] - low) * (n[a] - 1) - cell[a];
      }
      for (int c = 0; c < 8 && inside; ++c)
      {
        double weight = 1.0;
        int node[3];
        for (int a = 0; a < 3; ++a)
        {
          weight *= (c >> a & 1) ? at[a] : 1.0 - at[a];
          node[a] = cell[a] + (c >> a & 1);
        }
        const double* q = grid->GetPoint(node[0] + n[0] * (node[1] + n[1] * node[2]));
        for (int a = 0; a < 3; ++a)
        {
          x[a] += weight * q[a];
        }
      }
      if (inside)
      {
        nearest = std::min(nearest, vtkMath::Distance2BetweenPoints(x, image->GetPoint(id)));
      }
    }
    if (mask->GetValue(id) != 0)
    {
      farthest = std::max(farthest, std::sqrt(nearest));
    }
  }
  EXPECT_EQ(known, voxels);
  const double* spacing = image->GetSpacing();
  // Voxels along the surface, outside of the flat faces of cells.
  EXPECT_LT(farthest, 1.2 * std::max({ spacing[0], spacing[1], spacing[2] }));
  EXPECT_NEAR(volume / (voxels * spacing[0] * spacing[1] * spacing[2]), 1.0, 0.03);
  EXPECT_LT(chain.Known("PatchDistance", 0), chain.Known("PatchDistance", 1));
  EXPECT_LT(chain.Known("PatchDistance", 1), 1.2);
  EXPECT_LT(chain.Known("FaceDistance", 1), 1.2);
  EXPECT_GT(chain.Known("CellVolumeRatio", 0), 0.3);
  EXPECT_LT(chain.Known("CellVolumeRatio", 1), 3.0);
}
}

#endif
