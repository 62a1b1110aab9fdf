// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "FoldEnergy.h"

#include "CellBasis.h"
#include "Parameter/CornerEnergy.h"
#include "PartLattice.h"
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

// A part of a cell, of each level, is halved along all axes where points of its halves have a
// determinant so small.
constexpr double Nearly[] = { 0.1, 0.05, 0.02 };

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
// What a point of a part counts of the mean over all cells.
double FoldEnergy::ShareOfPoint(const Part& part) const
{
  return 1.0 / static_cast<double>((PartPoints << 3 * part.Halvings) * this->Cells.size());
}

//------------------------------------------------------------------------------
FoldEnergy::FoldEnergy(const BezierMesh& mesh, const SharedPoints& points, const ShapeNet& net,
  const Execution& execution)
  : Run(execution)
  , Points(points.Count())
  , Cells(mesh.Size())
  , Regularisation(mesh.Size(), Sharp)
  , Bluntness(mesh.Size(), Blunt)
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
        const Derivatives derivatives = DerivativesOf(this->BezierOf(c, net), Part{ c, 0, {} });
        Vector3d squares = Vector3d::Zero();
        for (Index point = 0; point < derivatives.rows(); ++point)
        {
          squares += JacobianOf(derivatives, point, ones).colwise().squaredNorm();
        }
        cell.Lengths = (squares / static_cast<double>(derivatives.rows())).cwiseSqrt();
      }
    });
  for (Index c = 0; c < mesh.Size(); ++c)
  {
    this->Parts.push_back({ c, 0, {} });
  }
}

//------------------------------------------------------------------------------
FoldEnergy::Bezier FoldEnergy::BezierOf(Index c, const ShapeNet& net) const
{
  const Cell& cell = this->Cells[c];
  Eigen::MatrixX3d own(cell.Points.size(), 3);
  for (std::size_t n = 0; n < cell.Points.size(); ++n)
  {
    own.row(n) = net.row(cell.Points[n]);
  }
  return cell.Extraction * own;
}

