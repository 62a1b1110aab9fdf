// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// The best place for a frame between its neighbours, as a rotation that is added to it.
#ifndef trivariate_FrameSteps_h
#define trivariate_FrameSteps_h

#include "FrameMatching.h"

#include <Eigen/Geometry>

namespace trivariate
{
/// A frame and those of its neighbours in the segment, with what each counts.
struct FrameStar
{
  Frame Own;
  std::array<Frame, 6> Neighbours;
  std::array<double, 6> Weights = { 1.0, 1.0, 1.0, 1.0, 1.0, 1.0 };
  int Count = 0;
};

/**
 * Each returns the rotation E, in the coordinates of the frame, such that E * Own is
 * - Mean: the closest to all neighbours in the mean square, label by label;
 * - Registration: what the paper's iterated closest points give;
 * - Quartic: a maximum of sum_j w_j sum_kl (R_k . v_jl)^4 in reach of Own.
 * The identity where there are no neighbours.
 */
Eigen::Quaterniond MeanRotation(const FrameStar& star);
Eigen::Quaterniond RegistrationRotation(const FrameStar& star);
Eigen::Quaterniond QuarticRotation(const FrameStar& star);
}

#endif
