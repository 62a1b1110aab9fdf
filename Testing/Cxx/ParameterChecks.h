// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// What the parameters that vtkVolumeParameterization solves for must be.
#ifndef ParameterChecks_h
#define ParameterChecks_h

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkMath.h"
#include "vtkMatrix3x3.h"
#include "vtkPointData.h"

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
}

#endif
