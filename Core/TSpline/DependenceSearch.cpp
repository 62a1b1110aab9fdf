// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "LinearIndependence.h"

#include "DependenceRows.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace trivariate
{
namespace
{
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Pivots that are smaller, relative to the largest, are zeros that rounding has blurred.
constexpr double PivotThreshold = 1e-9;
constexpr int LargestBlock = 512;
// Dense linear algebra takes over when few functions are left of which few can be closed in a
// round, or when several rounds close none.
constexpr std::size_t Few = 4000;
constexpr double SlowShare = 0.05;
constexpr int FruitlessRounds = 4;
constexpr unsigned SteadyRounds = 12; // of points that must not change the result before it counts

Eigen::FullPivLU<MatrixXd> Factorise(const MatrixXd& matrix)
{
  Eigen::FullPivLU<MatrixXd> lu(matrix);
  lu.setThreshold(PivotThreshold);
  return lu;
}

// The coefficients that rows of a block have within the block. `place` is scratch of minus ones.
MatrixXd BlockMatrix(
  const DependenceRows& rows, const std::vector<int>& block, std::vector<int>& place)
{
  const auto n = static_cast<int>(block.size());
  for (int k = 0; k < n; ++k)
  {
    place[block[k]] = k;
  }
  MatrixXd matrix = MatrixXd::Zero(n, n);
  for (int k = 0; k < n; ++k)
  {
    for (const DependenceEntry& entry : rows[block[k]])
    {
      if (place[entry.Column] >= 0)
      {
        matrix(k, place[entry.Column]) = entry.Value;
      }
    }
  }
  for (const int row : block)
  {
    place[row] = -1;
  }
  return matrix;
}

// The rows whose unknowns these equations do not force to zero.
std::vector<int> OpenRows(const DependenceRows& rows)
{
  std::vector<char> closed(rows.size(), false);
  std::vector<int> place(rows.size(), -1);
  for (const std::vector<int>& block : SolvableBlocks(rows))
  {
    for (const int row : block)
    {
      place[row] = 0;
    }
    const bool outsideIsZero = std::all_of(block.begin(), block.end(),
      [&](int row)
      {
        return std::all_of(rows[row].begin(), rows[row].end(),
          [&](const DependenceEntry& entry)
          { return closed[entry.Column] || place[entry.Column] == 0; });
      });
    for (const int row : block)
    {
      place[row] = -1;
    }
    const bool forced =
      outsideIsZero && block.size() <= LargestBlock &&
      (block.size() == 1 || Factorise(BlockMatrix(rows, block, place)).isInvertible());
    for (const int row : block)
    {
      closed[row] = forced;
    }
  }
  std::vector<int> open;
  for (int row = 0; row < static_cast<int>(rows.size()); ++row)
  {
    if (!closed[row])
    {
      open.push_back(row);
    }
  }
  return open;
}

// All solutions of the equations as X times parameters, which must fulfil Constraints * p = 0.
struct Solutions
{
  MatrixXd X;
  MatrixXd Constraints;
};

Solutions SolveByBlocks(const DependenceRows& rows)
{
  const auto blocks = SolvableBlocks(rows);
  std::vector<int> place(rows.size(), -1);
  std::vector<Eigen::FullPivLU<MatrixXd>> factors;
  Index parameters = 0, constraints = 0;
  for (const std::vector<int>& block : blocks)
  {
    factors.push_back(Factorise(BlockMatrix(rows, block, place)));
    if (!factors.back().isInvertible())
    {
      parameters += factors.back().dimensionOfKernel();
      constraints += factors.back().rows();
    }
  }
  Solutions result{ MatrixXd::Zero(rows.size(), parameters),
    MatrixXd::Zero(constraints, parameters) };
  Index parameter = 0, constraint = 0;
  for (std::size_t b = 0; b < blocks.size(); ++b)
  {
    const std::vector<int>& block = blocks[b];
    const auto n = static_cast<Index>(block.size());
    // What is in the block still counts as zero here, so this is what comes from outside.
    MatrixXd right = MatrixXd::Zero(n, parameters);
    for (Index k = 0; k < n; ++k)
    {
      for (const DependenceEntry& entry : rows[block[k]])
      {
        right.row(k) -= entry.Value * result.X.row(entry.Column);
      }
    }
    MatrixXd solution = factors[b].solve(right);
    if (!factors[b].isInvertible())
    {
      // Only combinations of the parameters for which the block has a solution count.
      result.Constraints.middleRows(constraint, n) =
        BlockMatrix(rows, block, place) * solution - right;
      constraint += n;
      const MatrixXd kernel = factors[b].kernel();
      solution.middleCols(parameter, kernel.cols()) += kernel;
      parameter += kernel.cols();
    }
    for (Index k = 0; k < n; ++k)
    {
      result.X.row(block[k]) = solution.row(k);
    }
  }
  return result;
}

// Kernel of a matrix whose columns have the unit of one, as columns.
MatrixXd KernelOf(const MatrixXd& matrix)
{
  Eigen::ColPivHouseholderQR<MatrixXd> qr(matrix);
  // Eigen's threshold is relative to the largest pivot, which may be rounding itself.
  qr.setThreshold(PivotThreshold / std::max(qr.maxPivot(), PivotThreshold));
  const Index rank = qr.rank(), n = matrix.cols();
  MatrixXd kernel = MatrixXd::Identity(n, n).rightCols(n - rank);
  const MatrixXd r = qr.matrixR().topRows(rank);
  kernel.topRows(rank) =
    -r.leftCols(rank).triangularView<Eigen::Upper>().solve(r.rightCols(n - rank));
  return qr.colsPermutation() * kernel;
}

// Left sides of the equations for each column of x.
MatrixXd Apply(const DependenceRows& rows, const MatrixXd& x)
{
  MatrixXd result = MatrixXd::Zero(x.rows(), x.cols());
  for (std::size_t i = 0; i < rows.size(); ++i)
  {
    for (const DependenceEntry& entry : rows[i])
    {
      result.row(i) += entry.Value * x.row(entry.Column);
    }
  }
  return result;
}

// Appends rows to a matrix and folds it to square form, which keeps the kernel.
void Append(MatrixXd& matrix, const MatrixXd& rows)
{
  MatrixXd both(matrix.rows() + rows.rows(), rows.cols());
  both << matrix, rows;
  if (both.rows() > both.cols())
  {
    both = MatrixXd(Eigen::HouseholderQR<MatrixXd>(both)
                      .matrixQR()
                      .topRows(both.cols())
                      .triangularView<Eigen::Upper>());
  }
  matrix = both;
}

// Gauss-Jordan on columns with complete pivoting: each column gets a one in a row of its own, and
// dependences in different places fall apart.
void Reduce(MatrixXd& columns)
{
  std::vector<char> done(columns.cols(), false);
  for (Index step = 0; step < columns.cols(); ++step)
  {
    double largest = 0.0;
    Index row = 0, column = 0;
    for (Index c = 0; c < columns.cols(); ++c)
    {
      Index r = 0;
      const double size = done[c] ? 0.0 : columns.col(c).cwiseAbs().maxCoeff(&r);
      if (size > largest)
      {
        largest = size;
        row = r;
        column = c;
      }
    }
    done[column] = true;
    columns.col(column) /= columns(row, column);
    for (Index c = 0; c < columns.cols(); ++c)
    {
      if (c != column)
      {
        columns.col(c) -= columns(row, c) * columns.col(column);
      }
    }
  }
}

// Dependences between these functions, as columns: what solves the equations and vanishes at enough
// points.
MatrixXd DependencesAmong(
  const TSpline& spline, const std::vector<Index>& functions, const Execution& execution)
{
  Solutions solutions =
    SolveByBlocks(MakeDependenceRows(spline, functions, CentralRound, execution));
  if (solutions.X.cols() == 0)
  {
    return solutions.X;
  }
  for (Index c = 0; c < solutions.X.cols(); ++c)
  {
    const double scale = solutions.X.col(c).cwiseAbs().maxCoeff();
    solutions.X.col(c) /= scale;
    solutions.Constraints.col(c) /= scale;
  }
  MatrixXd kernel = KernelOf(solutions.Constraints);
  for (unsigned check = 0, steady = 0; steady < SteadyRounds && kernel.cols() > 0; ++check)
  {
    execution.Check(0.9);
    Append(solutions.Constraints,
      Apply(MakeValueRows(spline, functions, check, execution), solutions.X));
    const Index before = kernel.cols();
    kernel = KernelOf(solutions.Constraints);
    steady = kernel.cols() == before ? steady + 1 : 0;
  }
  MatrixXd columns = solutions.X * kernel;
  Reduce(columns);
  return columns;
}
}

//------------------------------------------------------------------------------
std::vector<LinearDependence> FindLinearDependences(
  const TSpline& spline, const Execution& execution)
{
  std::vector<Index> open(spline.Functions.size());
  std::iota(open.begin(), open.end(), Index(0));
  unsigned round = FirstSearchRound;
  bool goOn = !open.empty();
  for (int fruitless = 0; goOn; ++round)
  {
    execution.Check(0.8 * (1.0 - double(open.size()) / double(spline.Size())));
    std::vector<Index> left;
    for (const int row : OpenRows(MakeDependenceRows(spline, open, round, execution)))
    {
      left.push_back(open[row]);
    }
    const std::size_t closed = open.size() - left.size();
    const bool slow = left.size() < Few && double(closed) < SlowShare * double(open.size());
    fruitless = closed > 0 ? 0 : fruitless + 1;
    open = std::move(left);
    goOn = !open.empty() && !slow && fruitless < FruitlessRounds;
  }
  std::vector<LinearDependence> dependences;
  if (open.empty())
  {
    return dependences;
  }
  const MatrixXd columns = DependencesAmong(spline, open, execution);
  for (Index c = 0; c < columns.cols(); ++c)
  {
    const double scale = columns.col(c).cwiseAbs().maxCoeff();
    LinearDependence dependence;
    for (Index k = 0; k < columns.rows(); ++k)
    {
      if (std::abs(columns(k, c)) > PivotThreshold * scale)
      {
        dependence.Functions.push_back(open[k]);
        dependence.Coefficients.push_back(columns(k, c) / scale);
      }
    }
    dependences.push_back(std::move(dependence));
  }
  return dependences;
}
}
