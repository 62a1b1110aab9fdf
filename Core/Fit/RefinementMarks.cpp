// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "RefinementMarks.h"

#include "TSpline/BlendingFunctionMap.h"

#include <algorithm>

namespace trivariate
{
namespace
{
// Small steps choose better, large ones are faster. A small spline is cheap to solve and decides
// where all else goes, so up to this size its steps are small, and the last of them may be as small
// as it likes.
constexpr Index LargeSize = 9000;

// How many marks that bring more functions than there is room for may be passed over.
constexpr int MostLeftOut = 8;

// Up to this many control points wanted in all, a round costs so little that steps are smaller yet:
// what a step chooses badly is a large share of a small spline. Measured on the volumes in
// Documentation/Results.md; where more are wanted, smaller steps at the start bring nothing.
constexpr double SmallMaximum = 4000.0;

// How many functions one round may add.
Index StepOf(Index size, Index maximum)
{
  const double growth = std::clamp(static_cast<double>(size) / LargeSize, 0.15, 0.5) *
                        std::clamp(maximum / SmallMaximum, 0.4, 1.0);
  return std::max<Index>(32, static_cast<Index>(growth * size));
}

// The best gains first, at most `count` of them; equal gains in the order of the functions.
void KeepLargest(std::vector<SplitGain>& gains, Index count)
{
  const auto better = [](const SplitGain& a, const SplitGain& b)
  {
    return std::tie(b.SquaredError, a.Function, a.Direction, a.Knot) <
           std::tie(a.SquaredError, b.Function, b.Direction, b.Knot);
  };
  if (count < static_cast<Index>(gains.size()))
  {
    std::nth_element(gains.begin(), gains.begin() + count, gains.end(), better);
    gains.resize(count);
  }
  std::sort(gains.begin(), gains.end(), better);
}

// One mark for each knot face: functions in line share their cross-section and so the face.
std::vector<RefinementMark> DistinctMarks(
  const std::vector<SplitGain>& gains, const TSpline& spline, Index count)
{
  std::vector<RefinementMark> marks;
  BlendingFunctionMap faces;
  for (const SplitGain& gain : gains)
  {
    BlendingFunction face = spline.Functions[gain.Function];
    face[gain.Direction] = { -1, gain.Knot, gain.Knot, gain.Knot, gain.Knot };
    if (gain.SquaredError > 0.0 && faces.Insert(face, 0).second)
    {
      marks.push_back({ gain.Function, gain.Direction, gain.Knot });
      if (static_cast<Index>(marks.size()) == count)
      {
        break;
      }
    }
  }
  return marks;
}
}

//------------------------------------------------------------------------------
bool RefinementMarks::IsFull(Index size, Index maximum)
{
  return maximum - size <= maximum / 100;
}

//------------------------------------------------------------------------------
bool RefinementMarks::Refine(std::vector<SplitGain> gains, Index maximum, TSpline& spline,
  std::unique_ptr<RefinementRule>& rule)
{
  const Index size = this->Count(spline);
  if (IsFull(size, maximum))
  {
    return false;
  }
  const Index step = StepOf(size, maximum);
  const Index limit = std::min(maximum, size + step + step / 4);
  // Aim a little below the maximum, for a trial that exceeds it is lost.
  const Index wanted = std::min(size + step, maximum - maximum / 200) - size;
  // Up to four functions in line ask for the same face.
  KeepLargest(gains, 4 * wanted);
  std::vector<RefinementMark> all = DistinctMarks(gains, spline, wanted);
  int leftOut = 0;
  const auto scaled = [&all](double count)
  { return static_cast<Index>(std::clamp<double>(count, 1.0, static_cast<double>(all.size()))); };
  Index count = all.empty() ? 0 : scaled(wanted / this->FunctionsPerMark);
  TSpline best;
  std::unique_ptr<RefinementRule> bestRule;
  for (Index fits = 0; count > fits;)
  {
    TSpline trial = spline;
    std::unique_ptr<RefinementRule> trialRule = rule->Clone();
    trialRule->Refine(trial, { all.begin(), all.begin() + count });
    const Index grown = this->Count(trial) - size;
    if (grown > 0)
    {
      this->FunctionsPerMark = static_cast<double>(grown) / count;
    }
    // A single mark may grow more than a step (never more than the maximum allows).
    if (size + grown > (count == 1 ? maximum : limit))
    {
      if (count == 1 && fits == 0 && ++leftOut < MostLeftOut && all.size() > 1)
      {
        all.erase(all.begin()); // alone too many
        continue;
      }
      count = fits > 0 ? 0 : std::min(count - 1, scaled(0.95 * count * wanted / grown));
      continue;
    }
    fits = count;
    best = std::move(trial);
    bestRule = std::move(trialRule);
    // Where marks are cheaper than rounds, the step to the maximum is made in one.
    const bool isLastStep = size > LargeSize && size + wanted >= maximum - maximum / 200;
    if (grown == 0 || !isLastStep || IsFull(size + grown, maximum))
    {
      break;
    }
    count = scaled(count * static_cast<double>(wanted) / grown);
  }
  if (best.Size() <= spline.Size())
  {
    return false;
  }
  spline = std::move(best);
  rule = std::move(bestRule);
  return true;
}
}
