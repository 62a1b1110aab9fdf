// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
// The normal equations and their solver against dense matrices.
#include "Fit/GramMatrix.h"
#include "RandomRefinement.h"
#include "ThreadedExecution.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

using namespace trivariate;

namespace
{
// A randomly refined spline over a grid of voxels, some of which may not count.
struct Problem
{
  std::array<Index, 3> Size;
  Axes Grid;
  TSpline Spline;
  FunctionTable Table{ Grid };
  std::vector<std::uint8_t> Counted;
  VoxelMask Mask;

  Problem(
    const std::array<Index, 3>& size, double rootCells, int rounds, int marks, std::mt19937& random)
    : Size(size)
    , Grid{ DyadicAxis::ForSamples(size[0], rootCells), DyadicAxis::ForSamples(size[1], rootCells),
      DyadicAxis::ForSamples(size[2], rootCells) }
    , Mask{ size, nullptr, {}, {}, {} }
  {
    std::array<KnotLine, 3> lines;
    std::array<int, 3> stride;
    for (int a = 0; a < 3; ++a)
    {
      lines[a] = this->Grid[a].Line();
      stride[a] = 1 << this->Grid[a].FinestLevel();
    }
    this->Spline = MakeTensorProduct(lines, stride, 1);
    const auto rule = MakeKnotInsertionRule(this->Spline);
    for (int round = 0; round < rounds; ++round)
    {
      rule->Refine(this->Spline, RandomMarks(this->Spline, marks, random));
    }
    this->Table.Update(this->Spline);
  }

  // A ball of random place and size, with holes.
  void CountOnlyABlob(std::mt19937& random)
  {
    std::array<double, 3> centre;
    for (int a = 0; a < 3; ++a)
    {
      centre[a] = Random(random, 0.2, 0.8) * (this->Size[a] - 1);
    }
    const double radius = Random(random, 0.25, 0.5) * this->Size[0];
    for (Index i = 0; i < this->Size[0] * this->Size[1] * this->Size[2]; ++i)
    {
      const Point x = this->Voxel(i);
      const double r = std::hypot(x[0] - centre[0], x[1] - centre[1], x[2] - centre[2]);
      this->Counted.push_back(r < radius && random() % 10 != 0 ? 1 + random() % 255 : 0);
    }
    this->Mask.Values = this->Counted.data();
    this->Mask.Prepare({});
  }

  Point Voxel(Index i) const
  {
    return { double(i % this->Size[0]), double(i / this->Size[0] % this->Size[1]),
      double(i / this->Size[0] / this->Size[1]) };
  }

  // Rows: the voxels that count.
  Eigen::MatrixXd Collocation() const
  {
    const Index voxels = this->Size[0] * this->Size[1] * this->Size[2];
    Eigen::MatrixXd values = Eigen::MatrixXd::Zero(voxels, this->Spline.Size());
    for (Index i = 0; i < voxels; ++i)
    {
      for (Index f = 0; f < this->Spline.Size() && (this->Counted.empty() || this->Counted[i]); ++f)
      {
        values(i, f) = ValueOf(this->Spline, f, this->Voxel(i));
      }
    }
    return values;
  }

