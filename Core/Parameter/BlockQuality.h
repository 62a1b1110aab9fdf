// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef trivariate_BlockQuality_h
#define trivariate_BlockQuality_h

#include "BlockMesh.h"
#include "Execution.h"

namespace trivariate
{
/// How good the cells of a mesh are.
struct CellQuality
{
  Index Cells = 0;
  Index Inverted = 0;            ///< LeastDeterminant <= 0
  std::vector<Index> InvertedIn; ///< each block
  double LeastJacobian = 0.0;    ///< scaled, see ScaledJacobian in DomainLayers.h
  double MeanJacobian = 0.0;
  double LowRatio = 0.0, HighRatio = 0.0; ///< of a cell's volume to its block's mean: 1, 99 percent
};

CellQuality QualityOf(const BlockMesh& mesh, const Execution& execution);
}

#endif
