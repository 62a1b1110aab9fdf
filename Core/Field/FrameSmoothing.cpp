// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "FrameSmoothing.h"

#include "FrameSteps.h"

#include <algorithm>
#include <cmath>

namespace trivariate
{
using Eigen::Matrix3d;
using Eigen::Quaterniond;

namespace
{
// Voxels whose energies are added up in one order, so that no sum depends on the threads.
constexpr Index BlockSize = 4096;
// Blocks between two looks at the user's abort flag: below a second.
constexpr Index BlocksInARow = 64;

FrameEnergy& operator+=(FrameEnergy& sum, const FrameEnergy& term)
{
  sum.Harmonic += term.Harmonic;
  sum.Registered += term.Registered;
  return sum;
}

// The sum of visit(first, last) over the blocks of voxels in [begin, end).
template <typename Visit>
FrameEnergy VisitBlocks(Index begin, Index end, const Execution& execution, const Visit& visit)
{
  FrameEnergy sum;
  for (Index row = begin; row < end; row += BlockSize * BlocksInARow)
  {
    const Index last = std::min(end, row + BlockSize * BlocksInARow);
    std::vector<FrameEnergy> partial((last - row + BlockSize - 1) / BlockSize);
    execution.ParallelFor(static_cast<Index>(partial.size()),
      [&](Index from, Index to)
      {
        for (Index block = from; block < to; ++block)
        {
          const Index first = row + block * BlockSize;
          partial[block] = visit(first, std::min(last, first + BlockSize));
        }
      });
    for (const FrameEnergy& term : partial)
    {
      sum += term;
    }
    execution.Check(static_cast<double>(last - begin) / static_cast<double>(end - begin));
  }
  return sum;
}

FrameStar Gather(
  const FrameVoxels& voxels, const Eigen::Vector3d& weights, const FrameList& frames, Index v)
{
  FrameStar star;
  star.Own = frames[v].cast<double>().toRotationMatrix();
  for (int side = 0; side < 6; ++side)
  {
    const std::int32_t n = voxels.Neighbours[v][side];
    if (n >= 0)
    {
      star.Weights[star.Count] = weights[side / 2];
      star.Neighbours[star.Count++] = frames[n].cast<double>().toRotationMatrix();
    }
  }
  return star;
}

FrameEnergy EnergyOf(const FrameStar& star, bool jumps)
{
  FrameEnergy energy;
  for (int j = 0; j < star.Count; ++j)
  {
    const Matrix3d r = star.Own * star.Neighbours[j].transpose();
    energy.Harmonic += star.Weights[j] * 5.0 / 3.0 * (3.0 - r.array().square().square().sum());
    const double along =
      jumps ? CubeRotations()[MatchFrames(star.Neighbours[j], star.Own)].cwiseProduct(r).sum()
            : r.trace();
    energy.Registered += star.Weights[j] * 2.0 * (3.0 - along);
  }
  return energy;
}

// Beyond the best place: the rotation from here to there times about a factor; from 90 degrees on
// no farther than it goes itself.
Quaterniond Relax(const Quaterniond& rotation, double factor)
{
  const double sign = rotation.w() < 0.0 ? -1.0 : 1.0, w = sign * rotation.w();
  if (w < std::sqrt(0.5))
  {
    return rotation;
  }
  return Quaterniond(1.0 + factor * (w - 1.0), sign * factor * rotation.x(),
    sign * factor * rotation.y(), sign * factor * rotation.z());
}

Quaterniond BestRotation(const SmoothingOptions& options, const FrameStar& star)
{
  if (options.Step == FrameStep::Quartic)
  {
    return QuarticRotation(star);
  }
  return options.Jumps ? RegistrationRotation(star) : MeanRotation(star);
}

// One colour: [begin, end) of the voxels. Returns the energy before where it is the red one, whose
// neighbours make up all pairs.
FrameEnergy HalfSweep(const FrameLevel& level, const SmoothingOptions& options, double factor,
  Index begin, Index end, FrameList& frames, const Execution& execution)
{
  const Eigen::Vector3d weights = level.Voxels.PairWeights();
  return VisitBlocks(begin, end, execution,
    [&](Index first, Index last)
    {
      FrameEnergy before;
      auto bound = std::lower_bound(level.Bounds.begin(), level.Bounds.end(), first,
        [](const FrameBound& b, Index voxel) { return b.Voxel < voxel; });
      for (Index v = first; v < last; ++v)
      {
        const FrameStar star = Gather(level.Voxels, weights, frames, v);
        if (begin == 0)
        {
          before += EnergyOf(star, options.Jumps);
        }
        const Quaterniond own = frames[v].cast<double>();
        const bool isBound = bound != level.Bounds.end() && bound->Voxel == v;
        Quaterniond rotation = BestRotation(options, star);
        if (isBound)
        {
          // What lies beyond is sought among the frames that fit the constraint, too.
          rotation = bound->Apply(rotation * own) * own.conjugate();
        }
        Quaterniond next = (Relax(rotation, factor) * own).normalized();
        if (isBound)
        {
          next = bound->Apply(next);
          ++bound;
        }
        frames[v] = next.cast<float>();
      }
      return before;
    });
}
}

//------------------------------------------------------------------------------
SmoothingOptions DefaultSmoothing(const FrameLevel& level)
{
  SmoothingOptions options;
  options.Step = level.IsLabelled() ? FrameStep::Registration : FrameStep::Quartic;
  options.Jumps = !level.IsLabelled();
  return options;
}

//------------------------------------------------------------------------------
FrameEnergy MeasureFrames(
  const FrameLevel& level, const FrameList& frames, bool jumps, const Execution& execution)
{
  const Eigen::Vector3d weights = level.Voxels.PairWeights();
  // Each pair has one red voxel.
  return VisitBlocks(0, level.Voxels.Red, execution,
    [&](Index first, Index last)
    {
      FrameEnergy energy;
      for (Index v = first; v < last; ++v)
      {
        energy += EnergyOf(Gather(level.Voxels, weights, frames, v), jumps);
      }
      return energy;
    });
}

//------------------------------------------------------------------------------
std::vector<SweepRecord> SmoothFrames(const FrameLevel& level, const SmoothingOptions& options,
  FrameList& frames, const Execution& execution, int number)
{
  const Index red = level.Voxels.Red, all = level.Voxels.Count();
  const auto lowered = [&options](const FrameEnergy& energy)
  { return options.Step == FrameStep::Quartic ? energy.Harmonic : energy.Registered; };
  // The spectral radius for waves of 4/3 of a voxel a sweep: what coarser levels leave.
  const double radius = std::cos(1.5 * std::acos(0.0) / std::max(options.Sweeps, 2));
  double factor = 1.0;
  const auto nextFactor = [&](int halfSweeps)
  {
    if (options.Relaxed)
    {
      const double square = radius * radius;
      factor = halfSweeps == 1 ? 1.0 / (1.0 - 0.5 * square) : 1.0 / (1.0 - 0.25 * square * factor);
    }
  };
  std::vector<SweepRecord> records;
  ApplyBounds(level, frames);
  for (int sweep = 0; sweep < options.Sweeps; ++sweep)
  {
    const double from = static_cast<double>(sweep) / options.Sweeps, step = 0.5 / options.Sweeps;
    const FrameEnergy energy =
      HalfSweep(level, options, factor, 0, red, frames, execution.Part(from, from + step));
    nextFactor(2 * sweep + 1);
    HalfSweep(
      level, options, factor, red, all, frames, execution.Part(from + step, from + 2.0 * step));
    nextFactor(2 * sweep + 2);
    records.push_back({ number, sweep, energy });
    if (sweep > 0 &&
        lowered(energy) > (1.0 - options.Drop) * lowered(records[records.size() - 2].Energy))
    {
      break;
    }
  }
  records.push_back({ number, static_cast<int>(records.size()),
    MeasureFrames(level, frames, options.Jumps, execution.Part(1.0, 1.0)) });
  return records;
}

//------------------------------------------------------------------------------
std::vector<SweepRecord> SmoothCoarseToFine(const std::vector<FrameLevel>& levels,
  const SmoothingOptions& options, FrameList& frames, const Execution& execution)
{
  std::vector<SweepRecord> records;
  for (int level = static_cast<int>(levels.size()) - 1; level >= 0; --level)
  {
    SmoothingOptions here = options;
    here.Sweeps = options.Sweeps << std::min(level, 4);
    // Each level is about four times the work of the one before.
    const double begin = std::pow(0.25, level + 1), end = std::pow(0.25, level);
    const std::vector<SweepRecord> more =
      SmoothFrames(levels[level], here, frames, execution.Part(begin, end), level);
    records.insert(records.end(), more.begin(), more.end());
    if (level > 0)
    {
      frames = Prolong(levels[level - 1], levels[level], frames, execution);
    }
  }
  return records;
}
}