  GramMatrix Matrix(const Execution& execution = {}) const
  {
    return GramMatrix(this->Spline, this->Table, this->Mask, execution);
  }
};

std::vector<double> ToStd(const Eigen::VectorXd& v)
{
  return { v.data(), v.data() + v.size() };
}

// Solves for random coefficients and compares what the solution and they are at the voxels. As the
// fit does, a second solve corrects what the single precision of the matrix left of the first; few
// voxels a function make that more.
void CheckSolve(const Problem& problem, double tolerance, std::mt19937& random)
{
  const Eigen::MatrixXd collocation = problem.Collocation();
  const GramMatrix gram = problem.Matrix();
  ASSERT_EQ(gram.Size(), problem.Spline.Size());
  for (int trial = 0; trial < 3; ++trial)
  {
    const Eigen::VectorXd wanted = Eigen::VectorXd::NullaryExpr(
      gram.Size(), [&random](Eigen::Index) { return Random(random, -1.0, 1.0); });
    const Eigen::VectorXd b = collocation.transpose() * (collocation * wanted);
    Eigen::VectorXd x = Eigen::VectorXd::Zero(gram.Size());
    for (int pass = 0; pass < 2; ++pass)
    {
      std::vector<double> solution;
      const Eigen::VectorXd residual = b - collocation.transpose() * (collocation * x);
      gram.Solve(ToStd(residual), 1e-7, 300, solution, {});
      x += Eigen::Map<const Eigen::VectorXd>(solution.data(), gram.Size());
    }
    // A wrong or missing entry would leave its share of b.
    const Eigen::VectorXd scale =
      collocation.colwise().norm().transpose().cwiseMax(1e-300).cwiseInverse();
    const Eigen::VectorXd left = collocation.transpose() * (collocation * (x - wanted));
    EXPECT_LT((scale.asDiagonal() * left).norm(), tolerance * (scale.asDiagonal() * b).norm());
    // And the fit is that of a dense solver.
    const Eigen::MatrixXd dense = collocation.transpose() * collocation;
    const Eigen::VectorXd exact = dense.completeOrthogonalDecomposition().solve(b);
    EXPECT_LT((collocation * (x - exact)).norm(), 50.0 * tolerance * (collocation * exact).norm());
    for (Index i = 0; i < gram.Size(); ++i)
    {
      if (collocation.col(i).isZero(0.0))
      {
        EXPECT_EQ(x[i], 0.0) << "function " << i << " has no voxel";
      }
    }
  }
}
}

TEST(GramMatrix, SolvesTheNormalEquationsOfAllVoxels)
{
  const std::vector<std::array<Index, 3>> sizes = { { 13, 13, 13 }, { 9, 20, 12 }, { 2, 21, 17 },
    { 8, 5, 33 } };
  for (unsigned seed = 0; seed < 8; ++seed)
  {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937 random(seed);
    CheckSolve(Problem(sizes[seed % 4], 1.0 + seed % 3, 3, 4, random), 2e-6, random);
  }
}

TEST(GramMatrix, SolvesTheNormalEquationsOfSomeVoxels)
{
  for (unsigned seed = 0; seed < 8; ++seed)
  {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937 random(seed);
    Problem problem({ 14, 11, 16 }, 1.0 + seed % 3, 3, 4, random);
    problem.CountOnlyABlob(random);
    CheckSolve(problem, 2e-5, random);
  }
}

TEST(GramMatrix, CountsVoxelsInBoxes)
{
  std::mt19937 random(4);
  Problem problem({ 7, 5, 6 }, 1.0, 0, 0, random);
  problem.CountOnlyABlob(random);
  for (Index z = 0; z <= 6; ++z)
  {
    for (Index y = 0; y <= 5; ++y)
    {
      for (Index x = 0; x <= 7; ++x)
      {
        int count = 0;
        for (Index i = 0; i < 7 * 5 * 6; ++i)
        {
          const Point at = problem.Voxel(i);
          count += problem.Counted[i] && at[0] < x && at[1] < y && at[2] < z;
        }
        ASSERT_EQ(problem.Mask.Counts[(z * 6 + y) * 8 + x], count);
      }
    }
  }
}

