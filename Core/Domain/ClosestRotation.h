// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef trivariate_ClosestRotation_h
#define trivariate_ClosestRotation_h

#include <Eigen/Dense>

namespace trivariate
{
/// The rotation R with the largest trace of R^T m.
inline Eigen::Matrix3d ClosestRotation(const Eigen::Matrix3d& m)
{
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(m, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::Matrix3d &u = svd.matrixU(), &v = svd.matrixV();
  Eigen::Matrix3d sign = Eigen::Matrix3d::Identity();
  sign(2, 2) = (u * v.transpose()).determinant() > 0.0 ? 1.0 : -1.0;
  return u * sign * v.transpose();
}
}

#endif
