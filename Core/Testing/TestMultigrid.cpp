// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Parameter/Multigrid.h"
#include "Parameter/StencilTransfer.h"
#include "ThreadedExecution.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <random>

using namespace trivariate;

namespace
{
// A matrix of trilinear cells on a ball of nodes with random weights near its boundary, so that
// some rows are common and some not; with two planes linked to nodes on both sides.
StencilMatrix BallMatrix(Index n)
{
  StencilMatrix matrix;
  matrix.Size = { n, n, n };
  const double weights[8] = { 8.0 / 3.0, 0.0, 0.0, -1.0 / 6.0, 0.0, -1.0 / 6.0, -1.0 / 6.0,
    -1.0 / 12.0 };
  std::copy(weights, weights + 8, matrix.Common.begin());
  std::vector<std::int32_t> rowOf(matrix.Nodes(), NoUnknown);
  std::int32_t rows = 0;
  const auto radiusAt = [n](Index node)
  {
    const double middle = 0.5 * static_cast<double>(n - 1);
    return Eigen::Vector3d(static_cast<double>(node % n) - middle,
      static_cast<double>(node / n % n) - middle, static_cast<double>(node / n / n) - middle)
      .norm();
  };
  const double radius = 0.5 * static_cast<double>(n) - 1.6;
  for (Index node = 0; node < matrix.Nodes(); ++node)
  {
    if (radiusAt(node) < radius)
    {
      rowOf[node] = radiusAt(node) < radius - 2.0 ? CommonRow : rows++;
    }
  }
  matrix.SetRows(rowOf);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(0.1, 1.0);
  // Between two nodes, at least one of which has a row of its own.
  const auto neighbour = [n](Index node, int d)
  { return node + d % 3 - 1 + n * (d / 3 % 3 - 1 + n * (d / 9 - 1)); };
  const StencilRow common = matrix.CommonStencil();
  for (Index node = 0; node < matrix.Nodes(); ++node)
  {
    for (int d = 0; d < 27 && rowOf[node] >= 0; ++d)
    {
      const Index other = neighbour(node, d);
      if (d == 13 || rowOf[other] == NoUnknown)
      {
        continue;
      }
      StencilRow& row = matrix.Rows[rowOf[node]];
      if (rowOf[other] == CommonRow)
      {
        row[d] = common[d];
        row[13] -= common[d];
      }
      else if (other > node)
      {
        const double weight = -uniform(random);
        row[d] = weight;
        row[13] -= weight;
        matrix.Rows[rowOf[other]][26 - d] = weight;
        matrix.Rows[rowOf[other]][13] -= weight;
      }
    }
  }
  matrix.PlaneDiagonal = { 0.0, 0.0 };
  std::vector<StencilMatrix::Link> links;
  for (Index node = 0; node < matrix.Nodes(); ++node)
  {
    if (rowOf[node] >= 0)
    {
      const std::int32_t plane = node % n < n / 2 ? 0 : 1;
      const double weight = 3.0 * uniform(random);
      links.push_back({ node, plane, -0.5 * weight });
      links.push_back({ node, plane, -0.5 * weight });
      matrix.Rows[rowOf[node]][13] += weight;
      matrix.PlaneDiagonal[plane] += weight + (plane == 0 ? 0.1 : 0.0);
    }
  }
  matrix.SetLinks(links);
  return matrix;
}

std::vector<double> RandomVector(const StencilMatrix& matrix, unsigned seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::vector<double> x(matrix.Length(), 0.0);
  const std::vector<std::int32_t> rowOf = matrix.RowOfNodes();
  for (Index i = 0; i < matrix.Length(); ++i)
  {
    x[i] = i >= matrix.Nodes() || rowOf[i] != NoUnknown ? uniform(random) : 0.0;
  }
  return x;
}

double Dot(const std::vector<double>& a, const std::vector<double>& b)
{
  return Eigen::Map<const Eigen::VectorXd>(a.data(), static_cast<Index>(a.size()))
    .dot(Eigen::Map<const Eigen::VectorXd>(b.data(), static_cast<Index>(b.size())));
}

std::vector<double> Times(const StencilMatrix& matrix, const std::vector<double>& x)
{
  std::vector<double> y(x.size(), 0.0);
  Multiply(matrix, x.data(), y.data(), Execution());
  return y;
}

// P y.
std::vector<double> Prolonged(
  const StencilMatrix& fine, const StencilMatrix& coarse, const std::vector<double>& y)
{
  const std::vector<float> from(y.begin(), y.end());
  std::vector<float> to(fine.Length(), 0.0F);
  ProlongAdd(fine, coarse, from.data(), to.data(), Execution());
  return { to.begin(), to.end() };
}
}