// Several blocks of the preconditioner, and voxels that all functions can tell apart.
TEST(GramMatrix, SolvesLargeSystems)
{
  std::mt19937 random(9);
  const Problem problem({ 33, 33, 33 }, 12.0, 2, 300, random);
  const Index n = problem.Spline.Size();
  ASSERT_GT(n, 4200);
  // Values at the voxels and their adjoint, function by function.
  const auto forEachValue = [&problem](Index f, const auto& visit)
  {
    std::array<SampledFunction, 3> s;
    for (int a = 0; a < 3; ++a)
    {
      s[a] = problem.Grid[a].Sample(problem.Spline.Functions[f][a]);
    }
    for (std::size_t z = 0; z < s[2].second.size(); ++z)
    {
      for (std::size_t y = 0; y < s[1].second.size(); ++y)
      {
        for (std::size_t x = 0; x < s[0].second.size(); ++x)
        {
          visit(((s[2].first + z) * 33 + s[1].first + y) * 33 + s[0].first + x,
            s[0].second[x] * s[1].second[y] * s[2].second[z]);
        }
      }
    }
  };
  const auto multiply = [&](const std::vector<double>& x)
  {
    std::vector<double> values(33 * 33 * 33, 0.0), product(n, 0.0);
    for (Index f = 0; f < n; ++f)
    {
      forEachValue(f, [&](std::size_t i, double b) { values[i] += x[f] * b; });
    }
    for (Index f = 0; f < n; ++f)
    {
      forEachValue(f, [&](std::size_t i, double b) { product[f] += values[i] * b; });
    }
    return product;
  };
  std::vector<double> wanted(n), x;
  std::generate(wanted.begin(), wanted.end(), [&random] { return Random(random, -1.0, 1.0); });
  const std::vector<double> b = multiply(wanted);
  const GramMatrix gram = problem.Matrix();
  gram.Solve(b, 1e-7, 200, x, {});
  const std::vector<double> ax = multiply(x);
  double left = 0.0, all = 0.0;
  for (Index i = 0; i < n; ++i)
  {
    left += (ax[i] - b[i]) * (ax[i] - b[i]);
    all += b[i] * b[i];
  }
  EXPECT_LT(std::sqrt(left), 1e-5 * std::sqrt(all));
}

TEST(GramMatrix, KeepsToToleranceAndIterations)
{
  std::mt19937 random(5);
  const Problem problem({ 20, 20, 20 }, 4.0, 3, 20, random);
  const GramMatrix gram = problem.Matrix();
  std::vector<double> b(gram.Size()), x;
  std::generate(b.begin(), b.end(), [&random] { return Random(random, -1.0, 1.0); });
  EXPECT_EQ(gram.Solve(b, 0.0, 3, x, {}), 3);
  const int rough = gram.Solve(b, 1e-1, 1000, x, {}), fine = gram.Solve(b, 1e-5, 1000, x, {});
  EXPECT_LT(rough, fine);
  EXPECT_LT(fine, 1000);
  const std::vector<double> nothing(gram.Size(), 0.0);
  EXPECT_EQ(gram.Solve(nothing, 1e-6, 10, x, {}), 0);
  EXPECT_EQ(x, nothing);
}

TEST(GramMatrix, SameForAnyThreads)
{
  std::mt19937 random(6);
  Problem problem({ 30, 30, 30 }, 10.0, 2, 200, random);
  for (const bool masked : { false, true })
  {
    if (masked)
    {
      problem.CountOnlyABlob(random);
    }
    std::vector<double> b(problem.Spline.Size()), one, more;
    std::generate(b.begin(), b.end(), [&random] { return Random(random, -1.0, 1.0); });
    problem.Matrix().Solve(b, 1e-5, 20, one, {});
    for (int threads = 2; threads <= 3; ++threads)
    {
      const Execution execution = ThreadedExecution(threads);
      problem.Matrix(execution).Solve(b, 1e-5, 20, more, execution);
      EXPECT_EQ(one, more) << threads << " threads";
    }
  }
}

TEST(GramMatrix, StopsWhenAsked)
{
  std::mt19937 random(7);
  const Problem problem({ 12, 12, 12 }, 2.0, 2, 5, random);
  const GramMatrix gram = problem.Matrix();
  Execution execution;
  int calls = 0;
  execution.Continue = [&calls](double) { return ++calls < 3; };
  std::vector<double> b(gram.Size(), 1.0), x;
  EXPECT_THROW(gram.Solve(b, 0.0, 100, x, execution), Aborted);
  EXPECT_EQ(calls, 3);
}
