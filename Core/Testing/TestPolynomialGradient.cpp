// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Parameter/PolynomialGradient.h"
#include "ParameterShapes.h"

#include <gtest/gtest.h>

using namespace trivariate;

namespace
{
ParameterCells CellsOf(const ParameterShape& shape, const Eigen::Vector3d& spacing)
{
  const std::vector<std::uint8_t> mask = MaskOf(shape);
  ParameterVoxels voxels = VoxelsOf(shape, mask);
  voxels.Spacing = spacing;
  ParameterSurface surface = SurfaceOf(shape, 10);
  for (Eigen::Vector3d& point : surface.Points)
  {
    point = point.cwiseProduct(spacing);
  }
  ParameterCells cells = BoxOfCells(voxels, surface);
  FindCells(voxels, surface, {}, cells, Execution());
  return cells;
}

std::vector<double> ValuesOf(
  const ParameterCells& cells, const std::function<double(const Eigen::Vector3d&)>& f)
{
  std::vector<double> values;
  for (Index node = 0; node < cells.Nodes(); ++node)
  {
    values.push_back(f(Eigen::Vector3d(double(node % cells.Size[0]),
      double(node / cells.Size[0] % cells.Size[1]), double(node / cells.Size[0] / cells.Size[1]))
                         .cwiseProduct(cells.Spacing)));
  }
  return values;
}

// Whether the 2-ring of a node is known.
bool IsWhole(const ParameterCells& cells, Index node)
{
  for (int k = -2; k <= 2; ++k)
  {
    for (int j = -2; j <= 2; ++j)
    {
      for (int i = -2; i <= 2; ++i)
      {
        if (cells.Known[node + i + cells.Size[0] * (j + cells.Size[1] * k)] == 0)
        {
          return false;
        }
      }
    }
  }
  return true;
}
}

TEST(PolynomialGradient, IsExactForCubicsInsideAndLinearsEverywhere)
{
  const ParameterCells cells = CellsOf(SlantedBox(22), { 0.5, 1.0, 1.5 });
  const PolynomialGradient gradient(cells, Execution());
  const std::vector<double> linear =
    ValuesOf(cells, [](const Eigen::Vector3d& x) { return 1.0 + 2.0 * x[0] - x[1] + 0.5 * x[2]; });
  const std::vector<double> cubic = ValuesOf(cells, [](const Eigen::Vector3d& x)
    { return 0.1 * x[0] * x[1] * x[2] + 0.02 * x[0] * x[0] * x[0] - 0.03 * x[2] * x[1] * x[1]; });
  Index whole = 0, cut = 0;
  for (Index node = 0; node < cells.Nodes(); ++node)
  {
    if (cells.Known[node] != 2)
    {
      continue;
    }
    EXPECT_LT((gradient.At(node, linear.data()) - Eigen::Vector3d(2.0, -1.0, 0.5)).norm(), 1e-10);
    if (!IsWhole(cells, node))
    {
      ++cut;
      continue;
    }
    ++whole;
    const Eigen::Vector3d x = Eigen::Vector3d(double(node % cells.Size[0]),
      double(node / cells.Size[0] % cells.Size[1]), double(node / cells.Size[0] / cells.Size[1]))
                                .cwiseProduct(cells.Spacing);
    const Eigen::Vector3d expected(0.1 * x[1] * x[2] + 0.06 * x[0] * x[0],
      0.1 * x[0] * x[2] - 0.06 * x[2] * x[1], 0.1 * x[0] * x[1] - 0.03 * x[1] * x[1]);
    EXPECT_LT((gradient.At(node, cubic.data()) - expected).norm(), 1e-9);
  }
  EXPECT_GT(whole, 500);
  EXPECT_GT(cut, 500);
}

// Why its energy needs help: it does not see odd-even waves. Trilinear cells do.
TEST(PolynomialGradient, VanishesOnCheckerboards)
{
  const ParameterCells cells = CellsOf(SlantedBox(22), Eigen::Vector3d::Ones());
  const PolynomialGradient gradient(cells, Execution());
  for (int kind = 1; kind < 8; ++kind)
  {
    const std::vector<double> board = ValuesOf(cells,
      [kind](const Eigen::Vector3d& x)
      {
        const Index sum = (kind & 1 ? Index(x[0]) : 0) + (kind & 2 ? Index(x[1]) : 0) +
                          (kind & 4 ? Index(x[2]) : 0);
        return sum % 2 == 0 ? 1.0 : -1.0;
      });
    for (Index node = 0; node < cells.Nodes(); ++node)
    {
      if (cells.Known[node] == 2 && IsWhole(cells, node))
      {
        EXPECT_LT(gradient.At(node, board.data()).norm(), 1e-12);
      }
    }
    PlaneSamples none;
    none.Coordinates = { 0 };
    const StencilMatrix trilinear = AssembleMatrix(cells, none,
      TargetField(cells.Nodes(), Eigen::Vector3d::UnitX()), 1.0, 1.0, 1.0, Execution());
    std::vector<double> product(board.size(), 0.0);
    Multiply(trilinear, board.data(), product.data(), Execution());
    double energy = 0.0, cellsThere = 0.0;
    for (Index node = 0; node < cells.Nodes(); ++node)
    {
      energy += board[node] * product[node];
      cellsThere += cells.Cut[node] == WholeCell ? 1.0 : 0.0;
    }
    EXPECT_GT(energy, cellsThere);
  }
}

TEST(PolynomialGradient, HasASymmetricEnergy)
{
  const ParameterCells cells = CellsOf(SlantedBox(16), { 1.0, 0.8, 1.2 });
  const PolynomialGradient gradient(cells, Execution());
  const TargetField targets(cells.Nodes(), Eigen::Vector3d(1.0, 2.0, -1.0));
  const auto wave = [&](double a, double b)
  {
    return ValuesOf(cells, [a, b](const Eigen::Vector3d& x)
      { return std::sin(a * x[0] + b * x[1]) + std::cos(b * x[2] + x[0]); });
  };
  const std::vector<double> x = wave(0.7, 1.9), y = wave(2.1, 0.3);
  std::vector<double> ax(x.size(), 0.0), ay(x.size(), 0.0), b(x.size(), 0.0);
  gradient.AddEnergy(targets, 0.3, x.data(), ax.data(), Execution());
  gradient.AddEnergy(targets, 0.3, y.data(), ay.data(), Execution());
  gradient.AddRightHandSide(targets, 0.3, b, Execution());
  double xay = 0.0, yax = 0.0, xax = 0.0, xb = 0.0, energy = 0.0, work = 0.0;
  const Eigen::Vector3d f = targets[0], along = f.normalized();
  for (Index node = 0; node < cells.Nodes(); ++node)
  {
    xay += x[node] * ay[node];
    yax += y[node] * ax[node];
    xax += x[node] * ax[node];
    xb += x[node] * b[node];
    if (cells.Known[node] == 2)
    {
      const Eigen::Vector3d g = gradient.At(node, x.data());
      const Eigen::Vector3d d = g - 0.7 * along.dot(g) * along;
      energy += cells.Spacing.prod() * g.dot(d);
      work += cells.Spacing.prod() * d.dot(f);
    }
  }
  EXPECT_NEAR(xay, yax, 1e-9 * std::abs(xax));
  EXPECT_NEAR(xax, energy, 1e-9 * energy);
  EXPECT_NEAR(xb, work, 1e-9 * energy);
}
