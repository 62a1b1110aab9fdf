// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "CrossHarmonics.h"

#include "Domain/ClosestRotation.h"

#include <Eigen/Geometry>

#include <cmath>
#include <random>
#include <vector>

namespace trivariate
{
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace
{
// A form of degree 4 as its 15 coefficients, each divided by the root of how often its product
// occurs in (x + y + z)^4: the scalar product is then that of the symmetric tensors.
using Form = Eigen::Matrix<double, 15, 1>;
using Basis = Eigen::Matrix<double, 15, 9>;

struct Product
{
  std::array<int, 3> Powers;
  double Root; // of the multinomial coefficient
};

std::array<Product, 15> MakeProducts()
{
  constexpr std::array<double, 5> factorial = { 1, 1, 2, 6, 24 };
  std::array<Product, 15> products;
  int n = 0;
  for (int a = 4; a >= 0; --a)
  {
    for (int b = 4 - a; b >= 0; --b)
    {
      const int c = 4 - a - b;
      products[n++] = { { a, b, c },
        std::sqrt(factorial[4] / (factorial[a] * factorial[b] * factorial[c])) };
    }
  }
  return products;
}

const std::array<Product, 15> Products = MakeProducts();

// The powers 0 to 4 of the coordinates.
std::array<std::array<double, 5>, 3> PowersOf(const Vector3d& x)
{
  std::array<std::array<double, 5>, 3> powers;
  for (int a = 0; a < 3; ++a)
  {
    powers[a] = { 1.0, x[a], x[a] * x[a], x[a] * x[a] * x[a], x[a] * x[a] * x[a] * x[a] };
  }
  return powers;
}

// The form (v . x)^4; also the values of the products at v, times their roots.
Form FourthPower(const Vector3d& v)
{
  const auto powers = PowersOf(v);
  Form form;
  for (int m = 0; m < 15; ++m)
  {
    const std::array<int, 3>& p = Products[m].Powers;
    form[m] = Products[m].Root * powers[0][p[0]] * powers[1][p[1]] * powers[2][p[2]];
  }
  return form;
}

Vector3d GradientOf(const Form& form, const Vector3d& x)
{
  const auto powers = PowersOf(x);
  Vector3d gradient = Vector3d::Zero();
  for (int m = 0; m < 15; ++m)
  {
    for (int a = 0; a < 3; ++a)
    {
      const int own = Products[m].Powers[a];
      if (own > 0)
      {
        const int b = (a + 1) % 3, c = (a + 2) % 3;
        gradient[a] += form[m] * Products[m].Root * own * powers[a][own - 1] *
                       powers[b][Products[m].Powers[b]] * powers[c][Products[m].Powers[c]];
      }
    }
  }
  return gradient;
}

Form CrossForm(const Frame& frame)
{
  return FourthPower(frame.row(0)) + FourthPower(frame.row(1)) + FourthPower(frame.row(2));
}

// What all crosses have in common: 3/5 (x.x)^2.
Form CommonForm()
{
  Form common = Form::Zero();
  for (int m = 0; m < 15; ++m)
  {
    const std::array<int, 3>& p = Products[m].Powers;
    if (p[0] % 2 == 0 && p[1] % 2 == 0 && p[2] % 2 == 0)
    {
      common[m] = Products[m].Root * (p[0] == 4 || p[1] == 4 || p[2] == 4 ? 0.6 : 0.2);
    }
  }
  return common;
}

std::vector<Frame> ScatteredFrames(int n)
{
  std::mt19937 random(1);
  std::vector<Frame> frames;
  const auto coordinate = [&random]()
  { return static_cast<double>(random()) / 4294967296.0 - 0.5; };
  while (static_cast<int>(frames.size()) < n)
  {
    const double w = coordinate(), x = coordinate(), y = coordinate(), z = coordinate();
    frames.push_back(Eigen::Quaterniond(w, x, y, z).normalized().toRotationMatrix());
  }
  return frames;
}

// The forms without a harmonic part of lower degree that crosses span: nine dimensions.
Basis MakeBasis()
{
  const std::vector<Frame> frames = ScatteredFrames(40);
  Eigen::Matrix<double, 15, Eigen::Dynamic> span(15, frames.size());
  for (std::size_t i = 0; i < frames.size(); ++i)
  {
    span.col(i) = CrossForm(frames[i]) - CommonForm();
  }
  return Eigen::JacobiSVD<Eigen::MatrixXd>(span, Eigen::ComputeThinU).matrixU().leftCols(9);
}

const Basis& HarmonicBasis()
{
  static const Basis basis = MakeBasis();
  return basis;
}
}

//------------------------------------------------------------------------------
CrossVector HarmonicsOf(const Frame& frame)
{
  return std::sqrt(5.0 / 6.0) * HarmonicBasis().transpose() * CrossForm(frame);
}

//------------------------------------------------------------------------------
// The sum of the form over the axes is convex in the frame once enough of (x.x)^2, which is
// constant there, is added, so that the rotation closest to its gradient raises it.
Frame ClosestCross(const CrossVector& harmonics)
{
  static const std::vector<Frame> starts = ScatteredFrames(24);
  static const std::vector<CrossVector> startHarmonics = []()
  {
    std::vector<CrossVector> all;
    for (const Frame& frame : starts)
    {
      all.push_back(HarmonicsOf(frame));
    }
    return all;
  }();
  const double length = harmonics.norm();
  if (!(length > 1e-12))
  {
    return Frame::Identity();
  }
  std::size_t best = 0;
  for (std::size_t i = 1; i < starts.size(); ++i)
  {
    best = startHarmonics[i].dot(harmonics) > startHarmonics[best].dot(harmonics) ? i : best;
  }
  const Form form = std::sqrt(6.0 / 5.0) / length * (HarmonicBasis() * harmonics) + CommonForm();
  Frame frame = starts[best];
  for (int i = 0; i < 30; ++i)
  {
    Matrix3d gradient;
    for (int a = 0; a < 3; ++a)
    {
      gradient.row(a) = GradientOf(form, frame.row(a));
    }
    const Frame before = frame;
    frame = ClosestRotation(gradient);
    if ((frame - before).squaredNorm() < 1e-8)
    {
      break;
    }
  }
  return frame;
}

//------------------------------------------------------------------------------
// Turned about the normal by t, the harmonics are Centre + cos 4t a + sin 4t b.
AlignedCrosses::AlignedCrosses(const Vector3d& normal)
{
  const Vector3d side = normal.unitOrthogonal();
  std::array<CrossVector, 4> turned;
  for (int i = 0; i < 4; ++i)
  {
    const Vector3d u = Eigen::AngleAxisd(i * std::acos(-1.0) / 8.0, normal) * side;
    Frame frame;
    frame << u.transpose(), normal.cross(u).transpose(), normal.transpose();
    turned[i] = HarmonicsOf(frame);
  }
  this->Centre = 0.5 * (turned[0] + turned[2]);
  this->Basis.col(0) = (turned[0] - turned[2]).normalized();
  this->Basis.col(1) = (turned[1] - turned[3]).normalized();
}
}
