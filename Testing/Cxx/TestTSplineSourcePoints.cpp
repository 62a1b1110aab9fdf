// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "SplineModels.h"
#include "TSpline/Evaluator.h"

#include "vtkImageData.h"
#include "vtkIntArray.h"
#include "vtkPolyData.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <limits>

namespace
{
using namespace trivariate;

TEST(TSplineSourcePoints, GradientsMatchFiniteDifferencesAndFormulas)
{
  const TSplineModel model = QuarterAnnulus(5, 11);
  auto source = MakeSource(model, vtkTSplineSource::LINEAR_HEXES);
  source->ComputeGradientsOn();
  source->ComputeJacobianOn();
  source->Update();
  auto* grid = vtkUnstructuredGrid::SafeDownCast(source->GetOutput());
  vtkDataArray* gradient = PointArray(grid, "RadialGradient");
  vtkDataArray* linear = PointArray(grid, "LinearGradient");
  vtkDataArray* jacobian = PointArray(grid, "JacobianDeterminant");
  ASSERT_TRUE(gradient && linear && jacobian);
  ASSERT_EQ(linear->GetNumberOfComponents(), 6);
  const double linearGradient[6] = { 1.0, 2.0, 0.0, 0.0, 0.0, 1.0 };
  const BezierMesh cells(model.Spline);
  const Evaluator geometry(model.Spline, cells, { 0, 1, 2 });
  for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i)
  {
    double x[3];
    grid->GetPoint(i, x);
    EXPECT_NEAR(gradient->GetComponent(i, 0), 2.0 * x[0], 1e-11);
    EXPECT_NEAR(gradient->GetComponent(i, 1), 2.0 * x[1], 1e-11);
    EXPECT_NEAR(gradient->GetComponent(i, 2), 0.0, 1e-11);
    for (int c = 0; c < 6; ++c)
    {
      EXPECT_NEAR(linear->GetComponent(i, c), linearGradient[c], 1e-11);
    }
    // The volume that a small box of parameters maps to, by central differences.
    double u[3], low[3], high[3], d[9];
    PointArray(grid, "Parameter")->GetTuple(i, u);
    const double h = 1e-5;
    bool inside = true;
    for (int a = 0; a < 3; ++a)
    {
      double q[3] = { u[0], u[1], u[2] };
      EvaluatorOutput output;
      output.Values = low;
      q[a] = u[a] - h;
      inside = inside && geometry.Evaluate(q, output);
      output.Values = high;
      q[a] = u[a] + h;
      inside = inside && geometry.Evaluate(q, output);
      for (int b = 0; b < 3; ++b)
      {
        d[3 * b + a] = (high[b] - low[b]) / (2.0 * h);
      }
    }
    if (inside)
    {
      EXPECT_NEAR(jacobian->GetTuple1(i), JacobianDeterminant(d), 1e-7);
    }
  }
}

TEST(TSplineSourcePoints, GradientOfARandomFieldMatchesFiniteDifferences)
{
  const TSplineModel model = RandomBox({ 2, 2, 2 }, 5, 4);
  std::mt19937 random(4);
  std::uniform_real_distribution<double> coordinate(0.1, 15.9);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  const double h = 1e-4;
  for (int i = 0; i < 50; ++i)
  {
    const double x[3] = { coordinate(random), coordinate(random), coordinate(random) };
    points->InsertNextPoint(x);
    for (int a = 0; a < 3; ++a)
    {
      for (const double step : { -h, h })
      {
        double y[3] = { x[0], x[1], x[2] };
        y[a] += step;
        points->InsertNextPoint(y);
      }
    }
  }
  vtkNew<vtkPolyData> cloud;
  cloud->SetPoints(points);
  auto source = MakeSource(model, vtkTSplineSource::POINTS);
  source->SetInputData(1, cloud);
  source->ComputeGradientsOn();
  source->Update();
  vtkDataArray* value = PointArray(source->GetOutput(), "Value");
  vtkDataArray* gradient = PointArray(source->GetOutput(), "ValueGradient");
  for (vtkIdType i = 0; i < 50; ++i)
  {
    for (int a = 0; a < 3; ++a)
    {
      const vtkIdType low = 7 * i + 1 + 2 * a;
      EXPECT_NEAR(gradient->GetComponent(7 * i, a),
        (value->GetTuple1(low + 1) - value->GetTuple1(low)) / (2.0 * h), 1e-6);
    }
  }
}

