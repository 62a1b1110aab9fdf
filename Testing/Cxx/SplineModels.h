// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// T-splines with known shapes, for tests of pipelines.
#ifndef SplineModels_h
#define SplineModels_h

#include "TSpline/RefinementRule.h"
#include "TSpline/TSplineModel.h"
#include "TSplineGrid.h"

#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkSmartPointer.h"
#include "vtkTSplineSource.h"
#include "vtkUnstructuredGrid.h"

#include <cmath>
#include <random>

namespace trivariate
{
/// Refines where `rounds` random marks fall; geometry and attributes stay the same functions.
inline void RefineRandomly(
  TSpline& spline, int rounds, unsigned seed, const std::unique_ptr<RefinementRule>& rule)
{
  std::mt19937 random(seed);
  for (int round = 0; round < rounds; ++round)
  {
    std::vector<RefinementMark> marks;
    while (marks.size() < 4)
    {
      const Index i = static_cast<Index>(random() % spline.Size());
      const int direction = static_cast<int>(random() % 3), span = static_cast<int>(random() % 4);
      const LocalKnots& k = spline.Functions[i][direction];
      const std::int32_t knot = DyadicMiddle(k[span], k[span + 1]);
      if (knot >= 0)
      {
        marks.push_back({ i, direction, knot });
      }
    }
    rule->Refine(spline, marks);
  }
}

inline void RefineRandomly(TSpline& spline, int rounds, unsigned seed)
{
  RefineRandomly(spline, rounds, seed, MakeKnotInsertionRule(spline));
}

inline void FinishModel(TSplineModel& model)
{
  model.Segment.assign(model.Spline.Size(), 0);
  model.Block.assign(model.Spline.Size(), 0);
}

/**
 * A quarter of a thick tube, radii 1 and 2, height 1, axis z: exact with rational weights, volume
 * 3 pi / 4. u runs outwards, v round, w up, each from 0 to 1. The attributes are the functions
 * Radial = x^2 + y^2 (of degree 2 in u) and Linear = (x + 2 y, z).
 */
inline TSplineModel QuarterAnnulus(int rounds = 0, unsigned seed = 1)
{
  TSplineModel model;
  const KnotLine line = MakeUniformKnotLine(0.0, 1.0, 16);
  model.Spline = MakeTensorProduct({ line, line, line }, { 16, 16, 16 }, 3);
  model.Attributes = { { "Radial", 1 }, { "Linear", 2 } };
  // The arc of degree 2 with weights 1, s, 1 and its control points, raised to degree 3.
  const double s = std::sqrt(0.5);
  const double x[4] = { 1.0, (1.0 + 2.0 * s) / 3.0, 2.0 * s / 3.0, 0.0 };
  const double weight[4] = { 1.0, (1.0 + 2.0 * s) / 3.0, (1.0 + 2.0 * s) / 3.0, 1.0 };
  // (1 + u)^2 in the Bernstein basis of degree 3.
  const double square[4] = { 1.0, 5.0 / 3.0, 8.0 / 3.0, 4.0 };
  for (Index i = 0; i < 64; ++i)
  {
    const int u = i % 4, v = i / 4 % 4, w = i / 16;
    model.Spline.Weights[i] = weight[v];
    double* p = model.Spline.ControlPoint(i);
    const double radius = 1.0 + u / 3.0;
    p[0] = radius * x[v] / weight[v];
    p[1] = radius * x[3 - v] / weight[v];
    p[2] = w / 3.0;
    p[3] = square[u];
    p[4] = p[0] + 2.0 * p[1];
    p[5] = p[2];
  }
  RefineRandomly(model.Spline, rounds, seed);
  model.RootCells = { 1, 1, 1 };
  FinishModel(model);
  return model;
}

/// The geometry is the identity on [0, sizes[a] - 1]; the attribute Value is random.
inline TSplineModel RandomBox(const std::array<int, 3>& roots, int rounds, unsigned seed)
{
  TSplineModel model;
  std::array<KnotLine, 3> lines;
  for (int a = 0; a < 3; ++a)
  {
    lines[a] = MakeUniformKnotLine(0.0, 8.0 * roots[a], 8 * roots[a]);
  }
  model.Spline = MakeTensorProduct(lines, { 8, 8, 8 }, 1);
  model.Attributes = { { "Value", 1 } };
  std::mt19937 random(seed + 1000);
  std::uniform_real_distribution<double> value(-1.0, 1.0);
  RefineRandomly(model.Spline, rounds, seed);
  for (Index i = 0; i < model.Spline.Size(); ++i)
  {
    model.Spline.ControlPoint(i)[3] = value(random);
  }
  FinishModel(model);
  return model;
}

inline vtkSmartPointer<vtkUnstructuredGrid> MakeGrid(const TSplineModel& model)
{
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  TSplineToGrid(model, grid);
  return grid;
}

/// The source on a spline, not yet updated.
inline vtkNew<vtkTSplineSource> MakeSource(const TSplineModel& model, int outputType)
{
  vtkNew<vtkTSplineSource> source;
  source->SetInputData(MakeGrid(model));
  source->SetOutputType(outputType);
  return source;
}

inline vtkDataArray* PointArray(vtkDataObject* data, const char* name)
{
  return vtkDataSet::SafeDownCast(data)->GetPointData()->GetArray(name);
}

/**
 * An L of three cubes with the identity for its geometry: [0, 2] x [0, 2] x [0, 1] without what is
 * beyond 1 in both u and v. The attribute Bend is u^2 + v w.
 */
inline TSplineModel Ell(int rounds = 0, unsigned seed = 1)
{
  TSplineModel model;
  const KnotLine two = MakeUniformKnotLine(0.0, 2.0, 16), one = MakeUniformKnotLine(0.0, 1.0, 8);
  TSpline& spline = model.Spline;
  spline = MakeTensorProduct({ two, two, one }, { 8, 8, 8 }, 1);
  spline.Holes = { { { 8, 8, 0 }, { 16, 16, 8 } } };
  std::vector<char> removed;
  for (Index i = 0; i < spline.Size(); ++i)
  {
    const Knots5 u = spline.LocalKnotValues(i, 0);
    double* p = spline.ControlPoint(i);
    p[3] = (u[1] * u[2] + u[1] * u[3] + u[2] * u[3]) / 3.0 + p[1] * p[2];
    removed.push_back(!HasSupportOutside(spline.Holes, spline.Functions[i]));
  }
  RemoveFunctions(spline, removed);
  model.Attributes = { { "Bend", 1 } };
  RefineRandomly(spline, rounds, seed);
  FinishModel(model);
  return model;
}
}

#endif
