// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "FoldEnergy.h"

#include "CellBasis.h"
#include "Parameter/CornerEnergy.h"
#include "ScatteredSystem.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace trivariate
{
namespace
{
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double Sharp = 1e-6;     // the regularisation where nothing folds,
constexpr double Blunt = 0.2;      // of a cell that does at first in parts of its determinant,
constexpr double Sharpening = 0.8; // less with each step,
constexpr double Shallow = 0.005;  // and not less than of a fold so deep

constexpr double Evenness = 1.0; // the size counts as much as the shape

// A determinant so small at twice as many points makes them count.
constexpr double Nearly[] = { 0.1, 0.002, 0.0 };

// The cubic Bernstein polynomials, and their derivatives, at points of the unit interval.
struct Line
{
  using Values = Eigen::Matrix<double, Eigen::Dynamic, 4>;
  Values Polynomials, Slopes;

  // At equal distances, the ends among them.
  explicit Line(int points)
    : Polynomials(points, 4)
    , Slopes(points, 4)
  {
    for (int i = 0; i < points; ++i)
    {
      const double s = i / (points - 1.0), r = 1.0 - s;
      this->Polynomials.row(i) << r * r * r, 3 * r * r * s, 3 * r * s * s, s * s * s;
      this->Slopes.row(i) << -3 * r * r, 3 * r * (r - 2 * s), 3 * s * (2 * r - s), 3 * s * s;
    }
  }

  const Values& Along(int direction, int derivative) const
  {
    return direction == derivative ? this->Slopes : this->Polynomials;
  }
  Index Size() const { return this->Polynomials.rows(); }
};

constexpr int MostHalvings = 3;

const Line& PointsOf(int halvings)
{
  static const Line lines[MostHalvings + 1] = { Line(5), Line(9), Line(17), Line(33) };
  return lines[halvings];
}

using Plane = Eigen::Matrix<double, 16, Eigen::Dynamic>;
using Pencil = Eigen::Matrix<double, 4, Eigen::Dynamic>;

// The derivative along a of the polynomial with 64 coefficients at all points, u fastest.
template <typename Coefficients, typename Values>
void Expand(const Line& line, int a, const Coefficients& coefficients, Values&& values)
{
  const Index n = line.Size();
  const Plane planes = Eigen::Map<const Eigen::Matrix<double, 16, 4>>(coefficients.data()) *
                       line.Along(2, a).transpose();
  Pencil pencils(4, n * n);
  for (Index k = 0; k < n; ++k)
  {
    pencils.middleCols(n * k, n).noalias() =
      Eigen::Map<const Eigen::Matrix4d>(planes.col(k).data()) * line.Along(1, a).transpose();
  }
  Eigen::Map<Eigen::MatrixXd>(values.data(), n, n * n).noalias() = line.Along(0, a) * pencils;
}

// The transposed map: adds to the 64 coefficients.
template <typename Values, typename Coefficients>
void Reduce(const Line& line, int a, const Values& values, Coefficients&& coefficients)
{
  const Index n = line.Size();
  const Pencil pencils =
    line.Along(0, a).transpose() * Eigen::Map<const Eigen::MatrixXd>(values.data(), n, n * n);
  Plane planes(16, n);
  for (Index k = 0; k < n; ++k)
  {
    Eigen::Map<Eigen::Matrix4d>(planes.col(k).data()).noalias() =
      pencils.middleCols(n * k, n) * line.Along(1, a);
  }
  Eigen::Map<Eigen::Matrix<double, 16, 4>>(coefficients.data()) += planes * line.Along(2, a);
}

// J at a point from its row.
template <typename Rows>
Matrix3d JacobianOf(const Rows& derivatives, Index point, const Vector3d& lengths)
{
  Matrix3d j;
  for (int a = 0; a < 3; ++a)
  {
    j.col(a) = derivatives.row(point).template segment<3>(3 * a) / lengths[a];
  }
  return j;
}

// Puts the derivative of something by J into the row, as one by it.
template <typename Rows>
void PutRow(const Matrix3d& slope, Index point, const Vector3d& lengths, Rows& rows)
{
  for (int a = 0; a < 3; ++a)
  {
    rows.row(point).template segment<3>(3 * a) = slope.col(a) / lengths[a];
  }
}

Matrix3d CofactorsOf(const Matrix3d& j)
{
  Matrix3d cofactors;
  cofactors << j.col(1).cross(j.col(2)), j.col(2).cross(j.col(0)), j.col(0).cross(j.col(1));
  return cofactors;
}

double Dot(const Matrix3d& a, const Matrix3d& b)
{
  return a.cwiseProduct(b).sum();
}
}

//------------------------------------------------------------------------------
FoldEnergy::FoldEnergy(const BezierMesh& mesh, const SharedPoints& points, const ShapeNet& net,
  const Execution& execution)
  : Run(execution)
  , Points(points.Count())
  , Cells(mesh.Size())
  , Halvings(mesh.Size(), 0)
  , Regularisation(mesh.Size(), Sharp)
  , Bluntness(mesh.Size(), Blunt)
  , Curvature(mesh.Size())
{
  this->Run.ParallelFor(mesh.Size(),
    [&](Index begin, Index end)
    {
      CellBasis basis(mesh);
      for (Index c = begin; c < end; ++c)
      {
        basis.SetCell(c);
        Cell& cell = this->Cells[c];
        const IdRange active = basis.Active();
        cell.Extraction.resize(64, active.size());
        for (Index n = 0; n < active.size(); ++n)
        {
          cell.Points.push_back(static_cast<std::int32_t>(points.PointOf[active.First[n]]));
          Moments64 form{};
          const auto& [u, v, w] = basis.Numbers[n];
          AddProduct(1.0, basis.Forms[0][u], basis.Forms[1][v], basis.Forms[2][w], form);
          cell.Extraction.col(n) = Eigen::Map<Eigen::Matrix<double, 64, 1>>(form.data());
        }
        const Vector3d ones = Vector3d::Ones();
        const Derivatives derivatives = this->DerivativesOf(c, net, 0);
        Vector3d squares = Vector3d::Zero();
        for (Index point = 0; point < derivatives.rows(); ++point)
        {
          squares += JacobianOf(derivatives, point, ones).colwise().squaredNorm();
        }
        cell.Lengths = (squares / static_cast<double>(derivatives.rows())).cwiseSqrt();
      }
    });
}

//------------------------------------------------------------------------------
FoldEnergy::Derivatives FoldEnergy::DerivativesOf(Index c, const ShapeNet& net, int halvings) const
{
  const Cell& cell = this->Cells[c];
  Eigen::MatrixX3d own(cell.Points.size(), 3);
  for (std::size_t n = 0; n < cell.Points.size(); ++n)
  {
    own.row(n) = net.row(cell.Points[n]);
  }
  const Eigen::Matrix<double, 64, 3> bezier = cell.Extraction * own;
  const Line& line = PointsOf(halvings);
  Derivatives derivatives(line.Size() * line.Size() * line.Size(), 9);
  for (int m = 0; m < 9; ++m)
  {
    Expand(line, m / 3, bezier.col(m % 3), derivatives.col(m));
  }
  return derivatives;
}

//------------------------------------------------------------------------------
double FoldEnergy::LeastOf(Index c, const Derivatives& derivatives) const
{
  double least = std::numeric_limits<double>::max();
  for (Index point = 0; point < derivatives.rows(); ++point)
  {
    least = std::min(least, JacobianOf(derivatives, point, this->Cells[c].Lengths).determinant());
  }
  return least;
}

//------------------------------------------------------------------------------
void FoldEnergy::CountFinely(const ShapeNet& net)
{
  this->Run.ParallelFor(static_cast<Index>(this->Cells.size()),
    [&](Index begin, Index end)
    {
      for (Index c = begin; c < end; ++c)
      {
        char& halvings = this->Halvings[c];
        const auto leastAt = [&](int points)
        { return this->LeastOf(c, this->DerivativesOf(c, net, points)); };
        // The finest points, eight times as many as before, are for folds that only they show.
        while (halvings < MostHalvings &&
               (halvings + 1 < MostHalvings || leastAt(halvings) > 0.0) &&
               leastAt(halvings + 1) <= Nearly[int(halvings)])
        {
          ++halvings;
        }
      }
    });
}

//------------------------------------------------------------------------------
FoldEnergy::Evaluation FoldEnergy::Evaluate(const ShapeNet& net) const
{
  const auto count = static_cast<Index>(this->Cells.size());
  std::vector<double> energies(count, 0.0);
  Evaluation evaluation;
  evaluation.Least.resize(count);
  this->Run.ParallelFor(count,
    [&](Index begin, Index end)
    {
      for (Index c = begin; c < end; ++c)
      {
        const Derivatives derivatives = this->DerivativesOf(c, net, this->Halvings[c]);
        evaluation.Least[c] = this->LeastOf(c, derivatives);
        for (Index point = 0; point < derivatives.rows(); ++point)
        {
          const Matrix3d j = JacobianOf(derivatives, point, this->Cells[c].Lengths);
          energies[c] +=
            CornerEnergy(j.squaredNorm(), j.determinant(), this->Regularisation[c], Evenness);
        }
        energies[c] /= static_cast<double>(derivatives.rows());
      }
    });
  evaluation.Energy =
    std::accumulate(energies.begin(), energies.end(), 0.0) / static_cast<double>(count);
  return evaluation;
}

//------------------------------------------------------------------------------
void FoldEnergy::Regularise(const std::vector<double>& least)
{
  for (std::size_t c = 0; c < this->Cells.size(); ++c)
  {
    this->Regularisation[c] = Sharp;
    if (least[c] <= 0.0)
    {
      this->Regularisation[c] += this->Bluntness[c] * (Shallow - least[c]);
      this->Bluntness[c] *= Sharpening;
    }
  }
}

//------------------------------------------------------------------------------
// The sum over cells of what visit(cell, rows) makes of rows for the derivatives at points of the
// cell: the derivative of the energy by each, as one by the net.
template <typename Visit>
ShapeNet FoldEnergy::Collect(const Visit& visit) const
{
  const std::vector<double> sums =
    SumOfParts(static_cast<Index>(this->Cells.size()), 3 * this->Points, this->Run,
      [&](Index first, Index last, std::vector<double>& part)
      {
        Eigen::Map<ShapeNet> net(part.data(), this->Points, 3);
        Derivatives rows;
        for (Index c = first; c < last; ++c)
        {
          const Cell& cell = this->Cells[c];
          visit(c, rows);
          Eigen::Matrix<double, 64, 3> bezier = Eigen::Matrix<double, 64, 3>::Zero();
          for (int m = 0; m < 9; ++m)
          {
            Reduce(PointsOf(this->Halvings[c]), m / 3, rows.col(m), bezier.col(m % 3));
          }
          const Eigen::MatrixX3d own = cell.Extraction.transpose() * bezier;
          const double factor =
            1.0 / static_cast<double>(rows.rows() * static_cast<Index>(this->Cells.size()));
          for (std::size_t n = 0; n < cell.Points.size(); ++n)
          {
            net.row(cell.Points[n]) += factor * own.row(n);
          }
        }
      });
  return Eigen::Map<const ShapeNet>(sums.data(), this->Points, 3);
}

//------------------------------------------------------------------------------
ShapeNet FoldEnergy::Differentiate(const ShapeNet& net)
{
  return this->Collect(
    [&](Index c, Derivatives& rows)
    {
      const Vector3d& lengths = this->Cells[c].Lengths;
      rows = this->DerivativesOf(c, net, this->Halvings[c]);
      std::vector<PointCurvature>& curvature = this->Curvature[c];
      curvature.resize(rows.rows());
      for (Index point = 0; point < rows.rows(); ++point)
      {
        PointCurvature& at = curvature[point];
        at.Jacobian = JacobianOf(rows, point, lengths);
        at.Cofactors = CofactorsOf(at.Jacobian);
        const double trace = at.Jacobian.squaredNorm();
        const EnergyDerivatives e = CornerDerivatives(
          trace, at.Jacobian.col(0).dot(at.Cofactors.col(0)), this->Regularisation[c], Evenness);
        at.ByTrace = e.ByTrace;
        at.ByBoth = e.ByBoth;
        // With |J|^2 and D as unknowns of their own this makes the energy convex.
        at.ByDeterminantTwice =
          std::max(e.ByDeterminantTwice, 2.0 * trace * e.ByBoth * e.ByBoth / e.ByTrace);
        const Matrix3d slope = 2.0 * e.ByTrace * at.Jacobian + e.ByDeterminant * at.Cofactors;
        PutRow(slope, point, lengths, rows);
      }
    });
}

//------------------------------------------------------------------------------
ShapeNet FoldEnergy::Curve(const ShapeNet& direction) const
{
  return this->Collect(
    [&](Index c, Derivatives& rows)
    {
      const Vector3d& lengths = this->Cells[c].Lengths;
      rows = this->DerivativesOf(c, direction, this->Halvings[c]);
      for (Index point = 0; point < rows.rows(); ++point)
      {
        const PointCurvature& at = this->Curvature[c][point];
        const Matrix3d d = JacobianOf(rows, point, lengths);
        const double trace = 2.0 * Dot(at.Jacobian, d), determinant = Dot(at.Cofactors, d);
        const Matrix3d curve =
          2.0 * at.ByTrace * d + 2.0 * at.ByBoth * determinant * at.Jacobian +
          (at.ByBoth * trace + at.ByDeterminantTwice * determinant) * at.Cofactors;
        PutRow(curve, point, lengths, rows);
      }
    });
}

//------------------------------------------------------------------------------
Eigen::SparseMatrix<double> FoldEnergy::CurvatureOfCubes() const
{
  std::vector<Eigen::Triplet<double>> entries;
  const EnergyDerivatives e = CornerDerivatives(3.0, 1.0, 0.0, Evenness);
  // Of 2 s |dJ|^2 + d (I : dJ)^2, the second spread over all directions.
  const double factor = 2.0 * e.ByTrace + e.ByDeterminantTwice / 3.0;
  // The sum over points is a product of sums along u, v, w.
  const Line& line = PointsOf(0);
  const Eigen::Matrix4d values = line.Polynomials.transpose() * line.Polynomials;
  const Eigen::Matrix4d slopes = line.Slopes.transpose() * line.Slopes;
  for (const Cell& cell : this->Cells)
  {
    Eigen::Matrix<double, 64, 64> bezier;
    for (int m = 0; m < 64 * 64; ++m)
    {
      const int i = m % 64, j = m / 64;
      double sum = 0.0;
      for (int a = 0; a < 3; ++a)
      {
        double product = 1.0 / (cell.Lengths[a] * cell.Lengths[a]);
        for (int b = 0; b < 3; ++b)
        {
          const int shift = 2 * b;
          product *= (a == b ? slopes : values)(i >> shift & 3, j >> shift & 3);
        }
        sum += product;
      }
      bezier(i, j) = sum;
    }
    const double points = std::pow(static_cast<double>(line.Size()), 3);
    const double scale = factor / (points * static_cast<double>(this->Cells.size()));
    const Eigen::MatrixXd own = scale * cell.Extraction.transpose() * bezier * cell.Extraction;
    for (Index i = 0; i < own.rows(); ++i)
    {
      for (Index j = 0; j < own.cols(); ++j)
      {
        entries.emplace_back(cell.Points[i], cell.Points[j], own(i, j));
      }
    }
  }
  Eigen::SparseMatrix<double> matrix(this->Points, this->Points);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}
}