TEST(TSplineSourcePoints, ImageEqualsPointsAndTheLatticePathTheGeneralOne)
{
  for (unsigned seed = 1; seed <= 4; ++seed)
  {
    const TSplineModel model = RandomBox({ 2, 3, 1 }, 5, seed);
    // The spline's own sample lattice: evaluated as a lattice.
    vtkNew<vtkImageData> lattice;
    lattice->SetExtent(-2, 14, 3, 27, 5, 13);
    lattice->SetOrigin(2.0, -3.0, -5.0);
    auto source = MakeSource(model, vtkTSplineSource::IMAGE);
    source->SetInputData(1, lattice);
    source->ComputeGradientsOn();
    source->Update();
    auto* image = vtkImageData::SafeDownCast(source->GetOutput());
    ASSERT_EQ(image->GetNumberOfPoints(), 17 * 25 * 9);
    // The same points in no order of a lattice: found one by one.
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    const vtkIdType n = image->GetNumberOfPoints();
    for (vtkIdType i = 0; i < n; ++i)
    {
      points->InsertNextPoint(image->GetPoint(n - 1 - i));
    }
    vtkNew<vtkPolyData> cloud;
    cloud->SetPoints(points);
    auto scattered = MakeSource(model, vtkTSplineSource::POINTS);
    scattered->SetInputData(1, cloud);
    scattered->ComputeGradientsOn();
    scattered->Update();
    const BezierMesh cells(model.Spline);
    const Evaluator evaluator(model.Spline, cells, { 3 });
    for (vtkIdType i = 0; i < n; ++i)
    {
      double expected = 0.0;
      EvaluatorOutput output;
      output.Values = &expected;
      ASSERT_TRUE(evaluator.Evaluate(image->GetPoint(i), output));
      ASSERT_EQ(PointArray(image, "vtkValidPointMask")->GetTuple1(i), 1.0);
      ASSERT_NEAR(PointArray(image, "Value")->GetTuple1(i), expected, 1e-13);
      for (const char* name : { "Value", "ValueGradient" })
      {
        vtkDataArray* a = PointArray(image, name);
        vtkDataArray* b = PointArray(scattered->GetOutput(), name);
        for (int c = 0; c < a->GetNumberOfComponents(); ++c)
        {
          ASSERT_NEAR(a->GetComponent(i, c), b->GetComponent(n - 1 - i, c), 1e-12);
        }
      }
    }
  }
}

TEST(TSplineSourcePoints, ImageLatticesMayBeTurnedFlippedOrOutside)
{
  const TSplineModel model = RandomBox({ 1, 1, 2 }, 3, 9);
  const BezierMesh cells(model.Spline);
  const Evaluator evaluator(model.Spline, cells, { 3 });
  // Rows: a quarter turn about z; a flip; a general rotation; none.
  const double directions[4][9] = { { 0, -1, 0, 1, 0, 0, 0, 0, 1 }, { -1, 0, 0, 0, 1, 0, 0, 0, 1 },
    { 0.6, -0.8, 0, 0.8, 0.6, 0, 0, 0, 1 }, { 1, 0, 0, 0, 1, 0, 0, 0, 1 } };
  for (const auto& direction : directions)
  {
    vtkNew<vtkImageData> lattice;
    lattice->SetDimensions(12, 10, 11);
    lattice->SetOrigin(3.0, 2.5, -1.0);
    lattice->SetSpacing(0.7, 0.9, 1.9);
    lattice->SetDirectionMatrix(direction);
    auto source = MakeSource(model, vtkTSplineSource::IMAGE);
    source->SetInputData(1, lattice);
    source->Update();
    auto* image = vtkImageData::SafeDownCast(source->GetOutput());
    int inside = 0;
    for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
    {
      double x[3], y[3], expected = 0.0;
      lattice->GetPoint(i, x);
      image->GetPoint(i, y);
      ASSERT_EQ(std::memcmp(x, y, sizeof(x)), 0);
      EvaluatorOutput output;
      output.Values = &expected;
      const bool found = evaluator.Evaluate(x, output);
      inside += found;
      ASSERT_EQ(PointArray(image, "vtkValidPointMask")->GetTuple1(i), found ? 1.0 : 0.0);
      ASSERT_NEAR(PointArray(image, "Value")->GetTuple1(i), found ? expected : 0.0, 1e-12);
    }
    EXPECT_GT(inside, 100);
    EXPECT_LT(inside, image->GetNumberOfPoints());
  }
}

TEST(TSplineSourcePoints, ImageOfACurvedSplineUsesItsInverseMap)
{
  auto source = MakeSource(QuarterAnnulus(3, 5), vtkTSplineSource::IMAGE);
  source->SetDimensions(31, 29, 7);
  source->Update();
  auto* image = vtkImageData::SafeDownCast(source->GetOutput());
  double bounds[6];
  image->GetBounds(bounds);
  const double expected[6] = { 0.0, 2.0, 0.0, 2.0, 0.0, 1.0 };
  for (int i = 0; i < 6; ++i)
  {
    EXPECT_NEAR(bounds[i], expected[i], 0.05); // the control points' box is a little larger
  }
  vtkDataArray* mask = PointArray(image, "vtkValidPointMask");
  vtkDataArray* radial = PointArray(image, "Radial");
  int inside = 0;
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    const double* x = image->GetPoint(i);
    const double r = std::hypot(x[0], x[1]);
    const double distance = std::min({ r - 1.0, 2.0 - r, x[0], x[1], x[2], 1.0 - x[2] });
    if (std::abs(distance) > 1e-9) // on the boundary either is right
    {
      ASSERT_EQ(mask->GetTuple1(i), distance > 0.0 ? 1.0 : 0.0) << x[0] << " " << x[1];
    }
    if (mask->GetTuple1(i) != 0.0)
    {
      ++inside;
      ASSERT_NEAR(radial->GetTuple1(i), r * r, 1e-8);
    }
    else
    {
      ASSERT_EQ(radial->GetTuple1(i), 0.0);
    }
  }
  EXPECT_GT(inside, 2000);
}

