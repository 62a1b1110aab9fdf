// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The T-splines of segments over their domains of cubes.
 */
#ifndef DomainFit_h
#define DomainFit_h

#include "FittedPart.h"

#include <set>
#include <string>
#include <vector>

namespace trivariate
{
/// Sets of two or more segments, from `lowest` on and without folds, whose blocks have faces in
/// common.
std::vector<std::set<int>> TouchingSegments(const FilledDomains& domains, int lowest);

/// What segments are over their cubes.
struct DomainFit
{
  std::vector<FittedPart> Fitted; ///< each of them
  std::vector<vtkIdType> Missed;  ///< voxels that the spline does not pass through
  double Error = 0.0;             ///< squared, of a voxel that is not missed
  std::string Why;                ///< there is none; empty: there is one
};

/**
 * Fits one segment, or several together, over their own blocks alone, and looks by the inverse map
 * how the spline stands for their voxels; those without a parameter are missed. Where a block mesh
 * or the spline is folded, the fit fails, or a segment misses 2 % of its voxels, there is none.
 * Throws as ChainStep does when the chain is stopped.
 */
DomainFit FitOverDomain(const SegmentedImage& image, const PartNumbers& numbers,
  const FilledDomains& domains, const SegmentFitOptions& options, Chain& chain, double from,
  double to);
}

#endif
