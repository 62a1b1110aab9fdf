// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The points of a part of a Bezier cell at which FoldEnergy counts, the derivatives of a tricubic
 * map there, sums along u, v, w one after the other, and what is done at each point.
 */
#ifndef trivariate_PartLattice_h
#define trivariate_PartLattice_h

#include <Eigen/Dense>

#include <array>
#include <vector>

namespace trivariate
{
constexpr int MostHalvings = 3; // of a cell along each axis
constexpr int PartLine = 5;     // points of a part along each axis, the ends among them
constexpr int PartPoints = PartLine * PartLine * PartLine;
constexpr int PaddedPoints = 128; // of vectors

// The cubic Bernstein polynomials, and their derivatives, at five equal distances of an interval in
// the unit interval, its ends among them.
struct Line
{
  using Values = Eigen::Matrix<double, PartLine, 4, Eigen::RowMajor>;
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

template <typename Part>
Lines LinesOf(const Part& part)
{
  return { &LineOf(part.Halvings, part.Place[0]), &LineOf(part.Halvings, part.Place[1]),
    &LineOf(part.Halvings, part.Place[2]) };
}

// A number for the derivative of each component c by each direction a, in row 3 a + c, at all
// points of a part, u fastest: a Jacobian at each, or the derivatives of something by it. The
// numbers beyond the points are zero.
struct alignas(64) PartMatrices
{
  double Rows[9][PaddedPoints];

  Eigen::Matrix3d At(int point) const
  {
    Eigen::Matrix3d matrix;
    for (int m = 0; m < 9; ++m)
    {
      matrix.data()[m] = this->Rows[m][point];
    }
    return matrix;
  }
  void Put(int point, const Eigen::Matrix3d& matrix)
  {
    for (int m = 0; m < 9; ++m)
    {
      this->Rows[m][point] = matrix.data()[m];
    }
  }
};

// The derivatives of the map with 64 coefficients of each of three components, those along a times
// scales[a].
void Expand(
  const Lines& lines, const double* scales, const double* coefficients, PartMatrices& out);

// The transposed map: adds to the coefficients.
void Reduce(const Lines& lines, const double* scales, const PartMatrices& in, double* coefficients);

// Of the matrices at all points.
void FindDeterminants(const PartMatrices& matrices, double* determinants);

// How an energy changes with J at all points of a part: its derivatives by |J|^2 and det J.
struct alignas(64) PartCurvature
{
  PartMatrices Jacobian;
  double ByTrace[PaddedPoints], ByBoth[PaddedPoints], ByDeterminantTwice[PaddedPoints];
};

// Takes changes of J to `factor` times those of the energy's derivative by J, but for what comes
// from how the determinant curves.
void MultiplyCurvature(const PartCurvature& curvature, double factor, PartMatrices& changes);

// Numbers at all points, u fastest.
using PointGrid = Eigen::Matrix<double, PartLine, PartLine * PartLine>;

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
