// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "SegmentFits.h"

#include "ChainStep.h"
#include "DomainFit.h"
#include "PartErrors.h"
#include "SMPExecution.h"
#include "SegmentCut.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkPointData.h"
#include "vtkTable.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <utility>

namespace trivariate
{
namespace
{
constexpr int FewestControlPoints = 64;
constexpr double ShareOfShares = 0.02; // of the progress: to look what each segment needs
constexpr double ShareOfBoxes = 0.2;   // of a unit's progress: the fits over boxes
constexpr double ShareOfUnion = 0.5;   // of what is left then: several segments in one fit
constexpr double ShareOfTrial = 0.2;   // of the fits over a domain: one with few control points

// Of the control points that a segment may have, those of a trial over its cubes; and the largest
// part of them that it may need. Where cubes pay they pay most with few control points
// (Documentation/Results.md, Fits over a domain), and a fit over them takes far longer than one
// over a box.
constexpr double TrialPart = 0.125, MostOfTrial = 0.5;

// A trial also ends where its shape stays farther away than this, in voxels: wherever it was looked
// at it then lost to the box or left out too many voxels (Documentation/Results.md). It must be
// more accurate than the box by this part: the ankle's, better by 2e-5, lost in the end.
constexpr double MostTrialDistance = 0.6, LeastTrialGain = 0.05;

// Segments that are to be fitted at once: one, or several with common faces.
using Unit = PartNumbers;

struct Limits
{
  int ControlPoints;
  double From, To;            // of the progress
  double ShapeDistance = 0.0; // in voxels, the most; 0: any
};

//------------------------------------------------------------------------------
class SegmentFitter
{
public:
  SegmentFitter(vtkImageData* image, const SegmentFitOptions& options, Chain& chain)
    : Segmented(image, options.Arrays())
    , Options(options)
    , Outer(chain)
    , Fitted(this->Segmented.Parts.size())
    , BoxRounds(this->Segmented.Parts.size())
  {
    const double* range = this->Segmented.Values()->GetRange(0);
    this->Range = range[1] - range[0];
  }

  /// Sentences for the user.
  std::vector<std::string> Fit(double from, double to);
  SegmentFits Join(vtkTable* rounds, double at) const;

private:
  std::vector<Unit> FindUnits() const;
  int Fewest(std::int32_t number) const;
  std::vector<const FilledDomains*> DomainsOf(std::int32_t number) const;
  SegmentFitOptions OptionsFor(const Part& part, int controlPoints) const;
  void FitBox(std::int32_t number, const Limits& limits);
  DomainFit FitCubes(const Unit& unit, const FilledDomains& domains, const Limits& limits) const;
  double BoxError(const Unit& unit, double part) const;
  std::string TryCubes(
    const Unit& unit, const FilledDomains& domains, double from, double to) const;
  std::string ImproveOverCubes(
    const Unit& unit, const std::vector<const FilledDomains*>& candidates, const Limits& limits);
  vtkIdType CountPoints(const Unit& unit) const;
  void FitUnit(const Unit& unit, const std::vector<int>& controlPoints, double from, double to);

