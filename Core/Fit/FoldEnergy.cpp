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

Matrix3d CofactorsOf(const Matrix3d& j)
{
  Matrix3d cofactors;
  cofactors << j.col(1).cross(j.col(2)), j.col(2).cross(j.col(0)), j.col(0).cross(j.col(1));
  return cofactors;
}

double LeastOf(const PartMatrices& jacobians)
{
  double determinants[PaddedPoints];
  FindDeterminants(jacobians, determinants);
  return *std::min_element(determinants, determinants + PartPoints);
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
        cell.Scales = Vector3d::Ones();
        PartMatrices jacobians;
        this->FindJacobians(this->BezierOf(c, net), Part{ c, 0, {} }, jacobians);
        Vector3d squares = Vector3d::Zero();
        for (int point = 0; point < PartPoints; ++point)
        {
          squares += jacobians.At(point).colwise().squaredNorm();
        }
        cell.Scales = (squares / PartPoints).cwiseSqrt().cwiseInverse();
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
std::vector<FoldEnergy::Bezier> FoldEnergy::BezierOfCells(const ShapeNet& net) const
{
  std::vector<Bezier> all(this->Cells.size());
  this->Run.ParallelFor(static_cast<Index>(all.size()),
    [&](Index begin, Index end)
    {
      for (Index c = begin; c < end; ++c)
      {
        all[c] = this->BezierOf(c, net);
      }
    });
  return all;
}

//------------------------------------------------------------------------------
void FoldEnergy::FindJacobians(
  const Bezier& bezier, const Part& part, PartMatrices& jacobians) const
{
  Expand(LinesOf(part), this->Cells[part.Cell].Scales.data(), bezier.data(), jacobians);
}

//------------------------------------------------------------------------------
// Adds the part, or its eighths and theirs where one of them nearly folds.
void FoldEnergy::Halve(const Bezier& bezier, const Part& part, std::vector<Part>& parts) const
{
  std::array<Part, 8> eighths;
  PartMatrices jacobians;
  double least = std::numeric_limits<double>::max();
  for (int e = 0; e < 8 && part.Halvings < MostHalvings; ++e)
  {
    eighths[e] = { part.Cell, part.Halvings + 1, {} };
    for (int a = 0; a < 3; ++a)
    {
      eighths[e].Place[a] = 2 * part.Place[a] + (e >> a & 1);
    }
    this->FindJacobians(bezier, eighths[e], jacobians);
    least = std::min(least, LeastOf(jacobians));
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
  const std::vector<Bezier> bezier = this->BezierOfCells(net);
  this->Run.ParallelFor(count,
    [&](Index begin, Index end)
    {
      for (Index p = begin; p < end; ++p)
      {
        this->Halve(bezier[this->Parts[p].Cell], this->Parts[p], halved[p]);
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
  const std::vector<Bezier> bezier = this->BezierOfCells(net);
  this->Run.ParallelFor(count,
    [&](Index begin, Index end)
    {
      for (Index p = begin; p < end; ++p)
      {
        const Part& part = this->Parts[p];
        PartMatrices jacobians;
        this->FindJacobians(bezier[part.Cell], part, jacobians);
        double determinants[PaddedPoints];
        FindDeterminants(jacobians, determinants);
        least[p] = *std::min_element(determinants, determinants + PartPoints);
        for (int point = 0; point < PartPoints; ++point)
        {
          energies[p] += CornerEnergy(jacobians.At(point).squaredNorm(), determinants[point],
            this->Regularisation[part.Cell], Evenness);
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
// The sum over parts of what visit(p, share, matrices) makes of J at the points of part p: `share`
// times the derivative of the energy by each, as one by the net.
template <typename Visit>
ShapeNet FoldEnergy::Collect(const ShapeNet& net, const Visit& visit) const
{
  const std::vector<double> sums =
    SumOfParts(static_cast<Index>(this->Parts.size()), 3 * this->Points, this->Run,
      [&](Index first, Index last, std::vector<double>& part)
      {
        Eigen::Map<ShapeNet> sum(part.data(), this->Points, 3);
        PartMatrices matrices;
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
            this->FindJacobians(own, part, matrices);
            visit(p, this->ShareOfPoint(part), matrices);
            Reduce(LinesOf(part), cell.Scales.data(), matrices, slopes.data());
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
    [&](Index p, double share, PartMatrices& matrices)
    {
      PartCurvature& at = this->Curvature[p];
      at = {};
      at.Jacobian = matrices;
      for (int point = 0; point < PartPoints; ++point)
      {
        const Matrix3d jacobian = matrices.At(point), cofactors = CofactorsOf(jacobian);
        const double trace = jacobian.squaredNorm();
        const EnergyDerivatives e = CornerDerivatives(trace, jacobian.col(0).dot(cofactors.col(0)),
          this->Regularisation[this->Parts[p].Cell], Evenness);
        at.ByTrace[point] = e.ByTrace;
        at.ByBoth[point] = e.ByBoth;
        // With |J|^2 and D as unknowns of their own this makes the energy convex.
        at.ByDeterminantTwice[point] =
          std::max(e.ByDeterminantTwice, 2.0 * trace * e.ByBoth * e.ByBoth / e.ByTrace);
        matrices.Put(point, share * (2.0 * e.ByTrace * jacobian + e.ByDeterminant * cofactors));
      }
    });
}

//------------------------------------------------------------------------------
ShapeNet FoldEnergy::Curve(const ShapeNet& direction) const
{
  return this->Collect(direction, [this](Index p, double share, PartMatrices& changes)
    { MultiplyCurvature(this->Curvature[p], share, changes); });
}

//------------------------------------------------------------------------------
// The sum over the cell's points of stiffness times the products of derivatives along each axis of
// the Bernstein polynomials.
FoldEnergy::CellMatrix FoldEnergy::StiffnessOf(Index firstPart, Index lastPart) const
{
  Eigen::Matrix<double, 256, 16> sum =
    Eigen::Matrix<double, 256, 16>::Zero(); // (u, u, v, v), (w, w)
  const Index cell = this->Parts[firstPart].Cell;
  const Vector3d& scales = this->Cells[cell].Scales;
  // Where a cell folds that spread is too much by far.
  const bool isCube = this->Regularisation[cell] > Sharp;
  const EnergyDerivatives e = CornerDerivatives(3.0, 1.0, 0.0, Evenness);
  const double ofCube = 2.0 * e.ByTrace + e.ByDeterminantTwice / 3.0;
  for (Index p = firstPart; p < lastPart; ++p)
  {
    const Part& part = this->Parts[p];
    PointGrid stiffness;
    const PartCurvature& at = this->Curvature[p];
    for (int point = 0; point < PartPoints; ++point)
    {
      // Of 2 s |dJ|^2 + d (cof : dJ)^2, the second spread over all directions.
      stiffness.data()[point] =
        isCube ? ofCube
               : 2.0 * at.ByTrace[point] + at.ByDeterminantTwice[point] *
                                             CofactorsOf(at.Jacobian.At(point)).squaredNorm() / 9.0;
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
        squares[0] * stiffness * (scales[a] * scales[a]);
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
Eigen::SparseMatrix<double> FoldEnergy::Stiffness() const
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
        ofCells[c] =
          extraction.transpose() * this->StiffnessOf(firstPart[c], firstPart[c + 1]) * extraction;
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
