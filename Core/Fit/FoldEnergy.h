// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * How far the shape of a spline is from folding, as a function of its net: the mean of CornerEnergy
 * over points of all Bezier cells,
 *   E(J) = tr(J^T J) / chi(D)^(2/3) + (1 + D^2) / chi(D),   D = det J,
 * where J takes a cube to the cell, each direction in parts of the cell's own length. A net is the
 * homogeneous coefficients w_i p_i of control points, one row each.
 */
#ifndef trivariate_FoldEnergy_h
#define trivariate_FoldEnergy_h

#include "BlockSpline.h"
#include "Execution.h"
#include "PartLattice.h"
#include "TSpline/BezierMesh.h"

#include <Eigen/Dense>
#include <Eigen/SparseCore>

#include <algorithm>
#include <array>
#include <vector>

namespace trivariate
{
using ShapeNet = Eigen::Matrix<double, Eigen::Dynamic, 3>;

class FoldEnergy
{
public:
  /// The lengths of cells are those of the net. The arguments but it must outlive this object.
  FoldEnergy(const BezierMesh& mesh, const SharedPoints& points, const ShapeNet& net,
    const Execution& execution);

  /// Cells count at 5 x 5 x 5 points. From now on parts of them that fold or nearly fold count at
  /// twice as many along each axis, parts of these that come nearer yet at four times, and where
  /// they fold at eight times as many.
  void CountFinely(const ShapeNet& net);

  struct Evaluation
  {
    double Energy = 0.0;
    std::vector<double> Least; ///< determinants of the cells, in parts of their lengths
    bool Folds() const { return *std::min_element(this->Least.begin(), this->Least.end()) <= 0.0; }
  };
  Evaluation Evaluate(const ShapeNet& net) const;

  /// Regularises cells that fold, by their least determinants, with every call less.
  void Regularise(const std::vector<double>& least);

  /// The gradient at a net; keeps what Curve needs.
  ShapeNet Differentiate(const ShapeNet& net);

  /// The curvature of the energy at the net of Differentiate times a direction, without the part
  /// that is not convex.
  ShapeNet Curve(const ShapeNet& direction) const;

  /// About as large as the curvature at the net of Differentiate, but the same for X, Y and Z, and
  /// for all directions at a point: a matrix of all points. Cells that fold count as cubes.
  Eigen::SparseMatrix<double> Stiffness() const;

private:
  using Bezier = Eigen::Matrix<double, 64, 3>;
  struct Cell
  {
    std::vector<std::int32_t> Points; // of its functions
    Eigen::MatrixXd Extraction;       // from their coefficients to the 64 of Bernstein
    Eigen::Vector3d Scales;           // one over the cell's lengths
  };
  // A cell that was halved so often along each axis has 2^Halvings places along each.
  struct Part
  {
    Index Cell;
    int Halvings;
    std::array<int, 3> Place;
  };

  Bezier BezierOf(Index cell, const ShapeNet& net) const;
  std::vector<Bezier> BezierOfCells(const ShapeNet& net) const;
  // J at the points of a part.
  void FindJacobians(const Bezier& bezier, const Part& part, PartMatrices& jacobians) const;
  void Halve(const Bezier& bezier, const Part& part, std::vector<Part>& parts) const;
  double ShareOfPoint(const Part& part) const;
  using CellMatrix = Eigen::Matrix<double, 64, 64>;
  CellMatrix StiffnessOf(Index firstPart, Index lastPart) const;
  template <typename Visit>
  ShapeNet Collect(const ShapeNet& net, const Visit& visit) const;

  const Execution& Run;
  Index Points;
  std::vector<Cell> Cells;
  std::vector<Part> Parts;              // of all cells in their order
  std::vector<double> Regularisation;   // of each cell
  std::vector<double> Bluntness;        // of each cell, the next one in parts of its determinant
  std::vector<PartCurvature> Curvature; // of each part
};
}

#endif
