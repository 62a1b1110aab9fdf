// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Gradients at voxels from a cubic polynomial fitted to the 2-ring: eqs. (2) to (7) of the paper.
 *
 * With the values U at the voxels of the 5 x 5 x 5 ring, grad u = (P_x, P_y, P_z) (Q^T Q)^-1 Q^T U:
 * the same 3 x 125 weights wherever the ring is whole. (In a 1-ring Q has rank 17 of 20.) Where the
 * ring is cut, they are fitted to the voxels that are there, with the highest degree, 3, 2 or 1,
 * that does not amplify errors: whose weights are shorter than those of a central difference, times
 * sqrt(2).
 *
 * These gradients are zero for every checkerboard, so their energy alone does not determine u.
 */
#ifndef trivariate_PolynomialGradient_h
#define trivariate_PolynomialGradient_h

#include "ParameterSystem.h"

namespace trivariate
{
class PolynomialGradient
{
public:
  /// At the voxels of the segment, over it and its band. Memory: 3 kB for each voxel whose ring is
  /// cut. `cells` must outlive this.
  PolynomialGradient(const ParameterCells& cells, const Execution& execution);

  /// grad u at a voxel of the segment.
  Eigen::Vector3d At(Index node, const double* u) const;

  /// y += the sum over voxels of G^T D G x, times a voxel's volume; D as in ParameterSystem.h.
  void AddEnergy(const TargetField& targets, double epsilon, const double* x, double* y,
    const Execution& execution) const;

  /// b += the sum over voxels of G^T D f, times a voxel's volume.
  void AddRightHandSide(const TargetField& targets, double epsilon, std::vector<double>& b,
    const Execution& execution) const;

private:
  using Weights = Eigen::Matrix<double, 3, 125>; // x fastest, from -2 to 2

  const Weights& WeightsOf(Index node) const
  {
    return this->Own[node] < 0 ? this->Whole : this->Cut[this->Own[node]];
  }
  template <typename Force>
  void Scatter(const Force& force, double* y, const Execution& execution) const;

  const ParameterCells& Cells;
  Weights Whole;
  std::vector<std::int32_t> Own; // of each node: its place in Cut; -1: whole, or no voxel
  std::vector<Weights> Cut;
};
}

#endif