//------------------------------------------------------------------------------
FoldEnergy::Derivatives FoldEnergy::DerivativesOf(const Bezier& bezier, const Part& part)
{
  const Lines lines = LinesOf(part);
  Derivatives derivatives;
  for (int m = 0; m < 9; ++m)
  {
    Expand(lines, m / 3, bezier.col(m % 3), derivatives.col(m));
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
// Adds the part, or its eighths and theirs where one of them nearly folds.
void FoldEnergy::Halve(const Bezier& bezier, const Part& part, std::vector<Part>& parts) const
{
  std::array<Part, 8> eighths;
  double least = std::numeric_limits<double>::max();
  for (int e = 0; e < 8 && part.Halvings < MostHalvings; ++e)
  {
    eighths[e] = { part.Cell, part.Halvings + 1, {} };
    for (int a = 0; a < 3; ++a)
    {
      eighths[e].Place[a] = 2 * part.Place[a] + (e >> a & 1);
    }
    least = std::min(least, this->LeastOf(part.Cell, DerivativesOf(bezier, eighths[e])));
  }
  if (part.Halvings == MostHalvings || least > Nearly[part.Halvings])
  {
    parts.push_back(part);
    return;
  }
  for (const Part& eighth : eighths)
  {
    this->Halve(bezier, eighth, parts);
  }
}

//------------------------------------------------------------------------------
void FoldEnergy::CountFinely(const ShapeNet& net)
{
  const auto count = static_cast<Index>(this->Parts.size());
  std::vector<std::vector<Part>> halved(count);
  this->Run.ParallelFor(count,
    [&](Index begin, Index end)
    {
      for (Index p = begin; p < end; ++p)
      {
        this->Halve(this->BezierOf(this->Parts[p].Cell, net), this->Parts[p], halved[p]);
      }
    });
  this->Parts.clear();
  for (const std::vector<Part>& parts : halved)
  {
    this->Parts.insert(this->Parts.end(), parts.begin(), parts.end());
  }
}

//------------------------------------------------------------------------------
FoldEnergy::Evaluation FoldEnergy::Evaluate(const ShapeNet& net) const
{
  const auto count = static_cast<Index>(this->Parts.size());
  std::vector<double> energies(count, 0.0), least(count);
  this->Run.ParallelFor(count,
    [&](Index begin, Index end)
    {
      for (Index p = begin; p < end; ++p)
      {
        const Part& part = this->Parts[p];
        const Derivatives derivatives = DerivativesOf(this->BezierOf(part.Cell, net), part);
        least[p] = this->LeastOf(part.Cell, derivatives);
        for (Index point = 0; point < derivatives.rows(); ++point)
        {
          const Matrix3d j = JacobianOf(derivatives, point, this->Cells[part.Cell].Lengths);
          energies[p] += CornerEnergy(
            j.squaredNorm(), j.determinant(), this->Regularisation[part.Cell], Evenness);
        }
        energies[p] *= this->ShareOfPoint(part);
      }
    });
  Evaluation evaluation;
  evaluation.Energy = std::accumulate(energies.begin(), energies.end(), 0.0);
  evaluation.Least.assign(this->Cells.size(), std::numeric_limits<double>::max());
  for (Index p = 0; p < count; ++p)
  {
    double& ofCell = evaluation.Least[this->Parts[p].Cell];
    ofCell = std::min(ofCell, least[p]);
  }
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
// The sum over parts of what visit(p, part, rows) makes of rows for the derivatives at points of
// part p: the derivative of the energy by each, as one by the net.
template <typename Visit>
ShapeNet FoldEnergy::Collect(const ShapeNet& net, const Visit& visit) const
{
  const std::vector<double> sums =
    SumOfParts(static_cast<Index>(this->Parts.size()), 3 * this->Points, this->Run,
      [&](Index first, Index last, std::vector<double>& part)
      {
        Eigen::Map<ShapeNet> sum(part.data(), this->Points, 3);
        for (Index p = first; p < last;)
        {
          // The parts of one cell.
          const Index c = this->Parts[p].Cell;
          const Cell& cell = this->Cells[c];
          const Bezier own = this->BezierOf(c, net);
          Bezier slopes = Bezier::Zero();
          for (; p < last && this->Parts[p].Cell == c; ++p)
          {
            const Part& part = this->Parts[p];
            Derivatives rows = DerivativesOf(own, part);
            visit(p, part, rows);
            rows *= this->ShareOfPoint(part);
            const Lines lines = LinesOf(part);
            for (int m = 0; m < 9; ++m)
            {
              Reduce(lines, m / 3, rows.col(m), slopes.col(m % 3));
            }
          }
          const Eigen::MatrixX3d ofPoints = cell.Extraction.transpose() * slopes;
          for (std::size_t n = 0; n < cell.Points.size(); ++n)
          {
            sum.row(cell.Points[n]) += ofPoints.row(n);
          }
        }
      });
  return Eigen::Map<const ShapeNet>(sums.data(), this->Points, 3);
}

//------------------------------------------------------------------------------
ShapeNet FoldEnergy::Differentiate(const ShapeNet& net)
{
  this->Curvature.resize(this->Parts.size());
  return this->Collect(net,
    [&](Index p, const Part& part, Derivatives& rows)
    {
      const Vector3d& lengths = this->Cells[part.Cell].Lengths;
      for (Index point = 0; point < rows.rows(); ++point)
      {
        PointCurvature& at = this->Curvature[p][point];
        at.Jacobian = JacobianOf(rows, point, lengths);
        at.Cofactors = CofactorsOf(at.Jacobian);
        const double trace = at.Jacobian.squaredNorm();
        const EnergyDerivatives e = CornerDerivatives(trace,
          at.Jacobian.col(0).dot(at.Cofactors.col(0)), this->Regularisation[part.Cell], Evenness);
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
  return this->Collect(direction,
    [&](Index p, const Part& part, Derivatives& rows)
    {
      const Vector3d& lengths = this->Cells[part.Cell].Lengths;
      for (Index point = 0; point < rows.rows(); ++point)
      {
        const PointCurvature& at = this->Curvature[p][point];
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
// The sum over the cell's points of stiffness times the products of derivatives along each axis of
// the Bernstein polynomials.
FoldEnergy::CellMatrix FoldEnergy::StiffnessOf(Index firstPart, Index lastPart, bool asCubes) const
{
  Eigen::Matrix<double, 256, 16> sum =
    Eigen::Matrix<double, 256, 16>::Zero(); // (u, u, v, v), (w, w)
  const Index cell = this->Parts[firstPart].Cell;
  const Vector3d& lengths = this->Cells[cell].Lengths;
  // Where a cell folds that spread is too much by far.
  const bool isCube = asCubes || this->Regularisation[cell] > Sharp;
  const EnergyDerivatives e = CornerDerivatives(3.0, 1.0, 0.0, Evenness);
  const double ofCube = 2.0 * e.ByTrace + e.ByDeterminantTwice / 3.0;
  for (Index p = firstPart; p < lastPart; ++p)
  {
    const Part& part = this->Parts[p];
    PointGrid stiffness;
    for (Index point = 0; point < PartPoints; ++point)
    {
      const PointCurvature& at = this->Curvature[p][point];
      // Of 2 s |dJ|^2 + d (cof : dJ)^2, the second spread over all directions.
      stiffness.data()[point] =
        isCube ? ofCube
               : 2.0 * at.ByTrace + at.ByDeterminantTwice * at.Cofactors.squaredNorm() / 9.0;
    }
    stiffness *= this->ShareOfPoint(part);
    const Lines lines = LinesOf(part);
    for (int a = 0; a < 3; ++a)
    {
      std::array<Squares, 3> squares;
      for (int b = 0; b < 3; ++b)
      {
        squares[b] = SquaresOf(lines[b]->Along(b, a));
      }
      const Eigen::Matrix<double, 16, PartLine* PartLine> pencils =
        squares[0] * stiffness / (lengths[a] * lengths[a]);
      Eigen::Matrix<double, 256, PartLine> planes;
      for (int k = 0; k < PartLine; ++k)
      {
        Eigen::Map<Eigen::Matrix<double, 16, 16>>(planes.col(k).data()).noalias() =
          pencils.middleCols<PartLine>(PartLine * k) * squares[1].transpose();
      }
      sum.noalias() += planes * squares[2].transpose();
    }
  }
  CellMatrix matrix;
  for (int m = 0; m < 64 * 64; ++m)
  {
    const int i = m % 64, j = m / 64;
    const auto pair = [i, j](int a) { return (i >> 2 * a & 3) + 4 * (j >> 2 * a & 3); };
    matrix(i, j) = sum(pair(0) + 16 * pair(1), pair(2));
  }
  return matrix;
}

//------------------------------------------------------------------------------
Eigen::SparseMatrix<double> FoldEnergy::Stiffness(bool asCubes) const
{
  const auto count = static_cast<Index>(this->Cells.size());
  std::vector<Index> firstPart(count + 1, static_cast<Index>(this->Parts.size()));
  for (Index p = firstPart[count] - 1; p >= 0; --p)
  {
    firstPart[this->Parts[p].Cell] = p;
  }
  std::vector<Eigen::MatrixXd> ofCells(count);
  this->Run.ParallelFor(count,
    [&](Index begin, Index end)
    {
      for (Index c = begin; c < end; ++c)
      {
        const Eigen::MatrixXd& extraction = this->Cells[c].Extraction;
        ofCells[c] = extraction.transpose() *
                     this->StiffnessOf(firstPart[c], firstPart[c + 1], asCubes) * extraction;
      }
    });
  std::vector<Eigen::Triplet<double>> entries;
  for (Index c = 0; c < count; ++c)
  {
    const std::vector<std::int32_t>& points = this->Cells[c].Points;
    for (std::size_t j = 0; j < points.size(); ++j)
    {
      for (std::size_t i = 0; i < points.size(); ++i)
      {
        entries.emplace_back(points[i], points[j], ofCells[c](i, j));
      }
    }
  }
  Eigen::SparseMatrix<double> matrix(this->Points, this->Points);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}
}
