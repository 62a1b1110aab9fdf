// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "NormalAxes.h"

#include "Domain/ClosestRotation.h"

#include <cmath>

namespace trivariate
{
using Eigen::Matrix3d;
using Eigen::Vector3d;

//------------------------------------------------------------------------------
Matrix3d PrincipalFrame(const std::vector<double>& weights, const std::vector<Vector3d>& points)
{
  Vector3d centre = Vector3d::Zero();
  double sum = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    centre += weights[i] * points[i];
    sum += weights[i];
  }
  centre /= sum;
  Matrix3d moment = Matrix3d::Zero();
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const Vector3d d = points[i] - centre;
    moment += weights[i] * d * d.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Matrix3d> principal(moment);
  Matrix3d frame = principal.eigenvectors().transpose();
  // Eigenvectors have no sign of their own: the longer tail is on the high side.
  const auto thirdMoment = [&](int axis)
  {
    double third = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      third += weights[i] * std::pow(frame.row(axis).dot(points[i] - centre), 3);
    }
    return third;
  };
  for (const int axis : { 0, 1 })
  {
    frame.row(axis) *= thirdMoment(axis) < 0.0 ? -1.0 : 1.0;
  }
  frame.row(2) = frame.row(0).cross(frame.row(1));
  return frame;
}

//------------------------------------------------------------------------------
// The sum is convex in the frame, so that the rotation closest to its gradient raises it.
Matrix3d ClingToNormals(
  const std::vector<double>& weights, const std::vector<Vector3d>& normals, Matrix3d frame)
{
  for (int round = 0; round < 30; ++round)
  {
    Matrix3d gradient = Matrix3d::Zero();
    for (std::size_t i = 0; i < normals.size(); ++i)
    {
      const Vector3d n = frame * normals[i];
      const Vector3d cube = n.array().cube();
      gradient += weights[i] * cube * normals[i].transpose();
    }
    const Matrix3d before = frame;
    frame = ClosestRotation(gradient);
    if ((frame - before).norm() < 1e-9)
    {
      break;
    }
  }
  return frame;
}
}
