// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ParameterShapes.h"
#include "ThreadedExecution.h"
#include "WatchedExecution.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

using namespace trivariate;

namespace
{
VoxelParameter Solve(const ParameterShape& shape, const ParameterOptions& options = {},
  const Execution& execution = {})
{
  const std::vector<std::uint8_t> mask = MaskOf(shape);
  return SolveVoxelParameter(
    VoxelsOf(shape, mask), SurfaceOf(shape, static_cast<int>(shape.Size)), options, execution);
}

// The error over the voxels of the segment, of all three parameters, as a share of their ranges.
struct Error
{
  double Largest = 0.0, Mean = 0.0; // the root of the mean square
};

Error ErrorOf(const ParameterShape& shape, const VoxelParameter& solved)
{
  Error error;
  double count = 0.0;
  const std::vector<std::uint8_t> mask = MaskOf(shape);
  for (Index id = 0; id < static_cast<Index>(mask.size()); ++id)
  {
    if (mask[id] != 0)
    {
      const Eigen::Vector3d x = VoxelPlace(shape, id);
      const Index at = solved.At({ Index(x[0]), Index(x[1]), Index(x[2]) });
      const Eigen::Vector3d cubes(shape.Cubes[0], shape.Cubes[1], shape.Cubes[2]);
      const Eigen::Vector3d e =
        (Eigen::Map<const Eigen::Vector3d>(&solved.Values[3 * at]) - shape.Parameter(x))
          .cwiseQuotient(cubes);
      error.Largest = std::max(error.Largest, e.cwiseAbs().maxCoeff());
      error.Mean += e.squaredNorm() / 3.0;
      count += 1.0;
    }
  }
  error.Mean = std::sqrt(error.Mean / count);
  return error;
}

// What is thrown, as text.
std::string FaultOf(const ParameterVoxels& voxels, const ParameterSurface& surface,
  const ParameterOptions& options = {})
{
  try
  {
    SolveVoxelParameter(voxels, surface, options, Execution());
  }
  catch (const std::exception& error)
  {
    return error.what();
  }
  return "";
}
}

TEST(VoxelParameter, SolvesAffineMapsExactly)
{
  for (const double epsilon : { 1.0, 0.1 })
  {
    ParameterOptions options;
    options.Epsilon = epsilon;
    options.Tolerance = 1e-11;
    ParameterShape shape = SlantedBox(24);
    EXPECT_LT(ErrorOf(shape, Solve(shape, options)).Largest, 1e-8);
    shape.Cubes = { 2, 1, 3 }; // equal cubes: straight in lattice units, too
    EXPECT_LT(ErrorOf(shape, Solve(shape, options)).Largest, 1e-8);
  }
}

TEST(VoxelParameter, ConvergesToKnownMapsInSecondOrder)
{
  const auto check = [](const char* name, const std::function<ParameterShape(Index)>& make)
  {
    SCOPED_TRACE(name);
    std::map<Index, Error> errors;
    for (const Index n : { 32, 64, 128 })
    {
      const ParameterShape shape = make(n);
      const VoxelParameter solved = Solve(shape);
      errors[n] = ErrorOf(shape, solved);
      for (int axis = 0; axis < 3; ++axis)
      {
        const double length = solved.Lengths[axis].back();
        EXPECT_LT(solved.Solves[axis].Deviation, 1e-3 * length) << n << " axis " << axis;
        EXPECT_LT(solved.Solves[axis].MeanDeviation, 2e-4 * length) << n << " axis " << axis;
        EXPECT_LT(solved.Solves[axis].Residual, 1e-8);
      }
    }
    EXPECT_LT(errors[64].Largest, 0.002);
    // Second order would be a factor of 16.
    EXPECT_GT(errors[32].Mean, 10.0 * errors[128].Mean) << errors[64].Mean;
  };
  check("annulus", UnitAnnulus);
  check("twisted bar", [](Index n) { return TwistedBar(n, 1.0); });
  check("spherical shell", ShellSector);
}

