// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "BlockFit.h"

#include "BlockSpline.h"
#include "RefinementMarks.h"
#include "ScatteredSystem.h"
#include "ShapeJacobian.h"
#include "TSpline/Evaluator.h"
#include "TSpline/InverseMap.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace trivariate
{
namespace
{
// As in the gridded fit.
constexpr double RoundTolerance = 1e-2;
constexpr int RoundIterations = 20;
constexpr double FinalTolerance = 1e-4;
constexpr int FinalIterations = 400;
constexpr double RmsFloor = 1e-11;

// Points of the surface count more than those inside, where voxels find their own parameters.
constexpr float SurfaceWeight = 25.0f;

void CheckInput(
  const BlockComplex& blocks, const BlockSamples& voxels, const BlockFitOptions& options)
{
  const auto fail = [](const std::string& what) { throw std::invalid_argument(what); };
  if (voxels.Count() == 0)
  {
    fail("The domain has no voxel to fit.");
  }
  if (!(options.RmsTolerance >= 0.0) || !(options.MaximumErrorTolerance >= 0.0) ||
      !(options.ShapeTolerance >= 0.0) || !(options.Spacing > 0.0))
  {
    fail("A tolerance is negative or not a number, or the distance of voxels is not positive.");
  }
  for (Index i = 0; i < voxels.Count(); ++i)
  {
    const double* p = &voxels.Parameters[3 * i];
    if (!std::isfinite(p[0] + p[1] + p[2]) || blocks.BlockAt({ p[0], p[1], p[2] }) < 0)
    {
      fail("The parameter of voxel " + std::to_string(i) + ", (" + std::to_string(p[0]) + ", " +
           std::to_string(p[1]) + ", " + std::to_string(p[2]) + "), is in no block of the domain.");
    }
  }
}

// Stiffness of cells that fold, multiplied by four for each further attempt.
constexpr float FirstStiffness = 1e-4f;
constexpr int FoldAttempts = 6;

// Knot intervals along the edge of a block: halved until they are about a voxel.
int DepthOf(const BlockComplex& blocks, const BlockSamples& voxels, double spacing)
{
  std::vector<std::array<double, 6>> bounds(
    blocks.Size(), { 1e300, -1e300, 1e300, -1e300, 1e300, -1e300 });
  for (Index i = 0; i < voxels.Count(); ++i)
  {
    const double* p = &voxels.Parameters[3 * i];
    std::array<double, 6>& box = bounds[blocks.BlockAt({ p[0], p[1], p[2] })];
    for (int a = 0; a < 3; ++a)
    {
      box[2 * a] = std::min(box[2 * a], voxels.Places[3 * i + a]);
      box[2 * a + 1] = std::max(box[2 * a + 1], voxels.Places[3 * i + a]);
    }
  }
  double longest = 1.0;
  for (const auto& box : bounds)
  {
    longest = std::max({ longest, box[1] - box[0], box[3] - box[2], box[5] - box[4] });
  }
  const LatticePoint extent = blocks.Extent();
  const double boxes = double(extent[0]) * extent[1] * extent[2];
  int depth = 1;
  // No more than 128 million boxes of the index grid, of which refinement keeps a byte each.
  while (depth < 8 && spacing * (1 << depth) < longest && boxes * std::pow(8.0, depth + 1) < 128e6)
  {
    ++depth;
  }
  return depth;
}

// One stage: some components are fitted to some samples, and the spline is refined for them.
struct Stage
{
  ScatteredSystem& System;
  int FirstComponent;
  std::vector<double> Scales; // of each component: the unit of its error
  double RmsTolerance, MaximumTolerance;
  Index MaximumPoints;
  bool IsShape;
  std::vector<float> Stiffness = {}; // of cells that would fold
};

class BlockFitter
{
public:
  BlockFitter(const BlockComplex& blocks, const BlockSamples& voxels,
    const BlockFitOptions& options, const Execution& execution)
    : Blocks(blocks)
    , Voxels(voxels)
    , Options(options)
    , Run(execution)
    , Layout(blocks, DepthOf(blocks, voxels, options.Spacing))
    , Marks([this](const TSpline& spline) { return this->Layout.Share(spline).Count(); })
  {
    this->Result.Spline = this->Layout.MakeCoarsest(options.CoarsestCells, voxels.Components);
    this->Rule = MakeBlockRule(this->Layout, this->Result.Spline);
    this->CoarsestSize = this->Layout.Share(this->Result.Spline).Count();
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

  BlockFitResult Fit(const ShapeSamples& shape)
  {
    this->FitShape(shape);
    ScatteredSamples samples;
    samples.Parameters = this->FindParameters();
    samples.Components = this->Voxels.Components;
    samples.Values = this->Voxels.Values;
    this->Lap("parameters");
    this->FitAttributes(samples);
    const SharedPoints shared = this->Layout.Share(this->Result.Spline);
    this->Result.PointOf = shared.PointOf;
    this->Result.ControlPoints = shared.Count();
    return std::move(this->Result);
  }

private:
  using Clock = std::chrono::steady_clock;

  // Control points grow by a constant factor a round, so their logarithm tells the way done.
  double Progress() const
  {
    const auto size = static_cast<double>(
      this->Result.Rounds.empty() ? this->CoarsestSize : this->Result.Rounds.back().ControlPoints);
    const auto root = static_cast<double>(this->CoarsestSize);
    const double most = static_cast<double>(this->Options.MaximumControlPoints);
    return std::clamp(
      0.05 + 0.9 * std::log(size / root) / std::log(std::max(2.0, most / root)), 0.0, 0.99);
  }

  void Lap(const char* topic)
  {
    const auto now = Clock::now();
    auto& seconds = this->Result.Seconds;
    auto entry = std::find_if(
      seconds.begin(), seconds.end(), [topic](const auto& e) { return e.first == topic; });
    if (entry == seconds.end())
    {
      entry = seconds.insert(seconds.end(), { topic, 0.0 });
    }
    entry->second += std::chrono::duration<double>(now - this->LastLap).count();
    this->LastLap = now;
  }

  void FitShape(const ShapeSamples& shape)
  {
    const ShapeSamples& points = shape.Parameters.empty()
                                   ? ShapeSamples{ this->Voxels.Parameters, this->Voxels.Places }
                                   : shape;
    ScatteredSamples samples;
    samples.Parameters = points.Parameters;
    samples.Components = 3;
    const Index n = samples.Count();
    std::vector<char> onSurface(n, 0);
    for (Index i = 0; i < n; ++i)
    {
      const double* p = &samples.Parameters[3 * i];
      const Index b = this->Blocks.BlockAt({ p[0], p[1], p[2] });
      for (int face = 0; b >= 0 && face < 6; ++face)
      {
        const int a = face / 2, side = face % 2;
        const FaceTwin& twin = this->Blocks.Twin({ b, a, side });
        const bool isOuter =
          !twin.Exists() || this->Blocks.Segments[twin.Face.Block] != this->Blocks.Segments[b];
        onSurface[i] |= isOuter && p[a] == this->Blocks.Origins[b][a] + side;
      }
      samples.Weights.push_back(onSurface[i] ? SurfaceWeight : 1.0f);
    }
    for (int a = 0; a < 3; ++a)
    {
      for (Index i = 0; i < n; ++i)
      {
        samples.Values.push_back(points.Places[3 * i + a]);
      }
    }
    ScatteredSystem system(samples, 0, this->Layout, this->Run);
    Stage stage{ system, 0, std::vector<double>(3, 1.0), this->Options.ShapeTolerance, 0.0,
      std::min(this->Options.MaximumShapePoints, this->Options.MaximumControlPoints), true };
    this->Adapt(stage);
    this->Result.ShapePoints = system.Points().Count();
    this->Result.ShapeRms = this->Result.Rounds.back().Rms;
    this->Result.ShapeMaximum = this->Result.Rounds.back().MaximumError;
    this->Result.Rounds.clear();
  }

  void FitAttributes(const ScatteredSamples& samples)
  {
    ScatteredSystem system(samples, 3, this->Layout, this->Run);
    Stage stage{ system, 3, {}, this->Options.RmsTolerance, this->Options.MaximumErrorTolerance,
      this->Options.MaximumControlPoints, false };
    for (int c = 0; c < samples.Components; ++c)
    {
      stage.Scales.push_back(system.Range(c));
    }
    this->Adapt(stage);
  }

  void Adapt(Stage& stage)
  {
    TSpline& spline = this->Result.Spline;
    stage.System.Update(spline);
    for (std::size_t c = 0; c < stage.Scales.size(); ++c)
    {
      for (Index i = 0; i < spline.Size(); ++i)
      {
        spline.ControlPoint(i)[stage.FirstComponent + c] = stage.System.Mean(c);
      }
    }
    this->Lap("sort");
    stage.System.ComputeResiduals(spline);
    this->Solve(stage, FinalTolerance, FinalIterations);
    this->Measure(stage);
    while (true)
    {
      const bool isGood = this->IsGoodEnough(stage) && (!stage.IsShape || this->Unfold(stage));
      const bool isRefined = !isGood && this->RefineOnce(stage);
      if (isRefined)
      {
        stage.System.Update(spline);
        stage.Stiffness.clear();
        stage.System.ComputeResiduals(spline);
        this->Lap("sort");
        this->Solve(stage, RoundTolerance, RoundIterations);
        this->Measure(stage);
        continue;
      }
      this->Result.Rounds.pop_back();
      this->Solve(stage, FinalTolerance, FinalIterations);
      this->Measure(stage);
      if (stage.IsShape)
      {
        this->Unfold(stage);
        this->Folded.clear();
      }
      if (!isGood || this->IsGoodEnough(stage))
      {
        return;
      }
    }
  }

  void Solve(Stage& stage, double tolerance, int iterations)
  {
    TSpline& spline = this->Result.Spline;
    const GramMatrix gram = stage.System.Assemble();
    this->Lap("assemble");
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
    this->Lap("solve");
    stage.System.ComputeResiduals(spline);
    this->Lap("evaluate");
  }

  void Measure(const Stage& stage)
  {
    FitRound round{ stage.System.Points().Count(), 0.0, 0.0, 0.0 };
    for (std::size_t c = 0; c < stage.Scales.size(); ++c)
    {
      const ScatteredError error = stage.System.Error(static_cast<int>(c));
      round.Rms = std::max(round.Rms, error.Rms / stage.Scales[c]);
      round.MaximumError = std::max(round.MaximumError, error.Maximum / stage.Scales[c]);
    }
    round.Seconds = std::chrono::duration<double>(Clock::now() - this->Start).count();
    this->Result.Rounds.push_back(round);
    this->Run.Check(0.0);
  }

  bool IsGoodEnough(const Stage& stage) const
  {
    const FitRound& round = this->Result.Rounds.back();
    const bool wantsRms = stage.RmsTolerance > 0.0, wantsMaximum = stage.MaximumTolerance > 0.0;
    return round.Rms <= RmsFloor ||
           ((wantsRms || wantsMaximum) && (!wantsRms || round.Rms <= stage.RmsTolerance) &&
             (!wantsMaximum || round.MaximumError <= stage.MaximumTolerance));
  }

  bool RefineOnce(Stage& stage)
  {
    std::vector<SplitGain> gains;
    for (std::size_t c = 0; c < stage.Scales.size(); ++c)
    {
      const double scale = stage.Scales[c];
      stage.System.AddGains(static_cast<int>(c), 1.0 / (scale * scale), gains);
    }
    if (!this->Folded.empty())
    {
      this->KeepGainsOfFolds(stage.System.Mesh(), gains);
    }
    this->Lap("indicator");
    const bool isRefined =
      this->Marks.Refine(std::move(gains), stage.MaximumPoints, this->Result.Spline, this->Rule);
    this->Lap("refine");
    return isRefined;
  }

  // Whether the shape folds somewhere; marks the cells.
  bool FindFolds(const Stage& stage)
  {
    const auto bounds = BoundJacobian(this->Result.Spline, stage.System.Mesh(), this->Run);
    this->Folded.assign(bounds.size(), 0);
    std::transform(bounds.begin(), bounds.end(), this->Folded.begin(),
      [](const CellJacobian& cell) { return cell.Sampled <= 0.0; });
    this->Lap("folds");
    if (std::find(this->Folded.begin(), this->Folded.end(), 1) == this->Folded.end())
    {
      this->Folded.clear();
    }
    return !this->Folded.empty();
  }

  // Makes cells that fold stiffer, and those around them, as long as there are some; whether the
  // shape then does not fold and is still near enough.
  bool Unfold(Stage& stage)
  {
    const BezierMesh& mesh = stage.System.Mesh();
    stage.Stiffness.resize(mesh.Size(), 0.0f);
    for (int attempt = 0; this->FindFolds(stage); ++attempt)
    {
      if (attempt == FoldAttempts)
      {
        return false;
      }
      const std::vector<char> isActive = this->FunctionsOfFolds(mesh);
      for (Index cell = 0; cell < mesh.Size(); ++cell)
      {
        const IdRange active = mesh.ActiveFunctions(cell);
        if (std::any_of(
              active.begin(), active.end(), [&isActive](std::int32_t i) { return isActive[i]; }))
        {
          stage.Stiffness[cell] = std::max(FirstStiffness, 4.0f * stage.Stiffness[cell]);
        }
      }
      stage.System.SetStiffness(stage.Stiffness);
      this->Solve(stage, FinalTolerance, FinalIterations);
      this->Result.Rounds.pop_back();
      this->Measure(stage);
    }
    return this->IsGoodEnough(stage);
  }

  std::vector<char> FunctionsOfFolds(const BezierMesh& mesh) const
  {
    std::vector<char> isActive(this->Result.Spline.Size(), 0);
    for (Index cell = 0; cell < mesh.Size(); ++cell)
    {
      for (const std::int32_t i : mesh.ActiveFunctions(cell))
      {
        isActive[i] |= this->Folded[cell];
      }
    }
    return isActive;
  }

  // Where only folds ask for more functions, only theirs are split.
  void KeepGainsOfFolds(const BezierMesh& mesh, std::vector<SplitGain>& gains)
  {
    const std::vector<char> isWanted = this->FunctionsOfFolds(mesh);
    gains.erase(std::remove_if(gains.begin(), gains.end(),
                  [&isWanted](const SplitGain& gain) { return !isWanted[gain.Function]; }),
      gains.end());
    this->Folded.clear();
  }

  // Where the shape passes through the voxels; those it does not reach keep their parameters.
  std::vector<double> FindParameters()
  {
    const BezierMesh mesh(this->Result.Spline, this->Run);
    const InverseMap inverse(this->Result.Spline, mesh, this->Run);
    const Index n = this->Voxels.Count();
    std::vector<double> parameters(3 * n);
    std::vector<std::uint8_t> found(n);
    inverse.Find(n, this->Voxels.Places.data(), parameters.data(), found.data(), this->Run);
    for (Index i = 0; i < n; ++i)
    {
      if (!found[i])
      {
        std::copy_n(&this->Voxels.Parameters[3 * i], 3, &parameters[3 * i]);
      }
      this->Result.VoxelsInside += found[i];
    }
    this->ReportJacobian(mesh, parameters);
    return parameters;
  }

  void ReportJacobian(const BezierMesh& mesh, const std::vector<double>& parameters)
  {
    const Index n = this->Voxels.Count();
    const Evaluator evaluator(this->Result.Spline, mesh, { 0, 1, 2 }, this->Run);
    std::vector<double> gradients(9 * n);
    EvaluatorOutput output;
    output.Gradients = gradients.data();
    evaluator.Evaluate(n, parameters.data(), output, this->Run);
    double sum = 0.0, least = std::numeric_limits<double>::max();
    for (Index i = 0; i < n; ++i)
    {
      const double determinant = JacobianDeterminant(&gradients[9 * i]);
      sum += determinant;
      least = std::min(least, determinant);
    }
    for (const CellJacobian& cell : BoundJacobian(this->Result.Spline, mesh, this->Run))
    {
      least = std::min(least, cell.Sampled);
      this->Result.FoldedCells += cell.Sampled <= 0.0;
      this->Result.CertifiedCells += cell.Certified;
    }
    this->Result.ShapeCells = mesh.Size();
    this->Result.SmallestJacobian = least * static_cast<double>(n) / sum;
  }

  const BlockComplex& Blocks;
  const BlockSamples& Voxels;
  const BlockFitOptions& Options;
  Execution Run;
  Clock::time_point Start = Clock::now(), LastLap = Start;
  BlockFitResult Result;
  BlockSpline Layout;
  RefinementMarks Marks;
  std::unique_ptr<RefinementRule> Rule;
  Index CoarsestSize = 1;
  double Done = 0.0;
  std::vector<char> Folded; // of each cell, where the shape is near enough but folds
};
}

//------------------------------------------------------------------------------
BlockFitResult FitBlocks(const BlockComplex& blocks, const BlockSamples& voxels,
  const ShapeSamples& shape, const BlockFitOptions& options, const Execution& execution)
{
  CheckInput(blocks, voxels, options);
  return BlockFitter(blocks, voxels, options, execution).Fit(shape);
}
}
