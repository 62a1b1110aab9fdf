// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "FrameSteps.h"

#include "Domain/ClosestRotation.h"

#include <algorithm>
#include <cmath>

namespace trivariate
{
using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

namespace
{
Quaterniond RotationBy(const Vector3d& turn)
{
  const double angle = turn.norm();
  const double scale = angle > 1e-8 ? std::sin(0.5 * angle) / angle : 0.5;
  return Quaterniond(std::cos(0.5 * angle), scale * turn.x(), scale * turn.y(), scale * turn.z());
}

// The step to the maximum of g.x + x.Hx / 2, at most half a radian; along g where H is not negative
// definite. bound: as large as the curvature can be.
Vector3d NewtonStep(const Vector3d& g, const Matrix3d& h, double bound)
{
  const Eigen::LLT<Matrix3d> factor(Matrix3d(-h));
  Vector3d step = g / bound;
  if (factor.info() == Eigen::Success &&
      factor.matrixLLT().diagonal().minCoeff() > 1e-3 * std::sqrt(bound))
  {
    step = factor.solve(g);
  }
  const double length = step.norm();
  return length > 0.5 ? Vector3d(0.5 / length * step) : step;
}

// The rotation with the largest trace of R^T m: Newton's iteration for the polar factor.
Matrix3d PolarRotation(const Matrix3d& m)
{
  Matrix3d x = m;
  for (int i = 0; i < 20; ++i)
  {
    const double determinant = x.determinant();
    if (!(determinant > 1e-6))
    {
      break;
    }
    const Matrix3d next = 0.5 * (x + x.inverse().transpose());
    const double change = (next - x).squaredNorm();
    x = next;
    if (change < 1e-14)
    {
      return x;
    }
  }
  return ClosestRotation(m);
}

// The derivatives of sum_c sum_k (E c)_k^4 in the rotation vector of E at the identity, from the
// weighted sums of the fourth-degree products of the coordinates of the directions c.
struct QuarticForm
{
  double X4 = 0, Y4 = 0, Z4 = 0, Y2Z2 = 0, X2Z2 = 0, X2Y2 = 0;
  double X3Y = 0, X3Z = 0, Y3X = 0, Y3Z = 0, Z3X = 0, Z3Y = 0;
  double X2YZ = 0, Y2XZ = 0, Z2XY = 0;

  void Add(double weight, double x, double y, double z)
  {
    const double xx = x * x, yy = y * y, zz = z * z, xy = x * y, xz = x * z, yz = y * z;
    const double wxx = weight * xx, wyy = weight * yy, wzz = weight * zz;
    this->X4 += wxx * xx;
    this->Y4 += wyy * yy;
    this->Z4 += wzz * zz;
    this->Y2Z2 += wyy * zz;
    this->X2Z2 += wxx * zz;
    this->X2Y2 += wxx * yy;
    this->X3Y += wxx * xy;
    this->X3Z += wxx * xz;
    this->Y3X += wyy * xy;
    this->Y3Z += wyy * yz;
    this->Z3X += wzz * xz;
    this->Z3Y += wzz * yz;
    this->X2YZ += wxx * yz;
    this->Y2XZ += wyy * xz;
    this->Z2XY += wzz * xy;
  }

  // 4 sum c x c^3
  Vector3d Gradient() const
  {
    return 4.0 * Vector3d(this->Z3Y - this->Y3Z, this->X3Z - this->Z3X, this->Y3X - this->X3Y);
  }