// Of unit frames on an annulus: v = c t with the c that minimises int (c / r - 1)^2 r dr.
TEST(VoxelParameter, FindsTheLengthsOfCubes)
{
  const Index n = 64;
  const VoxelParameter solved = Solve(UnitAnnulus(n));
  const double inner = 0.35 * n, outer = 0.9 * n;
  EXPECT_NEAR(solved.Lengths[0].back(), outer - inner, 1e-3 * n);
  EXPECT_NEAR(
    solved.Lengths[1].back(), std::acos(0.0) * (outer - inner) / std::log(outer / inner), 1e-3 * n);
  EXPECT_NEAR(solved.Lengths[2].back(), 0.4 * n, 1e-6 * n);
}

TEST(VoxelParameter, SolvesWithPolynomials)
{
  ParameterOptions options;
  options.Gradient = ParameterGradient::Polynomial;
  options.Tolerance = 1e-10;
  const ParameterShape box = SlantedBox(24);
  EXPECT_LT(ErrorOf(box, Solve(box, options)).Largest, 1e-8);
  // The stabilised energy leaves no odd-even waves: as close as trilinear cells come.
  const ParameterShape bar = TwistedBar(40, 1.0);
  EXPECT_LT(ErrorOf(bar, Solve(bar, options)).Largest, 0.001);
  EXPECT_LT(ErrorOf(bar, Solve(bar, options)).Mean, 0.7 * ErrorOf(bar, Solve(bar)).Mean);
}

TEST(VoxelParameter, FollowsGradients)
{
  // Frames that are off by up to 12 degrees; the planes bring the gradients back.
  ParameterShape shape = UnitAnnulus(32);
  const auto frame = shape.Frame;
  shape.Frame = [frame](const Eigen::Vector3d& x) -> Eigen::Matrix3d
  {
    return frame(x) *
           Eigen::AngleAxisd(0.2 * std::sin(0.4 * x[0] + 0.3 * x[1]), Eigen::Vector3d::UnitZ())
             .toRotationMatrix();
  };
  ParameterOptions options;
  const double once = ErrorOf(shape, Solve(shape, options)).Mean;
  options.Rounds = 2;
  const double thrice = ErrorOf(shape, Solve(shape, options)).Mean;
  EXPECT_LT(thrice, 0.8 * once);
}

TEST(VoxelParameter, MapsCubesOfUnequalLengthsToTheLattice)
{
  // Cuts at a quarter and a half: lengths 1 : 1 : 2.
  ParameterShape shape = SlantedBox(32);
  const std::vector<std::uint8_t> mask = MaskOf(shape);
  shape.Cubes = { 1, 1, 4 };
  ParameterSurface surface = SurfaceOf(shape, 32);
  ASSERT_EQ(surface.LinePlanes.back().Coordinate, 3);
  while (surface.LinePlanes.back().Coordinate == 3)
  {
    surface.Lines.pop_back();
    surface.LinePlanes.pop_back();
  }
  for (LatticePlane& plane : surface.Planes)
  {
    plane.Coordinate = plane.Axis == 2 && plane.Coordinate == 4 ? 3 : plane.Coordinate;
  }
  const VoxelParameter solved =
    SolveVoxelParameter(VoxelsOf(shape, mask), surface, {}, Execution());
  ASSERT_EQ(solved.Coordinates[2], (std::vector<int>{ 0, 1, 2, 3 }));
  const std::vector<double>& lengths = solved.Lengths[2];
  EXPECT_NEAR(lengths[1] / lengths[3], 0.25, 1e-6);
  EXPECT_NEAR(lengths[2] / lengths[3], 0.5, 1e-6);
  double last = -1.0;
  for (double p = 0.01; p < 1.0; p += 0.01)
  {
    Eigen::Vector3d value;
    ASSERT_TRUE(solved.Evaluate(shape.Point({ 0.5, 0.5, p }), value));
    EXPECT_GT(value[2], last);
    last = value[2];
  }
  for (const auto& [p, w] : { std::pair(0.25, 1.0), std::pair(0.5, 2.0), std::pair(1.0, 3.0) })
  {
    Eigen::Vector3d value;
    ASSERT_TRUE(solved.Evaluate(shape.Point({ 0.5, 0.5, p }), value));
    EXPECT_NEAR(value[2], w, 0.01); // trilinear where the function bends
  }
}

