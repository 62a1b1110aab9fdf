// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Frames as crosses: which of the 24 relabellings brings two of them together, and how far apart
 * they are whatever the labels.
 *
 * A frame is a rotation whose rows are the unit vectors u, v, w: frame * x are the coordinates of a
 * direction x in it. The 24 rotations of the cube permute and flip the rows and keep the hand.
 */
#ifndef trivariate_FrameMatching_h
#define trivariate_FrameMatching_h

#include <Eigen/Dense>

#include <array>

namespace trivariate
{
using Frame = Eigen::Matrix3d;

/// The 24 rotations of the cube as signed permutations of the rows; number 0 changes nothing.
const std::array<Frame, 24>& CubeRotations();

/// The number of the cube rotation that is a after b.
int ComposeRotations(int a, int b);

/// The number of the cube rotation O for which O * from is closest to `to`.
int MatchFrames(const Frame& from, const Frame& to);

/**
 * The squared distance of the crosses as unit vectors of spherical harmonics of degree 4:
 * |q - q'|^2 = 5/3 (3 - sum_kl R_kl^4), R = from * to^T. It does not depend on the labels; for a
 * small angle t between the frames it is 20/3 t^2.
 */
double HarmonicDistance(const Frame& from, const Frame& to);

/**
 * The product of the four matchings once around a plaquette, as the number of a cube rotation; 0
 * where the crosses close up, anything else where a singular curve passes through.
 */
int PlaquetteRotation(const std::array<Frame, 4>& around);
}

#endif
