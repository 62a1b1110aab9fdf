// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// Block meshes without folds.
#ifndef trivariate_BlockRepair_h
#define trivariate_BlockRepair_h

#include "BlockQuality.h"
#include "BoundaryFit.h"

namespace trivariate
{
struct RepairOptions
{
  int MostRounds = 4;          ///< of 100 sweeps each, as long as cells are inverted
  double MostInverted = 0.005; ///< of the cells after a round, or there is no further one
  int MostSmoothing = 40;      ///< sweeps afterwards
  double Fitting = 1000.0;     ///< the weight of BoundaryFit
  double Evenness = 1.0;       ///< the weight of equal volumes beside that of right angles
  double Facing = 0.0;         ///< the weight of FacingFaces
  double Settled = 1e-3; ///< smoothing ends when sweeps lower the energy by less than this share,
  int Patience = 1;      ///< so many in a row: it may rise where nearest points are found anew
};

/**
 * Moves the nodes of a mesh, each as SlidingNodes lets it, one after the other, to lower the sum of
 * CornerEnergy over the corners of all cells: first with a regularisation that shrinks until no
 * cell is inverted, and starts anew with each round, then to make them even. Where cells stay
 * inverted, the mesh is that of the round with the fewest, or the last one without any: smoothing
 * may fold cells again. Nodes of one colour move at a time, so
 * that the result does not depend on threads. Each move is a Newton step with a line search.
 * targets: of each block, the wanted lengths of its cells.
 */
void Repair(BlockMesh& mesh, SlidingNodes& sliding, BoundaryFit& fit,
  const std::vector<Eigen::Vector3d>& targets, const RepairOptions& options,
  const Execution& execution);
}

#endif
