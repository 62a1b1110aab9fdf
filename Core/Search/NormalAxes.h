// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// Three axes at right angles for a surface. Frames have them as rows and are right-handed.
#ifndef trivariate_NormalAxes_h
#define trivariate_NormalAxes_h

#include <Eigen/Core>

#include <vector>

namespace trivariate
{
/// The principal axes of weighted points, the one with the least moment first; the first two point
/// to the side of positive third moment.
Eigen::Matrix3d PrincipalFrame(
  const std::vector<double>& weights, const std::vector<Eigen::Vector3d>& points);

/// Turns a frame so that the weighted sum of the fourth powers of the normals' components is at a
/// maximum: the axes to which the normals cling.
Eigen::Matrix3d ClingToNormals(const std::vector<double>& weights,
  const std::vector<Eigen::Vector3d>& normals, Eigen::Matrix3d frame);
}

#endif
