// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "BallBlocks.h"
#include "Fit/DataErrors.h"
#include "Fit/RefinementHistory.h"
#include "Fit/ShapeInverse.h"
#include "TSpline/Evaluator.h"
#include "ThreadedExecution.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>

namespace
{
using namespace trivariate;

// What a spline cannot follow, and what it can.
double Steep(const double* x)
{
  return std::tanh(4.0 * (x[0] + 0.6 * x[1] - 0.3 * x[2] - 1.1));
}

double Cubic(const double* x)
{
  return x[0] * x[0] * x[0] - x[1] * x[1] + x[0] * x[1] * x[2];
}

// A cube of eight cells with X, Y, Z = 2u, 2v, 2w, and voxels in it with an attribute.
struct CubeOfData
{
  BlockComplex Blocks = CubesComplex({ { 0, 0, 0 } });
  BlockSpline Layout{ this->Blocks, 3 };
  Execution Run = ThreadedExecution(2);
  TSpline Shape = this->Layout.MakeCoarsest(2, 1);
  std::vector<double> Places;
  ScatteredSamples Samples;

  explicit CubeOfData(double (*value)(const double*))
  {
    for (Index i = 0; i < this->Shape.Size(); ++i)
    {
      double* p = this->Shape.ControlPoint(i);
      for (int a = 0; a < 3; ++a)
      {
        // Linear functions have their values at the mean knots as coefficients.
        const auto& knots = this->Shape.Functions[i][a];
        const auto& line = this->Shape.KnotLines[a];
        p[a] = 2.0 * (line[knots[1]] + line[knots[2]] + line[knots[3]]) / 3.0;
      }
      p[3] = 0.0;
    }
    this->Samples.Components = 1;
    for (int m = 0; m < 13 * 13 * 13; ++m)
    {
      for (const int n : { m % 13, m / 13 % 13, m / 169 })
      {
        this->Places.push_back(0.1 + 0.15 * n);
      }
      this->Samples.Values.push_back(value(&this->Places[3 * m]));
    }
  }

  // The shape moved inside of the cube, its attribute fitted at where the voxels are on it.
  struct Fitted
  {
    TSpline Spline;
    ScatteredSamples Samples;
    std::unique_ptr<ScatteredSystem> System;
  };
  void Fit(const ShapeNet& way, Fitted& fitted) const
  {
    fitted.Spline = this->Shape;
    for (Index i = 0; i < way.rows(); ++i)
    {
      Eigen::Map<Eigen::RowVector3d>(fitted.Spline.ControlPoint(i)) += way.row(i);
    }
    const BezierMesh mesh(fitted.Spline);
    fitted.Samples = this->Samples;
    const FoundParameters found =
      FindParametersOnShape(fitted.Spline, mesh, this->Places, {}, this->Run);
    ASSERT_TRUE(found.Outside.empty());
    fitted.Samples.Parameters = found.Parameters;
    fitted.System = std::make_unique<ScatteredSystem>(fitted.Samples, 3, this->Layout, this->Run);
    fitted.System->Update(fitted.Spline);
    fitted.System->ComputeResiduals(fitted.Spline);
    const GramMatrix gram = fitted.System->Assemble();
    std::vector<double> coefficients;
    for (int round = 0; round < 3; ++round) // the matrix is of single precision
    {
      gram.Solve(fitted.System->Gradient(0), 1e-10, 1000, coefficients, this->Run);
      for (Index i = 0; i < fitted.Spline.Size(); ++i)
      {
        fitted.Spline.ControlPoint(i)[3] += coefficients[i];
      }
      fitted.System->ComputeResiduals(fitted.Spline);
    }
  }

  // What keeps the surface where it is.
  ShapeNet RandomWay(unsigned seed, double size) const
  {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(-size, size);
    ShapeNet way = ShapeNet::NullaryExpr(this->Shape.Size(), 3, [&]() { return uniform(random); });
    for (Index i = 0; i < way.rows(); ++i)
    {
      for (int a = 0; a < 3; ++a)
      {
        const auto& knots = this->Shape.Functions[i][a];
        const bool isInside = knots[0] < knots[3] && knots[1] < knots[4];
        way.row(i) *= isInside ? 1.0 : 0.0;
      }
    }
    return way;
  }
};

struct ErrorsOfCube
{
  CubeOfData Cube;
  CubeOfData::Fitted Here;
  double Range = 1.0;
  std::unique_ptr<DataErrors> Model;
  DataErrorOptions Options{ 0.15, 7.0, 0.0 };

  explicit ErrorsOfCube(double (*value)(const double*))
    : Cube(value)
  {
    this->Cube.Fit(ShapeNet::Zero(this->Cube.Shape.Size(), 3), this->Here);
    this->Range = this->Here.System->Range(0);
    this->Model = this->With(this->Options);
  }

  std::unique_ptr<DataErrors> With(const DataErrorOptions& options) const
  {
    return std::make_unique<DataErrors>(this->Here.Spline, this->Cube.Shape, this->Cube.Layout,
      this->Here.Samples, *this->Here.System, std::vector<double>{ this->Range }, options,
      this->Cube.Run);
  }

