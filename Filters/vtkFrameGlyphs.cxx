// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkFrameGlyphs.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSignedCharArray.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <array>
#include <cmath>

vtkStandardNewMacro(vtkFrameGlyphs);

namespace
{
constexpr double FramesAlongLongestSide = 32.0;

// Every how many voxels along i, j, k a frame is drawn, and how far apart that is at least.
struct Sampling
{
  Sampling(const int* wholeExtent, const double* spacing, int wanted)
  {
    const double finest = std::min({ spacing[0], spacing[1], spacing[2] });
    double longest = 0.0;
    for (int a = 0; a < 3; ++a)
    {
      longest = std::max(
        longest, spacing[a] / finest * (wholeExtent[2 * a + 1] - wholeExtent[2 * a] + 1.0));
    }
    const double stride = wanted > 0 ? wanted : std::ceil(longest / FramesAlongLongestSide);
    this->Distance = stride * finest;
    for (int a = 0; a < 3; ++a)
    {
      const int voxels = wholeExtent[2 * a + 1] - wholeExtent[2 * a] + 1;
      this->Strides[a] =
        static_cast<int>(std::clamp(std::round(this->Distance / spacing[a]), 1.0, 1.0 * voxels));
      this->Begins[a] = wholeExtent[2 * a] + this->Strides[a] / 2;
    }
  }

  // The first index from `begin` on that is drawn, the same in all pieces of an image.
  int First(int axis, int begin) const
  {
    const int stride = this->Strides[axis];
    const int skipped = std::max(0, begin - this->Begins[axis] + stride - 1) / stride;
    return this->Begins[axis] + skipped * stride;
  }

  std::array<int, 3> Strides, Begins;
  double Distance;
};
}

//------------------------------------------------------------------------------
int vtkFrameGlyphs::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  return 1;
}

//------------------------------------------------------------------------------
int vtkFrameGlyphs::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkImageData* input = vtkImageData::GetData(inputVector[0]);
  vtkPolyData* output = vtkPolyData::GetData(outputVector);
  if (input->GetNumberOfPoints() == 0)
  {
    return 1;
  }
  std::array<vtkDataArray*, 3> frames;
  const char* const names[3] = { "FrameU", "FrameV", "FrameW" };
  for (int axis = 0; axis < 3; ++axis)
  {
    frames[axis] = input->GetPointData()->GetArray(names[axis]);
    if (!frames[axis] || frames[axis]->GetNumberOfComponents() != 3)
    {
      vtkErrorMacro("The image has no point array \""
                    << names[axis] << "\" of 3 components; Frame Field makes it.");
      return 0;
    }
  }
  const Sampling sampling(
    inputVector[0]->GetInformationObject(0)->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT()),
    input->GetSpacing(), this->Stride);
  const double half = 0.5 * this->Length * sampling.Distance;

  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> lines;
  vtkNew<vtkSignedCharArray> axes;
  axes->SetName("FrameAxis");
  const int* extent = input->GetExtent();
  int at[3];
  for (at[2] = sampling.First(2, extent[4]); at[2] <= extent[5]; at[2] += sampling.Strides[2])
  {
    for (at[1] = sampling.First(1, extent[2]); at[1] <= extent[3]; at[1] += sampling.Strides[1])
    {
      for (at[0] = sampling.First(0, extent[0]); at[0] <= extent[1]; at[0] += sampling.Strides[0])
      {
        const vtkIdType id = input->ComputePointId(at);
        double centre[3];
        input->GetPoint(id, centre);
        for (int axis = 0; axis < 3; ++axis)
        {
          double direction[3];
          frames[axis]->GetTuple(id, direction);
          if (vtkMath::Norm(direction) > 0.0)
          {
            vtkIdType ends[2];
            for (int end = 0; end < 2; ++end)
            {
              double point[3];
              for (int a = 0; a < 3; ++a)
              {
                point[a] = centre[a] + (end ? half : -half) * direction[a];
              }
              ends[end] = points->InsertNextPoint(point);
            }
            lines->InsertNextCell(2, ends);
            axes->InsertNextValue(static_cast<signed char>(axis));
          }
        }
      }
    }
  }
  output->SetPoints(points);
  output->SetLines(lines);
  output->GetCellData()->SetScalars(axes); // ParaView's first choice for colors
  return 1;
}

//------------------------------------------------------------------------------
void vtkFrameGlyphs::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Stride: " << this->Stride << "\n";
  os << indent << "Length: " << this->Length << "\n";
}
