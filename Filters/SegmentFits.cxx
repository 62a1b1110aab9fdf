// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "SegmentFits.h"

#include "ChainStep.h"
#include "DomainFit.h"
#include "DomainSamples.h"
#include "SMPExecution.h"
#include "SegmentCut.h"
#include "TSplineGrid.h"
#include "vtkTSplineFit.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkTable.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <set>
#include <stdexcept>

namespace trivariate
{
namespace
{
constexpr int FewestControlPoints = 64;
constexpr double ShareOfShares = 0.02; // of the progress: to look what each segment needs
constexpr double ShareOfBoxes = 0.2;   // of a unit's progress: the fits over boxes
constexpr double ShareOfUnion = 0.5;   // of what is left then: several segments in one fit
constexpr double ShareOfErrors = 0.1;  // of a fit over cubes: its errors
constexpr double MostMissed = 0.02;    // of a unit's voxels by a spline over a domain

// Segments that are to be fitted at once, by the numbers of their parts: one, or several with
// common faces.
using Unit = std::vector<std::int32_t>;

struct Limits
{
  int ControlPoints;
  double From, To; // of the progress
};

//------------------------------------------------------------------------------
class SegmentFitter
{
public:
  SegmentFitter(vtkImageData* image, const SegmentFitOptions& options, Chain& chain)
    : Image(image)
    , Options(options)
    , Outer(chain)
    , Values(image->GetPointData()->GetArray(options.Array.c_str()))
    , Parts(FindParts(image, this->Values, this->PartOf))
    , Fitted(this->Parts.size())
  {
    this->Arrays.push_back(options.Array);
    this->Arrays.insert(this->Arrays.end(), options.Further.begin(), options.Further.end());
    const double* range = this->Values->GetRange(0);
    this->Range = range[1] - range[0];
  }

  /// Sentences for the user.
  std::vector<std::string> Fit(double from, double to);
  SegmentFits Join(vtkTable* rounds) const;

private:
  struct CubesFit
  {
    std::vector<FittedPart> Fitted; // of each part of the unit
    std::vector<vtkIdType> Missed;  // voxels that the spline does not pass through
    double Error = 0.0;             // squared, of a voxel that is not missed
    std::string Why;                // there is none; empty: there is one
  };

  std::vector<Unit> FindUnits() const;
  int Fewest(std::int32_t number) const;
  std::vector<const FilledDomains*> DomainsOf(std::int32_t number) const;
  SegmentFitOptions OptionsFor(const Part& part, int controlPoints) const;
  FittedPart FitBox(std::int32_t number, const Limits& limits) const;
  CubesFit FitCubes(const Unit& unit, const FilledDomains& domains, const Limits& limits) const;
  std::string ImproveOverCubes(
    const Unit& unit, const std::vector<const FilledDomains*>& candidates, const Limits& limits);
  vtkIdType CountPoints(const Unit& unit) const;
  void FitUnit(const Unit& unit, const std::vector<int>& controlPoints, double from, double to);

