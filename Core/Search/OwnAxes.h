// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef trivariate_OwnAxes_h
#define trivariate_OwnAxes_h

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace trivariate
{
/**
 * Axes of weighted points that turn with the points: their principal axes. Where two of these have
 * equal moments, to 1e-4 of the largest, the directions among them are those where the strongest
 * harmonic of order 3 to 8 around the third has its peaks; where all three have, those along which
 * fourth moments are largest. Which of these axes comes first, and which of its ends, is told by
 * moments of odd order.
 */
struct OwnAxes
{
  Eigen::Matrix3d Frame; ///< rows: the axes
  bool ArePrincipal;     ///< all three, told apart by their moments
};

/// None where all of these moments are equal, as of a ball or a round cylinder. Of a figure with
/// exact symmetries, the nearest to the axes of space of those in which it is the same. O(n).
std::optional<OwnAxes> FindOwnAxes(
  const std::vector<double>& weights, const std::vector<Eigen::Vector3d>& points);
}

#endif
