// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "SplitImage.h"

#include "vtkSegmentTopology.h"
#include "vtkTextureSegmentation.h"

#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace trivariate
{
namespace
{
constexpr double Segmented = 0.87; // of the progress

// The most, up to `wanted`, whose window the image has room for.
int RadiusIn(vtkImageData* image, int wanted)
{
  const int* n = image->GetDimensions();
  const int least = *std::min_element(n, n + 3);
  if (least < 3)
  {
    throw std::invalid_argument("The image has " + std::to_string(n[0]) + " x " +
                                std::to_string(n[1]) + " x " + std::to_string(n[2]) +
                                " points; to be split by texture it needs three or more along "
                                "each axis. Choose an array of labels, or the domain Box.");
  }
  return std::min(wanted, (least - 1) / 2);
}
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkImageData> SplitImage(
  vtkImageData* image, const Segmentation& wanted, Chain& chain, double to)
{
  vtkNew<vtkTextureSegmentation> segmentation;
  vtkNew<vtkSegmentTopology> topology;
  topology->SetController(nullptr);
  topology->SetInputData(image);
  if (!wanted.HasLabels)
  {
    segmentation->SetController(nullptr);
    segmentation->SetInputData(image);
    segmentation->SetInputArrayToProcess(
      0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, image->GetPointData()->GetArrayName(0));
    segmentation->SetNumberOfSegments(wanted.NumberOfSegments);
    segmentation->SetWindowRadius(RadiusIn(image, segmentation->GetWindowRadius()));
    ChainStep(segmentation, chain, 0.0, Segmented * to).RunTelling();
    topology->SetInputData(segmentation->GetOutput());
  }
  ChainStep(topology, chain, Segmented * to, to).RunTelling();
  return vtkImageData::SafeDownCast(topology->GetOutputDataObject(0));
}
}
