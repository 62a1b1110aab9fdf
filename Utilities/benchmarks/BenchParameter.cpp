// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
//
// One parameter of a box that fills its grid, with frames that turn: conjugate gradients with
// multigrid beside Eigen's with the diagonal and with incomplete Cholesky factors, on one thread
// where not said otherwise, to a residual of 1e-6. And a whole parameterization, all that
// SolveVoxelParameter does: trilinear and with polynomials, on two threads and on one.
#include "BenchmarkRun.h"
#include "Parameter/Multigrid.h"
#include "Parameter/ParameterSystem.h"
#include "Parameter/VoxelParameter.h"

#include <Eigen/Sparse>
#include <benchmark/benchmark.h>

#include <map>

using namespace trivariate;

namespace
{
constexpr double Tolerance = 1e-6;

// A box around all voxels; its frames turn by a radian on the way through.
struct FilledBox
{
  explicit FilledBox(Index n)
    : Mask(n * n * n, 1)
    , Voxels{ { n, n, n }, Eigen::Vector3d::Ones(), Mask.data(),
      [n](Index id) -> Eigen::Matrix3d
      {
        const double turn = static_cast<double>(id % n + id / (n * n)) / (2.0 * n);
        return Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ()).toRotationMatrix();
      } }
  {
    std::map<std::array<Index, 3>, Index> numbers;
    const auto pointAt = [&](const std::array<Index, 3>& p)
    {
      const auto [at, fresh] = numbers.emplace(p, static_cast<Index>(this->Surface.Points.size()));
      if (fresh)
      {
        this->Surface.Points.emplace_back(p[0] - 0.4, p[1] - 0.4, p[2] - 0.4);
      }
      return at->second;
    };
    for (int axis = 0; axis < 3; ++axis)
    {
      for (int side = 0; side < 2; ++side)
      {
        for (Index square = 0; square < (n - 1) * (n - 1); ++square)
        {
          const auto corner = [&](Index s, Index t)
          {
            std::array<Index, 3> p;
            p[axis] = side * (n - 1);
            p[(axis + 1) % 3] = square % (n - 1) + s;
            p[(axis + 2) % 3] = square / (n - 1) + t;
            return pointAt(p);
          };
          const Index a = corner(0, 0), b = corner(1, 0), c = corner(1, 1), d = corner(0, 1);
          this->Surface.Triangles.push_back(side ? Triangle{ a, b, c } : Triangle{ a, c, b });
          this->Surface.Triangles.push_back(side ? Triangle{ a, c, d } : Triangle{ a, d, c });
          this->Surface.Planes.insert(this->Surface.Planes.end(), 2, { axis, side });
        }
      }
    }
  }

  std::vector<std::uint8_t> Mask;
  ParameterVoxels Voxels;
  ParameterSurface Surface;
};

struct System
{
  StencilMatrix Matrix;
  std::vector<double> RightHandSide;

  explicit System(Index n)
  {
    const FilledBox box(n);
    ParameterCells cells = BoxOfCells(box.Voxels, box.Surface);
    const PlaneSamples samples = SamplePlanes(cells, box.Surface, 0);
    std::vector<Index> sampled;
    for (const PlaneSample& sample : samples.Samples)
    {
      sampled.push_back(sample.Cell);
    }
    FindCells(box.Voxels, box.Surface, sampled, cells, Execution());
    const TargetField targets = FillTargets(cells, box.Voxels, 0, Execution());
    this->Matrix = AssembleMatrix(cells, samples, targets, 1.0, 1.0, 100.0, Execution());
    this->RightHandSide =
      AssembleRightHandSide(cells, targets, 1.0, this->Matrix.Planes(), Execution());
  }
};

const System& SystemOf(Index n)
{
  static std::map<Index, System> systems;
  return systems.try_emplace(n, n).first->second;
}

// Rows of unknowns only.
Eigen::SparseMatrix<double> Sparse(const StencilMatrix& matrix, std::vector<Index>& unknowns)
{
  const std::vector<std::int32_t> rowOf = matrix.RowOfNodes();
  std::vector<int> number(matrix.Length(), -1);
  for (Index i = 0; i < matrix.Length(); ++i)
  {
    if (i >= matrix.Nodes() || rowOf[i] != NoUnknown)
    {
      number[i] = static_cast<int>(unknowns.size());
      unknowns.push_back(i);
    }
  }
  const StencilRow common = matrix.CommonStencil();
  std::vector<Eigen::Triplet<double>> entries;
  for (Index i = 0; i < matrix.Nodes(); ++i)
  {
    for (Index d = 0; d < 27 && rowOf[i] != NoUnknown; ++d)
    {
      const Index other =
        i + d % 3 - 1 + matrix.Size[0] * (d / 3 % 3 - 1 + matrix.Size[1] * (d / 9 - 1));
      const double value = rowOf[i] == CommonRow ? common[d] : matrix.Rows[rowOf[i]][d];
      if (number[other] >= 0 && value != 0.0)
      {
        entries.emplace_back(number[i], number[other], value);
      }
    }
  }
  for (const StencilMatrix::Link& link : matrix.Links)
  {
    const int plane = number[matrix.Nodes() + link.Plane];
    entries.emplace_back(number[link.Node], plane, link.Value);
    entries.emplace_back(plane, number[link.Node], link.Value);
  }
  for (Index p = 0; p < matrix.Planes(); ++p)
  {
    entries.emplace_back(
      number[matrix.Nodes() + p], number[matrix.Nodes() + p], matrix.PlaneDiagonal[p]);
  }
  const Eigen::Index n = static_cast<Eigen::Index>(unknowns.size());
  Eigen::SparseMatrix<double> sparse(n, n);
  sparse.setFromTriplets(entries.begin(), entries.end());
  return sparse;
}

