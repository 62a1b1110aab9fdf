// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The points of a part of a Bezier cell at which FoldEnergy counts, and a tricubic polynomial
 * there: sums along u, v, w one after the other.
 */
#ifndef trivariate_PartLattice_h
#define trivariate_PartLattice_h

#include <Eigen/Dense>

#include <array>
#include <vector>

namespace trivariate
{
constexpr int MostHalvings = 3; // of a cell along each axis
constexpr int PartLine = 5;     // points of a part along each axis

// The cubic Bernstein polynomials, and their derivatives, at five equal distances of an interval in
// the unit interval, its ends among them.
struct Line
{
  using Values = Eigen::Matrix<double, PartLine, 4>;
  Values Polynomials, Slopes;

  Line(int halvings, int place)
  {
    for (int i = 0; i < PartLine; ++i)
    {
      const double s = (place + i / (PartLine - 1.0)) / (1 << halvings), r = 1.0 - s;
      this->Polynomials.row(i) << r * r * r, 3 * r * r * s, 3 * r * s * s, s * s * s;
      this->Slopes.row(i) << -3 * r * r, 3 * r * (r - 2 * s), 3 * s * (2 * r - s), 3 * s * s;
    }
  }

  const Values& Along(int direction, int derivative) const
  {
    return direction == derivative ? this->Slopes : this->Polynomials;
  }
};

inline const Line& LineOf(int halvings, int place)
{
  static const std::vector<Line> lines = []()
  {
    std::vector<Line> all;
    for (int h = 0; h <= MostHalvings; ++h)
    {
      for (int i = 0; i < 1 << h; ++i)
      {
        all.emplace_back(h, i);
      }
    }
    return all;
  }();
  return lines[(1 << halvings) - 1 + place];
}

// The polynomials along u, v, w at the points of a part.
using Lines = std::array<const Line*, 3>;
using Plane = Eigen::Matrix<double, 16, PartLine>;
using Pencil = Eigen::Matrix<double, 4, PartLine * PartLine>;
using PointGrid = Eigen::Matrix<double, PartLine, PartLine * PartLine>;

// The derivative along a of the polynomial with 64 coefficients at all points, u fastest.
template <typename Coefficients, typename Values>
void Expand(const Lines& lines, int a, const Coefficients& coefficients, Values&& values)
{
  const Plane planes = Eigen::Map<const Eigen::Matrix<double, 16, 4>>(coefficients.data()) *
                       lines[2]->Along(2, a).transpose();
  Pencil pencils;
  for (int k = 0; k < PartLine; ++k)
  {
    pencils.template middleCols<PartLine>(PartLine * k).noalias() =
      Eigen::Map<const Eigen::Matrix4d>(planes.col(k).data()) * lines[1]->Along(1, a).transpose();
  }
  Eigen::Map<PointGrid>(values.data()).noalias() = lines[0]->Along(0, a) * pencils;
}

// The transposed map: adds to the 64 coefficients.
template <typename Values, typename Coefficients>
void Reduce(const Lines& lines, int a, const Values& values, Coefficients&& coefficients)
{
  const Pencil pencils =
    lines[0]->Along(0, a).transpose() * Eigen::Map<const PointGrid>(values.data());
  Plane planes;
  for (int k = 0; k < PartLine; ++k)
  {
    Eigen::Map<Eigen::Matrix4d>(planes.col(k).data()).noalias() =
      pencils.template middleCols<PartLine>(PartLine * k) * lines[1]->Along(1, a);
  }
  Eigen::Map<Eigen::Matrix<double, 16, 4>>(coefficients.data()) += planes * lines[2]->Along(2, a);
}

template <typename Part>
Lines LinesOf(const Part& part)
{
  return { &LineOf(part.Halvings, part.Place[0]), &LineOf(part.Halvings, part.Place[1]),
    &LineOf(part.Halvings, part.Place[2]) };
}

// Of each point of a line, the products of all pairs of polynomials.
using Squares = Eigen::Matrix<double, 16, PartLine>;
inline Squares SquaresOf(const Line::Values& values)
{
  Squares squares;
  for (int m = 0; m < 16; ++m)
  {
    squares.row(m) = values.col(m % 4).cwiseProduct(values.col(m / 4)).transpose();
  }
  return squares;
}
}

#endif
