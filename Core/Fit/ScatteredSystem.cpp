// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ScatteredSystem.h"

#include "TSpline/BezierExtraction.h"
#include "TSpline/BezierKernels.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace trivariate
{
namespace
{
// Cells with fewer samples than this get a little fairness, at most as much as this.
constexpr double EnoughSamples = 8.0;
constexpr double FairnessOfEmpty = 1e-6;
}

//------------------------------------------------------------------------------
ScatteredSystem::ScatteredSystem(const ScatteredSamples& samples, int firstComponent,
  const BlockSpline& layout, const Execution& execution)
  : Samples(samples)
  , FirstComponent(firstComponent)
  , Layout(layout)
  , Run(execution)
  , Residuals(samples.Components)
{
  this->CheckSamples();
  const Index n = samples.Count();
  for (int c = 0; c < samples.Components; ++c)
  {
    const auto begin = samples.Values.begin() + c * n;
    const auto [low, high] = std::minmax_element(begin, begin + n);
    this->Ranges.push_back(*high > *low ? *high - *low : *low != 0.0 ? std::abs(*low) : 1.0);
    this->Means.push_back(std::accumulate(begin, begin + n, 0.0) / static_cast<double>(n));
  }
}

//------------------------------------------------------------------------------
void ScatteredSystem::CheckSamples() const
{
  const Index n = this->Samples.Count();
  if (n == 0)
  {
    throw std::invalid_argument("There is no sample to fit.");
  }
  for (Index i = 0; i < n; ++i)
  {
    const double* p = &this->Samples.Parameters[3 * i];
    if (!std::isfinite(p[0] + p[1] + p[2]) ||
        this->Layout.Blocks().BlockAt({ p[0], p[1], p[2] }) < 0)
    {
      throw std::invalid_argument("The parameter of sample " + std::to_string(i) + ", (" +
                                  std::to_string(p[0]) + ", " + std::to_string(p[1]) + ", " +
                                  std::to_string(p[2]) + "), is in no block of the domain.");
    }
    for (int c = 0; c < this->Samples.Components; ++c)
    {
      if (!std::isfinite(this->Samples.Values[c * n + i]))
      {
        throw std::invalid_argument("The sample " + std::to_string(i) + " is not a finite number.");
      }
    }
  }
}

//------------------------------------------------------------------------------
void ScatteredSystem::Update(const TSpline& spline)
{
  this->Cells = std::make_unique<BezierMesh>(spline, this->Run);
  this->Shared = this->Layout.Share(spline, this->Shares());
  this->SplitsMade = this->Layout.LinkSplits(spline, Sharing::Places);
  this->SplitsUnknown = this->Layout.LinkSplits(spline, this->Shares());
  const BezierMesh& mesh = *this->Cells;

  // Functions are numbered along a space-filling curve, cells by the first of theirs.
  std::vector<std::int32_t> firstFunction(mesh.Size());
  for (Index cell = 0; cell < mesh.Size(); ++cell)
  {
    const IdRange active = mesh.ActiveFunctions(cell);
    firstFunction[cell] = *std::min_element(active.begin(), active.end());
  }
  this->Order.resize(mesh.Size());
  std::iota(this->Order.begin(), this->Order.end(), Index(0));
  std::stable_sort(this->Order.begin(), this->Order.end(),
    [&firstFunction](Index a, Index b) { return firstFunction[a] < firstFunction[b]; });

  const Index n = this->Samples.Count();
  std::vector<std::int32_t> cellOf(n);
  this->Run.ParallelFor(n,
    [this, &mesh, &cellOf](Index begin, Index end)
    {
      for (Index i = begin; i < end; ++i)
      {
        const double* p = &this->Samples.Parameters[3 * i];
        cellOf[i] = static_cast<std::int32_t>(mesh.FindCell(p[0], p[1], p[2]));
      }
    });
  this->SampleBegin.assign(mesh.Size() + 1, 0);
  for (const std::int32_t cell : cellOf)
  {
    ++this->SampleBegin[cell + 1];
  }
  std::partial_sum(this->SampleBegin.begin(), this->SampleBegin.end(), this->SampleBegin.begin());
  std::vector<Index> next(this->SampleBegin.begin(), this->SampleBegin.end() - 1);
  this->Sorted.resize(n);
  for (Index i = 0; i < n; ++i)
  {
    this->Sorted[next[cellOf[i]]++] = static_cast<std::int32_t>(i);
  }
  this->SetStiffness({});
  this->Run.Check(0.0);
}

//------------------------------------------------------------------------------
void ScatteredSystem::SetStiffness(const std::vector<float>& stiffness)
{
  this->Fairness.resize(this->Cells->Size());
  for (Index cell = 0; cell < this->Cells->Size(); ++cell)
  {
    double weight = 0.0;
    for (Index at = this->SampleBegin[cell]; at < this->SampleBegin[cell + 1]; ++at)
    {
      weight += this->WeightOf(this->Sorted[at]);
    }
    const auto count = static_cast<double>(this->SampleBegin[cell + 1] - this->SampleBegin[cell]);
    const double isShort = std::max(0.0, 1.0 - count / EnoughSamples);
    const double stiff = stiffness.empty() ? 0.0 : stiffness[cell] * std::max(1.0, weight);
    this->Fairness[cell] = static_cast<float>(FairnessOfEmpty * isShort + stiff);
  }
}

//------------------------------------------------------------------------------
void ScatteredSystem::ComputeResiduals(const TSpline& spline)
{
  const int components = this->Samples.Components;
  std::vector<int> wanted(components);
  std::iota(wanted.begin(), wanted.end(), this->FirstComponent);
  const Index n = this->Samples.Count();
  for (std::vector<double>& residuals : this->Residuals)
  {
    residuals.resize(n);
  }
  const BezierMesh& mesh = *this->Cells;
  this->Bezier = ExtractBezier(spline, mesh, wanted, this->Run);
  this->Run.ParallelFor(mesh.Size(),
    [&](Index begin, Index end)
    {
      for (Index cell = begin; cell < end; ++cell)
      {
        const auto b = mesh.Bounds(cell);
        for (Index at = this->SampleBegin[cell]; at < this->SampleBegin[cell + 1]; ++at)
        {
          const Index sample = this->Sorted[at];
          const double* p = &this->Samples.Parameters[3 * sample];
          const BernsteinJet<0> u((p[0] - b[0]) / (b[1] - b[0]), 1.0);
          const BernsteinJet<0> v((p[1] - b[2]) / (b[3] - b[2]), 1.0);
          const BernsteinJet<0> w((p[2] - b[4]) / (b[5] - b[4]), 1.0);
          for (int c = 0; c < components; ++c)
          {
            double value;
            PolynomialJet<0>(&this->Bezier[64 * (cell * components + c)], u, v, w, &value);
            this->Residuals[c][at] = this->Samples.Values[c * n + sample] - value;
          }
        }
      }
    });
  this->Run.Check(0.0);
}

//------------------------------------------------------------------------------
ScatteredError ScatteredSystem::Error(int component) const
{
  double weights = 0.0;
  ScatteredError error;
  for (std::size_t at = 0; at < this->Sorted.size(); ++at)
  {
    weights += this->WeightOf(this->Sorted[at]);
    error.Maximum = std::max(error.Maximum, std::abs(this->Residuals[component][at]));
  }
  error.Rms = std::sqrt(this->SquaredError(component) / weights);
  return error;
}

//------------------------------------------------------------------------------
double ScatteredSystem::SquaredError(int component) const
{
  double squares = 0.0;
  for (std::size_t at = 0; at < this->Sorted.size(); ++at)
  {
    const double r = this->Residuals[component][at];
    squares += this->WeightOf(this->Sorted[at]) * r * r;
  }
  return squares;
}
}