  // After another fit on a moved shape.
  double At(const ShapeNet& way) const
  {
    CubeOfData::Fitted there;
    this->Cube.Fit(way, there);
    return 0.5 * this->Options.Weight * there.System->SquaredError(0) / (this->Range * this->Range);
  }
};

TEST(DataErrors, KnowHowTheyChangeWithTheShape)
{
  const ErrorsOfCube errors(Steep);
  const double now = errors.At(ShapeNet::Zero(errors.Cube.Shape.Size(), 3));
  for (unsigned seed = 0; seed < 4; ++seed)
  {
    const ShapeNet way = errors.Cube.RandomWay(seed, 0.02);
    const double slope = errors.Model->Slope().cwiseProduct(way).sum();
    EXPECT_NEAR(
      0.5 * (errors.At(way) - errors.At(-way)), slope, 0.05 * std::abs(slope) + 1e-3 * now)
      << seed;
  }
  // The steepest way, as far as it promises, brings most of what it promises.
  ShapeNet best = -errors.Model->Slope();
  for (Index i = 0; i < best.rows(); ++i)
  {
    best.row(i) *= errors.Cube.RandomWay(1, 1.0).row(i).isZero() ? 0.0 : 1.0;
  }
  const double slope = errors.Model->Slope().cwiseProduct(best).sum();
  const double length = -slope / errors.Model->Curve(best).cwiseProduct(best).sum();
  const double promised = 0.5 * slope * length;
  EXPECT_LT(promised, -0.02 * now);
  EXPECT_NEAR(errors.At(length * best) - now, promised, 0.5 * std::abs(promised));
}

// Where there is no error it is that of the second derivative, what the attribute cannot follow; it
// is followed almost to the end.
TEST(DataErrors, AreWhatAttributesCannotFollow)
{
  const ErrorsOfCube errors(Cubic);
  EXPECT_LT(errors.At(ShapeNet::Zero(errors.Cube.Shape.Size(), 3)), 1e-9);
  for (unsigned seed = 0; seed < 4; ++seed)
  {
    const ShapeNet way = errors.Cube.RandomWay(seed, 0.01);
    const double curve = errors.Model->Curve(way).cwiseProduct(way).sum();
    EXPECT_NEAR(errors.At(way), 0.5 * curve, 0.15 * curve) << seed;
  }
}

// It is symmetric, as far as the attributes are taken off; and damping counts the ways of voxels.
TEST(DataErrors, HaveASymmetricCurvature)
{
  const ErrorsOfCube errors(Steep);
  const CubeOfData& cube = errors.Cube;
  const auto curve = [&](double damping, const ShapeNet& way, const ShapeNet& other) {
    return errors.With({ 0.5, 2.0, damping })->Curve(way).cwiseProduct(other).sum();
  };
  const ShapeNet way = cube.RandomWay(1, 1.0), other = cube.RandomWay(2, 1.0);
  const double size = std::sqrt(curve(0.0, way, way) * curve(0.0, other, other));
  EXPECT_NEAR(curve(0.0, way, other), curve(0.0, other, way), 0.02 * size);
  ShapeNet all(cube.Shape.Size(), 3);
  all.rowwise() = Eigen::RowVector3d(0.3, 0.0, 0.4);
  const double ways = 0.25 * cube.Samples.Values.size();
  EXPECT_NEAR(curve(10.0, all, all) - curve(0.0, all, all), 2.0 * 10.0 * ways / 0.25, 1e-6 * ways);
}

// A part of the voxels tells nearly the same of the second derivative, and the gradient is that of
// all.
TEST(DataErrors, NeedFewVoxelsForTheirCurvature)
{
  const ErrorsOfCube errors(Steep);
  DataErrorOptions options = errors.Options;
  options.VoxelsOfPoint = 6; // of 2,197 for 125 points
  const auto few = errors.With(options);
  EXPECT_EQ(few->Slope(), errors.Model->Slope());
  for (unsigned seed = 0; seed < 4; ++seed)
  {
    const ShapeNet way = errors.Cube.RandomWay(seed, 1.0);
    const double curve = errors.Model->Curve(way).cwiseProduct(way).sum();
    const double ofFew = few->Curve(way).cwiseProduct(way).sum();
    EXPECT_NE(ofFew, curve);
    EXPECT_NEAR(ofFew, curve, 0.25 * curve) << seed;
  }
}

TEST(RefinementHistory, RefinesAnotherSplineInTheSameWay)
{
  const BallMap ball;
  const BlockSpline layout(ball.Blocks, 4);
  const TSpline coarse = layout.MakeCoarsest(1, 1);
  const auto first = MakeBlockRule(layout, coarse);
  RefinementHistory history(first->Clone());
  TSpline refined = coarse;
  for (int round = 0; round < 3; ++round)
  {
    const BlendingFunction& f = refined.Functions[17 * round];
    history.Refine(refined, { { 17 * round, 0, (f[0][0] + f[0][4]) / 2 } });
  }
  ASSERT_GT(refined.Size(), coarse.Size());
  TSpline other = coarse;
  for (Index i = 0; i < other.Size(); ++i)
  {
    other.ControlPoint(i)[3] = std::sin(double(layout.Share(coarse, Sharing::Places).PointOf[i]));
  }
  const TSpline before = other;
  history.Repeat(*first, other);
  EXPECT_EQ(other.Functions, refined.Functions);
  const BezierMesh coarseMesh(before), mesh(other);
  const Evaluator wanted(before, coarseMesh, { 3 }), found(other, mesh, { 3 });
  for (int i = 0; i < 50; ++i)
  {
    const auto& o = ball.Blocks.Origins[i % 7];
    const double p[3] = { o[0] + 0.017 * i, o[1] + 0.99 - 0.019 * i, o[2] + 0.013 * i };
    double expected, actual;
    EvaluatorOutput output;
    output.Values = &expected;
    ASSERT_TRUE(wanted.Evaluate(p, output));
    output.Values = &actual;
    ASSERT_TRUE(found.Evaluate(p, output));
    EXPECT_NEAR(actual, expected, 1e-12);
  }
}
}
