// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// Frame fields as VTK's data sets.
#ifndef FrameOutput_h
#define FrameOutput_h

#include "Field/SegmentField.h"

#include "vtkFloatArray.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkTable.h"

#include <array>

class vtkImageData;
class vtkMultiProcessController;

namespace trivariate
{
struct LabelledImage;

/// Collects the fields of segments as the outputs of vtkFrameField.
class FrameOutput
{
public:
  /// The arrays FrameU, FrameV, FrameW of the whole image, zero.
  explicit FrameOutput(const LabelledImage& image);

  void Add(int segment, const SegmentField& field, const LabelledImage& image);

  /// Collective: all get the arrays of process 0.
  void Share(vtkMultiProcessController* controller);

  /// Adds to an image, whose extent lies within the whole, the arrays and what is known of fields.
  void AddTo(vtkImageData* image) const;

  bool IsEmpty() const { return this->Frames[0]->GetNumberOfTuples() == 0; }

  vtkNew<vtkPolyData> Graph;
  vtkNew<vtkTable> Sweeps;

private:
  std::array<int, 6> Extent;
  std::array<vtkNew<vtkFloatArray>, 3> Frames;
  vtkNew<vtkTable> Fields;
};
}

#endif
