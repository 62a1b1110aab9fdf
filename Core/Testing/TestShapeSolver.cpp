// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Fit/FoldEnergy.h"
#include "Fit/ShapeJacobian.h"
#include "Fit/ShapeSolver.h"
#include "ThreadedExecution.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>

namespace
{
using namespace trivariate;

constexpr double Radius = 10.0;

// A star with five rays as one cube: at the cube's edges the faces meet at a straight angle, and
// the determinant vanishes there; in the rays a plain fit overshoots.
std::array<double, 3> PlaceInStar(const std::array<double, 3>& local)
{
  std::array<double, 3> place;
  for (int a = 0; a < 3; ++a)
  {
    const double x = 2.0 * local[a] - 1.0, y = 2.0 * local[(a + 1) % 3] - 1.0,
                 z = 2.0 * local[(a + 2) % 3] - 1.0;
    place[a] = Radius * x * std::sqrt(1.0 - (y * y + z * z) / 2.0 + y * y * z * z / 3.0);
  }
  const double ray = 1.0 + 0.4 * std::cos(5.0 * std::atan2(place[1], place[0]));
  return { ray * place[0], ray * place[1], place[2] };
}

struct CubeInStar
{
  BlockComplex Blocks{ { { 0, 1, 2, 3, 4, 5, 6, 7 } }, { 0 }, { 0 }, { { 0, 0, 0 } } };
  BlockSpline Layout{ this->Blocks, 4 };
  ShapeSamples Nodes;
  Execution Run = ThreadedExecution(2);
  std::unique_ptr<ShapeTarget> Target;
  std::unique_ptr<ScatteredSystem> System;
  TSpline Spline;

  explicit CubeInStar(int cells)
  {
    AddSamplesOfBlock(this->Blocks, 0, { 16, 16, 16 }, PlaceInStar, this->Nodes);
    this->Target = std::make_unique<ShapeTarget>(this->Blocks, this->Nodes, 0.25);
    this->System =
      std::make_unique<ScatteredSystem>(this->Target->Samples(), 0, this->Layout, this->Run);
    this->Spline = this->Layout.MakeCoarsest(cells, 0);
    this->System->Update(this->Spline);
    this->System->ComputeResiduals(this->Spline);
    const GramMatrix gram = this->System->Assemble();
    for (int c = 0; c < 3; ++c)
    {
      std::vector<double> points;
      gram.Solve(this->System->Gradient(c), 1e-8, 1000, points, this->Run);
      for (Index i = 0; i < this->Spline.Size(); ++i)
      {
        this->Spline.ControlPoint(i)[c] = points[i];
      }
    }
  }

  ShapeNet Net() const
  {
    ShapeNet net(this->Spline.Size(), 3);
    for (Index i = 0; i < net.rows(); ++i)
    {
      net.row(i) = Eigen::Map<const Eigen::RowVector3d>(this->Spline.ControlPoint(i));
    }
    return net;
  }

  double Distance()
  {
    this->Target->Slide(this->Spline, this->System->Mesh(), this->Run);
    return this->Target->Distance().Rms;
  }

  Index Folded() const
  {
    const auto bounds = BoundJacobian(this->Spline, this->System->Mesh(), this->Run);
    return std::count_if(
      bounds.begin(), bounds.end(), [](const CellJacobian& cell) { return cell.Sampled <= 0.0; });
  }
};

ShapeNet RandomNet(Index rows, double size)
{
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-size, size);
  return ShapeNet::NullaryExpr(rows, 3, [&]() { return uniform(random); });
}

// And it comes nearer to the surface, for its samples slide on.
TEST(ShapeSolver, TakesFoldsOut)
{
  CubeInStar shape(2);
  const double before = shape.Distance();
  EXPECT_GT(shape.Folded(), 0);
  SolveShape(shape.Spline, *shape.System, *shape.Target, {}, shape.Run);
  EXPECT_EQ(shape.Folded(), 0);
  EXPECT_LT(shape.Distance(), before);
}

// Central differences agree with the gradient, where cells fold and are regularised.
TEST(FoldEnergy, HasItsGradient)
{
  CubeInStar shape(2);
  const ShapeNet net = shape.Net() + RandomNet(shape.Spline.Size(), 2.0);
  FoldEnergy energy(shape.System->Mesh(), shape.System->Points(), net, shape.Run);
  energy.CountFinely(net);
  const FoldEnergy::Evaluation here = energy.Evaluate(net);
  ASSERT_TRUE(here.Folds());
  energy.Regularise(here.Least);
  const ShapeNet slope = energy.Differentiate(net), way = RandomNet(net.rows(), 1.0);
  const double step = 1e-6;
  const double difference =
    (energy.Evaluate(net + step * way).Energy - energy.Evaluate(net - step * way).Energy) /
    (2.0 * step);
  EXPECT_NEAR(slope.cwiseProduct(way).sum(), difference, 1e-5 * std::abs(difference));
}

// Points that are added where cells nearly fold have their share of the mean: that of a shape that
// is flattened evenly stays what it is.
TEST(FoldEnergy, IsTheMeanOverCellsAlsoAtMorePoints)
{
  CubeInStar shape(2);
  const TSpline& spline = shape.Spline;
  ShapeNet cubes(spline.Size(), 3);
  for (Index i = 0; i < spline.Size(); ++i)
  {
    for (int a = 0; a < 3; ++a)
    {
      const auto& k = spline.Functions[i][a];
      const KnotLine& line = spline.KnotLines[a];
      cubes(i, a) = (line[k[1]] + line[k[2]] + line[k[3]]) / 3.0;
    }
  }
  FoldEnergy energy(shape.System->Mesh(), shape.System->Points(), cubes, shape.Run);
  EXPECT_NEAR(energy.Evaluate(cubes).Energy, 5.0, 1e-9);
  ShapeNet flat = cubes;
  const double d = 0.01;
  flat.col(2) *= d;
  const double wanted = (2.0 + d * d) / std::pow(d, 2.0 / 3.0) + (1.0 + d * d) / d;
  for (int round = 0; round < 2; ++round)
  {
    const FoldEnergy::Evaluation here = energy.Evaluate(flat);
    EXPECT_NEAR(here.Energy, wanted, 1e-6 * wanted);
    EXPECT_NEAR(*std::min_element(here.Least.begin(), here.Least.end()), d, 1e-9);
    energy.CountFinely(flat);
  }
}

// It is symmetric and positive, with folds too.
TEST(FoldEnergy, HasAConvexCurvature)
{
  CubeInStar shape(2);
  const ShapeNet net = shape.Net() + RandomNet(shape.Spline.Size(), 2.0);
  FoldEnergy energy(shape.System->Mesh(), shape.System->Points(), net, shape.Run);
  energy.Regularise(energy.Evaluate(net).Least);
  energy.Differentiate(net);
  const ShapeNet way = RandomNet(net.rows(), 1.0), other = net;
  const ShapeNet curved = energy.Curve(way), otherCurved = energy.Curve(other);
  const double size = std::abs(curved.cwiseProduct(other).sum());
  EXPECT_NEAR(curved.cwiseProduct(other).sum(), otherCurved.cwiseProduct(way).sum(), 1e-9 * size);
  EXPECT_GT(curved.cwiseProduct(way).sum(), 0.0);
  EXPECT_GT(otherCurved.cwiseProduct(other).sum(), 0.0);
}
}
