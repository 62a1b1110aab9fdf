// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// The space of an image's grid: index times spacing, without the image's origin and direction.
#ifndef GridSpace_h
#define GridSpace_h

#include <Eigen/Dense>

#include <array>

namespace trivariate
{
struct GridSpace
{
  /// As ImageSamples has them.
  GridSpace(const std::array<double, 16>& indexToPhysical, const std::array<int, 6>& extent)
  {
    using Affine = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;
    const Eigen::Map<const Affine> affine(indexToPhysical.data());
    const Eigen::Matrix3d steps = affine.topLeftCorner<3, 3>();
    this->Spacing = steps.colwise().norm();
    this->Axes = steps * this->Spacing.cwiseInverse().asDiagonal();
    this->Origin =
      affine.topRightCorner<3, 1>() + steps * Eigen::Vector3d(extent[0], extent[2], extent[4]);
  }

  Eigen::Vector3d FromSpace(const Eigen::Vector3d& point) const
  {
    return this->Axes.transpose() * (point - this->Origin);
  }

  Eigen::Vector3d ToSpace(const Eigen::Vector3d& point) const
  {
    return this->Origin + this->Axes * point;
  }

  bool IsMirrored() const { return this->Axes.determinant() < 0.0; }

  Eigen::Vector3d Spacing;
  Eigen::Matrix3d Axes;   ///< columns: unit vectors along i, j, k
  Eigen::Vector3d Origin; ///< of the first voxel
};
}

#endif
