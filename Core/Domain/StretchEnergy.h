// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// The symmetric Dirichlet energy of a triangle of a surface mapped to the plane.
#ifndef trivariate_StretchEnergy_h
#define trivariate_StretchEnergy_h

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>

namespace trivariate
{
/**
 * (s^2 + 1/s^2 + t^2 + 1/t^2) / 4 times the triangle's weight, where s and t are the singular
 * values of its map: 1 for an isometry, infinite where it is flat or folded. Edges of the map are
 * the columns from corner 0 to corners 1 and 2.
 */
class StretchTriangle
{
public:
  using Gradient = Eigen::Matrix<double, 6, 1>; ///< by the places of corners 0, 1, 2
  using Hessian = Eigen::Matrix<double, 6, 6>;

  /// Its corners in space. The weight is its area.
  StretchTriangle(const Eigen::Vector3d& p, const Eigen::Vector3d& q, const Eigen::Vector3d& r)
  {
    const Eigen::Vector3d a = q - p, b = r - p;
    const double length = std::max(a.norm(), 1e-300), twice = a.cross(b).norm();
    Eigen::Matrix2d edges;
    edges << length, a.dot(b) / length, 0.0, std::max(twice / length, LeastHeight * length);
    this->Inverse = edges.inverse();
    this->Weight = 0.5 * twice;
  }

  double Area() const { return this->Weight; }

  double Energy(const Eigen::Matrix2d& edges) const
  {
    const Eigen::Matrix2d j = edges * this->Inverse;
    const double determinant = j.determinant();
    return determinant > 0.0
             ? 0.25 * this->Weight * j.squaredNorm() * (1.0 + 1.0 / (determinant * determinant))
             : std::numeric_limits<double>::infinity();
  }

  /**
   * The gradient, and the Hessian without its negative part. With J = U diag(s) V^T and energy
   * f(s0) + f(s1), f(s) = s^2 + 1/s^2, the Hessian by J has the eigenvectors U D V^T with D
   * diag(1, 0), diag(0, 1), and the (normalised) turned and mirrored identities [B. Smith,
   * F. de Goes, T. Kim, Analytic eigensystems for isotropic distortion energies, 2019].
   */
  void Differentiate(const Eigen::Matrix2d& edges, Gradient& gradient, Hessian& hessian) const
  {
    const Eigen::Matrix2d j = edges * this->Inverse;
    // Closed form of the decomposition by the sum and the difference of two turns.
    const double e = 0.5 * (j(0, 0) + j(1, 1)), f = 0.5 * (j(0, 0) - j(1, 1));
    const double g = 0.5 * (j(1, 0) + j(0, 1)), h = 0.5 * (j(1, 0) - j(0, 1));
    const double s0 = std::hypot(e, h) + std::hypot(f, g), s1 = j.determinant() / s0;
    const double mirrored = std::atan2(g, f), turned = std::atan2(h, e);
    const double left = 0.5 * (turned + mirrored), right = 0.5 * (turned - mirrored);
    Eigen::Matrix2d u, vt;
    u << std::cos(left), -std::sin(left), std::sin(left), std::cos(left);
    vt << std::cos(right), -std::sin(right), std::sin(right), std::cos(right);

    const auto slope = [](double s) { return 2.0 * (s - 1.0 / (s * s * s)); };
    const double product = s0 * s1, half = std::sqrt(0.5);
    const double values[4] = { 2.0 + 6.0 / std::pow(s0, 4), 2.0 + 6.0 / std::pow(s1, 4),
      std::max(0.0, (slope(s0) + slope(s1)) / (s0 + s1)),
      2.0 + 2.0 * (s0 * s0 + product + s1 * s1) / (product * product * product) };
    const Eigen::Matrix2d modes[4] = { u.col(0) * vt.row(0), u.col(1) * vt.row(1),
      half * (u.col(1) * vt.row(0) - u.col(0) * vt.row(1)),
      half * (u.col(1) * vt.row(0) + u.col(0) * vt.row(1)) };

    // J is linear in the places: place k enters by the outer product with row k - 1 of Inverse.
    Eigen::Matrix<double, 3, 2> rows;
    rows << -this->Inverse.colwise().sum(), this->Inverse;
    const auto byPlaces = [&rows](const Eigen::Matrix2d& byJacobian)
    {
      Gradient out;
      for (int k = 0; k < 3; ++k)
      {
        out.segment<2>(2 * k) = byJacobian * rows.row(k).transpose();
      }
      return out;
    };
    gradient = 0.25 * this->Weight * byPlaces(slope(s0) * modes[0] + slope(s1) * modes[1]);
    hessian.setZero();
    for (int mode = 0; mode < 4; ++mode)
    {
      const Gradient q = byPlaces(modes[mode]);
      hessian += (0.25 * this->Weight * values[mode]) * q * q.transpose();
    }
  }

private:
  static constexpr double LeastHeight = 1e-6; // of a triangle, by its first edge

  Eigen::Matrix2d Inverse; // of the edges in the triangle's plane
  double Weight;
};
}

#endif
