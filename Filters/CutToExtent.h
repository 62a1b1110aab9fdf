// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// Parts of point arrays of images.
#ifndef CutToExtent_h
#define CutToExtent_h

#include "vtkDataArray.h"
#include "vtkSmartPointer.h"
#include "vtkStructuredData.h"

namespace trivariate
{
/// The tuples of an extent within that of the whole.
inline vtkSmartPointer<vtkDataArray> CutToExtent(
  vtkDataArray* whole, const int* wholeExtent, const int* extent)
{
  vtkSmartPointer<vtkDataArray> part;
  part.TakeReference(whole->NewInstance());
  part->SetName(whole->GetName());
  part->SetNumberOfComponents(whole->GetNumberOfComponents());
  const vtkIdType row = extent[1] - extent[0] + 1;
  part->SetNumberOfTuples(row * (extent[3] - extent[2] + 1) * (extent[5] - extent[4] + 1));
  vtkIdType to = 0;
  for (int k = extent[4]; k <= extent[5]; ++k)
  {
    for (int j = extent[2]; j <= extent[3]; ++j, to += row)
    {
      int first[3] = { extent[0], j, k };
      part->InsertTuples(
        to, row, vtkStructuredData::ComputePointIdForExtent(wholeExtent, first), whole);
    }
  }
  return part;
}
}

#endif
