// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "SegmentField.h"

#include "FrameStart.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace trivariate
{
namespace
{
bool HasAllSides(const FrameLevel& level)
{
  std::array<bool, 6> has = {};
  for (const FrameConstraint& constraint : level.Constraints)
  {
    if (constraint.Side != AnyAxis)
    {
      has[constraint.Side] = true;
    }
  }
  return std::all_of(has.begin(), has.end(), [](bool b) { return b; });
}

// The coarsest level shows the hand, at next to no cost.
void CheckHand(const std::vector<FrameLevel>& levels, const Execution& execution)
{
  if (!levels[0].IsLabelled() || !HasAllSides(levels[0]))
  {
    return;
  }
  const int coarsest = static_cast<int>(levels.size()) - 1;
  const double share = HarmonicCoordinateFrames(levels, coarsest, execution).LeftHanded;
  if (share > 0.5)
  {
    throw std::invalid_argument(
      "The axes and sides of its patches are left-handed: the parameters u, v, w grow along a left "
      "hand in " +
      std::to_string(std::lround(100.0 * share)) +
      " % of its volume. Exchange low and high side of one axis.");
  }
}

FrameList StartFrames(
  FieldStart start, const std::vector<FrameLevel>& levels, int level, const Execution& execution)
{
  switch (start)
  {
    case FieldStart::Constant:
      return ConstantFrames(levels[level]);
    case FieldStart::HarmonicCoordinates:
      return HarmonicCoordinateFrames(levels, level, execution).Frames;
    default:
      return LinearFrames(levels, level, execution);
  }
}
}

//------------------------------------------------------------------------------
SegmentField ComputeSegmentField(FrameVoxels voxels, std::vector<FrameConstraint> constraints,
  const FieldOptions& options, const Execution& execution)
{
  std::vector<FrameLevel> levels =
    MakeFrameLevels(std::move(voxels), std::move(constraints), 300, execution.Part(0.0, 0.02));
  const double begin = options.CoarseToFine ? 0.1 : 0.5, end = 0.9;
  CheckHand(levels, execution.Part(0.02, 0.05));
  const int from = options.CoarseToFine ? static_cast<int>(levels.size()) - 1 : 0;
  SegmentField field;
  field.Frames = StartFrames(options.Start, levels, from, execution.Part(0.05, begin));
  SmoothingOptions smoothing = options.Smoothing;
  if (options.ChooseStep)
  {
    const SmoothingOptions chosen = DefaultSmoothing(levels[0]);
    smoothing.Step = chosen.Step;
    smoothing.Jumps = chosen.Jumps;
  }
  const Execution sweeps = execution.Part(begin, end);
  field.Records = options.CoarseToFine ? SmoothCoarseToFine(levels, smoothing, field.Frames, sweeps)
                                       : SmoothFrames(levels[0], smoothing, field.Frames, sweeps);
  field.Alignment = AlignmentError(levels[0], field.Frames);
  field.Graph = FindSingularGraph(levels[0], field.Frames, false, execution.Part(end, 1.0));
  field.Voxels = std::move(levels[0].Voxels);
  return field;
}

//------------------------------------------------------------------------------
double FieldBytesPerVoxel(const FieldOptions& options)
{
  constexpr double levels = 63.0, finestStart = 72.0 * sizeof(double);
  return levels +
         (options.CoarseToFine || options.Start == FieldStart::Constant ? 0.0 : finestStart);
}
}