TEST(Multigrid, MultipliesByRows)
{
  const StencilMatrix matrix = BallMatrix(14);
  const std::vector<double> x = RandomVector(matrix, 1), y = Times(matrix, x);
  const std::vector<std::int32_t> rowOf = matrix.RowOfNodes();
  EXPECT_GT(std::count(rowOf.begin(), rowOf.end(), CommonRow), 100);
  std::vector<double> expected(x.size(), 0.0);
  const StencilRow common = matrix.CommonStencil();
  for (Index node = 0; node < matrix.Nodes(); ++node)
  {
    for (Index d = 0; d < 27 && rowOf[node] != NoUnknown; ++d)
    {
      const StencilRow& row = rowOf[node] == CommonRow ? common : matrix.Rows[rowOf[node]];
      expected[node] += row[d] * x[node + d % 3 - 1 + 14 * (d / 3 % 3 - 1 + 14 * (d / 9 - 1))];
    }
  }
  for (const StencilMatrix::Link& link : matrix.Links)
  {
    expected[link.Node] += link.Value * x[matrix.Nodes() + link.Plane];
    expected[matrix.Nodes() + link.Plane] += link.Value * x[link.Node];
  }
  for (Index p = 0; p < 2; ++p)
  {
    expected[matrix.Nodes() + p] += matrix.PlaneDiagonal[p] * x[matrix.Nodes() + p];
  }
  for (std::size_t i = 0; i < x.size(); ++i)
  {
    EXPECT_NEAR(y[i], expected[i], 1e-12) << i;
  }
}

TEST(Multigrid, CoarsensByGalerkin)
{
  const StencilMatrix fine = BallMatrix(19), coarse = Coarsen(fine, Execution());
  EXPECT_FALSE(coarse.Rows.empty());
  for (unsigned seed = 0; seed < 3; ++seed)
  {
    const std::vector<double> x = RandomVector(coarse, seed), y = RandomVector(coarse, seed + 9);
    // x^T (P^T A P) y = (P x)^T A (P y), and restriction is the transposed prolongation.
    const std::vector<double> px = Prolonged(fine, coarse, x), py = Prolonged(fine, coarse, y);
    const std::vector<double> apy = Times(fine, py);
    EXPECT_NEAR(Dot(x, Times(coarse, y)), Dot(px, apy), 1e-5 * std::sqrt(Dot(apy, apy)));
    const std::vector<float> from(apy.begin(), apy.end());
    std::vector<float> to(coarse.Length(), 0.0F);
    Restrict(fine, coarse, from.data(), to.data(), Execution());
    EXPECT_NEAR(Dot(x, { to.begin(), to.end() }), Dot(px, apy), 1e-5 * std::sqrt(Dot(apy, apy)));
  }
  // Constants stay constants.
  std::vector<double> ones = RandomVector(coarse, 1);
  for (double& value : ones)
  {
    value = value == 0.0 ? 0.0 : 1.0;
  }
  const std::vector<double> prolonged = Prolonged(fine, coarse, ones);
  const std::vector<double> unknowns = RandomVector(fine, 1);
  for (Index i = 0; i < fine.Length(); ++i)
  {
    EXPECT_EQ(prolonged[i], unknowns[i] == 0.0 ? 0.0 : 1.0);
  }
}

TEST(Multigrid, PreconditionsSymmetrically)
{
  const StencilMatrix matrix = BallMatrix(25);
  Multigrid multigrid(matrix, Execution());
  EXPECT_GT(multigrid.NumberOfLevels(), 2);
  const std::vector<double> x = RandomVector(matrix, 1), y = RandomVector(matrix, 2);
  std::vector<double> mx(x.size(), 0.0), my(x.size(), 0.0);
  multigrid.Precondition(x.data(), mx.data(), Execution());
  multigrid.Precondition(y.data(), my.data(), Execution());
  EXPECT_NEAR(Dot(x, my), Dot(y, mx), 1e-5 * std::sqrt(Dot(x, mx) * Dot(y, my)));
  EXPECT_GT(Dot(x, mx), 0.0);
}

TEST(Multigrid, Solves)
{
  const StencilMatrix matrix = BallMatrix(40);
  const std::vector<double> wanted = RandomVector(matrix, 3), b = Times(matrix, wanted);
  const auto solve = [&](const Execution& execution, std::vector<double>& x)
  {
    Multigrid multigrid(matrix, execution);
    x.assign(matrix.Length(), 0.0);
    return SolveConjugateGradients([&matrix](const double* from, double* to, const Execution& here)
      { Multiply(matrix, from, to, here); },
      multigrid, b, 1e-10, 60, x, execution);
  };
  std::vector<double> x, again;
  const LinearSolve result = solve(Execution(), x);
  EXPECT_LE(result.Iterations, 20);
  EXPECT_LT(result.Residual, 1e-10);
  for (std::size_t i = 0; i < x.size(); ++i)
  {
    EXPECT_NEAR(x[i], wanted[i], 1e-6);
  }
  solve(ThreadedExecution(3), again);
  EXPECT_EQ(x, again);
}

TEST(Multigrid, SaysWhenItDoesNotConverge)
{
  const StencilMatrix matrix = BallMatrix(30);
  Multigrid multigrid(matrix, Execution());
  const std::vector<double> b = RandomVector(matrix, 3);
  std::vector<double> x(matrix.Length(), 0.0);
  EXPECT_THROW(
    SolveConjugateGradients([&matrix](const double* from, double* to, const Execution& here)
      { Multiply(matrix, from, to, here); },
      multigrid, b, 1e-12, 2, x, Execution()),
    std::runtime_error);
}
