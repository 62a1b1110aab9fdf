// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "GridFitSystem.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace trivariate
{
namespace
{
Array3 TakeMoments(const Axes& axes, Array3 values, const Execution& execution)
{
  for (int a = 0; a < 3; ++a)
  {
    values = Apply(axes[a].Moments, a, values, execution);
  }
  return values;
}

double InnerProduct(const std::vector<double>& a, const std::vector<double>& b)
{
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

// Sums the residual's moments against all factors of a function but that of direction(id), which
// leaves a line of numbers in that direction: visit(id, line), in parallel over the functions.
template <typename Direction, typename Visitor>
void VisitLines(const Axes& axes, const Residual& residual,
  const std::vector<LevelFunction>& functions, const std::vector<LevelGroup>& groups,
  const Direction& direction, const Visitor& visit, const Execution& execution)
{
  VisitMoments(
    axes, residual.Moments, residual.Level, groups,
    [&](const LevelGroup& group, const Array3& moments)
    {
      execution.ParallelFor(static_cast<Index>(group.Functions.size()),
        [&](Index begin, Index end)
        {
          std::vector<double> line;
          for (Index m = begin; m < end; ++m)
          {
            const Index id = group.Functions[m];
            ContractLine(moments, functions[id], direction(id), line);
            visit(id, line);
          }
        });
    },
    execution);
}
}

//------------------------------------------------------------------------------
GridFitSystem::GridFitSystem(
  const GridSamples& samples, const Axes& axes, const Execution& execution)
  : Samples(samples)
  , Grid(axes)
  , Run(execution)
  , Finest{ axes[0].FinestLevel(), axes[1].FinestLevel(), axes[2].FinestLevel() }
  , Functions(axes)
  , Voxels{ samples.Size, samples.Mask, {}, {}, {} }
{
  this->Voxels.Prepare(execution);
  this->CountedVoxels = samples.Mask ? this->Voxels.Counts.back() : samples.Count();
  for (int c = 0; c < samples.Components; ++c)
  {
    Array3 counted(samples.Size, this->Pool);
    std::copy_n(samples.Values + c * samples.Count(), samples.Count(), counted.Values.begin());
    double low = std::numeric_limits<double>::max(), high = -low;
    for (Index i = 0; i < samples.Count(); ++i)
    {
      double& value = counted.Values[i];
      if (!samples.Mask || samples.Mask[i])
      {
        low = std::min(low, value);
        high = std::max(high, value);
      }
      else
      {
        value = 0.0;
      }
    }
    const auto sum = [this, &counted](int power)
    {
      return this->SumOfLayers(
        [&counted, power](Index begin, Index end)
        {
          double layer = 0.0;
          for (Index i = begin; i < end; ++i)
          {
            layer += power == 1 ? counted.Values[i] : counted.Values[i] * counted.Values[i];
          }
          return layer;
        });
    };
    this->Means.push_back(sum(1) / static_cast<double>(this->CountedVoxels));
    this->Ranges.push_back(high > low ? high - low : low != 0.0 ? std::abs(low) : 1.0);
    this->SquaredSums.push_back(sum(2));
    this->FinestMoments.push_back(TakeMoments(axes, std::move(counted), execution));
  }
}

//------------------------------------------------------------------------------
double GridFitSystem::SumOfLayers(const std::function<double(Index begin, Index end)>& term) const
{
  // One partial sum a layer of voxels keeps the result independent of the threads.
  const Index layer = this->Samples.Size[0] * this->Samples.Size[1];
  std::vector<double> sums(this->Samples.Size[2]);
  this->Run.ParallelFor(this->Samples.Size[2],
    [&](Index begin, Index end)
    {
      for (Index z = begin; z < end; ++z)
      {
        sums[z] = term(z * layer, (z + 1) * layer);
      }
    });
  return std::accumulate(sums.begin(), sums.end(), 0.0);
}

//------------------------------------------------------------------------------
void GridFitSystem::Update(const TSpline& spline)
{
  this->Functions.Update(spline);
  this->Expansions.clear();
  this->Work = { 0, 0, 0 };
  for (Index i = 0; i < spline.Size(); ++i)
  {
    this->Expansions.push_back(this->Functions.Expansion(i));
  }
  for (int a = 0; a < 3; ++a)
  {
    for (const Univariate& factor : this->Functions.AllFactors(a))
    {
      const int level =
        factor.Splits.empty() ? factor.Expansion.Level : factor.Splits.front().Gain.Level;
      this->Work[a] = std::max(this->Work[a], level);
    }
  }
  this->Groups = GroupByLevel(this->Expansions);
}

//------------------------------------------------------------------------------
bool GridFitSystem::HasVoxel(Index i) const
{
  if (!this->Samples.Mask)
  {
    return true;
  }
  std::array<Index, 3> begin, end;
  for (int a = 0; a < 3; ++a)
  {
    const SampledFunction& samples = this->Functions.Factor(i, a).Samples;
    begin[a] = samples.first;
    end[a] = begin[a] + static_cast<Index>(samples.second.size());
  }
  return this->Voxels.CountIn(begin, end) > 0;
}

//------------------------------------------------------------------------------
Residual GridFitSystem::ComputeResidual(int component, const std::vector<double>& d)
{
  if (this->Samples.Mask)
  {
    Array3 residual = this->Reconstruct(d);
    const double* values = this->Samples.Values + component * this->Samples.Count();
    const double sum = this->SumOfLayers(
      [this, &residual, values](Index begin, Index end)
      {
        double layer = 0.0;
        for (Index i = begin; i < end; ++i)
        {
          double& r = residual.Values[i];
          r = this->Samples.Mask[i] ? values[i] - r : 0.0;
          layer += r * r;
        }
        return layer;
      });
    return { this->Work,
      Restrict(this->Grid, TakeMoments(this->Grid, std::move(residual), this->Run), this->Finest,
        this->Work, this->Run),
      sum };
  }
  // Without a mask the Gram matrix of the uniform basis is separable, so no voxel is touched: with
  // c the coefficients, m the moments of the samples and G that matrix, the residual has the
  // moments m - G c and the squared sum |f|^2 - c (2 m - G c).
  const Array3 coefficients =
    Synthesize(this->Grid, this->Expansions, this->Groups, d, this->Work, this->Pool, this->Run);
  const auto multiply = [this](const Array3& in, int a)
  { return Apply(this->Grid[a].Gram[this->Work[a]], a, in, this->Run); };
  Array3 residual = multiply(multiply(multiply(coefficients, 0), 1), 2);
  const Array3& samples = this->SampleMoments(component);
  double sum = this->SquaredSums[component];
  for (std::size_t i = 0; i < residual.Values.size(); ++i)
  {
    residual.Values[i] = samples.Values[i] - residual.Values[i];
    sum -= coefficients.Values[i] * (samples.Values[i] + residual.Values[i]);
  }
  return { this->Work, std::move(residual), std::max(0.0, sum) };
}

//------------------------------------------------------------------------------
const Array3& GridFitSystem::SampleMoments(int component)
{
  if (this->Work == this->Finest)
  {
    return this->FinestMoments[component];
  }
  if (this->WorkMomentsLevel != this->Work)
  {
    this->WorkMoments.clear();
    for (const Array3& moments : this->FinestMoments)
    {
      this->WorkMoments.push_back(
        Restrict(this->Grid, moments, this->Finest, this->Work, this->Run));
    }
    this->WorkMomentsLevel = this->Work;
  }
  return this->WorkMoments[component];
}

//------------------------------------------------------------------------------
std::vector<double> GridFitSystem::Gradient(const Residual& residual) const
{
  std::vector<double> gradient(this->Expansions.size());
  VisitLines(
    this->Grid, residual, this->Expansions, this->Groups, [](Index) { return 0; },
    [&](Index id, const std::vector<double>& line)
    { gradient[id] = InnerProduct(this->Expansions[id].Factors[0]->Coefficients, line); },
    this->Run);
  return gradient;
}

//------------------------------------------------------------------------------
void GridFitSystem::AddGains(
  const Residual& residual, double factor, std::vector<SplitGain>& gains) const
{
  // One request for each function and direction that can be split: the factor in that direction is
  // replaced by its candidates, which share a level and the parent's support.
  std::vector<LevelFunction> requests;
  std::vector<std::pair<Index, int>> owners;
  std::vector<Index> firstGain;
  Index count = 0;
  for (Index i = 0; i < this->Functions.Size(); ++i)
  {
    for (int a = 0; a < 3; ++a)
    {
      const Univariate& split = this->Functions.Factor(i, a);
      if (!split.Splits.empty())
      {
        LevelFunction request = this->Expansions[i];
        request.Factors[a] = &split.Splits.front().Gain;
        requests.push_back(request);
        owners.emplace_back(i, a);
        firstGain.push_back(count);
        count += static_cast<Index>(split.Splits.size());
      }
    }
  }
  gains.resize(count, { 0, 0, 0, 0.0 });
  VisitLines(
    this->Grid, residual, requests, GroupByLevel(requests),
    [&](Index id) { return owners[id].second; },
    [&](Index id, const std::vector<double>& line)
    {
      const auto [i, a] = owners[id];
      const double norm2 = this->Functions.Factor(i, (a + 1) % 3).SquaredNorm *
                           this->Functions.Factor(i, (a + 2) % 3).SquaredNorm;
      const auto& splits = this->Functions.Factor(i, a).Splits;
      for (std::size_t s = 0; s < splits.size(); ++s)
      {
        const double sum = InnerProduct(splits[s].Gain.Coefficients, line);
        SplitGain& gain = gains[firstGain[id] + s];
        gain = { i, a, splits[s].Knot,
          gain.SquaredError + (norm2 > 0.0 ? factor * sum * sum / norm2 : 0.0) };
      }
    },
    this->Run);
}

//------------------------------------------------------------------------------
Array3 GridFitSystem::Reconstruct(const std::vector<double>& d) const
{
  Array3 values =
    Synthesize(this->Grid, this->Expansions, this->Groups, d, this->Finest, this->Pool, this->Run);
  for (int a = 2; a >= 0; --a)
  {
    values = Apply(this->Grid[a].Collocation, a, values, this->Run);
  }
  return values;
}

//------------------------------------------------------------------------------
FitError GridFitSystem::Error(int component, const std::vector<double>& d) const
{
  const Array3 fitted = this->Reconstruct(d);
  const double* values = this->Samples.Values + component * this->Samples.Count();
  const Index layer = this->Samples.Size[0] * this->Samples.Size[1];
  std::vector<double> maxima(this->Samples.Size[2], 0.0);
  const double sum = this->SumOfLayers(
    [&](Index begin, Index end)
    {
      double squares = 0.0;
      double& maximum = maxima[begin / layer];
      for (Index i = begin; i < end; ++i)
      {
        if (!this->Samples.Mask || this->Samples.Mask[i])
        {
          const double r = std::abs(values[i] - fitted.Values[i]);
          squares += r * r;
          maximum = std::max(maximum, r);
        }
      }
      return squares;
    });
  return { std::sqrt(sum / static_cast<double>(this->CountedVoxels)),
    *std::max_element(maxima.begin(), maxima.end()) };
}
}
