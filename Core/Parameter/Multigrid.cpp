// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Multigrid.h"

#include "StencilTransfer.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>
#include <stdexcept>

namespace trivariate
{
namespace
{
// So few unknowns are solved for directly.
constexpr Index FewUnknowns = 500;
// Numbers that are worked on by one thread at a time; sums do not depend on the threads.
constexpr Index ChunkSize = 1 << 16;

// Calls body(i) for i in [0, n), and adds up what it returns.
template <typename Body>
double SumOver(Index n, const Execution& execution, const Body& body)
{
  std::vector<double> sums((n + ChunkSize - 1) / ChunkSize);
  execution.Check(0.0);
  execution.ParallelFor(static_cast<Index>(sums.size()),
    [&](Index first, Index last)
    {
      for (Index chunk = first; chunk < last; ++chunk)
      {
        double sum = 0.0;
        const Index end = std::min(n, (chunk + 1) * ChunkSize);
        for (Index i = chunk * ChunkSize; i < end; ++i)
        {
          sum += body(i);
        }
        sums[chunk] = sum;
      }
    });
  return std::accumulate(sums.begin(), sums.end(), 0.0);
}

template <typename Body>
void ForEach(Index n, const Execution& execution, const Body& body)
{
  execution.Check(0.0);
  execution.ParallelFor((n + ChunkSize - 1) / ChunkSize,
    [&](Index first, Index last)
    {
      for (Index i = first * ChunkSize; i < std::min(n, last * ChunkSize); ++i)
      {
        body(i);
      }
    });
}

Index UnknownsOf(const StencilMatrix& matrix)
{
  Index count = matrix.Planes();
  for (const StencilMatrix::Run& run : matrix.Runs)
  {
    count += run.End - run.Begin;
  }
  return count;
}
}

//------------------------------------------------------------------------------
Multigrid::Multigrid(const StencilMatrix& matrix, const Execution& execution)
  : Finest(matrix)
{
  // Each level is about an eighth of the work of the one before.
  for (double left = 1.0; UnknownsOf(this->LevelMatrix(this->Coarse.size())) > FewUnknowns;
       left *= 0.125)
  {
    this->Coarse.push_back(Coarsen(
      this->LevelMatrix(this->Coarse.size()), execution.Part(1.0 - left, 1.0 - 0.125 * left)));
  }
  for (std::size_t level = 0; level <= this->Coarse.size(); ++level)
  {
    const std::size_t length = this->LevelMatrix(level).Length();
    this->Levels.push_back({ std::vector<float>(length, 0.0F), std::vector<float>(length, 0.0F),
      std::vector<float>(level < this->Coarse.size() ? length : 0, 0.0F) });
  }
  this->FactorCoarsest();
}

//------------------------------------------------------------------------------
void Multigrid::FactorCoarsest()
{
  const StencilMatrix& matrix = this->LevelMatrix(this->Coarse.size());
  const std::vector<std::int32_t> rowOf = matrix.RowOfNodes();
  std::vector<Index> number(matrix.Length(), -1);
  for (Index node = 0; node < matrix.Length(); ++node)
  {
    if (node >= matrix.Nodes() || rowOf[node] != NoUnknown)
    {
      number[node] = static_cast<Index>(this->CoarsestUnknowns.size());
      this->CoarsestUnknowns.push_back(node);
    }
  }
  const StencilRow common = matrix.CommonStencil();
  const Index n = static_cast<Index>(this->CoarsestUnknowns.size());
  Eigen::MatrixXd full = Eigen::MatrixXd::Zero(n, n);
  for (Index node = 0; node < matrix.Nodes(); ++node)
  {
    if (number[node] < 0)
    {
      continue;
    }
    const StencilRow& row = rowOf[node] == CommonRow ? common : matrix.Rows[rowOf[node]];
    for (Index d = 0; d < 27; ++d)
    {
      const Index other =
        node + d % 3 - 1 + matrix.Size[0] * (d / 3 % 3 - 1 + matrix.Size[1] * (d / 9 - 1));
      if (number[other] >= 0)
      {
        full(number[node], number[other]) = row[d];
      }
    }
  }
  for (const StencilMatrix::Link& link : matrix.Links)
  {
    const Index plane = number[matrix.Nodes() + link.Plane];
    full(number[link.Node], plane) = full(plane, number[link.Node]) = link.Value;
  }
  for (Index p = 0; p < matrix.Planes(); ++p)
  {
    const Index plane = number[matrix.Nodes() + p];
    full(plane, plane) = matrix.PlaneDiagonal[p];
  }
  // Coarse nodes whose few fine ones are also those of others may depend on each other.
  full.diagonal() *= 1.0 + 1e-6;
  this->Factor.compute(full);
}

//------------------------------------------------------------------------------
void Multigrid::SolveCoarsest()
{
  Vectors& vectors = this->Levels.back();
  const Index n = static_cast<Index>(this->CoarsestUnknowns.size());
  Eigen::VectorXd b(n);
  for (Index u = 0; u < n; ++u)
  {
    b[u] = vectors.RightHandSide[this->CoarsestUnknowns[u]];
  }
  b = this->Factor.solve(b);
  for (Index u = 0; u < n; ++u)
  {
    vectors.Solution[this->CoarsestUnknowns[u]] = static_cast<float>(b[u]);
  }
}

//------------------------------------------------------------------------------
void Multigrid::Cycle(std::size_t level, const Execution& execution)
{
  if (level == this->Coarse.size())
  {
    this->SolveCoarsest();
    return;
  }
  const StencilMatrix& matrix = this->LevelMatrix(level);
  const StencilMatrix& coarse = this->Coarse[level];
  Vectors& here = this->Levels[level];
  Vectors& below = this->Levels[level + 1];
  float* x = here.Solution.data();
  std::fill(here.Solution.begin(), here.Solution.end(), 0.0F);
  RelaxForward(matrix, here.RightHandSide.data(), x, execution);
  Residual(matrix, here.RightHandSide.data(), x, here.Residual.data(), execution);
  Restrict(matrix, coarse, here.Residual.data(), below.RightHandSide.data(), execution);
  this->Cycle(level + 1, execution);
  ProlongAdd(matrix, coarse, below.Solution.data(), x, execution);
  RelaxBackward(matrix, here.RightHandSide.data(), x, execution);
}

//------------------------------------------------------------------------------
double Multigrid::Precondition(const double* r, double* z, const Execution& execution)
{
  float* from = this->Levels.front().RightHandSide.data();
  const float* to = this->Levels.front().Solution.data();
  const Index n = this->Finest.Length();
  ForEach(n, execution, [=](Index i) { from[i] = static_cast<float>(r[i]); });
  this->Cycle(0, execution);
  return SumOver(n, execution,
    [=](Index i)
    {
      z[i] = to[i];
      return r[i] * z[i];
    });
}

//------------------------------------------------------------------------------
LinearSolve SolveConjugateGradients(const LinearOperator& a, Multigrid& preconditioner,
  const std::vector<double>& b, double tolerance, int most, std::vector<double>& x,
  const Execution& execution)
{
  LinearSolve solve;
  const Index n = static_cast<Index>(b.size());
  const Execution start = execution.Part(0.0, 0.0);
  Eigen::VectorXd r(n), z(n), p(n);
  ForEach(n, start, [&](Index i) { r[i] = z[i] = p[i] = 0.0; });
  a(x.data(), r.data(), start);
  const double size = std::sqrt(SumOver(n, start, [&](Index i) { return b[i] * b[i]; }));
  const double first = std::sqrt(SumOver(n, start,
    [&](Index i)
    {
      r[i] = b[i] - r[i];
      return r[i] * r[i];
    }));
  double before = 1.0, done = 0.0;
  solve.Residual = size > 0.0 ? first / size : 0.0;
  while (!(solve.Residual <= tolerance))
  {
    if (solve.Iterations == most)
    {
      std::ostringstream message;
      message << "The parameterization's linear system is not solved after " << most
              << " iterations: the residual is " << solve.Residual
              << " of the right-hand side. Is a part of the segment thinner than a voxel?";
      throw std::runtime_error(message.str());
    }
    done = std::clamp(std::log(solve.Residual) / std::log(tolerance), done, 1.0);
    const Execution here = execution.Part(done, done);
    const double product = preconditioner.Precondition(r.data(), z.data(), here);
    const double beta = solve.Iterations == 0 ? 0.0 : product / before;
    before = product;
    ForEach(n, here, [&](Index i) { p[i] = z[i] + beta * p[i]; });
    a(p.data(), z.data(), here);
    const double alpha = product / SumOver(n, here, [&](Index i) { return p[i] * z[i]; });
    const double squares = SumOver(n, here,
      [&](Index i)
      {
        x[i] += alpha * p[i];
        r[i] -= alpha * z[i];
        return r[i] * r[i];
      });
    solve.Residual = std::sqrt(squares) / size;
    ++solve.Iterations;
  }
  return solve;
}
}