TEST(VoxelParameter, EvaluatesBetweenVoxels)
{
  const ParameterShape shape = SlantedBox(24);
  ParameterOptions options;
  options.Tolerance = 1e-11;
  const VoxelParameter solved = Solve(shape, options);
  Eigen::Vector3d value;
  Eigen::Matrix3d gradient;
  for (const Eigen::Vector3d& p :
    { Eigen::Vector3d(0.5, 0.5, 0.5), Eigen::Vector3d(0.0, 1.0, 0.3), Eigen::Vector3d(1, 1, 1) })
  {
    ASSERT_TRUE(solved.Evaluate(shape.Point(p), value, &gradient));
    EXPECT_LT((value - p).norm(), 1e-8);
    EXPECT_LT((gradient - shape.Frame(p)).norm(), 1e-8);
  }
  EXPECT_FALSE(solved.Evaluate({ 0, 0, 0 }, value));
  EXPECT_FALSE(solved.Evaluate({ -99, 5, 5 }, value));
  EXPECT_FALSE(solved.Evaluate({ std::numeric_limits<double>::quiet_NaN(), 5, 5 }, value));
}

TEST(VoxelParameter, CountsFolds)
{
  VoxelParameter solved;
  solved.Low = { -1, 2, 0 };
  solved.Size = { 4, 3, 3 };
  solved.Spacing = { 1.0, 0.5, 2.0 };
  solved.Known.assign(36, KnownInSegment);
  for (int node = 0; node < 36; ++node)
  {
    solved.Values.insert(solved.Values.end(),
      { double(node % 4), 1.0 + 0.5 * (node / 4 % 3), 7.0 + 0.1 * (node / 12) });
  }
  const auto expect = [&solved](double orientation, Index cells, Index folded)
  {
    for (const Execution& execution : { Execution(), Execution(ThreadedExecution(3)) })
    {
      const ParameterFolds folds = CountFolds(solved, orientation, execution);
      EXPECT_EQ(folds.Cells, cells);
      EXPECT_EQ(folds.Folded, folded);
    }
  };
  expect(1.0, 12, 0);
  expect(-1.0, 12, 12);
  solved.Values[3 * (1 + 4 * (1 + 3 * 1))] += 3.0; // beyond the next voxel: in the four cells there
  expect(1.0, 12, 4);
  solved.Known[3] = 1; // a corner of a cell that is not folded
  expect(1.0, 11, 4);
  solved.Known[2] = 0; // and of one that is
  expect(1.0, 10, 3);
}

TEST(VoxelParameter, KeepsSpacing)
{
  const ParameterShape shape = SlantedBox(24);
  const std::vector<std::uint8_t> mask = MaskOf(shape);
  ParameterVoxels voxels = VoxelsOf(shape, mask);
  ParameterSurface surface = SurfaceOf(shape, 24);
  voxels.Spacing = { 0.5, 2.0, 1.25 };
  for (Eigen::Vector3d& point : surface.Points)
  {
    point = point.cwiseProduct(voxels.Spacing);
  }
  voxels.FrameAt = [&](Index id) -> Eigen::Matrix3d
  { return shape.Frame(VoxelPlace(shape, id)) * voxels.Spacing.cwiseInverse().asDiagonal(); };
  ParameterOptions options;
  options.Tolerance = 1e-11;
  const VoxelParameter solved = SolveVoxelParameter(voxels, surface, options, Execution());
  EXPECT_LT(ErrorOf(shape, solved).Largest, 1e-8);
}

TEST(VoxelParameter, IsTheSameOnTwoThreads)
{
  const ParameterShape shape = UnitAnnulus(40);
  const VoxelParameter one = Solve(shape), two = Solve(shape, {}, ThreadedExecution(2));
  EXPECT_EQ(one.Values, two.Values);
  EXPECT_EQ(one.Known, two.Known);
  EXPECT_EQ(one.Lengths, two.Lengths);
}

TEST(VoxelParameter, TakesAsManyIterationsWhateverTheSize)
{
  const auto iterations = [](Index n)
  {
    int most = 0;
    for (const ParameterSolve& solve : Solve(TwistedBar(n, 1.0)).Solves)
    {
      most = std::max(most, solve.Iterations);
    }
    return most;
  };
  const int few = iterations(40), many = iterations(120);
  EXPECT_LE(many, 1.3 * few) << few << " then " << many;
  EXPECT_LE(many, 40);
}

