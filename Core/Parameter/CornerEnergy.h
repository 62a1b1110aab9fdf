// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The foldover-free energy at the corner of a hexahedron, as a function of one of its nodes:
 *   E(J) = tr(J^T J) / chi(D)^(2/3) + evenness (1 + D^2) / chi(D),   D = det J,
 * J from a box of the wanted lengths to the corner's three edges: the shape and the size. chi is D
 * made positive: (D + sqrt(epsilon^2 + D^2)) / 2 (V. Garanzha et al., Foldover-free maps in 50
 * lines of code, 2021).
 */
#ifndef trivariate_CornerEnergy_h
#define trivariate_CornerEnergy_h

#include "BlockCells.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <cmath>

namespace trivariate
{
/// J's trace and determinant when the node moves by d: T + t.d + k d.d and D + c.d, exactly.
struct CornerTerm
{
  double Trace, Determinant;
  Eigen::Vector3d TraceSlope, DeterminantSlope;
  double TraceCurve;

  double TraceAt(const Eigen::Vector3d& d) const
  {
    return this->Trace + this->TraceSlope.dot(d) + this->TraceCurve * d.squaredNorm();
  }

  double DeterminantAt(const Eigen::Vector3d& d) const
  {
    return this->Determinant + this->DeterminantSlope.dot(d);
  }
};

inline Eigen::Matrix3d CornerJacobian(const std::vector<Eigen::Vector3d>& places,
  const BlockPoints& cell, int corner, const Eigen::Vector3d& lengths)
{
  Eigen::Matrix3d jacobian;
  for (int axis = 0; axis < 3; ++axis)
  {
    const Eigen::Vector3d edge = places[cell[AcrossAxis(corner, axis)]] - places[cell[corner]];
    jacobian.col(axis) = (EndOfCorner(corner, axis) ? -edge : edge) / lengths[axis];
  }
  return jacobian;
}

/// At `corner`, when the node there moves (axis -1), or its neighbour along an axis.
inline CornerTerm TermOf(const std::vector<Eigen::Vector3d>& places, const BlockPoints& cell,
  int corner, int movedAxis, const Eigen::Vector3d& lengths)
{
  const Eigen::Matrix3d j = CornerJacobian(places, cell, corner, lengths);
  Eigen::Matrix3d cofactors;
  cofactors << j.col(1).cross(j.col(2)), j.col(2).cross(j.col(0)), j.col(0).cross(j.col(1));
  CornerTerm term{ j.squaredNorm(), j.col(0).dot(cofactors.col(0)), Eigen::Vector3d::Zero(),
    Eigen::Vector3d::Zero(), 0.0 };
  for (int axis = 0; axis < 3; ++axis)
  {
    if (movedAxis >= 0 && movedAxis != axis)
    {
      continue;
    }
    const bool forward = (EndOfCorner(corner, axis) == 0) == (movedAxis >= 0);
    const double rate = (forward ? 1.0 : -1.0) / lengths[axis]; // of the column with the node
    term.TraceSlope += 2.0 * rate * j.col(axis);
    term.DeterminantSlope += rate * cofactors.col(axis);
    term.TraceCurve += rate * rate;
  }
  return term;
}

/// Of the trilinear map at a point of a cell, when the node at a corner moves.
inline CornerTerm TermAt(const std::vector<Eigen::Vector3d>& places, const BlockPoints& cell,
  const Eigen::Vector3d& at, int corner, const Eigen::Vector3d& lengths)
{
  const Eigen::Matrix3d j = JacobianAt(places, cell, at) * lengths.cwiseInverse().asDiagonal();
  Eigen::Matrix3d cofactors;
  cofactors << j.col(1).cross(j.col(2)), j.col(2).cross(j.col(0)), j.col(0).cross(j.col(1));
  const Eigen::Vector3d rate = ShapeGradient(corner, at).cwiseQuotient(lengths);
  return { j.squaredNorm(), j.col(0).dot(cofactors.col(0)), 2.0 * j * rate, cofactors * rate,
    rate.squaredNorm() };
}

/// The energy and its derivatives in trace and determinant.
struct EnergyDerivatives
{
  double Value, ByTrace, ByDeterminant, ByBoth, ByDeterminantTwice;
};

inline double CornerEnergy(double trace, double d, double epsilon, double evenness)
{
  const double root = std::sqrt(epsilon * epsilon + d * d);
  const double chi = d > 0.0 ? 0.5 * (d + root) : 0.5 * epsilon * epsilon / (root - d);
  const double cubic = std::cbrt(chi);
  return trace / (cubic * cubic) + evenness * (1.0 + d * d) / chi;
}

inline EnergyDerivatives CornerDerivatives(double trace, double d, double epsilon, double evenness)
{
  const double root = std::sqrt(epsilon * epsilon + d * d);
  const double chi = d > 0.0 ? 0.5 * (d + root) : 0.5 * epsilon * epsilon / (root - d);
  const double slope = chi / root; // of chi
  const double curve = 0.5 * epsilon * epsilon / (root * root * root);
  const double cubic = std::cbrt(chi), shape = 1.0 / (cubic * cubic);
  const double size = 1.0 + d * d, ratio = slope / chi;
  const double sizeSlope = (2.0 * d - size * ratio) / chi;
  const double sizeCurve =
    (2.0 - 4.0 * d * ratio - size * curve / chi + 2.0 * size * ratio * ratio) / chi;
  return { trace * shape + evenness * size / chi, shape,
    -2.0 / 3.0 * trace * shape * ratio + evenness * sizeSlope, -2.0 / 3.0 * shape * ratio,
    trace * shape * (10.0 / 9.0 * ratio * ratio - 2.0 / 3.0 * curve / chi) + evenness * sizeCurve };
}
}

#endif
