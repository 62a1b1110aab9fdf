// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
// Frame fields on solids whose smoothest fields are known, or compared with the slow ways to them.
#include "Field/FrameSmoothing.h"
#include "Field/FrameStart.h"
#include "Field/SingularGraph.h"
#include "FrameShapes.h"
#include "ThreadedExecution.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <random>

namespace trivariate
{
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace
{
const Execution Alone;
constexpr double Degree = 57.29577951308232;

struct Field
{
  FrameList Frames;
  std::vector<SweepRecord> Records;
};

// The default: linear start on the coarsest level, then coarse to fine.
Field DefaultField(const std::vector<FrameLevel>& levels, const Execution& execution = Alone)
{
  Field field;
  field.Frames = LinearFrames(levels, static_cast<int>(levels.size()) - 1, execution);
  field.Records = SmoothCoarseToFine(levels, DefaultSmoothing(levels[0]), field.Frames, execution);
  return field;
}

// Sweeps on the finest level alone, to the best place each, until nothing is gained.
Field Converged(const FrameLevel& level, FrameStep step, bool jumps, FrameList start)
{
  SmoothingOptions options;
  options.Step = step;
  options.Jumps = jumps;
  options.Relaxed = false;
  options.Sweeps = 2000;
  options.Drop = 1e-6;
  Field field;
  field.Frames = std::move(start);
  field.Records = SmoothFrames(level, options, field.Frames, Alone);
  return field;
}

double HarmonicEnergy(const FrameLevel& level, const FrameList& frames)
{
  return MeasureFrames(level, frames, true, Alone).Harmonic;
}

// The energy of frames that keep their labels; a way that knows crosses only gets the labels that
// bring it closest to other frames.
double LabelledEnergy(const FrameLevel& level, const FrameList& frames)
{
  return MeasureFrames(level, frames, false, Alone).Registered;
}

FrameList NamedAfter(const FrameList& others, FrameList frames)
{
  for (std::size_t v = 0; v < frames.size(); ++v)
  {
    const Matrix3d frame = frames[v].cast<double>().toRotationMatrix();
    const Eigen::Quaterniond label(
      CubeRotations()[MatchFrames(frame, others[v].cast<double>().toRotationMatrix())]);
    frames[v] = (label * frames[v].cast<double>()).cast<float>();
  }
  return frames;
}

// The largest entry of the differences between frames and rows(voxel).
template <typename Rows>
double FarthestFrom(const FrameLevel& level, const FrameList& frames, const Rows& rows)
{
  double largest = 0.0;
  for (Index v = 0; v < level.Voxels.Count(); ++v)
  {
    const Matrix3d difference = frames[v].cast<double>().toRotationMatrix() - rows(v);
    largest = std::max(largest, difference.cwiseAbs().maxCoeff());
  }
  return largest;
}

// Which row is which is drawn anew for every voxel.
void MixLabels(FrameList& frames)
{
  std::mt19937 random(3);
  for (Eigen::Quaternionf& frame : frames)
  {
    const Eigen::Quaterniond label(CubeRotations()[random() % 24]);
    frame = (label * frame.cast<double>()).cast<float>();
  }
}

int FinestSweeps(const Field& field)
{
  return field.Records.back().Sweep;
}
}

//------------------------------------------------------------------------------
TEST(FrameField, BoxesHaveConstantFrames)
{
  for (const bool turned : { false, true })
  {
    const FrameShape shape = turned ? TurnedBox(32) : AlignedBox(32);
    const std::vector<FrameLevel> levels = LevelsOf(shape, true);
    Matrix3d rows;
    for (int a = 0; a < 3; ++a)
    {
      rows.row(a) = shape.Gradient(Vector3d::Zero(), a).normalized();
    }
    const Field field = DefaultField(levels);
    EXPECT_LT(FarthestFrom(levels[0], field.Frames, [&](Index) { return rows; }), 1e-6);
    EXPECT_EQ(FindSingularGraph(levels[0], field.Frames, true, Alone).Edges.size(), 0u);
  }
}

//------------------------------------------------------------------------------
// The slanted sides of a sheared box bind nothing; the others hold the frames straight.
TEST(FrameField, ShearedBoxHasConstantFrames)
{
  Matrix3d edges = Vector3d(16.0, 18.0, 20.0).asDiagonal();
  edges(0, 1) = 6.0;
  const std::vector<FrameLevel> levels = LevelsOf(AffineBox(32, edges), true, { 0, 1 });
  const Field field = DefaultField(levels);
  EXPECT_LT(
    FarthestFrom(levels[0], field.Frames, [](Index) { return Matrix3d::Identity(); }), 1e-6);
}

//------------------------------------------------------------------------------
TEST(FrameField, QuarterAnnulusHasPolarFrames)
{
  const FrameShape shape = QuarterAnnulus(32);
  const std::vector<FrameLevel> levels = LevelsOf(shape, true);
  const Field field = DefaultField(levels);
  double largest = 0.0;
  for (Index v = 0; v < levels[0].Voxels.Count(); ++v)
  {
    const std::array<Index, 3> p = levels[0].Voxels.Place(v);
    const Matrix3d frame = field.Frames[v].cast<double>().toRotationMatrix();
    for (int a = 0; a < 3; ++a)
    {
      const Vector3d there =
        shape.Gradient(Vector3d(p[0], p[1], p[2]), a).normalized().cross(frame.row(a).transpose());
      largest = std::max(largest, Degree * std::asin(std::min(1.0, there.norm())));
    }
  }
  EXPECT_LT(largest, 1.0);
  EXPECT_LT(AlignmentError(levels[0], field.Frames), 0.01);
}

//------------------------------------------------------------------------------
// The paper's Figure 2 in space. The frames of a ball with the labels of a cube turn by a quarter
// around the cube's edges, on the surface; with any axis at the normal they do it inside.
TEST(FrameField, LabelsKeepABallFreeOfSingularCurves)
{
  const std::vector<FrameLevel> labelled = LevelsOf(RoundBall(32), true);
  const Field aligned = DefaultField(labelled);
  const SingularGraph none = FindSingularGraph(labelled[0], aligned.Frames, false, Alone);
  EXPECT_EQ(none.Edges.size(), 0u);
  EXPECT_GT(none.Plaquettes, 10000);
  EXPECT_LT(AlignmentError(labelled[0], aligned.Frames), 0.01);
  // No neighbour is reached by a jump, but at the edges of the cube.
  const FrameEnergy plain = MeasureFrames(labelled[0], aligned.Frames, false, Alone);
  const FrameEnergy matched = MeasureFrames(labelled[0], aligned.Frames, true, Alone);
  EXPECT_NEAR(plain.Registered, matched.Registered, 1e-3 * plain.Registered);

  const std::vector<FrameLevel> open = LevelsOf(RoundBall(32), false);
  const Field unaligned = DefaultField(open);
  const SingularGraph graph = FindSingularGraph(open[0], unaligned.Frames, false, Alone);
  EXPECT_GT(graph.Edges.size(), 50u);
  EXPECT_LT(AlignmentError(open[0], unaligned.Frames), 0.01);
  EXPECT_LT(HarmonicEnergy(open[0], unaligned.Frames), HarmonicEnergy(labelled[0], aligned.Frames));
  std::size_t joined = 0;
  for (const std::vector<Index>& line : graph.Lines)
  {
    joined += line.size() - 1;
  }
  EXPECT_EQ(joined, graph.Edges.size());
  EXPECT_LT(graph.Lines.size(), graph.Edges.size() / 2);
}

//------------------------------------------------------------------------------
// The paper's Figure 3(b): from frames whose labels differ from voxel to voxel.
TEST(FrameField, JumpsLowerTheEnergy)
{
  for (const FrameShape& shape : { QuarterAnnulus(18), HelicalBar(18, 1.2), RoundBall(18) })
  {
    const std::vector<FrameLevel> levels = LevelsOf(shape, false);
    FrameList mixed = ConstantFrames(levels[0]);
    MixLabels(mixed);
    const Field with = Converged(levels[0], FrameStep::Registration, true, mixed);
    const Field without = Converged(levels[0], FrameStep::Registration, false, mixed);
    const double e = HarmonicEnergy(levels[0], with.Frames);
    EXPECT_LT(e, 0.9 * HarmonicEnergy(levels[0], without.Frames));
  }
}

//------------------------------------------------------------------------------
// Energies of all the ways, printed. The default is not above the paper's plain sweeps (but for the
// share that is left after 15 sweeps) and near the best.
TEST(FrameField, EnergyIsNearTheBest)
{
  const std::vector<std::pair<const char*, FrameShape>> shapes = { { "turned", TurnedBox(22) },
    { "annulus", QuarterAnnulus(22) }, { "helix", HelicalBar(22, 1.5) },
    { "ball", RoundBall(22) } };
  for (const auto& [name, shape] : shapes)
  {
    for (const bool labels : { true, false })
    {
      const std::vector<FrameLevel> levels = LevelsOf(shape, labels);
      const FrameLevel& finest = levels[0];
      const Field field = DefaultField(levels);
      const double energy = HarmonicEnergy(finest, field.Frames);
      const FrameList constant = ConstantFrames(finest), linear = LinearFrames(levels, 0, Alone);
      const FrameList sweeps = Converged(finest, FrameStep::Registration, !labels, constant).Frames;
      const FrameList quartic = Converged(finest, FrameStep::Quartic, true, linear).Frames;
      const double plain = HarmonicEnergy(finest, sweeps), best = HarmonicEnergy(finest, quartic);
      const double harmonic =
        labels ? HarmonicEnergy(finest, HarmonicCoordinateFrames(levels, 0, Alone).Frames) : 0.0;
      std::printf(
        "%-8s %-8s default %9.3f in %2d sweeps | constant + paper's sweeps %9.3f | linear "
        "%9.3f, + quartic %9.3f | harmonic coordinates %9.3f\n",
        name, labels ? "labels" : "open", energy, FinestSweeps(field), plain,
        HarmonicEnergy(finest, linear), best, harmonic);
      EXPECT_LE(energy, 1.001 * plain + 0.01);
      EXPECT_LE(energy, 1.05 * best + 0.01);
      EXPECT_LE(FinestSweeps(field), 15);
      if (labels)
      {
        EXPECT_LT(HarmonicEnergy(finest, linear), 1.5 * energy + 0.01);
        // Of frames that keep their labels the default has the least.
        const double labelled = LabelledEnergy(finest, field.Frames);
        const FrameList jumps = Converged(finest, FrameStep::Registration, true, constant).Frames;
        EXPECT_LE(labelled, 1.001 * LabelledEnergy(finest, sweeps) + 0.01);
        for (const FrameList& crosses : { jumps, quartic })
        {
          EXPECT_LE(
            labelled, 1.001 * LabelledEnergy(finest, NamedAfter(field.Frames, crosses)) + 0.01);
        }
      }
    }
  }
}

//------------------------------------------------------------------------------
// After 15 sweeps or fewer, any size is within a thousandth of where a hundred more lead.
TEST(FrameField, SweepsDoNotGrowWithTheSize)
{
  for (const Index size : { 20, 40, 60 })
  {
    const std::vector<FrameLevel> levels = LevelsOf(HelicalBar(size, 1.5), true);
    Field field = DefaultField(levels);
    SmoothingOptions on = DefaultSmoothing(levels[0]);
    on.Drop = -1.0; // never enough
    on.Sweeps = 100;
    const double reached = HarmonicEnergy(levels[0], field.Frames);
    const int sweeps = FinestSweeps(field);
    SmoothFrames(levels[0], on, field.Frames, Alone);
    EXPECT_LE(sweeps, 15);
    EXPECT_LT(reached, 1.001 * HarmonicEnergy(levels[0], field.Frames)) << size;
  }
}

//------------------------------------------------------------------------------
TEST(FrameField, EnergyFallsSweepBySweep)
{
  const std::vector<FrameLevel> levels = LevelsOf(RoundBall(24), true);
  const FrameList start = ConstantFrames(levels[0]);
  for (const bool jumps : { false, true })
  {
    const Field field = Converged(levels[0], FrameStep::Registration, jumps, start);
    const std::vector<SweepRecord>& records = field.Records;
    ASSERT_GT(records.size(), 10u);
    EXPECT_EQ(records.back().Sweep, static_cast<int>(records.size()) - 1);
    EXPECT_LT(records.back().Energy.Registered, 0.7 * records.front().Energy.Registered);
    for (std::size_t i = 1; i + 1 < records.size(); ++i)
    {
      EXPECT_LT(records[i].Energy.Registered, 1.0001 * records[i - 1].Energy.Registered);
    }
    // What sweeps report by the way is what is measured.
    const FrameEnergy measured = MeasureFrames(levels[0], field.Frames, jumps, Alone);
    EXPECT_EQ(measured.Harmonic, records.back().Energy.Harmonic);
  }
}

//------------------------------------------------------------------------------
TEST(FrameField, HarmonicCoordinatesShowTheHand)
{
  const FrameShape shape = HelicalBar(24, 1.0);
  const std::vector<FrameLevel> levels = LevelsOf(shape, true);
  EXPECT_LT(HarmonicCoordinateFrames(levels, 0, Alone).LeftHanded, 0.01);
  std::vector<FrameConstraint> swapped = levels[0].Constraints;
  for (FrameConstraint& constraint : swapped)
  {
    constraint.Side ^= constraint.Side < 2 ? 1 : 0; // u from the high to the low side
  }
  const std::vector<FrameLevel> mirrored = MakeFrameLevels(levels[0].Voxels, swapped);
  EXPECT_GT(HarmonicCoordinateFrames(mirrored, 0, Alone).LeftHanded, 0.99);
}

//------------------------------------------------------------------------------
TEST(FrameField, ThreadsChangeNothing)
{
  for (const bool labels : { true, false })
  {
    const std::vector<FrameLevel> levels = LevelsOf(RoundBall(36), labels);
    const Field one = DefaultField(levels);
    for (const int threads : { 2, 3 })
    {
      const Field many = DefaultField(levels, ThreadedExecution(threads));
      ASSERT_EQ(one.Records.size(), many.Records.size());
      EXPECT_EQ(one.Records.back().Energy.Harmonic, many.Records.back().Energy.Harmonic);
      for (std::size_t v = 0; v < one.Frames.size(); ++v)
      {
        ASSERT_EQ(one.Frames[v].coeffs(), many.Frames[v].coeffs()) << v;
      }
    }
  }
}

//------------------------------------------------------------------------------
TEST(FrameField, CanBeStopped)
{
  const std::vector<FrameLevel> levels = LevelsOf(RoundBall(24), true);
  double last = 0.0;
  Execution execution;
  execution.Continue = [&last](double done)
  {
    EXPECT_GE(done, last);
    EXPECT_LE(done, 1.0);
    last = done;
    return done < 0.5;
  };
  FrameList frames = ConstantFrames(levels.back());
  EXPECT_THROW(SmoothCoarseToFine(levels, DefaultSmoothing(levels[0]), frames, execution), Aborted);
}

//------------------------------------------------------------------------------
// No voxel, one voxel, a sheet, two parts of which one has no constraint, none at all.
TEST(FrameField, OddSegmentsGetFrames)
{
  std::vector<std::uint8_t> none(12 * 12 * 12, 0), one = none, sheet = none, parts = none,
                                                   all = none;
  one[700] = 1;
  for (int id = 0; id < 12 * 12 * 12; ++id)
  {
    sheet[id] = id / 144 == 5 ? 1 : 0;
    parts[id] = id % 12 != 6 ? 1 : 0;
    all[id] = 1;
  }
  for (const std::vector<std::uint8_t>& mask : { none, one, sheet, parts, all })
  {
    for (const std::int8_t side : { AnyAxis, std::int8_t{ 3 } })
    {
      for (const bool bound : { true, false })
      {
        const FrameVoxels voxels = CollectVoxels({ 12, 12, 12 }, mask.data());
        std::vector<FrameConstraint> constraints;
        if (bound && voxels.Count() > 0)
        {
          constraints.push_back({ 0, { 0.6f, 0.0f, 0.8f }, side });
        }
        const std::vector<FrameLevel> levels = MakeFrameLevels(voxels, constraints, 50);
        const Field field = DefaultField(levels);
        ASSERT_EQ(field.Frames.size(), levels[0].Voxels.Ids.size());
        for (const Eigen::Quaternionf& frame : field.Frames)
        {
          EXPECT_NEAR(frame.norm(), 1.0f, 1e-5f);
        }
        EXPECT_LT(AlignmentError(levels[0], field.Frames), 0.01);
        EXPECT_NEAR(HarmonicEnergy(levels[0], field.Frames), 0.0, 0.1); // rounding
      }
    }
  }
}

//------------------------------------------------------------------------------
// Frames that turn by a quarter around the middle line of a block, the axis along it.
TEST(SingularGraph, FindsAStraightLine)
{
  const Index n = 10;
  const std::vector<std::uint8_t> mask(n * n * n, 1);
  const std::vector<FrameLevel> levels =
    MakeFrameLevels(CollectVoxels({ n, n, n }, mask.data()), {}, 2000);
  FrameList frames;
  for (Index v = 0; v < n * n * n; ++v)
  {
    const std::array<Index, 3> p = levels[0].Voxels.Place(v);
    const double angle = std::atan2(p[1] - 4.5, p[2] - 3.5) / 4.0;
    frames.emplace_back(
      Eigen::Quaterniond(Eigen::AngleAxisd(angle, Vector3d::UnitX())).cast<float>());
  }
  MixLabels(frames);
  const SingularGraph graph = FindSingularGraph(levels[0], frames, true, Alone);
  EXPECT_EQ(graph.Plaquettes, 3 * n * (n - 1) * (n - 1));
  ASSERT_EQ(graph.Lines.size(), 1u);
  EXPECT_EQ(graph.Lines[0].size(), static_cast<std::size_t>(n + 1));
  for (const std::array<double, 3>& point : graph.Points)
  {
    EXPECT_EQ(point[1], 4.5);
    EXPECT_EQ(point[2], 3.5);
  }
}
}
