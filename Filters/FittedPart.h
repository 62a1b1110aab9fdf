// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The fit of one segment, or of several together, and what its rounds tell.
 */
#ifndef FittedPart_h
#define FittedPart_h

#include "SegmentCut.h"
#include "SegmentFits.h"

#include "vtkSmartPointer.h"

#include <string>

class vtkTSplineFit;
class vtkTable;

namespace trivariate
{
struct FittedPart
{
  TSplineModel Model;
  vtkSmartPointer<vtkTable> Rounds;
  int Together = 0;   ///< the lowest label of those that the rounds are of
  double Range = 0.0; ///< of the array in them, of which the errors of Rounds are parts
  /// Sum of the squared errors of the round trip; with several arrays those of the fit's worst one,
  /// as SquaresOf has them.
  double Squares = 0.0;
};

/**
 * Runs a fit that has its inputs, for the voxels that `mask` names (none: all) and as the options
 * want it. Its time is that of the `step`. Throws as ChainStep does.
 */
FittedPart RunFit(vtkTSplineFit* fit, const char* mask, const std::string& step,
  const SegmentFitOptions& options, Chain& chain, double from, double to);

/// The voxels of one segment over its box.
FittedPart FitOverBox(const Cut& cut, const Part& part, const SegmentFitOptions& options,
  Chain& chain, double from, double to);

/// The error that a fit ended with, of the worst array, squared and summed over so many voxels, as
/// if the first array's range were that one's.
double SquaresOf(const FittedPart& part, double voxels);

/// The error that a fit ended with, in percent of the range of what it fitted.
double LastRms(vtkTable* rounds);

/// The distinct control points that it ended with.
vtkIdType LastControlPoints(vtkTable* rounds);

/// The error, in percent of that range, that it had with so many control points: between two rounds
/// a power of their number, before the first and after the last one theirs.
double RmsWith(vtkTable* rounds, double controlPoints);

/// Adds the rounds of a fit to those of all, under a label. The error of the segment alone is known
/// of a single array.
void AddRounds(const FittedPart& fitted, int segment, bool isSingle, vtkTable* all);
}

#endif