  SegmentedImage Segmented;
  const SegmentFitOptions& Options;
  Chain& Outer;
  std::vector<FittedPart> Fitted;                   // of each part
  std::vector<vtkSmartPointer<vtkTable>> BoxRounds; // of each part that was fitted over its box
  double Range;                                     // of the first array over the whole image
  std::vector<std::string> Warnings;
};

//------------------------------------------------------------------------------
// Those that it is to be fitted over. The lowest label takes what others miss, and has none.
std::vector<const FilledDomains*> SegmentFitter::DomainsOf(std::int32_t number) const
{
  std::vector<const FilledDomains*> found;
  for (const FilledDomains& domains : this->Options.Domains)
  {
    if (number > 0 && domains.BlocksOf.count(this->Segmented.Parts[number].Label) > 0)
    {
      found.push_back(&domains);
    }
  }
  return found;
}

//------------------------------------------------------------------------------
// Those with common faces in the first domains, and all others by themselves.
std::vector<Unit> SegmentFitter::FindUnits() const
{
  std::vector<Unit> units;
  std::vector<char> isTaken(this->Segmented.Parts.size(), 0);
  if (!this->Options.Domains.empty() && this->Segmented.Parts.size() > 1)
  {
    for (const std::set<int>& team :
      TouchingSegments(this->Options.Domains.front(), this->Segmented.Parts[1].Label))
    {
      Unit unit;
      for (std::size_t p = 1; p < this->Segmented.Parts.size(); ++p)
      {
        if (team.count(this->Segmented.Parts[p].Label) > 0)
        {
          unit.push_back(static_cast<std::int32_t>(p));
          isTaken[p] = 1;
        }
      }
      units.push_back(unit);
    }
  }
  for (std::size_t p = 0; p < this->Segmented.Parts.size(); ++p)
  {
    if (!isTaken[p])
    {
      units.push_back({ static_cast<std::int32_t>(p) });
    }
  }
  return units;
}

//------------------------------------------------------------------------------
// Over a domain that is wanted every block needs some.
int SegmentFitter::Fewest(std::int32_t number) const
{
  int blocks = 1;
  for (const FilledDomains& domains : this->Options.Domains)
  {
    const auto domain = domains.BlocksOf.find(this->Segmented.Parts[number].Label);
    const bool isWanted = !this->Options.Compared && domain != domains.BlocksOf.end();
    blocks = std::max(blocks, isWanted ? domain->second : 1);
  }
  return FewestControlPoints * blocks;
}

//------------------------------------------------------------------------------
SegmentFitOptions SegmentFitter::OptionsFor(const Part& part, int controlPoints) const
{
  SegmentFitOptions own = this->Options;
  own.MaximumControlPoints = controlPoints;
  own.RmsTolerance = std::min(100.0, this->Segmented.ToleranceIn(part, own.RmsTolerance));
  return own;
}

//------------------------------------------------------------------------------
void SegmentFitter::FitBox(std::int32_t number, const Limits& limits)
{
  const Part& part = this->Segmented.Parts[number];
  this->Fitted[number] = FitOverBox(CutOut(this->Segmented, { number }), part,
    this->OptionsFor(part, limits.ControlPoints), this->Outer, limits.From, limits.To);
  this->BoxRounds[number] = this->Fitted[number].Rounds;
}

//------------------------------------------------------------------------------
DomainFit SegmentFitter::FitCubes(
  const Unit& unit, const FilledDomains& domains, const Limits& limits) const
{
  const Part whole = UniteParts(this->Segmented.Parts, unit);
  SegmentFitOptions own = this->OptionsFor(whole, limits.ControlPoints);
  own.LargestShapeDistance = limits.ShapeDistance;
  return FitOverDomain(this->Segmented, unit, domains, own, this->Outer, limits.From, limits.To);
}

//------------------------------------------------------------------------------
// Squared, of a voxel of a unit over boxes with a part of the control points that they took.
double SegmentFitter::BoxError(const Unit& unit, double part) const
{
  double squares = 0.0, voxels = 0.0;
  for (const std::int32_t number : unit)
  {
    vtkTable* rounds = this->BoxRounds[number];
    const Part& segment = this->Segmented.Parts[number];
    const double points = part * static_cast<double>(LastControlPoints(rounds));
    const double error = RmsWith(rounds, points) / 100.0 * (segment.High - segment.Low);
    const PartNumbers& of = this->Segmented.PartOf;
    const auto count = static_cast<double>(std::count(of.begin(), of.end(), number));
    squares += error * error * count;
    voxels += count;
  }
  return squares / voxels;
}

//------------------------------------------------------------------------------
// Why a fit over cubes is not worth its time; empty: it may be.
std::string SegmentFitter::TryCubes(
  const Unit& unit, const FilledDomains& domains, double from, double to) const
{
  double all = 0.0, needed = 0.0;
  for (const std::int32_t number : unit)
  {
    all += static_cast<double>(LastControlPoints(this->BoxRounds[number]));
    needed += FewestControlPoints * domains.BlocksOf.at(this->Segmented.Parts[number].Label);
  }
  const double few = std::max(TrialPart * all, needed);
  if (few > MostOfTrial * all)
  {
    return "";
  }
  const DomainFit trial =
    this->FitCubes(unit, domains, { static_cast<int>(few), from, to, MostTrialDistance });
  const double most = std::pow(1.0 - LeastTrialGain, 2) * this->BoxError(unit, few / all);
  if (trial.Why.empty() && trial.Error >= most)
  {
    return "boxes are as good with " + std::to_string(static_cast<int>(few)) + " control points.";
  }
  return trial.Why;
}

//------------------------------------------------------------------------------
// Takes the best fit of a unit over cubes in place of what there is for its parts, if that is less
// accurate; voxels that it misses then are those of part 0. Says why there is none.
std::string SegmentFitter::ImproveOverCubes(
  const Unit& unit, const std::vector<const FilledDomains*>& candidates, const Limits& limits)
{
  const bool isCompared = this->BoxRounds[unit.front()] != nullptr;
  // Squared error of a voxel.
  double least = isCompared ? this->BoxError(unit, 1.0) : std::numeric_limits<double>::infinity();
  const double each = (limits.To - limits.From) / static_cast<double>(candidates.size());
  std::vector<vtkIdType> missed;
  const FilledDomains* chosen = nullptr;
  std::string why;
  for (std::size_t i = 0; i < candidates.size(); ++i)
  {
    double begin = limits.From + each * static_cast<double>(i);
    const double end = begin + each;
    DomainFit cubes;
    if (isCompared)
    {
      const double tried = begin + ShareOfTrial * each;
      cubes.Why = this->TryCubes(unit, *candidates[i], begin, tried);
      begin = tried;
    }
    if (cubes.Why.empty())
    {
      cubes = this->FitCubes(unit, *candidates[i], { limits.ControlPoints, begin, end });
    }
    if (cubes.Why.empty() && cubes.Error >= least)
    {
      cubes.Why = "boxes are more accurate with as many control points.";
    }
    if (cubes.Why.empty())
    {
      for (std::size_t n = 0; n < unit.size(); ++n)
      {
        this->Fitted[unit[n]] = std::move(cubes.Fitted[n]);
      }
      missed = std::move(cubes.Missed);
      least = cubes.Error;
      chosen = candidates[i];
    }
    why = why.empty() ? cubes.Why : why;
  }
  for (const vtkIdType voxel : missed)
  {
    this->Segmented.GiveToFirst(voxel);
  }
  if (chosen && chosen != candidates.front() && !why.empty())
  {
    this->Warnings.push_back("Segment " +
                             std::to_string(this->Segmented.Parts[unit.front()].Label) +
                             " is fitted over cubes without layers: with layers, " + why);
  }
  return chosen ? "" : why;
}

//------------------------------------------------------------------------------
// Each over its box; all together over their cubes if that is better; or else each over its own.
void SegmentFitter::FitUnit(
  const Unit& unit, const std::vector<int>& controlPoints, double from, double to)
{
  const auto domains = this->DomainsOf(unit.front());
  const double boxed = domains.empty() ? to : from + ShareOfBoxes * (to - from);
  const double perBox = (boxed - from) / static_cast<double>(unit.size());
  for (std::size_t n = 0; n < unit.size() && (domains.empty() || this->Options.Compared); ++n)
  {
    const double begin = from + perBox * static_cast<double>(n);
    this->FitBox(unit[n], { controlPoints[n], begin, begin + perBox });
  }
  double at = boxed;
  if (unit.size() > 1)
  {
    at = boxed + ShareOfUnion * (to - boxed);
    const int all = std::accumulate(controlPoints.begin(), controlPoints.end(), 0);
    const std::string why = this->ImproveOverCubes(unit, { domains.front() }, { all, boxed, at });
    if (why.empty())
    {
      return;
    }
    std::string labels;
    for (std::size_t n = 0; n < unit.size(); ++n)
    {
      labels += n == 0 ? "" : n + 1 == unit.size() ? " and " : ", ";
      labels += std::to_string(this->Segmented.Parts[unit[n]].Label);
    }
    this->Warnings.push_back(
      "Segments " + labels + " are not fitted together over common faces: " + why);
  }
  const double perPart = (to - at) / static_cast<double>(unit.size());
  for (std::size_t n = 0; n < unit.size(); ++n)
  {
    const double begin = at + perPart * static_cast<double>(n);
    const auto own = this->DomainsOf(unit[n]);
    const std::string why =
      this->ImproveOverCubes({ unit[n] }, own, { controlPoints[n], begin, begin + perPart });
    if (!why.empty())
    {
      this->Warnings.push_back("Segment " + std::to_string(this->Segmented.Parts[unit[n]].Label) +
                               " is fitted over its bounding box: " + why);
    }
    if (!this->Fitted[unit[n]].Rounds)
    {
      this->FitBox(unit[n], { controlPoints[n], begin + perPart, begin + perPart });
    }
  }
}

//------------------------------------------------------------------------------
std::vector<std::string> SegmentFitter::Fit(double from, double to)
{
  const std::vector<double> shares =
    FindShares(this->Segmented, SMPExecution(this->Outer.Filter, from, from + ShareOfShares));
  std::vector<Unit> units = this->FindUnits();
  const auto shareOf = [&shares](const Unit& unit)
  {
    return std::accumulate(unit.begin(), unit.end(), 0.0,
      [&shares](double sum, std::int32_t number) { return sum + shares[number]; });
  };
  // Those with a small share first, the lowest label last: it gets the voxels that others miss.
  std::stable_sort(units.begin(), units.end(),
    [&shareOf](const Unit& a, const Unit& b)
    {
      return a.front() == 0 || b.front() == 0 ? b.front() == 0 && a.front() != 0
                                              : shareOf(a) < shareOf(b);
    });
  double left = this->Options.MaximumControlPoints, open = 1.0, reserved = 0.0;
  for (const std::int32_t number : this->Segmented.AllParts())
  {
    reserved += this->Fewest(number);
  }
  if (const auto& domains = this->Options.Domains;
      !this->Options.Compared && !domains.empty() &&
      domains.front().BlocksOf.count(this->Segmented.Parts[0].Label) > 0)
  {
    this->Warnings.push_back("Segment " + std::to_string(this->Segmented.Parts[0].Label) +
                             " is fitted over its bounding box: the lowest label takes the voxels "
                             "that others miss.");
  }
  double at = from + ShareOfShares;
  const double width = to - at;
  for (const Unit& unit : units)
  {
    // As many as their shares, but those after them must have some.
    std::vector<int> controlPoints;
    double mine = 0.0;
    for (const std::int32_t number : unit)
    {
      reserved -= this->Fewest(number);
      const double most = left - mine - reserved;
      const double wanted = open > 0.0 ? std::min(most, left * shares[number] / open) : most;
      controlPoints.push_back(std::max(this->Fewest(number), static_cast<int>(wanted)));
      mine += controlPoints.back();
    }
    const double share = shareOf(unit);
    this->FitUnit(unit, controlPoints, at, at + width * share);
    at += width * share;
    open -= share;
    left -= static_cast<double>(this->CountPoints(unit));
  }
  return std::move(this->Warnings);
}

//------------------------------------------------------------------------------
// Distinct ones; those of a fit of several are the first one's.
vtkIdType SegmentFitter::CountPoints(const Unit& unit) const
{
  vtkIdType count = 0;
  for (const std::int32_t number : unit)
  {
    const FittedPart& fitted = this->Fitted[number];
    count +=
      fitted.Together == this->Segmented.Parts[number].Label ? LastControlPoints(fitted.Rounds) : 0;
  }
  return count;
}

//------------------------------------------------------------------------------
SegmentFits SegmentFitter::Join(vtkTable* rounds, double at) const
{
  SegmentFits whole{ {}, 0, 0.0 };
  const bool isSingle = this->Options.Further.empty();
  std::vector<TSplineModel> models; // of the parts, where several arrays are to be compared
  double squares = 0.0;
  for (std::size_t p = 0; p < this->Segmented.Parts.size(); ++p)
  {
    whole.Model = JoinParts(whole.Model, this->Fitted[p].Model);
    squares += this->Fitted[p].Squares;
    whole.ControlPoints += this->CountPoints({ static_cast<std::int32_t>(p) });
    AddRounds(this->Fitted[p], this->Segmented.Parts[p].Label, isSingle, rounds);
    models.push_back(this->Fitted[p].Model);
  }
  vtkDataArray* labels = this->Segmented.Image->GetPointData()->GetArray("Segment");
  for (vtkIdType voxel = 0; voxel < labels->GetNumberOfTuples(); ++voxel)
  {
    labels->SetTuple1(voxel, this->Segmented.Parts[this->Segmented.PartOf[voxel]].Label);
  }
  if (!isSingle)
  {
    whole.RmsPercent = WorstRms(this->Segmented, models, this->Outer, at);
  }
  else if (this->Range > 0.0)
  {
    const auto voxels = static_cast<double>(labels->GetNumberOfTuples());
    whole.RmsPercent = 100.0 * std::sqrt(squares / voxels) / this->Range;
  }
  return whole;
}
}

//------------------------------------------------------------------------------
SegmentFits FitSegments(vtkImageData* image, const SegmentFitOptions& options, vtkTable* rounds,
  std::vector<std::string>& why, Chain& chain, double from, double to)
{
  SegmentFitter fitter(image, options, chain);
  why = fitter.Fit(from, to);
  return fitter.Join(rounds, to);
}
}
