// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Crosses as unit vectors of nine components: the harmonic part of sum_l (v_l . x)^4 in an
 * orthonormal basis. The distance of two of them is HarmonicDistance.
 */
#ifndef trivariate_CrossHarmonics_h
#define trivariate_CrossHarmonics_h

#include "FrameMatching.h"

namespace trivariate
{
using CrossVector = Eigen::Matrix<double, 9, 1>;

CrossVector HarmonicsOf(const Frame& frame);

/// A frame whose harmonics are closest to a multiple of a vector: the best of a few maxima.
Frame ClosestCross(const CrossVector& harmonics);

/// The crosses with one direction along a unit normal: Centre + span(Basis), orthonormal.
struct AlignedCrosses
{
  explicit AlignedCrosses(const Eigen::Vector3d& normal);
  CrossVector Centre;
  Eigen::Matrix<double, 9, 2> Basis;
};
}

#endif
