// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Fit.h"

#include "FitSteps.h"
#include "GridFitSystem.h"
#include "RefinementMarks.h"
#include "TSpline/LinearIndependence.h"
#include "TSpline/RefinementRule.h"
#include "UniformFit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace trivariate
{
namespace
{
constexpr int FinalIterations = 40;
// Functions at the edge of a mask have few voxels to tell them apart: on noise 40 iterations end up
// to 3 % above the least-squares error, 400 up to 1 %, for about a seventh more of the fit's time.
constexpr int FinalIterationsUnderMask = 400;

// Below this share the sum of squares from moments has lost its digits to cancellation.
constexpr double RmsFromMoments = 1e-6;

// The root mesh has about this many cells a direction; fewer where the limit asks for it.
constexpr double RootCells = 4.0;

void CheckInput(const GridSamples& samples, const FitOptions& options)
{
  const auto fail = [](const std::string& what) { throw std::invalid_argument(what); };
  for (int a = 0; a < 3; ++a)
  {
    if (samples.Size[a] < 2)
    {
      fail("The volume has " + std::to_string(samples.Size[0]) + " x " +
           std::to_string(samples.Size[1]) + " x " + std::to_string(samples.Size[2]) +
           " samples; at least 2 are needed in every direction.");
    }
  }
  if (options.MaximumControlPoints < 64)
  {
    fail("The limit is " + std::to_string(options.MaximumControlPoints) +
         " control points; a trivariate cubic needs at least 64.");
  }
  if (!(options.RmsTolerance >= 0.0) || !(options.MaximumErrorTolerance >= 0.0))
  {
    fail("A tolerance is negative or not a number.");
  }
  bool any = false;
  for (Index i = 0; i < samples.Count(); ++i)
  {
    if (samples.Mask && !samples.Mask[i])
    {
      continue;
    }
    any = true;
    for (int c = 0; c < samples.Components; ++c)
    {
      if (!std::isfinite(samples.Values[c * samples.Count() + i]))
      {
        fail("The sample " + std::to_string(i % samples.Size[0]) + ", " +
             std::to_string(i / samples.Size[0] % samples.Size[1]) + ", " +
             std::to_string(i / samples.Size[0] / samples.Size[1]) + " is not a finite number.");
      }
    }
  }
  if (!any)
  {
    fail("The mask leaves no voxel to fit.");
  }
}

Axes MakeAxes(const GridSamples& samples, const FitOptions& options)
{
  if (options.Rule == Refinement::Uniform)
  {
    return MakeUniformAxes(samples.Size, options.MaximumControlPoints);
  }
  for (double cells = RootCells;; cells /= 2.0)
  {
    Axes axes{ DyadicAxis::ForSamples(samples.Size[0], cells),
      DyadicAxis::ForSamples(samples.Size[1], cells),
      DyadicAxis::ForSamples(samples.Size[2], cells) };
    if (axes[0].Functions(0) * axes[1].Functions(0) * axes[2].Functions(0) <=
          options.MaximumControlPoints ||
        cells <= 1.0)
    {
      return axes;
    }
  }
}

class AdaptiveFit
{
public:
  AdaptiveFit(const GridSamples& samples, const FitOptions& options, const Execution& execution)
    : Samples(samples)
    , Options(options)
    , Run(execution)
    , Grid(MakeAxes(samples, options))
    , System(samples, this->Grid, this->Run)
    , Residuals(samples.Components)
  {
    this->Run.Continue = [this, &execution](double)
    {
      // Dropped functions take no progress back.
      this->Done = std::max(this->Done, this->Progress());
      return execution.Continue(this->Done);
    };
    std::array<KnotLine, 3> lines;
    std::array<int, 3> stride;
    for (int a = 0; a < 3; ++a)
    {
      lines[a] = this->Grid[a].Line();
      stride[a] = 1 << this->Grid[a].FinestLevel();
      this->Result.RootCells[a] = this->Grid[a].Root();
    }
    this->Result.Spline = MakeTensorProduct(lines, stride, samples.Components);
    this->RootSize = this->Result.Spline.Size();
    for (Index i = 0; i < this->RootSize; ++i)
    {
      for (int c = 0; c < samples.Components; ++c)
      {
        this->Result.Spline.ControlPoint(i)[3 + c] = this->System.Mean(c);
      }
    }
    this->Lap("moments");
  }

  FitResult Adapt()
  {
    TSpline& spline = this->Result.Spline;
    std::unique_ptr<RefinementRule> rule;
    if (this->Options.Rule == Refinement::Compact)
    {
      rule = MakeKnotInsertionRule(spline);
    }
    else if (this->Options.Rule == Refinement::AnalysisSuitable)
    {
      rule = MakeAnalysisSuitableRule(spline);
    }
    this->System.Update(spline);
    if (!rule && !this->Samples.Mask && HasSmallInverse(this->Grid))
    {
      this->SolveTensorProduct();
      this->Measure(true);
      return this->TakeResult();
    }
    this->SolveRoot();
    while (true)
    {
      const bool isGood = this->IsGoodEnough();
      const bool isRefined = !isGood && this->RefineOnce(rule);
      if (isRefined)
      {
        this->System.Update(spline);
      }
      else
      {
        this->Result.Rounds.pop_back(); // its spline is solved once more, for good
      }
      if (isRefined && !RefinementMarks::IsFull(spline.Size(), this->Options.MaximumControlPoints))
      {
        this->Solve(RoundTolerance, RoundIterations);
        this->Measure(false);
        continue;
      }
      this->DropDependentFunctions();
      this->Solve(FinalTolerance, this->Samples.Mask ? FinalIterationsUnderMask : FinalIterations);
      this->Measure(true);
      // The last solve lowers the mean square, but it can raise the largest error again.
      if (!isGood || this->IsGoodEnough())
      {
        this->DropEmptyFunctions();
        return this->TakeResult();
      }
    }
  }

private:
  FitResult TakeResult()
  {
    this->Result.Seconds = this->Time.Seconds;
    return std::move(this->Result);
  }

  // Control points grow by a constant factor a round, so their logarithm tells the way done.
  double Progress() const
  {
    const double size = static_cast<double>(this->Result.Spline.Size());
    const double most = static_cast<double>(this->Options.MaximumControlPoints);
    return std::clamp(0.05 + 0.9 * std::log(size / this->RootSize + 0.01) /
                               std::log(std::max(2.0, most / this->RootSize)),
      0.0, 0.99);
  }

  void Lap(const char* topic) { this->Time.Lap(topic); }

  // The homogeneous coefficients w_i p_i of one attribute.
  std::vector<double> Coefficients(int c) const
  {
    const TSpline& spline = this->Result.Spline;
    std::vector<double> d(spline.Size());
    for (Index i = 0; i < spline.Size(); ++i)
    {
      d[i] = spline.Weights[i] * spline.ControlPoint(i)[3 + c];
    }
    return d;
  }

  // Without a mask the normal equations of a tensor product are a tensor product too.
  void SolveTensorProduct()
  {
    for (int c = 0; c < this->Samples.Components; ++c)
    {
      const std::vector<double> d =
        SolveUniform(this->Grid, this->System.SampleMoments(c), this->Run);
      for (std::size_t i = 0; i < d.size(); ++i)
      {
        this->Result.Spline.ControlPoint(i)[3 + c] = d[i];
      }
    }
    this->Lap("solve");
  }

  // The root's functions alone can be all that is needed, for a polynomial or a constant. So solves
  // go on, each correcting the one before, as long as they bring much.
  void SolveRoot()
  {
    double before = 1.0, now = 1.0;
    do
    {
      this->Result.Rounds.clear();
      this->Solve(FinalTolerance, FinalIterations);
      this->Measure(false);
      before = now;
      now = this->Result.Rounds.back().Rms;
    } while (now > RmsFloor && now < 0.1 * before);
  }

  // Knot insertion now and then makes more functions than the space has dimensions.
  void DropDependentFunctions()
  {
    if (this->Options.Independent && this->Options.Rule == Refinement::Compact)
    {
      if (RepairLinearDependence(this->Result.Spline, this->Run) > 0)
      {
        this->System.Update(this->Result.Spline);
      }
      this->Lap("independence");
    }
  }

  // Under a mask, functions without a voxel stand for nothing. Those that have one but are zero
  // there are kept: between the voxels that count the spline must be whole.
  void DropEmptyFunctions()
  {
    TSpline& spline = this->Result.Spline;
    std::vector<char> empty(spline.Functions.size());
    for (Index i = 0; i < spline.Size(); ++i)
    {
      empty[i] = !this->System.HasVoxel(i);
    }
    RemoveFunctions(spline, empty);
    this->Result.Rounds.back().ControlPoints = spline.Size();
  }

  // Corrects the control points by what the normal equations make of the residual.
  void Solve(double tolerance, int iterations)
  {
    TSpline& spline = this->Result.Spline;
    const GramMatrix gram(spline, this->System.Table(), this->System.Mask(), this->Run);
    this->Lap("assemble");
    std::vector<double> correction;
    for (int c = 0; c < this->Samples.Components; ++c)
    {
      Residual& residual = this->Residuals[c];
      if (residual.Level != this->System.WorkLevel())
      {
        residual = this->System.ComputeResidual(c, this->Coefficients(c));
      }
      const std::vector<double> gradient = this->System.Gradient(residual);
      this->Lap("moments");
      gram.Solve(gradient, tolerance, iterations, correction, this->Run);
      for (Index i = 0; i < spline.Size(); ++i)
      {
        spline.ControlPoint(i)[3 + c] += correction[i] / spline.Weights[i];
      }
      this->Lap("solve");
      residual = this->System.ComputeResidual(c, this->Coefficients(c));
      this->Lap("moments");
    }
  }

  // Appends a round with its errors; at the voxels where moments do not tell enough.
  void Measure(bool atVoxels)
  {
    const double voxels = static_cast<double>(this->System.NumberOfVoxels());
    FitRound round{ this->Result.Spline.Size(), 0.0, 0.0, 0.0 };
    for (int c = 0; c < this->Samples.Components; ++c)
    {
      const double range = this->System.Range(c);
      const double rms = std::sqrt(this->Residuals[c].SquaredSum / voxels) / range;
      if (atVoxels || this->Options.MaximumErrorTolerance > 0.0 || rms < RmsFromMoments)
      {
        const FitError error = this->System.Error(c, this->Coefficients(c));
        round.Rms = std::max(round.Rms, error.Rms / range);
        round.MaximumError = std::max(round.MaximumError, error.Maximum / range);
      }
      else
      {
        round.Rms = std::max(round.Rms, rms);
        round.MaximumError = std::numeric_limits<double>::quiet_NaN();
      }
    }
    this->Lap("evaluate");
    round.Seconds = this->Time.Total();
    this->Result.Rounds.push_back(round);
    this->Run.Check(0.0);
  }

  bool IsGoodEnough() const
  {
    const FitRound& round = this->Result.Rounds.back();
    const FitOptions& o = this->Options;
    const bool wantsRms = o.RmsTolerance > 0.0, wantsMaximum = o.MaximumErrorTolerance > 0.0;
    return round.Rms <= RmsFloor ||
           ((wantsRms || wantsMaximum) && (!wantsRms || round.Rms <= o.RmsTolerance) &&
             (!wantsMaximum || round.MaximumError <= o.MaximumErrorTolerance));
  }

  // False when nothing could be refined.
  bool RefineOnce(std::unique_ptr<RefinementRule>& rule)
  {
    if (!rule)
    {
      return false;
    }
    std::vector<SplitGain> gains;
    for (int c = 0; c < this->Samples.Components; ++c)
    {
      const double range = this->System.Range(c);
      this->System.AddGains(this->Residuals[c], 1.0 / (range * range), gains);
    }
    this->Lap("indicator");
    const bool refined = this->Marks.Refine(
      std::move(gains), this->Options.MaximumControlPoints, this->Result.Spline, rule);
    this->Lap("refine");
    this->Run.Check(0.0);
    return refined;
  }

  const GridSamples& Samples;
  const FitOptions& Options;
  Execution Run;
  FitClock Time;
  FitResult Result;
  Axes Grid;
  GridFitSystem System;
  std::vector<Residual> Residuals; // one for each attribute, of the spline as it is
  RefinementMarks Marks;
  Index RootSize = 1;
  double Done = 0.0;
};
}

//------------------------------------------------------------------------------
FitResult FitGrid(const GridSamples& samples, const FitOptions& options, const Execution& execution)
{
  CheckInput(samples, options);
  return AdaptiveFit(samples, options, execution).Adapt();
}
}
