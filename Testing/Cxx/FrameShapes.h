// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// Solids with the six patches of a cube, for tests of vtkFrameField.
#ifndef FrameShapes_h
#define FrameShapes_h

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkImageData.h"
#include "vtkIntArray.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSignedCharArray.h"

#include <array>
#include <cmath>
#include <functional>
#include <set>

namespace trivariate_testing
{
using Place = std::array<double, 3>;

// A solid as the image of the unit cube under a right-handed map.
struct Solid
{
  std::function<Place(const Place&)> ToSpace, ToCube;
};

inline Solid Box(const Place& low, const Place& size, double shear = 0.0)
{
  return { [=](const Place& c)
    {
      return Place{ low[0] + size[0] * c[0] + shear * c[1], low[1] + size[1] * c[1],
        low[2] + size[2] * c[2] };
    },
    [=](const Place& x)
    {
      const double v = (x[1] - low[1]) / size[1];
      return Place{ (x[0] - low[0] - shear * v) / size[0], v, (x[2] - low[2]) / size[2] };
    } };
}

// Radius u, angle v of 90 degrees, height w.
inline Solid QuarterAnnulus(double inner, double outer, double height)
{
  const double quarter = 0.5 * vtkMath::Pi();
  return { [=](const Place& c)
    {
      const double r = inner + (outer - inner) * c[0], t = quarter * c[1];
      return Place{ r * std::cos(t), r * std::sin(t), height * c[2] };
    },
    [=](const Place& x)
    {
      return Place{ (std::hypot(x[0], x[1]) - inner) / (outer - inner),
        std::atan2(x[1], x[0]) / quarter, x[2] / height };
    } };
}

// A square bar along z that turns by `turn` radians over its length.
inline Solid HelicalBar(double width, double length, double turn)
{
  const auto rotated = [](const Place& x, double angle)
  {
    const double c = std::cos(angle), s = std::sin(angle);
    return Place{ c * x[0] - s * x[1], s * x[0] + c * x[1], x[2] };
  };
  return { [=](const Place& c)
    {
      return rotated({ width * (c[0] - 0.5), width * (c[1] - 0.5), length * c[2] }, turn * c[2]);
    },
    [=](const Place& x)
    {
      const Place b = rotated(x, -turn * x[2] / length);
      return Place{ b[0] / width + 0.5, b[1] / width + 0.5, b[2] / length };
    } };
}

// Labels 1 inside of the solid, on an image whose geometry is set.
inline void LabelSolid(vtkImageData* image, const Solid& solid)
{
  vtkNew<vtkIntArray> labels;
  labels->SetName("Segment");
  for (vtkIdType id = 0; id < image->GetNumberOfPoints(); ++id)
  {
    const double* x = image->GetPoint(id);
    const Place c = solid.ToCube({ x[0], x[1], x[2] });
    const bool inside =
      c[0] > 0.0 && c[0] < 1.0 && c[1] > 0.0 && c[1] < 1.0 && c[2] > 0.0 && c[2] < 1.0;
    labels->InsertNextValue(inside ? 1 : 0);
  }
  image->GetPointData()->AddArray(labels);
}

// The sides of a solid as patches of segment 1, each of 2 n^2 triangles; without some.
inline vtkNew<vtkPolyData> PatchesOf(const Solid& solid, int n, const std::set<int>& without = {})
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> cells;
  vtkNew<vtkSignedCharArray> axes, sides;
  vtkNew<vtkIntArray> segments;
  axes->SetName("PatchAxis");
  sides->SetName("PatchSide");
  segments->SetName("Segment");
  for (int side = 0; side < 6; ++side)
  {
    if (without.count(side))
    {
      continue;
    }
    const int a = side / 2, b = (a + 1) % 3, c = (a + 2) % 3;
    const vtkIdType begin = points->GetNumberOfPoints();
    for (int j = 0; j <= n; ++j)
    {
      for (int i = 0; i <= n; ++i)
      {
        Place at;
        at[a] = side % 2;
        at[b] = double(i) / n;
        at[c] = double(j) / n;
        points->InsertNextPoint(solid.ToSpace(at).data());
        if (i < n && j < n)
        {
          const vtkIdType p = begin + i + (n + 1) * j, q = p + n + 1;
          const bool high = side % 2 == 1;
          cells->InsertNextCell({ p, high ? p + 1 : q + 1, high ? q + 1 : p + 1 });
          cells->InsertNextCell({ p, high ? q + 1 : q, high ? q : q + 1 });
          for (int triangle = 0; triangle < 2; ++triangle)
          {
            axes->InsertNextValue(static_cast<signed char>(a));
            sides->InsertNextValue(static_cast<signed char>(side % 2));
            segments->InsertNextValue(1);
          }
        }
      }
    }
  }
  vtkNew<vtkPolyData> patches;
  patches->SetPoints(points);
  patches->SetPolys(cells);
  patches->GetCellData()->AddArray(axes);
  patches->GetCellData()->AddArray(sides);
  patches->GetCellData()->AddArray(segments);
  return patches;
}
}

#endif
