// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "FrameSurface.h"

#include "Boundary/SegmentBoundary.h"
#include "LabelledImage.h"
#include "SegmentSurface.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace trivariate
{
using Eigen::Vector3d;

namespace
{
//------------------------------------------------------------------------------
// Points in the voxels of an image, counted from its first one.
std::vector<Vector3d> InVoxels(const std::vector<Vector3d>& points, const LabelledImage& image)
{
  using Matrix = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;
  const Eigen::Affine3d toSpace(Matrix(Eigen::Map<const Matrix>(image.IndexToPhysical.data())));
  const Eigen::Affine3d toIndex = toSpace.inverse();
  const Vector3d first(image.Extent[0], image.Extent[2], image.Extent[4]);
  std::vector<Vector3d> voxels(points.size());
  std::transform(points.begin(), points.end(), voxels.begin(),
    [&](const Vector3d& point) -> Vector3d { return toIndex * point - first; });
  return voxels;
}

//------------------------------------------------------------------------------
SurfaceTriangle TriangleOf(
  const std::vector<Vector3d>& points, const Triangle& corners, std::int8_t side, bool turned)
{
  return { { points[corners[0]], points[corners[turned ? 2 : 1]], points[corners[turned ? 1 : 2]] },
    side };
}

// Both sides of a triangle whose normal points from the first label to the second.
void AddBothSides(const std::vector<Vector3d>& points, const Triangle& triangle,
  const std::array<int, 2>& labels, FrameSurfaces& surfaces)
{
  surfaces[labels[0]].push_back(TriangleOf(points, triangle, AnyAxis, false));
  surfaces[labels[1]].push_back(TriangleOf(points, triangle, AnyAxis, true));
}

//------------------------------------------------------------------------------
vtkDataArray* PatchArray(vtkPolyData* input, const char* name)
{
  vtkDataArray* array = input->GetCellData()->GetArray(name);
  if (!array || array->GetNumberOfComponents() != 1)
  {
    throw std::invalid_argument("The patches have no cell array \"" + std::string(name) +
                                "\" of one component; Polycube Domain makes PatchAxis, PatchSide "
                                "and Segment.");
  }
  return array;
}

// A value of a patch within a range.
int ValueAt(vtkDataArray* array, std::size_t cell, int largest)
{
  const double value = array->GetComponent(static_cast<vtkIdType>(cell), 0);
  if (!(value >= 0.0 && value <= largest))
  {
    throw std::invalid_argument(std::string("The array \"") + array->GetName() + "\" is " +
                                std::to_string(value) + " at cell " + std::to_string(cell) +
                                "; whole numbers from 0 to " + std::to_string(largest) +
                                " mean something.");
  }
  return static_cast<int>(value);
}
}

//------------------------------------------------------------------------------
FrameSurfaces ReadFrameSurfaces(vtkPolyData* input, const LabelledImage& image)
{
  FrameSurfaces surfaces;
  if (!input->GetCellData()->GetArray("PatchAxis"))
  {
    if (input->GetNumberOfPolys() > 0 && !input->GetCellData()->GetArray("BoundaryLabels"))
    {
      throw std::invalid_argument(
        "The surface has neither the cell array PatchAxis, as the patches of Polycube Domain, nor "
        "BoundaryLabels, as those of Segment Boundary.");
    }
    const LabelledSurface surface = ReadSurface(input);
    const std::vector<Vector3d> points = InVoxels(surface.Points, image);
    for (std::size_t t = 0; t < surface.Triangles.size(); ++t)
    {
      AddBothSides(points, surface.Triangles[t], surface.Labels[t], surfaces);
    }
    return surfaces;
  }
  const std::vector<Triangle> triangles = ReadTriangles(input);
  const std::vector<Vector3d> points = InVoxels(ReadPoints(input), image);
  vtkDataArray* axes = PatchArray(input, "PatchAxis");
  vtkDataArray* sides = PatchArray(input, "PatchSide");
  vtkDataArray* segments = PatchArray(input, "Segment");
  for (std::size_t t = 0; t < triangles.size(); ++t)
  {
    const int side = 2 * ValueAt(axes, t, 2) + ValueAt(sides, t, 1);
    const int segment = ValueAt(segments, t, VTK_INT_MAX);
    surfaces[segment].push_back(
      TriangleOf(points, triangles[t], static_cast<std::int8_t>(side), false));
  }
  return surfaces;
}

//------------------------------------------------------------------------------
FrameSurfaces MakeFrameSurfaces(
  const LabelledImage& image, const std::vector<int>& segments, const Execution& execution)
{
  CheckLabels(image, segments);
  const SegmentBoundary boundary =
    ComputeSegmentBoundary(image.View(), BoundaryOptions(), execution);
  std::vector<Vector3d> points;
  points.reserve(boundary.Points.size());
  for (const Point& point : boundary.Points)
  {
    points.emplace_back(point[0], point[1], point[2]);
  }
  FrameSurfaces surfaces;
  for (std::size_t t = 0; t < boundary.Triangles.size(); ++t)
  {
    AddBothSides(points, boundary.Triangles[t], boundary.Labels[t], surfaces);
  }
  return surfaces;
}
}
