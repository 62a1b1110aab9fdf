// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Evaluation on one thread: adaptive fits of a 128^3 volume beside the uniform tensor-product fit
// with as many control points. Items are cells for Cells and Extract, otherwise points.
#include "BenchmarkSplines.h"
#include "TSpline/BezierExtraction.h"
#include "TSpline/BezierMesh.h"
#include "TSpline/Evaluator.h"
#include "TSpline/InverseMap.h"

#include <benchmark/benchmark.h>

#include <cmath>
#include <random>

using namespace trivariate;

namespace
{
constexpr Index VolumeSize = 128;

const TSpline& SplineOf(const benchmark::State& state)
{
  return OrbitalFit(VolumeSize, static_cast<Refinement>(state.range(0)), state.range(1));
}

void Report(benchmark::State& state, const BezierMesh& mesh, const TSpline& spline, Index items)
{
  state.SetItemsProcessed(state.iterations() * items);
  state.counters["control_points"] = static_cast<double>(spline.Size());
  state.counters["cells"] = static_cast<double>(mesh.Size());
}

std::vector<double> RandomPoints(const TSpline& spline, Index n)
{
  std::mt19937 random(1);
  std::vector<double> points;
  for (Index i = 0; i < 3 * n; ++i)
  {
    const KnotLine& line = spline.KnotLines[i % 3];
    points.push_back(std::uniform_real_distribution<double>(line.front(), line.back())(random));
  }
  return points;
}

// The third argument is the order of the derivatives.
EvaluatorOutput Output(const benchmark::State& state, std::vector<double>& memory, Index n)
{
  memory.assign(10 * n, 0.0);
  EvaluatorOutput output;
  output.Values = memory.data();
  output.Gradients = state.range(2) > 0 ? memory.data() + n : nullptr;
  output.Hessians = state.range(2) > 1 ? memory.data() + 4 * n : nullptr;
  return output;
}

void Cells(benchmark::State& state)
{
  const TSpline& spline = SplineOf(state);
  Index cells = 0;
  for (auto _ : state)
  {
    const BezierMesh mesh(spline);
    cells = mesh.Size();
  }
  Report(state, BezierMesh(spline), spline, cells);
}

void Extract(benchmark::State& state)
{
  const TSpline& spline = SplineOf(state);
  const BezierMesh mesh(spline);
  for (auto _ : state)
  {
    benchmark::DoNotOptimize(ExtractBezier(spline, mesh, { 3 }).data());
  }
  Report(state, mesh, spline, mesh.Size());
}

void Scattered(benchmark::State& state)
{
  const TSpline& spline = SplineOf(state);
  const BezierMesh mesh(spline);
  const Evaluator evaluator(spline, mesh, { 3 });
  const Index n = 1000000;
  const std::vector<double> points = RandomPoints(spline, n);
  std::vector<double> memory;
  const EvaluatorOutput output = Output(state, memory, n);
  for (auto _ : state)
  {
    evaluator.Evaluate(n, points.data(), output);
  }
  Report(state, mesh, spline, n);
}

void Lattice(benchmark::State& state)
{
  const TSpline& spline = SplineOf(state);
  const BezierMesh mesh(spline);
  const Evaluator evaluator(spline, mesh, { 3 });
  std::array<std::vector<double>, 3> lattice;
  for (int a = 0; a < 3; ++a)
  {
    lattice[a] = MakeUniformKnotLine(spline.KnotLines[a].front(), spline.KnotLines[a].back(), 255);
  }
  const Index n = 256 * 256 * 256;
  std::vector<double> memory;
  const EvaluatorOutput output = Output(state, memory, n);
  for (auto _ : state)
  {
    evaluator.EvaluateLattice(lattice, output);
  }
  Report(state, mesh, spline, n);
}

// The yardstick of the lattice: as many numbers written to memory.
void Fill(benchmark::State& state)
{
  const Index n = 256 * 256 * 256;
  std::vector<double> memory(n);
  double x = 0.0;
  for (auto _ : state)
  {
    std::fill(memory.begin(), memory.end(), ++x);
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * n);
}

// The geometry bent and twisted, so that the map has no closed form.
void Inverse(benchmark::State& state)
{
  TSpline spline = SplineOf(state);
  for (Index i = 0; i < spline.Size(); ++i)
  {
    double* p = spline.ControlPoint(i);
    const double x = p[0] - 64.0, y = p[1] - 64.0, angle = 0.01 * p[2];
    p[0] = x * std::cos(angle) - y * std::sin(angle);
    p[1] = x * std::sin(angle) + y * std::cos(angle);
    p[2] += 0.1 * x;
  }
  const BezierMesh mesh(spline);
  const Evaluator geometry(spline, mesh, { 0, 1, 2 });
  const InverseMap inverse(spline, mesh);
  const Index n = 100000;
  std::vector<double> points = RandomPoints(spline, n), parameters(3 * n);
  std::vector<std::uint8_t> found(n);
  EvaluatorOutput positions;
  positions.Values = parameters.data();
  geometry.Evaluate(n, points.data(), positions);
  points = parameters;
  for (auto _ : state)
  {
    inverse.Find(n, points.data(), parameters.data(), found.data());
  }
  Report(state, mesh, spline, n);
}

void Splines(benchmark::internal::Benchmark* benchmark, const std::vector<std::int64_t>& orders)
{
  benchmark->ArgNames({ "rule", "control_points", "derivatives" })->Unit(benchmark::kMillisecond);
  for (const std::int64_t controlPoints : { 5000, 50000 })
  {
    for (const Refinement rule :
      { Refinement::Uniform, Refinement::Compact, Refinement::AnalysisSuitable })
    {
      for (const std::int64_t order : orders)
      {
        benchmark->Args({ static_cast<std::int64_t>(rule), controlPoints, order });
      }
    }
  }
}

void WithoutDerivatives(benchmark::internal::Benchmark* benchmark)
{
  Splines(benchmark, { 0 });
}

void WithDerivatives(benchmark::internal::Benchmark* benchmark)
{
  Splines(benchmark, { 0, 1, 2 });
}
}

BENCHMARK(Cells)->Apply(WithoutDerivatives);
BENCHMARK(Extract)->Apply(WithoutDerivatives);
BENCHMARK(Scattered)->Apply(WithDerivatives);
BENCHMARK(Lattice)->Apply(WithDerivatives);
BENCHMARK(Fill)->Unit(benchmark::kMillisecond);
BENCHMARK(Inverse)->Apply(WithoutDerivatives);
