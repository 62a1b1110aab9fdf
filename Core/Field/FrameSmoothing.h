// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Makes frames as smooth as their constraints allow, voxel by voxel.
 *
 * A sweep visits the red voxels, then the black ones. A visit takes the frame to the best place
 * between the frames of its neighbours, in one of two senses, and then turns a bound frame onto its
 * constraints:
 * - Registration (the paper's section 2.2): the end points of the frame are registered with the
 *   union of the neighbours' end points, and the rotation of that map, its polar factor, is added.
 *   With jumps, an end point goes with the closest one whatever its label (ICP); without, u goes
 *   with u, v with v, w with w, and the rotation has a closed form.
 * - Quartic: maximises sum_j sum_kl (R_k . v_jl)^4, so it lowers the harmonic energy itself and
 *   needs no matching; one to three Newton steps on the rotations.
 *
 * Jumps and domains. The harmonic energy and all 24 matchings know crosses only: the label of a
 * constraint then has no say, as every label can be jumped to, and the smoothest field has the
 * singular curves of an unaligned one. Labels are respected, and a domain stays free of singular
 * curves, by the registration without jumps; that is the default where all constraints have labels.
 *
 * A sweep goes beyond the best place by the factors of Chebyshev's semi-iteration, for which the
 * two colours are made, so that a few sweeps on each level do. The energy they leave is higher than
 * what a hundred more reach by 1e-4 to 4e-4 of itself; with open axes, where singular curves still
 * creep, by up to 2.4e-3 (annulus, helix and ball of 40 and 80 voxels).
 *
 * Time: 0.25 (registration without jumps) to 0.4 microseconds (quartic) a voxel and sweep on one
 * core of an AMD EPYC, all coarser levels included 0.3 to 0.5; a segment that fills 256^3 takes 70
 * s on one core for 15 sweeps, 8.1 times as long as 128^3. Memory: nothing that grows, besides the
 * levels and the frames. No result depends on the number of threads.
 */
#ifndef trivariate_FrameSmoothing_h
#define trivariate_FrameSmoothing_h

#include "FrameVoxels.h"

namespace trivariate
{
enum class FrameStep
{
  Registration,
  Quartic
};

struct SmoothingOptions
{
  FrameStep Step = FrameStep::Registration;
  bool Jumps = false;  ///< Registration only; the quartic step always knows crosses only
  bool Relaxed = true; ///< go beyond the best place (Chebyshev); false: to it, as the paper
  int Sweeps = 15;     ///< at most, on the finest level; twice as many on each coarser one
  double Drop = 1e-4;  ///< stop when a sweep lowers the energy by less than this share of it
};

/// Sums over the pairs of neighbours in a level, weighted as FrameVoxels::PairWeights says.
struct FrameEnergy
{
  double Harmonic = 0.0; ///< of 5/3 (3 - sum_kl R_kl^4); times half the mean spacing: ARFF's energy
  double Registered =
    0.0; ///< of |F - F'|^2, with jumps to the closest labels; 2 t^2 for an angle t
};

struct SweepRecord
{
  int Level = 0;      ///< 0 is the finest
  int Sweep = 0;      ///< sweeps done before; the last record of a level is of its result
  FrameEnergy Energy; ///< after that many sweeps
};

/// Registration without jumps where all constraints have labels, else the quartic step.
SmoothingOptions DefaultSmoothing(const FrameLevel& level);

FrameEnergy MeasureFrames(
  const FrameLevel& level, const FrameList& frames, bool jumps, const Execution& execution);

/**
 * Smooths the frames of one level in place: at most options.Sweeps sweeps. Returns a record for the
 * start and for every sweep. `number` is written into the records as the level.
 */
std::vector<SweepRecord> SmoothFrames(const FrameLevel& level, const SmoothingOptions& options,
  FrameList& frames, const Execution& execution, int number = 0);

/**
 * From coarse to fine: `frames`, given on the last (coarsest) level, are smoothed there, carried to
 * the next finer one, and so on; on return they are those of the finest level.
 */
std::vector<SweepRecord> SmoothCoarseToFine(const std::vector<FrameLevel>& levels,
  const SmoothingOptions& options, FrameList& frames, const Execution& execution);
}

#endif