  Matrix3d Hessian() const
  {
    Matrix3d h;
    h(0, 0) = 24.0 * this->Y2Z2 - 4.0 * (this->Y4 + this->Z4);
    h(1, 1) = 24.0 * this->X2Z2 - 4.0 * (this->X4 + this->Z4);
    h(2, 2) = 24.0 * this->X2Y2 - 4.0 * (this->X4 + this->Y4);
    h(0, 1) = h(1, 0) = 2.0 * (this->X3Y + this->Y3X) - 12.0 * this->Z2XY;
    h(0, 2) = h(2, 0) = 2.0 * (this->X3Z + this->Z3X) - 12.0 * this->Y2XZ;
    h(1, 2) = h(2, 1) = 2.0 * (this->Y3Z + this->Z3Y) - 12.0 * this->X2YZ;
    return h;
  }
};
}

//------------------------------------------------------------------------------
Quaterniond MeanRotation(const FrameStar& star)
{
  Matrix3d sum = Matrix3d::Zero();
  double weight = 0.0;
  for (int j = 0; j < star.Count; ++j)
  {
    sum += star.Weights[j] * star.Neighbours[j];
    weight += star.Weights[j];
  }
  // tr(E A) has the gradient of A's skew part and the Hessian sym(A) - tr(A) I.
  Matrix3d a = star.Own * sum.transpose();
  Quaterniond rotation = Quaterniond::Identity();
  for (int i = 0; i < 10 && star.Count > 0; ++i)
  {
    const Vector3d g(a(1, 2) - a(2, 1), a(2, 0) - a(0, 2), a(0, 1) - a(1, 0));
    Matrix3d h = 0.5 * (a + a.transpose());
    h.diagonal().array() -= a.trace();
    const Vector3d step = NewtonStep(g, h, 2.0 * weight);
    const Quaterniond turn = RotationBy(step);
    rotation = turn * rotation;
    if (step.squaredNorm() < 1e-6) // Newton's next step would be of the order of its square
    {
      break;
    }
    a = turn.toRotationMatrix() * a;
  }
  return rotation;
}

//------------------------------------------------------------------------------
Quaterniond RegistrationRotation(const FrameStar& star)
{
  Matrix3d rotation = Matrix3d::Identity();
  for (int i = 0; i < 10 && star.Count > 0; ++i)
  {
    // The neighbours' ends that are closest to the end of each axis; opposite ends agree.
    Matrix3d sum = Matrix3d::Zero();
    Vector3d weights = Vector3d::Zero();
    for (int j = 0; j < star.Count; ++j)
    {
      const Matrix3d r = rotation * star.Own * star.Neighbours[j].transpose();
      for (int l = 0; l < 3; ++l)
      {
        int axis;
        r.col(l).cwiseAbs().maxCoeff(&axis);
        sum.col(axis) += (r(axis, l) > 0.0 ? 1.0 : -1.0) * star.Weights[j] * r.col(l);
        weights[axis] += star.Weights[j];
      }
    }
    // The map of the axes onto the means of their partners; its rotation moves the frame.
    for (int axis = 0; axis < 3; ++axis)
    {
      sum.col(axis) =
        weights[axis] > 0.0 ? Vector3d(sum.col(axis) / weights[axis]) : Vector3d::Unit(axis);
    }
    const Matrix3d turn = PolarRotation(sum).transpose();
    rotation = turn * rotation;
    if (turn.trace() > 3.0 - 1e-8)
    {
      break;
    }
  }
  return Quaterniond(rotation);
}

//------------------------------------------------------------------------------
Quaterniond QuarticRotation(const FrameStar& star)
{
  Quaterniond rotation = Quaterniond::Identity();
  for (int i = 0; i < 3 && star.Count > 0; ++i)
  {
    const Matrix3d own = rotation.toRotationMatrix() * star.Own;
    QuarticForm form;
    double weight = 0.0;
    for (int j = 0; j < star.Count; ++j)
    {
      weight += star.Weights[j];
      const Matrix3d r = own * star.Neighbours[j].transpose();
      for (int l = 0; l < 3; ++l)
      {
        form.Add(star.Weights[j], r(0, l), r(1, l), r(2, l));
      }
    }
    const Vector3d step = NewtonStep(form.Gradient(), form.Hessian(), 8.0 * weight);
    rotation = RotationBy(step) * rotation;
    if (step.squaredNorm() < 2.5e-3)
    {
      break;
    }
  }
  return rotation;
}
}
