// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "BlockFit.h"

#include "BlockFitInput.h"
#include "DataFollow.h"
#include "FitStage.h"
#include "FitSteps.h"
#include "RefinementHistory.h"
#include "RefinementMarks.h"
#include "SegmentErrors.h"
#include "ShapeInverse.h"
#include "ShapeSolver.h"
#include "ShapeTarget.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace trivariate
{
namespace
{
constexpr int FinalIterations = 400;

// How far outside of the surface the shape is to lie, in voxels: those at the surface are to be
// inside, also where the chords of the block mesh cut them off.
constexpr double Margin = 0.25;

// A shape that is farther from its surface than this, in voxels, may have more points than its
// share, up to half of all and so many: it takes more from few attributes than points of their own.
constexpr double TooFar = 0.35;
constexpr Index MostFar = 2000;

// How often voxels that are still outside pull the surface over themselves, and the steps of each
// pull. From voxels farther away, in voxels, cubes are missing: the surface would leave others.
constexpr int Pulls = 4, PullSteps = 8;
constexpr double FarthestPull = 2.0;

// Steps of the shape with each barrier after a refinement; after the last one as many as it needs.
constexpr int RoundSteps = 3;

// Stiffness of all cells of a shape whose surface slides: little enough to bend as the surface
// does, enough to be smooth inside where the block mesh is not.
constexpr float Stiffness = 2e-6f;

// How often the shape follows the attributes' errors, and how often in a row an error may fall by
// less than a share; with a barrier (see ShapeSolver.h) that becomes less each time, and damped
// (see DataErrors.h), more where the error has not fallen.
constexpr int MostFollows = 10, MostVain = 3;
constexpr double LeastGain = 0.01;
constexpr double FollowBarrier = 0.03, FollowLowering = 0.5, FollowDamping = 4e-4;

class BlockFitter
{
public:
  BlockFitter(const BlockComplex& blocks, const BlockSamples& voxels, const ShapeSamples& shape,
    const BlockFitOptions& options, const Execution& execution)
    : Blocks(blocks)
    , Voxels(voxels)
    , Shape(shape.Parameters.empty() ? ShapeSamples{ voxels.Parameters, voxels.Places, {} } : shape)
    , Options(options)
    , Run(execution)
    , Layout(blocks, KnotDepth(blocks, Shape, options.Spacing))
    , Marks([this](const TSpline& spline) { return this->CountPoints(spline); })
  {
    this->Result.Spline = this->Layout.MakeCoarsest(options.CoarsestCells, voxels.Components);
    this->Rule = options.Rule == Refinement::Compact
                   ? MakeBlockRule(this->Layout, this->Result.Spline)
                   : MakeAnalysisSuitableBlockRule(this->Layout, options.CoarsestCells);
    this->CoarsestSize = this->CountPoints(this->Result.Spline);
    if (this->CoarsestSize > options.MaximumControlPoints)
    {
      throw std::invalid_argument("The limit is " + std::to_string(options.MaximumControlPoints) +
                                  " control points; the " + std::to_string(blocks.Size()) +
                                  " blocks of the domain need at least " +
                                  std::to_string(this->CoarsestSize) + ".");
    }
    this->Run.Continue = [this, &execution](double)
    {
      // Dropped marks take no progress back.
      this->Done = std::max(this->Done, this->Progress());
      return execution.Continue(this->Done);
    };
  }

  BlockFitResult Fit()
  {
    ShapeTarget target(this->Blocks, this->Shape, Margin * this->Options.Spacing);
    this->FitShape(target);
    ScatteredSamples samples;
    samples.Components = this->Voxels.Components;
    samples.Values = this->Voxels.Values;
    samples.Parameters = this->FindParameters(this->Result.Spline, this->Voxels.Parameters);
    this->FitAttributes(samples, target);
    const SharedPoints shared = this->Layout.Share(this->Result.Spline, Sharing::Attributes);
    this->Result.PointOf = shared.PointOf;
    this->Result.ControlPoints = shared.Count();
    this->Result.NumbersFitted =
      3 * this->Result.ShapePoints + samples.Components * this->Result.ControlPoints;
    for (const BlendingFunction& f : this->Result.Spline.Functions)
    {
      this->Result.BlockOf.push_back(this->Layout.BlockOf(f));
    }
    this->Result.Seconds = this->Time.Seconds;
    return std::move(this->Result);
  }

private:
  // Control points grow by a constant factor a round, so their logarithm tells the way done.
  double Progress() const
  {
    const std::vector<FitRound>& rounds = this->Result.Rounds;
    const auto root = static_cast<double>(this->CoarsestSize);
    const double size = rounds.empty() ? root : static_cast<double>(rounds.back().ControlPoints);
    const auto most = static_cast<double>(this->Options.MaximumControlPoints);
    return std::clamp(
      0.05 + 0.9 * std::log(size / root) / std::log(std::max(2.0, most / root)), 0.0, 0.99);
  }

  Index CountPoints(const TSpline& spline) const
  {
    return this->Layout.Share(spline, Sharing::Attributes).Count();
  }

  // Throws where not even its points, as many as it may have, bring the shape to its surface.
  void CheckReach(const FitStage& stage) const
  {
    const FitRound& last = this->Result.Rounds.back();
    const double most = this->Options.LargestShapeDistance;
    if (stage.Slides() && most > 0.0 && last.Rms > most)
    {
      std::ostringstream why;
      why.precision(2);
      why << "The shape stays " << last.Rms / this->Options.Spacing
          << " voxels from its surface with " << last.ControlPoints << " control points.";
      throw std::invalid_argument(why.str());
    }
  }

  void FitShape(ShapeTarget& target)
  {
    ScatteredSystem system(target.Samples(), 0, this->Layout, this->Run);
    FitStage stage{ system, 0, std::vector<double>(3, 1.0), this->Options.ShapeTolerance, 0.0,
      std::min(this->Options.MaximumShapePoints, this->Options.MaximumControlPoints), &target };
    this->Adapt(stage);
    this->Result.ShapePoints = system.Points().Count();
    if (target.Slides())
    {
      this->CoverVoxels(target);
    }
    this->Result.ShapeRms = this->Result.Rounds.back().Rms;
    this->Result.ShapeMaximum = this->Result.Rounds.back().MaximumError;
    this->Result.Rounds.clear();
  }

  // Voxels that are still outside pull the surface next to them over themselves.
  void CoverVoxels(ShapeTarget& target)
  {
    std::vector<double> places = this->Voxels.Places, starts = this->Voxels.Parameters;
    for (int pull = 0; pull < Pulls; ++pull)
    {
      const BezierMesh mesh(this->Result.Spline, this->Run);
      const FoundParameters found =
        FindParametersOnShape(this->Result.Spline, mesh, places, starts, this->Run);
      auto [outside, feet] = OutsideWithin(FarthestPull * this->Options.Spacing, found, places);
      this->Time.Lap("cover");
      if (outside.empty())
      {
        return;
      }
      target.Pull(feet, outside);
      ScatteredSystem system(target.Samples(), 0, this->Layout, this->Run);
      FitStage stage{ system, 0, std::vector<double>(3, 1.0), 0.0, 0.0, 0, &target };
      this->Update(stage);
      // The shape is the one that the last barrier left.
      this->SlideToSurface(stage, ShapeSolverOptions().LastBarrier, PullSteps);
      this->Measure(stage);
      places = std::move(outside);
      starts = std::move(feet);
    }
  }

  void FitAttributes(ScatteredSamples& samples, ShapeTarget& target)
  {
    const TSpline shape = this->Result.Spline;
    const std::unique_ptr<RefinementRule> rule = this->Rule->Clone();
    this->Rule = std::make_unique<RefinementHistory>(std::move(this->Rule));
    ScatteredSystem system(samples, 3, this->Layout, this->Run);
    FitStage stage{ system, 3, {}, this->Options.RmsTolerance, this->Options.MaximumErrorTolerance,
      this->Options.MaximumControlPoints, nullptr };
    for (int c = 0; c < samples.Components; ++c)
    {
      stage.Scales.push_back(system.Range(c));
    }
    this->Adapt(stage);
    if (target.Slides() && !stage.IsGoodEnough(this->Result.Rounds.back()))
    {
      this->FollowData(stage, samples, target, shape, *rule);
    }
    this->Result.Ranges = stage.Scales;
    this->Result.SegmentRms = RmsOfSegments(this->Blocks, samples, system, stage.Scales);
    this->Result.Jump = WorstGradientJump(this->Blocks, this->Result.Spline, system.Mesh(),
      stage.Scales, this->Options.Spacing, this->Run);
    this->Time.Lap("jump");
  }

  // Moves the shape, on its own net, to where the errors of the attributes want it, and fits these
  // again. What makes the fit worse, or folds, is taken back.
  void FollowData(FitStage& stage, ScatteredSamples& samples, ShapeTarget& target, TSpline shape,
    const RefinementRule& rule)
  {
    // What FitAttributes has made it, or a clone that Marks has put in its place.
    const auto& history = static_cast<const RefinementHistory&>(*this->Rule);
    double barrier = FollowBarrier, damping = FollowDamping;
    for (int follow = 0, vain = 0; follow < MostFollows && vain < MostVain;
         ++follow, barrier *= FollowLowering)
    {
      const BlockFitResult before = this->Result;
      const std::vector<double> parameters = samples.Parameters;
      const TSpline moved = MoveToData({ this->Result.Spline, this->Layout, samples, stage.System,
                                         stage.Scales, target, this->Options.Spacing },
        shape, barrier, damping, this->Run);
      this->Time.Lap("follow");
      samples.Parameters = this->FindParameters(moved, parameters);
      this->Result.Spline = moved;
      history.Repeat(rule, this->Result.Spline);
      for (Index i = 0; i < before.Spline.Size(); ++i)
      {
        std::copy_n(before.Spline.ControlPoint(i) + 3, samples.Components,
          this->Result.Spline.ControlPoint(i) + 3);
      }
      this->Update(stage);
      stage.System.ComputeResiduals(this->Result.Spline);
      this->Solve(stage, FinalTolerance, FinalIterations);
      this->Measure(stage);
      const double gain = 1.0 - this->Result.Rounds.back().Rms / before.Rounds.back().Rms;
      vain = gain < LeastGain ? vain + 1 : 0;
      if (gain <= 0.0)
      {
        this->Result = before;
        samples.Parameters = parameters;
        this->Update(stage);
        stage.System.ComputeResiduals(this->Result.Spline);
        damping *= 10.0;
        continue;
      }
      shape = moved;
      this->Result.ShapeRms = target.Distance().Rms;
      this->Result.ShapeMaximum = target.Distance().Maximum;
    }
  }

  void Adapt(FitStage& stage)
  {
    TSpline& spline = this->Result.Spline;
    this->Update(stage);
    for (std::size_t c = 0; c < stage.Scales.size(); ++c)
    {
      for (Index i = 0; i < spline.Size(); ++i)
      {
        spline.ControlPoint(i)[stage.FirstComponent + c] = stage.System.Mean(c);
      }
    }
    this->Time.Lap("sort");
    stage.System.ComputeResiduals(spline);
    this->Solve(stage, FinalTolerance, FinalIterations);
    this->Measure(stage);
    for (bool isSolved = true;;)
    {
      const bool isGood = stage.IsGoodEnough(this->Result.Rounds.back());
      const bool isRefined = !isGood && this->RefineOnce(stage);
      if (isRefined)
      {
        isSolved = false;
        this->Update(stage);
        stage.System.ComputeResiduals(spline);
        this->Time.Lap("sort");
        this->Solve(stage, RoundTolerance, RoundIterations);
        this->Measure(stage);
        continue;
      }
      this->CheckReach(stage);
      if (isSolved)
      {
        return;
      }
      isSolved = true;
      this->Result.Rounds.pop_back();
      this->Solve(stage, FinalTolerance, FinalIterations);
      this->Measure(stage);
      if (!isGood || stage.IsGoodEnough(this->Result.Rounds.back()))
      {
        return;
      }
    }
  }

  void Update(FitStage& stage)
  {
    stage.System.Update(this->Result.Spline);
    if (stage.Slides())
    {
      stage.System.SetStiffness(std::vector<float>(stage.System.Mesh().Size(), Stiffness));
    }
  }

  void Solve(FitStage& stage, double tolerance, int iterations)
  {
    if (!stage.Slides() || this->Result.Rounds.empty())
    {
      const GramMatrix gram = stage.System.Assemble();
      this->Time.Lap("assemble");
      this->Correct(stage, gram, tolerance, iterations);
    }
    if (stage.Slides())
    {
      const ShapeSolverOptions usual;
      this->SlideToSurface(
        stage, usual.FirstBarrier, tolerance == FinalTolerance ? usual.MostSteps : RoundSteps);
    }
  }

  // Refinement keeps the shape, so that only the coarsest net can have folds.
  void SlideToSurface(FitStage& stage, double firstBarrier, int steps)
  {
    ShapeSolverOptions options;
    options.FirstBarrier = firstBarrier;
    options.Spacing = this->Options.Spacing;
    options.MostSteps = steps;
    SolveShape(this->Result.Spline, stage.System, *stage.Target, options, this->Run);
    this->Time.Lap("shape");
  }

  void Correct(FitStage& stage, const GramMatrix& gram, double tolerance, int iterations)
  {
    TSpline& spline = this->Result.Spline;
    const SharedPoints& points = stage.System.Points();
    std::vector<double> correction;
    for (std::size_t c = 0; c < stage.Scales.size(); ++c)
    {
      const std::vector<double> gradient = stage.System.Gradient(static_cast<int>(c));
      gram.Solve(gradient, tolerance, iterations, correction, this->Run);
      for (Index i = 0; i < spline.Size(); ++i)
      {
        spline.ControlPoint(i)[stage.FirstComponent + c] +=
          correction[points.PointOf[i]] / spline.Weights[i];
      }
    }
    this->Time.Lap("solve");
    stage.System.ComputeResiduals(spline);
    this->Time.Lap("evaluate");
  }

  void Measure(const FitStage& stage)
  {
    this->Result.Rounds.push_back(stage.Measure(this->Time.Total()));
    this->Run.Check(0.0);
  }

  Index MostPoints(const FitStage& stage) const
  {
    const bool isFar =
      stage.Slides() && this->Result.Rounds.back().Rms > TooFar * this->Options.Spacing;
    const Index ofFar = std::min(MostFar, this->Options.MaximumControlPoints / 2);
    return isFar ? std::max(stage.MaximumPoints, ofFar) : stage.MaximumPoints;
  }

  bool RefineOnce(FitStage& stage)
  {
    std::vector<SplitGain> gains;
    for (std::size_t c = 0; c < stage.Scales.size(); ++c)
    {
      const double scale = stage.Scales[c];
      stage.System.AddGains(static_cast<int>(c), 1.0 / (scale * scale), gains);
    }
    this->Time.Lap("indicator");
    const bool isRefined = this->Marks.Refine(
      std::move(gains), this->MostPoints(stage), this->Result.Spline, this->Rule);
    this->Time.Lap("refine");
    return isRefined;
  }

  // Where the voxels are on a shape, looked for from `starts`; keeps what there is to know about
  // it.
  std::vector<double> FindParameters(const TSpline& shape, const std::vector<double>& starts)
  {
    const FoundParameters found = FindParametersOnSegments(
      shape, this->Layout, this->Voxels.Places, this->Voxels.Parameters, starts, this->Run);
    this->Result.VoxelsInside = found.Inside;
    this->Result.VoxelsNear = std::count_if(found.Distances.begin(), found.Distances.end(),
      [this](double distance) { return distance <= 0.5 * this->Options.Spacing; });
    this->Result.Folds = FindFolds(shape, found.Parameters, this->Run);
    this->Time.Lap("parameters");
    return found.Parameters;
  }

  const BlockComplex& Blocks;
  const BlockSamples& Voxels;
  ShapeSamples Shape;
  const BlockFitOptions& Options;
  Execution Run;
  FitClock Time;
  BlockFitResult Result;
  BlockSpline Layout;
  RefinementMarks Marks;
  std::unique_ptr<RefinementRule> Rule;
  Index CoarsestSize = 1;
  double Done = 0.0;
};
}

//------------------------------------------------------------------------------
BlockFitResult FitBlocks(const BlockComplex& blocks, const BlockSamples& voxels,
  const ShapeSamples& shape, const BlockFitOptions& options, const Execution& execution)
{
  CheckBlockFit(blocks, voxels, shape, options);
  return BlockFitter(blocks, voxels, shape, options, execution).Fit();
}
}
