// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "BallBlocks.h"
#include "RandomRefinement.h"
#include "ThreadedExecution.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace
{
using namespace trivariate;

BlockFitOptions Options(Index most, double shapeTolerance = 0.05)
{
  BlockFitOptions options;
  options.MaximumControlPoints = most;
  options.ShapeTolerance = shapeTolerance;
  return options;
}

// With the ball's own parameters the ramp at its edge is one direction of the layers: a tenth of
// the error of the same voxels in the image's own directions, at the same number of control points.
TEST(BlockFit, BeatsTheGridOnABall)
{
  const BallPhantom ball(36);
  const BlockFitResult fit = FitBlocks(
    ball.Map.Blocks, ball.Voxels, ball.Map.Nodes(16), Options(1800), ThreadedExecution(2));
  EXPECT_EQ(Validate(fit.Spline), "");
  EXPECT_LE(fit.ControlPoints, 1800);
  EXPECT_EQ(fit.Rounds.back().ControlPoints, fit.ControlPoints);
  EXPECT_LT(100.0 * fit.Rounds.back().Rms, 0.4);
  EXPECT_LE(fit.ShapeRms, 0.05);
  EXPECT_LT(fit.ShapePoints, 500);
  EXPECT_EQ(fit.VoxelsInside, ball.Voxels.Count());
  EXPECT_GT(fit.Folds.SmallestJacobian, 0.1);
  // Nearly all of the jump (.002 inside) is in the ramp, whose gradient is the range a voxel.
  EXPECT_GT(fit.Jump.Rms, 0.0);
  EXPECT_LT(fit.Jump.Rms, 0.4);
  EXPECT_GT(fit.Jump.Maximum, fit.Jump.Rms);

  GridSamples grid;
  grid.Size = { 36, 36, 36 };
  grid.Values = ball.Grid.data();
  grid.Mask = ball.Mask.data();
  FitOptions options;
  options.MaximumControlPoints = 1800;
  const FitResult identity = FitGrid(grid, options, ThreadedExecution(2));
  EXPECT_GT(identity.Rounds.back().Rms, 10.0 * fit.Rounds.back().Rms);
}

// Nodes that are anywhere on the sphere, uneven along it, cost a shape that must take each to its
// place many functions, and one that must only be on the surface none.
TEST(BlockFit, SlidesOnTheSurface)
{
  const BallPhantom ball(30);
  ShapeSamples nodes = ball.Map.Nodes(16);
  for (std::size_t i = 0; i < nodes.Places.size(); i += 3)
  {
    double* x = &nodes.Places[i];
    const double angle = 0.05 * std::sin(1.7 * x[2]), c = std::cos(angle), s = std::sin(angle);
    const double rotated[2] = { c * x[0] - s * x[1], s * x[0] + c * x[1] };
    std::copy_n(rotated, 2, x);
  }
  const auto fit = [&ball](const ShapeSamples& shape)
  {
    return FitBlocks(ball.Map.Blocks, ball.Voxels, shape, Options(1000, 0.1), ThreadedExecution(2));
  };
  const BlockFitResult sliding = fit(nodes);
  EXPECT_LT(sliding.ShapeRms, 0.1);
  EXPECT_LT(sliding.ShapePoints, 300);
  EXPECT_EQ(sliding.VoxelsInside, ball.Voxels.Count());
  EXPECT_GT(sliding.Folds.SmallestJacobian, 0.0);
  EXPECT_EQ(sliding.NumbersFitted, 3 * sliding.ShapePoints + sliding.ControlPoints);
  nodes.Surface.clear();
  const BlockFitResult fixed = fit(nodes);
  EXPECT_GT(fixed.ShapePoints, 400);
  EXPECT_GT(fixed.ShapeRms, 2.0 * sliding.ShapeRms);
}

// A surface with more detail than its share of the control points can follow gets up to half of
// them, and no more than its share where that does.
TEST(BlockFit, GivesAShapeThatIsFarFromItsSurfaceMorePoints)
{
  const BallPhantom ball(24);
  BlockFitOptions options = Options(700, 0.05);
  options.MaximumShapePoints = 240;
  const auto fit = [&](double depth)
  {
    ShapeSamples nodes = ball.Map.Nodes(12);
    for (std::size_t i = 0; i < nodes.Places.size(); i += 3)
    {
      const double* x = &nodes.Places[i];
      const double factor = 1.0 - depth * (1.0 + std::cos(10.0 * std::atan2(x[1], x[0])));
      std::for_each(&nodes.Places[i], &nodes.Places[i] + 2, [factor](double& y) { y *= factor; });
    }
    return FitBlocks(ball.Map.Blocks, ball.Voxels, nodes, options, ThreadedExecution(2));
  };
  const BlockFitResult smooth = fit(0.0), wavy = fit(0.2);
  EXPECT_LE(smooth.ShapePoints, 240);
  EXPECT_GT(wavy.ShapePoints, 240);
  EXPECT_LE(wavy.ShapePoints, 350);
}

// With a limit for that distance such a fit ends as soon as its shape has all its points; one that
// keeps to it is as without.
TEST(BlockFit, RefusesAShapeThatStaysAwayFromItsSurface)
{
  const BallPhantom ball(24);
  const auto fit = [&ball](double most)
  {
    BlockFitOptions options = Options(600, 0.1);
    options.LargestShapeDistance = most;
    return FitBlocks(
      ball.Map.Blocks, ball.Voxels, ball.Map.Nodes(12), options, ThreadedExecution(2));
  };
  const BlockFitResult any = fit(0.0), near = fit(0.5);
  EXPECT_LT(any.ShapeRms, 0.5);
  EXPECT_EQ(any.Spline.ControlPoints, near.Spline.ControlPoints);
  try
  {
    fit(0.001);
    FAIL() << "no error";
  }
  catch (const std::invalid_argument& error)
  {
    EXPECT_EQ(std::string(error.what()).rfind("The shape stays 0.", 0), 0u) << error.what();
  }
}

// Where block meshes have a dent and leave voxels out, the surface is pulled over some of them
// (over 23 of 52; a surface that stays where it is wanted covers none).
TEST(BlockFit, CoversVoxelsOutsideOfTheMeshes)
{
  const BallPhantom ball(24);
  const auto dented = [&ball](const double* x)
  {
    const double r = std::hypot(x[0], x[1], x[2]), slope = r > 0.0 ? x[2] / r : 0.0;
    return 1.0 - 0.1 * std::max(0.0, slope - 0.6) / 0.4 * r / ball.Map.Radius;
  };
  ShapeSamples nodes = ball.Map.Nodes(12);
  for (std::size_t i = 0; i < nodes.Places.size(); i += 3)
  {
    const double factor = dented(&nodes.Places[i]);
    std::for_each(&nodes.Places[i], &nodes.Places[i] + 3, [factor](double& x) { x *= factor; });
  }
  Index outside = 0; // of the meshes and a quarter of a voxel around them
  for (Index i = 0; i < ball.Voxels.Count(); ++i)
  {
    const double* x = &ball.Voxels.Places[3 * i];
    const double r = std::hypot(x[0], x[1], x[2]), to = ball.Map.Radius / r;
    const double onSphere[3] = { to * x[0], to * x[1], to * x[2] };
    outside += r > ball.Map.Radius * dented(onSphere) + 0.25;
  }
  EXPECT_GT(outside, 40);
  const BlockFitResult fit =
    FitBlocks(ball.Map.Blocks, ball.Voxels, nodes, Options(600, 0.1), ThreadedExecution(2));
  EXPECT_LT(4 * (ball.Voxels.Count() - fit.VoxelsInside), 3 * outside);
}

// Voxels that the meshes leave out by far, a spike of 5 x 5 x 6 on a ball, do not pull the surface
// off the ball.
TEST(BlockFit, IsNotPulledFarAway)
{
  BallPhantom ball(24);
  BlockSamples& voxels = ball.Voxels;
  Index top = 0;
  for (Index i = 0; i < voxels.Count(); ++i)
  {
    top = voxels.Places[3 * i + 2] > voxels.Places[3 * top + 2] ? i : top;
  }
  const std::vector<double> foot(&voxels.Parameters[3 * top], &voxels.Parameters[3 * top] + 3);
  for (int n = 0; n < 150; ++n)
  {
    voxels.Parameters.insert(voxels.Parameters.end(), foot.begin(), foot.end());
    const double place[3] = { n % 5 - 2.0, n / 5 % 5 - 2.0, ball.Map.Radius + 4.0 + n / 25 };
    voxels.Places.insert(voxels.Places.end(), place, place + 3);
    voxels.Values.push_back(0.8);
  }
  const BlockFitResult fit =
    FitBlocks(ball.Map.Blocks, voxels, ball.Map.Nodes(12), Options(600), ThreadedExecution(2));
  EXPECT_LT(fit.ShapeMaximum, 1.0);
}

// The core is another segment than the layers, with a density of its own: each side of the face
// between them has what its voxels have, and their places there are the same to rounding.
TEST(BlockFit, JumpsBetweenSegmentsWithoutAGap)
{
  BallPhantom ball(30);
  const auto fit = [&ball]()
  {
    return FitBlocks(
      ball.Map.Blocks, ball.Voxels, ball.Map.Nodes(12), Options(700, 0.1), ThreadedExecution(2));
  };
  for (Index i = 0; i < ball.Voxels.Count(); ++i)
  {
    const double* p = &ball.Voxels.Parameters[3 * i];
    const bool isCore = ball.Map.Blocks.BlockAt({ p[0], p[1], p[2] }) == 0;
    const double* x = &ball.Voxels.Places[3 * i];
    ball.Voxels.Values[i] = isCore ? 1.0 + 0.01 * x[0] : 0.2 - 0.01 * x[1];
  }
  const double blurred = fit().Rounds.back().Rms;
  const BlockComplex nested = NestedCubeComplex();
  ball.Map.Blocks.Segments = nested.Segments;
  const BlockFitResult sharp = fit();
  EXPECT_LT(sharp.Rounds.back().Rms, 1e-3);
  // The error of all is that of the two, each with its voxels.
  const auto inCore = std::count_if(
    ball.Voxels.Values.begin(), ball.Voxels.Values.end(), [](double value) { return value > 0.6; });
  const double all = double(ball.Voxels.Count());
  EXPECT_NEAR(inCore * std::pow(sharp.SegmentRms.at(0), 2) +
                (all - inCore) * std::pow(sharp.SegmentRms.at(1), 2),
    all * std::pow(sharp.Rounds.back().Rms, 2), 1e-6 * all * std::pow(sharp.Rounds.back().Rms, 2));
  EXPECT_GT(blurred, 20.0 * sharp.Rounds.back().Rms);
  EXPECT_LE(sharp.ControlPoints, 700);
  for (int f = 0; f < 6; ++f)
  {
    const BlockFace face{ 0, f / 2, f % 2 };
    const FaceTwin& twin = nested.Twin(face);
    for (const std::array<double, 2> st : { std::array<double, 2>{ 0.3, 0.6 }, { 0.0, 0.45 } })
    {
      const auto inside = HomogeneousValue(sharp.Spline, PointOn(nested, face, st));
      const auto outside =
        HomogeneousValue(sharp.Spline, PointOn(nested, twin.Face, twin.Map<double>(st, 1.0)));
      for (int c = 0; c < 3; ++c)
      {
        EXPECT_NEAR(inside[c], outside[c], 1e-13);
      }
      EXPECT_GT(inside[3] - outside[3], 0.5);
    }
  }
}

TEST(BlockFit, NeedsNoMoreThanTheTolerance)
{
  const BallPhantom ball(24);
  BlockFitOptions options = Options(3000, 0.1);
  options.RmsTolerance = 0.02;
  const BlockFitResult fit = FitBlocks(ball.Map.Blocks, ball.Voxels, {}, options);
  EXPECT_LE(fit.Rounds.back().Rms, 0.02);
  EXPECT_LT(fit.ControlPoints, 1500);
  options.RmsTolerance = 0.0;
  options.MaximumErrorTolerance = 0.1;
  const BlockFitResult other = FitBlocks(ball.Map.Blocks, ball.Voxels, {}, options);
  EXPECT_LE(other.Rounds.back().MaximumError, 0.1);
}

TEST(BlockFit, IsTheSameForAnyThreads)
{
  const BallPhantom ball(20);
  const auto fit = [&ball](int threads)
  {
    return FitBlocks(
      ball.Map.Blocks, ball.Voxels, ball.Map.Nodes(6), Options(500), ThreadedExecution(threads));
  };
  const BlockFitResult one = fit(1), three = fit(3);
  EXPECT_EQ(one.Spline.Functions, three.Spline.Functions);
  EXPECT_EQ(one.Spline.Weights, three.Spline.Weights);
  EXPECT_EQ(one.Spline.ControlPoints, three.Spline.ControlPoints);
}

// A bent L of three cubes, eight voxels wide, full of a smooth texture. As one grid it is fitted C2
// over all faces between cubes, closer and with fewer points for the shape than as three blocks.
TEST(BlockFit, FitsAnEllAsOneGrid)
{
  const Polycube cubes({ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } });
  const auto bend = [](const std::array<double, 3>& p) {
    return std::array<double, 3>{ 8.0 * p[0] + std::sin(p[1]), 8.0 * p[1], 8.0 * p[2] };
  };
  const auto fit = [&](const std::vector<int>& groups)
  {
    const BlockComplex blocks(cubes.CubePoints, { 0, 0, 0 }, groups, cubes.Cubes);
    BlockSamples voxels;
    ShapeSamples nodes;
    for (Index b = 0; b < blocks.Size(); ++b)
    {
      const LatticePoint &cube = cubes.Cubes[b], &origin = blocks.Origins[b];
      AddSamplesOfBlock(
        blocks, b, { 8, 8, 8 },
        [&](const std::array<double, 3>& local) {
          return bend({ cube[0] + local[0], cube[1] + local[1], cube[2] + local[2] });
        },
        nodes);
      for (int m = 0; m < 512; ++m)
      {
        const std::array<double, 3> local{ (m % 8 + 0.5) / 8.0, (m / 8 % 8 + 0.5) / 8.0,
          (m / 64 + 0.5) / 8.0 };
        const auto x = bend({ cube[0] + local[0], cube[1] + local[1], cube[2] + local[2] });
        for (int a = 0; a < 3; ++a)
        {
          voxels.Parameters.push_back(origin[a] + local[a]);
        }
        voxels.Places.insert(voxels.Places.end(), x.begin(), x.end());
        voxels.Values.push_back(std::cos(x[0] / 4.0) * std::cos(x[1] / 3.0) + 0.1 * x[2]);
      }
    }
    return FitBlocks(blocks, voxels, nodes, Options(260, 0.1), ThreadedExecution(2));
  };
  const BlockFitResult one = fit({ 0, 0, 0 }), three = fit({ 0, 1, 2 });
  EXPECT_FALSE(one.Spline.Holes.empty());
  EXPECT_EQ(one.Jump.Rms, 0.0);
  EXPECT_GT(three.Jump.Rms, 0.0);
  EXPECT_EQ(one.ShapePoints, 96);
  EXPECT_EQ(three.ShapePoints, 160);
  EXPECT_EQ(one.VoxelsInside, 3 * 512);
  EXPECT_EQ(one.Folds.Folded, 0);
  EXPECT_LT(one.Rounds.back().Rms, 0.9 * three.Rounds.back().Rms);
}

TEST(BlockFit, RefusesAndStops)
{
  const BallPhantom ball(20);
  const auto refusal = [&ball](BlockSamples voxels, const BlockFitOptions& options) -> std::string
  {
    try
    {
      FitBlocks(ball.Map.Blocks, voxels, {}, options);
    }
    catch (const std::invalid_argument& error)
    {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(refusal({}, Options(500)).find("no voxel"), std::string::npos);
  EXPECT_NE(refusal(ball.Voxels, Options(200)).find("at least 232"), std::string::npos);
  BlockSamples bad = ball.Voxels;
  bad.Parameters[0] = 17.0;
  EXPECT_NE(refusal(bad, Options(500)).find("voxel 0"), std::string::npos);
  bad = ball.Voxels;
  bad.Values[3] = NAN;
  EXPECT_NE(refusal(bad, Options(500)).find("not a finite number"), std::string::npos);

  int calls = 0;
  Execution stopping;
  stopping.Continue = [&calls](double done)
  {
    EXPECT_GE(done, 0.0);
    EXPECT_LE(done, 1.0);
    return ++calls < 10;
  };
  EXPECT_THROW(FitBlocks(ball.Map.Blocks, ball.Voxels, {}, Options(500), stopping), Aborted);
}
}