TEST(VoxelParameter, TouchesTheBorderOfTheImage)
{
  ParameterShape shape = UnitAnnulus(32);
  // The same solid, with a part of the grid cut off on all sides.
  const Eigen::Vector3d shift(0.0, 0.0, 4.0);
  const auto point = shape.Point;
  const auto place = shape.Place;
  const auto frame = shape.Frame;
  shape.Point = [=](const Eigen::Vector3d& p) -> Eigen::Vector3d { return point(p) - shift; };
  shape.Place = [=](const Eigen::Vector3d& x) -> Eigen::Vector3d { return place(x + shift); };
  shape.Frame = [=](const Eigen::Vector3d& x) -> Eigen::Matrix3d { return frame(x + shift); };
  const VoxelParameter solved = Solve(shape);
  EXPECT_LT(solved.Low[2], 0);
  EXPECT_LT(ErrorOf(shape, solved).Largest, 0.005);
}

TEST(VoxelParameter, SaysWhatIsWrong)
{
  const ParameterShape shape = SlantedBox(20);
  const std::vector<std::uint8_t> mask = MaskOf(shape);
  const ParameterVoxels voxels = VoxelsOf(shape, mask);
  const ParameterSurface surface = SurfaceOf(shape, 20);
  const auto contains = [](const std::string& text, const std::string& part)
  { return text.find(part) != std::string::npos; };

  const std::vector<std::uint8_t> nothing(mask.size(), 0);
  EXPECT_TRUE(contains(FaultOf(VoxelsOf(shape, nothing), surface), "no voxels"));

  std::vector<std::uint8_t> pieces = mask;
  pieces[0] = 1;
  EXPECT_TRUE(contains(FaultOf(VoxelsOf(shape, pieces), surface), "in pieces"));

  ParameterSurface reversed = surface;
  for (Triangle& triangle : reversed.Triangles)
  {
    std::swap(triangle[0], triangle[1]);
  }
  EXPECT_TRUE(contains(FaultOf(voxels, reversed), "inside out"));

  ParameterSurface elsewhere = surface;
  elsewhere.Points[0] = { 500.0, 0.0, 0.0 };
  EXPECT_TRUE(contains(FaultOf(voxels, elsewhere), "not the surface of this segment"));

  ParameterSurface oneEnd = surface;
  for (LatticePlane& plane : oneEnd.Planes)
  {
    plane.Coordinate = plane.Axis == 1 ? 0 : plane.Coordinate;
  }
  EXPECT_TRUE(contains(FaultOf(voxels, oneEnd), "at one coordinate only along v"));

  ParameterVoxels frameless = voxels;
  frameless.FrameAt = [](Index) -> Eigen::Matrix3d { return Eigen::Matrix3d::Zero(); };
  EXPECT_TRUE(contains(FaultOf(frameless, surface), "The frame of voxel"));

  ParameterVoxels mirrored = voxels;
  mirrored.FrameAt = [&voxels](Index id) -> Eigen::Matrix3d { return -voxels.FrameAt(id); };
  EXPECT_TRUE(contains(FaultOf(mirrored, surface), "left-handed"));

  ParameterOptions options;
  options.Epsilon = 0.0;
  EXPECT_TRUE(contains(FaultOf(voxels, surface, options), "Epsilon"));
  options.Epsilon = 1.0;
  options.Tolerance = 0.0;
  EXPECT_TRUE(contains(FaultOf(voxels, surface, options), "Tolerance"));
}

TEST(VoxelParameter, StopsWithinASecond)
{
  // In the second of three parameters: the first one has been set up and solved for.
  Watch watch;
  EXPECT_THROW(Solve(UnitAnnulus(128), {}, watch.Until(0.4)), Aborted);
  EXPECT_LT(watch.LongestLook, 1.0);
  EXPECT_LT(watch.LongestRest, 1.0);

  ParameterOptions polynomial;
  polynomial.Gradient = ParameterGradient::Polynomial;
  Watch other;
  EXPECT_THROW(Solve(UnitAnnulus(64), polynomial, other.Until(0.1)), Aborted);
  EXPECT_LT(other.LongestLook, 1.0);
}
