// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "TSplinePoints.h"

#include "MemoryLimit.h"
#include "TSpline/BezierExtraction.h"
#include "TSpline/InverseJacobian.h"
#include "TSpline/InverseMap.h"

#include "vtkBoundingBox.h"
#include "vtkCharArray.h"
#include "vtkDataSet.h"
#include "vtkImageData.h"
#include "vtkMatrix3x3.h"
#include "vtkPointData.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace trivariate
{
namespace
{
// Points whose parameters are looked for at a time.
constexpr Index Stride = 1 << 18;

using Lattice = std::array<std::vector<double>, 3>;

/**
 * The parameters of an image's points as a lattice, where the spline's geometry is affine and each
 * of the image's axes runs along one parameter, in the same order and sense; empty otherwise.
 */
Lattice AlignedLattice(const InverseMap& map, const BezierMesh& mesh, vtkImageData* image)
{
  if (!map.Affine())
  {
    return {};
  }
  const InverseJacobian inverse(map.Matrix().data());
  const int* extent = image->GetExtent();
  double origin[3]; // of the whole image, so that a piece of it gets the same numbers
  image->TransformIndexToPhysicalPoint(0, 0, 0, origin);
  for (int a = 0; a < 3; ++a)
  {
    origin[a] -= map.Offset()[a];
  }
  const std::array<double, 3> start = inverse.Step(origin);
  Lattice lattice;
  for (int a = 0; a < 3; ++a)
  {
    double axis[3];
    for (int b = 0; b < 3; ++b)
    {
      axis[b] = image->GetDirectionMatrix()->GetElement(b, a) * image->GetSpacing()[a];
    }
    const std::array<double, 3> step = inverse.Step(axis);
    const int low = extent[2 * a], high = extent[2 * a + 1];
    for (int b = 0; b < 3; ++b)
    {
      const KnotLine& line = mesh.KnotLines()[b];
      const double tolerance = 1e-10 * (line.back() - line.front());
      if (b == a ? !(step[a] > 0.0)
                 : std::abs(step[b] * std::max(std::abs(low), std::abs(high))) > tolerance)
      {
        return {};
      }
    }
    const KnotLine& line = mesh.KnotLines()[a];
    const double tolerance = 1e-10 * (line.back() - line.front());
    for (int i = low; i <= high; ++i)
    {
      // A point on the boundary must not fall out of the domain by rounding.
      const double u = start[a] + i * step[a];
      const double nearest = std::min(std::max(u, line.front()), line.back());
      lattice[a].push_back(std::abs(u - nearest) <= tolerance ? nearest : u);
    }
  }
  return lattice;
}
}

void FillPoints(const TSplineView& view, vtkDataSet* output, const Execution& execution)
{
  const Index count = output->GetNumberOfPoints();
  FieldSampler sampler(view, false, execution.Part(0.0, 0.1));
  const std::string fault = MemoryFault("The output", count * (1.0 + sampler.BytesPerPoint()));
  if (!fault.empty())
  {
    throw std::length_error(fault);
  }
  sampler.Allocate(count);
  vtkNew<vtkCharArray> mask;
  mask->SetName("vtkValidPointMask");
  mask->SetNumberOfValues(count);
  auto* found = reinterpret_cast<std::uint8_t*>(mask->GetPointer(0));

  const InverseMap inverse(view.Model.Spline, view.Mesh, execution.Part(0.1, 0.2));
  vtkImageData* image = vtkImageData::SafeDownCast(output);
  const Lattice lattice = image ? AlignedLattice(inverse, view.Mesh, image) : Lattice();
  if (!lattice[0].empty())
  {
    sampler.SampleLattice(lattice, found, execution.Part(0.2, 1.0));
  }
  else
  {
    std::vector<double> positions(3 * std::min(count, Stride)), parameters(positions.size());
    for (Index first = 0; first < count; first += Stride)
    {
      const Index n = std::min(Stride, count - first);
      for (Index i = 0; i < n; ++i)
      {
        output->GetPoint(first + i, &positions[3 * i]);
      }
      const Execution part =
        execution.Part(0.2 + 0.8 * first / count, 0.2 + 0.8 * (first + n) / count);
      inverse.Find(
        n, positions.data(), parameters.data(), found + first, part.Part(0.0, 0.7), view.Reach);
      sampler.Sample(first, n, parameters.data(), found + first, part.Part(0.7, 1.0));
    }
  }
  sampler.AddTo(output->GetPointData());
  output->GetPointData()->AddArray(mask);
}

void PlaceImage(const TSplineView& view, const int dimensions[3], vtkImageData* output,
  const Execution& execution)
{
  const std::vector<double> coefficients =
    ExtractBezier(view.Model.Spline, view.Mesh, { 0, 1, 2, Denominator }, execution);
  vtkBoundingBox box;
  for (std::size_t cell = 0; cell < coefficients.size(); cell += 4 * 64)
  {
    const double* x = &coefficients[cell];
    for (int i = 0; i < 64; ++i)
    {
      const double weight = x[i + 3 * 64];
      if (weight > 0.0)
      {
        box.AddPoint(x[i] / weight, x[i + 64] / weight, x[i + 2 * 64] / weight);
      }
    }
  }
  double spacing[3];
  for (int a = 0; a < 3; ++a)
  {
    spacing[a] = box.GetLength(a) / (dimensions[a] - 1);
  }
  output->SetDimensions(dimensions);
  output->SetOrigin(box.GetMinPoint());
  output->SetSpacing(spacing);
}
}
