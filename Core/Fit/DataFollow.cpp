// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "DataFollow.h"

#include "DataErrors.h"
#include "ShapeJacobian.h"
#include "ShapeSolver.h"

#include <algorithm>

namespace trivariate
{
namespace
{
constexpr int Steps = 3, Products = 15; // of each step

// What the squared error of a voxel in parts of the range counts: of a hundredth as much as a
// sample of the held surface (see ShapeTarget.h) that is off by 0.014 voxels.
constexpr double DataWeight = 3000.0;

Index CountFolded(const TSpline& shape, const BezierMesh& mesh, const Execution& execution)
{
  const std::vector<CellJacobian> cells = BoundJacobian(shape, mesh, execution);
  return std::count_if(
    cells.begin(), cells.end(), [](const CellJacobian& cell) { return cell.Sampled <= 0.0; });
}
}

//------------------------------------------------------------------------------
TSpline MoveToData(const FittedAttributes& fitted, const TSpline& shape, double barrier,
  double damping, const Execution& execution)
{
  const DataErrors errors(fitted.Spline, shape, fitted.Layout, fitted.Samples, fitted.System,
    fitted.Ranges, { fitted.Spacing, DataWeight, damping }, execution);
  fitted.Target.Hold();
  ScatteredSystem system(fitted.Target.Samples(), 0, fitted.Layout, execution);
  system.Update(shape);
  ShapeSolverOptions options;
  options.Spacing = fitted.Spacing;
  options.FirstBarrier = options.LastBarrier = barrier;
  options.MostSteps = Steps;
  options.MostProducts = Products;
  TSpline moved = shape;
  SolveShape(moved, system, fitted.Target, options, execution, &errors);
  fitted.Target.Release();
  const Index folded = CountFolded(shape, system.Mesh(), execution);
  while (CountFolded(moved, system.Mesh(), execution) > folded)
  {
    for (std::size_t i = 0; i < moved.ControlPoints.size(); ++i)
    {
      moved.ControlPoints[i] = 0.5 * (moved.ControlPoints[i] + shape.ControlPoints[i]);
    }
  }
  return moved;
}
}