  vtkImageData* Image;
  const SegmentFitOptions& Options;
  Chain& Outer;
  vtkDataArray* Values;
  std::vector<std::int32_t> PartOf; // of each voxel
  std::vector<Part> Parts;
  std::vector<FittedPart> Fitted;  // of each part
  std::vector<std::string> Arrays; // to fit
  double Range;                    // of the first one over the whole image
  std::vector<std::string> Warnings;
};

//------------------------------------------------------------------------------
// Those that it is to be fitted over. The lowest label takes what others miss, and has none.
std::vector<const FilledDomains*> SegmentFitter::DomainsOf(std::int32_t number) const
{
  std::vector<const FilledDomains*> found;
  for (const FilledDomains& domains : this->Options.Domains)
  {
    if (number > 0 && domains.BlocksOf.count(this->Parts[number].Label) > 0)
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
  std::vector<char> isTaken(this->Parts.size(), 0);
  if (!this->Options.Domains.empty() && this->Parts.size() > 1)
  {
    for (const std::set<int>& team :
      TouchingSegments(this->Options.Domains.front(), this->Parts[1].Label))
    {
      Unit unit;
      for (std::size_t p = 1; p < this->Parts.size(); ++p)
      {
        if (team.count(this->Parts[p].Label) > 0)
        {
          unit.push_back(static_cast<std::int32_t>(p));
          isTaken[p] = 1;
        }
      }
      units.push_back(unit);
    }
  }
  for (std::size_t p = 0; p < this->Parts.size(); ++p)
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
    const auto domain = domains.BlocksOf.find(this->Parts[number].Label);
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
  const double range = part.High - part.Low;
  own.RmsTolerance = range > 0.0 ? std::min(100.0, own.RmsTolerance * this->Range / range) : 0.0;
  return own;
}

//------------------------------------------------------------------------------
FittedPart SegmentFitter::FitBox(std::int32_t number, const Limits& limits) const
{
  const Part& part = this->Parts[number];
  return FitOverBox(CutOut(this->Image, this->Parts, { number }, this->PartOf, this->Arrays), part,
    this->OptionsFor(part, limits.ControlPoints), this->Outer, limits.From, limits.To);
}

//------------------------------------------------------------------------------
SegmentFitter::CubesFit SegmentFitter::FitCubes(
  const Unit& unit, const FilledDomains& domains, const Limits& limits) const
{
  CubesFit cubes;
  const Part whole = UniteParts(this->Parts, unit);
  const Cut cut = CutOut(this->Image, this->Parts, unit, this->PartOf, this->Arrays);
  for (const char* name : { ParameterArrayName, ParameterMaskName })
  {
    AddCropped(domains.Fields, domains.Fields->GetPointData()->GetArray(name), cut.Image);
  }
  std::set<int> labels;
  for (const std::int32_t number : unit)
  {
    labels.insert(this->Parts[number].Label);
  }
  double at = limits.To - ShareOfErrors * (limits.To - limits.From);
  FittedPart fitted;
  try
  {
    fitted = FitOverDomain(domains, cut.Image, CutMaskName, labels,
      this->OptionsFor(whole, limits.ControlPoints), this->Outer, limits.From, at);
  }
  catch (const std::runtime_error& reason)
  {
    cubes.Why = reason.what();
    return cubes;
  }
  fitted.Together = whole.Label;
  fitted.Range = whole.High - whole.Low;
  const auto all = static_cast<double>(cut.Voxels.size());
  double squares = 0.0;
  for (const std::int32_t number : unit)
  {
    FittedPart& part = cubes.Fitted.emplace_back(fitted);
    part.Model = SegmentPart(fitted.Model, this->Parts[number].Label);
    std::vector<vtkIdType> voxels;
    std::copy_if(cut.Voxels.begin(), cut.Voxels.end(), std::back_inserter(voxels),
      [&](vtkIdType voxel) { return this->PartOf[voxel] == number; });
    const double next = at + (limits.To - at) * static_cast<double>(voxels.size()) / all;
    const PartErrors errors =
      MeasurePart(this->Image, this->Options.Array, part.Model, voxels, this->Outer, at, next);
    at = next;
    part.Squares = errors.Squares;
    squares += errors.Squares;
    cubes.Missed.insert(cubes.Missed.end(), errors.Missed.begin(), errors.Missed.end());
    if (double(errors.Missed.size()) > MostMissed * double(voxels.size()))
    {
      cubes.Why = "the spline over cubes misses " + std::to_string(errors.Missed.size()) + " of " +
                  std::to_string(voxels.size()) + " voxels.";
    }
  }
  cubes.Error = squares / (all - static_cast<double>(cubes.Missed.size()));
  return cubes;
}

//------------------------------------------------------------------------------
// Takes the best fit of a unit over cubes in place of what there is for its parts, if that is less
// accurate; voxels that it misses then are those of part 0. Says why there is none.
std::string SegmentFitter::ImproveOverCubes(
  const Unit& unit, const std::vector<const FilledDomains*>& candidates, const Limits& limits)
{
  double least = std::numeric_limits<double>::infinity(); // squared error of a voxel
  if (this->Fitted[unit.front()].Rounds)
  {
    double squares = 0.0, voxels = 0.0;
    for (const std::int32_t number : unit)
    {
      squares += this->Fitted[number].Squares;
      voxels += static_cast<double>(std::count(this->PartOf.begin(), this->PartOf.end(), number));
    }
    least = squares / voxels;
  }
  const double each = (limits.To - limits.From) / static_cast<double>(candidates.size());
  std::vector<vtkIdType> missed;
  bool isOverCubes = false;
  std::string why;
  for (std::size_t i = 0; i < candidates.size(); ++i)
  {
    const double begin = limits.From + each * static_cast<double>(i);
    CubesFit cubes =
      this->FitCubes(unit, *candidates[i], { limits.ControlPoints, begin, begin + each });
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
      isOverCubes = true;
    }
    why = why.empty() ? cubes.Why : why;
  }
  for (const vtkIdType voxel : missed)
  {
    this->PartOf[voxel] = 0;
  }
  if (isOverCubes && !why.empty() && this->Fitted[unit.front()].Domain == "Cubes")
  {
    this->Warnings.push_back("Segment " + std::to_string(this->Parts[unit.front()].Label) +
                             " is fitted over cubes without layers: with layers, " + why);
  }
  return isOverCubes ? "" : why;
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
    this->Fitted[unit[n]] = this->FitBox(unit[n], { controlPoints[n], begin, begin + perBox });
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
    for (const std::int32_t number : unit)
    {
      labels += (labels.empty()           ? ""
                  : number == unit.back() ? " and "
                                          : ", ") +
                std::to_string(this->Parts[number].Label);
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
      this->Warnings.push_back("Segment " + std::to_string(this->Parts[unit[n]].Label) +
                               " is fitted over its bounding box: " + why);
    }
    if (!this->Fitted[unit[n]].Rounds)
    {
      this->Fitted[unit[n]] =
        this->FitBox(unit[n], { controlPoints[n], begin + perPart, begin + perPart });
    }
  }
}

//------------------------------------------------------------------------------
std::vector<std::string> SegmentFitter::Fit(double from, double to)
{
  const std::vector<double> shares = FindShares(this->Image, this->Values, this->PartOf,
    this->Parts.size(), SMPExecution(this->Outer.Filter, from, from + ShareOfShares));
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
  for (std::size_t p = 0; p < this->Parts.size(); ++p)
  {
    reserved += this->Fewest(static_cast<std::int32_t>(p));
  }
  if (const auto& domains = this->Options.Domains;
      !this->Options.Compared && !domains.empty() &&
      domains.front().BlocksOf.count(this->Parts[0].Label) > 0)
  {
    this->Warnings.push_back("Segment " + std::to_string(this->Parts[0].Label) +
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
    count += fitted.Together == this->Parts[number].Label ? LastControlPoints(fitted.Rounds) : 0;
  }
  return count;
}

//------------------------------------------------------------------------------
SegmentFits SegmentFitter::Join(vtkTable* rounds) const
{
  SegmentFits whole{ {}, 0, 0.0 };
  double squares = 0.0;
  for (std::size_t p = 0; p < this->Parts.size(); ++p)
  {
    whole.Model = JoinParts(whole.Model, this->Fitted[p].Model);
    squares += this->Fitted[p].Squares;
    whole.ControlPoints += this->CountPoints({ static_cast<std::int32_t>(p) });
    AddRounds(this->Fitted[p], this->Parts[p].Label, rounds);
  }
  vtkDataArray* labels = this->Image->GetPointData()->GetArray("Segment");
  for (vtkIdType voxel = 0; voxel < this->Image->GetNumberOfPoints(); ++voxel)
  {
    labels->SetTuple1(voxel, this->Parts[this->PartOf[voxel]].Label);
  }
  if (this->Range > 0.0)
  {
    const auto voxels = static_cast<double>(this->Image->GetNumberOfPoints());
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
  return fitter.Join(rounds);
}
}
