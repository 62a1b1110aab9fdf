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
TEST(FrameVoxels, LevelsKeepNeighbours)
{
  const std::vector<FrameLevel> levels = LevelsOf(RoundBall(28), true);
  ASSERT_GE(levels.size(), 2u);
  for (const FrameLevel& level : levels)
  {
    const FrameVoxels& voxels = level.Voxels;
    for (Index v = 0; v < voxels.Count(); ++v)
    {
      const std::array<Index, 3> p = voxels.Place(v);
      EXPECT_EQ((p[0] + p[1] + p[2]) % 2, v < voxels.Red ? 0 : 1);
      for (int side = 0; side < 6; ++side)
      {
        const std::int32_t n = voxels.Neighbours[v][side];
        if (n >= 0)
        {
          std::array<Index, 3> q = voxels.Place(n);
          q[side / 2] += side % 2 ? -1 : 1;
          EXPECT_EQ(p, q);
          EXPECT_EQ(voxels.Neighbours[n][side ^ 1], v);
        }
      }
    }
  }
  const FrameLevel& fine = levels[0];
  for (Index v = 0; v < fine.Voxels.Count(); ++v)
  {
    const std::array<Index, 3> p = fine.Voxels.Place(v),
                               q = levels[1].Voxels.Place(fine.Parents[v]);
    EXPECT_EQ(q, (std::array<Index, 3>{ p[0] / 2, p[1] / 2, p[2] / 2 }));
  }
}

//------------------------------------------------------------------------------
// Two sheets in one coarse voxel's reach do not become neighbours unless they were.
TEST(FrameVoxels, ACutStaysACut)
{
  std::vector<std::uint8_t> mask(16 * 16 * 16, 1);
  for (int i = 0; i < 16 * 16 * 16; ++i)
  {
    const int y = i / 16 % 16, x = i % 16;
    // A gap one voxel wide between x = 7 and x = 9 that no coarse voxel is empty for.
    mask[i] = x == 8 || (x == 9 && y % 2) ? 0 : 1;
  }
  const std::vector<FrameLevel> levels =
    MakeFrameLevels(CollectVoxels({ 16, 16, 16 }, mask.data()), {}, 100);
  ASSERT_EQ(levels.size(), 2u);
  const FrameVoxels& coarse = levels[1].Voxels;
  EXPECT_EQ(coarse.Count(), 512);
  for (Index v = 0; v < coarse.Count(); ++v)
  {
    if (coarse.Place(v)[0] == 3)
    {
      EXPECT_EQ(coarse.Neighbours[v][1], -1);
    }
  }
}

//------------------------------------------------------------------------------
TEST(FrameVoxels, TwoAxesFixTheFrame)
{
  const std::uint8_t mask[8] = { 1, 1, 1, 1, 1, 1, 1, 1 };
  const FrameVoxels voxels = CollectVoxels({ 2, 2, 2 }, mask);
  const float c = std::cos(0.1f), s = std::sin(0.1f);
  // Normals 0.2 more than a right angle apart: each is missed by 0.1.
  std::vector<FrameLevel> levels =
    MakeFrameLevels(voxels, { { 3, { c, -s, 0 }, 1 }, { 3, { s, -c, 0 }, 2 } });
  ASSERT_EQ(levels[0].Bounds.size(), 1u);
  EXPECT_EQ(levels[0].Bounds[0].What, FrameBound::Kind::Fixed);
  FrameList frames(8, Eigen::Quaternionf::UnitRandom());
  ApplyBounds(levels[0], frames);
  EXPECT_LT((frames[3].toRotationMatrix() - Eigen::Matrix3f::Identity()).norm(), 1e-6f);
  // Normals that nearly agree: the middle of the axes goes there.
  levels = MakeFrameLevels(voxels, { { 3, { c, -s, 0 }, 1 }, { 3, { c, s, 0 }, 3 } });
  EXPECT_EQ(levels[0].Bounds[0].What, FrameBound::Kind::Axis);
  ApplyBounds(levels[0], frames);
  const Eigen::Vector3f there = frames[3] * Eigen::Vector3f::UnitX();
  EXPECT_LT((there - Eigen::Vector3f(1, 1, 0).normalized()).norm(), 1e-6f);
  // Open axes: any of the labels, along both normals.
  levels = MakeFrameLevels(voxels, { { 3, { 1, 0, 0 } }, { 3, { 0, 0, -1 } } });
  EXPECT_EQ(levels[0].Bounds[0].What, FrameBound::Kind::Fixed);
  ApplyBounds(levels[0], frames);
  EXPECT_NEAR(
    HarmonicDistance(frames[3].cast<double>().toRotationMatrix(), Frame::Identity()), 0.0, 1e-5);
}

//------------------------------------------------------------------------------
TEST(FrameVoxels, BadConstraintsAreNamed)
{
  const std::uint8_t mask[8] = { 1, 1, 1, 1, 1, 1, 1, 0 };
  const FrameVoxels voxels = CollectVoxels({ 2, 2, 2 }, mask);
  EXPECT_EQ(voxels.Count(), 7);
  EXPECT_THROW(MakeFrameLevels(voxels, { { 7, { 1, 0, 0 }, 1 } }), std::invalid_argument);
  EXPECT_THROW(MakeFrameLevels(voxels, { { 0, { 0, 0, 0 }, 1 } }), std::invalid_argument);
  EXPECT_THROW(MakeFrameLevels(voxels, { { 0, { NAN, 0, 0 }, 1 } }), std::invalid_argument);
  EXPECT_THROW(MakeFrameLevels(voxels, { { 0, { 1, 0, 0 }, 6 } }), std::invalid_argument);
  const std::vector<FrameLevel> levels = MakeFrameLevels(voxels, { { 0, { 1, 0, 0 }, 1 } });
  EXPECT_THROW(HarmonicCoordinateFrames(levels, 0, Alone), std::invalid_argument);
  const std::uint8_t none[8] = {};
  const std::vector<FrameLevel> empty = MakeFrameLevels(CollectVoxels({ 2, 2, 2 }, none), {});
  EXPECT_EQ(DefaultField(empty).Frames.size(), 0u);
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
      const auto converged = [&finest](FrameStep step, bool jumps, const FrameList& start)
      { return HarmonicEnergy(finest, Converged(finest, step, jumps, start).Frames); };
      const double plain = converged(FrameStep::Registration, !labels, constant);
      const double best = converged(FrameStep::Quartic, true, linear);
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
      }
    }
  }
}

//------------------------------------------------------------------------------
// After 15 sweeps or fewer, any size is within a thousandth of where sweeps for ever lead.
TEST(FrameField, SweepsDoNotGrowWithTheSize)
{
  for (const Index size : { 20, 40, 60 })
  {
    const std::vector<FrameLevel> levels = LevelsOf(HelicalBar(size, 1.5), true);
    Field field = DefaultField(levels);
    SmoothingOptions on = DefaultSmoothing(levels[0]);
    on.Drop = 1e-7;
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