void SolveMultigrid(benchmark::State& state)
{
  const System& system = SystemOf(state.range(0));
  const Execution execution = OnThreads(static_cast<int>(state.range(1)));
  const PeakMemory memory;
  LinearSolve solve;
  for (auto _ : state)
  {
    Multigrid multigrid(system.Matrix, execution);
    std::vector<double> x(system.Matrix.Length(), 0.0);
    solve = SolveConjugateGradients([&system](const double* from, double* to, const Execution& here)
      { Multiply(system.Matrix, from, to, here); },
      multigrid, system.RightHandSide, Tolerance, 500, x, execution);
  }
  state.counters["iterations"] = solve.Iterations;
  state.counters["megabytes"] = memory.Bytes() * 1e-6;
}

void ParametersOnThreads(benchmark::State& state)
{
  const FilledBox box(state.range(0));
  CompareThreads(state, [&box](int threads)
    { SolveVoxelParameter(box.Voxels, box.Surface, ParameterOptions(), OnThreads(threads)); });
}

template <typename Preconditioner>
void SolveEigen(benchmark::State& state)
{
  const System& system = SystemOf(state.range(0));
  const PeakMemory memory;
  std::vector<Index> unknowns;
  const Eigen::SparseMatrix<double> sparse = Sparse(system.Matrix, unknowns);
  Eigen::VectorXd b(sparse.rows());
  for (Eigen::Index i = 0; i < b.size(); ++i)
  {
    b[i] = system.RightHandSide[unknowns[i]];
  }
  Eigen::ConjugateGradient<Eigen::SparseMatrix<double>, Eigen::Lower | Eigen::Upper, Preconditioner>
    solver;
  solver.setTolerance(Tolerance);
  for (auto _ : state)
  {
    solver.compute(sparse);
    benchmark::DoNotOptimize(solver.solve(b).eval());
  }
  state.counters["iterations"] = static_cast<double>(solver.iterations());
  state.counters["megabytes"] = memory.Bytes() * 1e-6;
}

void Parameterize(benchmark::State& state)
{
  const FilledBox box(state.range(0));
  ParameterOptions options;
  options.Gradient = state.range(1) ? ParameterGradient::Polynomial : ParameterGradient::Trilinear;
  const PeakMemory memory;
  VoxelParameter solved;
  for (auto _ : state)
  {
    solved = SolveVoxelParameter(box.Voxels, box.Surface, options, OnThreads(HardwareThreads()));
  }
  state.counters["iterations"] = solved.Solves[0].Iterations;
  state.counters["megabytes"] = memory.Bytes() * 1e-6;
}
}

BENCHMARK(SolveMultigrid)
  ->ArgNames({ "voxels", "threads" })
  ->ArgsProduct({ { 64, 128, 256 }, { 1, 2 } })
  ->Unit(benchmark::kMillisecond)
  ->MeasureProcessCPUTime()
  ->UseRealTime();
BENCHMARK(ParametersOnThreads)
  ->ArgName("voxels")
  ->Arg(128)
  ->Unit(benchmark::kMillisecond)
  ->Iterations(5);
BENCHMARK_TEMPLATE(SolveEigen, Eigen::DiagonalPreconditioner<double>)
  ->ArgName("voxels")
  ->Arg(64)
  ->Arg(128)
  ->Unit(benchmark::kMillisecond);
BENCHMARK_TEMPLATE(SolveEigen, Eigen::IncompleteCholesky<double>)
  ->ArgName("voxels")
  ->Arg(64)
  ->Arg(128)
  ->Unit(benchmark::kMillisecond);
BENCHMARK(Parameterize)
  ->ArgNames({ "voxels", "polynomial" })
  ->ArgsProduct({ { 64, 128 }, { 0, 1 } })
  ->Args({ 256, 0 })
  ->Unit(benchmark::kMillisecond)
  ->MeasureProcessCPUTime()
  ->UseRealTime();