// A spline that was fitted over the domain of a segment stands for points with its label alone,
// where points have labels; one of segment 0, without a domain, for all.
TEST(TSplineSourcePoints, ASplineOfASegmentStandsForItsLabelAlone)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(24, 24, 5);
  image->SetSpacing(0.1, 0.1, 0.25);
  vtkNew<vtkIntArray> labels;
  labels->SetName("Segment");
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    labels->InsertNextValue(image->GetPoint(i)[0] < 1.0 ? 3 : 0);
  }
  for (const bool labelled : { true, false })
  {
    for (const int segment : { 3, 0 })
    {
      TSplineModel model = QuarterAnnulus(3, 1);
      model.Segment.assign(model.Spline.Size(), segment);
      auto source = MakeSource(model, vtkTSplineSource::IMAGE);
      if (labelled)
      {
        image->GetPointData()->AddArray(labels);
      }
      else
      {
        image->GetPointData()->RemoveArray("Segment");
      }
      source->SetInputData(1, image);
      source->Update();
      vtkDataArray* mask = PointArray(source->GetOutput(), "vtkValidPointMask");
      vtkDataArray* radial = PointArray(source->GetOutput(), "Radial");
      for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
      {
        const double* x = image->GetPoint(i);
        const double r = std::hypot(x[0], x[1]);
        const bool isInside = r > 1.001 && r < 1.999, isFar = r < 0.5 || r > 2.5;
        const bool isOwn = !labelled || segment == 0 || labels->GetValue(i) == segment;
        if (isInside || isFar || !isOwn)
        {
          const bool found = isInside && isOwn;
          ASSERT_EQ(mask->GetTuple1(i), found) << labelled << segment << " " << x[0] << " " << x[1];
          ASSERT_NEAR(radial->GetTuple1(i), found ? r * r : 0.0, 1e-8);
        }
      }
    }
  }
}

TEST(TSplineSourcePoints, PointsKeepTheirDataSetAndMarkThoseOutside)
{
  auto source = MakeSource(QuarterAnnulus(2, 2), vtkTSplineSource::POINTS);
  vtkNew<vtkImageData> image;
  image->SetDimensions(9, 8, 7);
  image->SetOrigin(-0.4, -0.3, -0.2);
  image->SetSpacing(0.3, 0.3, 0.2);
  image->AllocateScalars(VTK_SHORT, 1);
  std::fill_n(static_cast<short*>(image->GetScalarPointer()), 9 * 8 * 7, short(5));
  source->SetInputData(1, image);
  source->Update();
  auto* output = vtkImageData::SafeDownCast(source->GetOutput());
  ASSERT_TRUE(output);
  EXPECT_EQ(PointArray(output, "ImageScalars")->GetTuple1(0), 5.0);
  EXPECT_EQ(PointArray(output, "vtkValidPointMask")->GetTuple1(0), 0.0);
  EXPECT_EQ(image->GetPointData()->GetNumberOfArrays(), 1); // the input is left alone

  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->InsertNextPoint(1.5, 0.0, 0.5);
  points->InsertNextPoint(std::numeric_limits<double>::quiet_NaN(), 0.0, 0.5);
  points->InsertNextPoint(std::numeric_limits<double>::infinity(), 0.0, 0.5);
  points->InsertNextPoint(-1.5, 0.0, 0.5);
  vtkNew<vtkPolyData> cloud;
  cloud->SetPoints(points);
  source->SetInputData(1, cloud);
  source->Update();
  ASSERT_TRUE(vtkPolyData::SafeDownCast(source->GetOutput()));
  vtkDataArray* mask = PointArray(source->GetOutput(), "vtkValidPointMask");
  vtkDataArray* radial = PointArray(source->GetOutput(), "Radial");
  EXPECT_EQ(mask->GetTuple1(0), 1.0);
  EXPECT_NEAR(radial->GetTuple1(0), 2.25, 1e-9);
  for (vtkIdType i = 1; i < 4; ++i)
  {
    EXPECT_EQ(mask->GetTuple1(i), 0.0);
    EXPECT_EQ(radial->GetTuple1(i), 0.0);
  }
}
}
