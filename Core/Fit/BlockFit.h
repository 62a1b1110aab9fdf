// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Adaptive least-squares fit of one T-spline to samples over the blocks of a domain.
 *
 * First the shape: X, Y, Z as functions of the parameters, refined until the spline's surface lies
 * on that of the samples, wherever on it, and no further, with a barrier against folds
 * (ShapeSolver.h); what comes after carries it along unchanged, so it lives on a coarser net,
 * nested in that of the attributes. Then every voxel takes the parameters at which this shape
 * passes through it, and the attributes are fitted there, as in FitGrid. Of several segments each
 * has attributes of its own, and its voxels their places in its own blocks. Where the shape has a
 * surface to slide on, it then follows the errors of the attributes, on its own net and with its
 * surface held (DataErrors.h); voxels take their parameters on it and the attributes are fitted
 * again, with the functions that they have, a few times and as long as the error falls.
 */
#ifndef trivariate_BlockFit_h
#define trivariate_BlockFit_h

#include "Domain/BlockComplex.h"
#include "Fit.h"
#include "GradientJump.h"
#include "ShapeJacobian.h"

#include <array>
#include <functional>
#include <map>
#include <vector>

namespace trivariate
{
/// Voxels with their parameters in the space of the complex.
struct BlockSamples
{
  std::vector<double> Parameters; ///< (u, v, w) of each; none: where the shape has them
  std::vector<double> Places;     ///< (X, Y, Z) of each
  int Components = 1;
  std::vector<double> Values; ///< Components blocks, each with a number for each voxel

  Index Count() const { return static_cast<Index>(this->Places.size() / 3); }
};

/// Points of the shape, such as the nodes of a block mesh; none: the voxels, at their parameters.
struct ShapeSamples
{
  std::vector<double> Parameters; ///< (u, v, w) of each; on a face of a block: of the surface
  std::vector<double> Places;     ///< (X, Y, Z) of each
  /// The surface between the samples on it, three of them each, anticlockwise seen from outside of
  /// their block; none: the shape takes each sample to its own place.
  std::vector<std::array<Index, 3>> Surface;
};

/**
 * Appends a lattice of samples of block b, `intervals` along its edges: place(u, v, w) for u, v, w
 * in [0, 1]; and the triangles between them on those of its faces that are on the surface of its
 * segment, outer or to another one. (u, v, w) must map to places right-handedly.
 */
void AddSamplesOfBlock(const BlockComplex& blocks, Index b, const std::array<int, 3>& intervals,
  const std::function<std::array<double, 3>(const std::array<double, 3>&)>& place,
  ShapeSamples& shape);

struct BlockFitOptions
{
  Refinement Rule = Refinement::Compact; ///< that or AnalysisSuitable
  Index MaximumControlPoints = 50000;    ///< distinct ones; hard limit
  /// As in FitOptions.
  double RmsTolerance = 0.0;
  double MaximumErrorTolerance = 0.0;
  /// The shape is refined until the root mean square distance from where the surface is wanted is
  /// at most this, in the unit of the places, or it has MaximumShapePoints control points; as long
  /// as it is more than 0.35 Spacing, up to half of all and 2000.
  double ShapeTolerance = 0.1;
  Index MaximumShapePoints = 2000;
  /// A shape that slides and is farther away than this when it is refined no further is refused
  /// with an error, before the costly steps that end it; 0: none is.
  double LargestShapeDistance = 0.0;
  double Spacing = 1.0;  ///< distance of voxels in the unit of the places
  int CoarsestCells = 1; ///< along the edge of a block, a power of two
};

struct BlockFitResult
{
  /// Components: X, Y, Z, then the attributes.
  TSpline Spline;
  std::vector<Index> PointOf; ///< of each function: which of the distinct control points it has
  std::vector<Index> BlockOf; ///< of each function: its block, or one of its group
  Index ControlPoints = 0;    ///< distinct ones
  std::vector<FitRound> Rounds;
  std::map<int, double> SegmentRms; ///< of the last round, each segment's, as FitRound::Rms
  std::vector<double> Ranges;       ///< of each attribute, of which errors are parts
  Index ShapePoints = 0;            ///< distinct control points that the shape was fitted with
  /// The numbers that were solved for: three for each control point of the shape, which later
  /// splits only carry along, and the attributes of all control points. A file has the places of
  /// all.
  Index NumbersFitted = 0;
  double ShapeRms = 0.0, ShapeMaximum = 0.0; ///< distance from where the surface is wanted
  Index VoxelsInside = 0;                    ///< voxels that the shape passes through
  Index VoxelsNear = 0; ///< others, up to half of Spacing away; they have their nearest point
  ShapeFolds Folds;     ///< of the shape, also at all voxels
  /// Of the attribute where it is largest, in parts of its range a Spacing.
  GradientJump Jump;
  std::vector<std::pair<std::string, double>> Seconds; ///< by topic
};

/**
 * Throws std::invalid_argument with a sentence for the user, Aborted when stopped. The result is
 * the same for any threads.
 */
BlockFitResult FitBlocks(const BlockComplex& blocks, const BlockSamples& voxels,
  const ShapeSamples& shape, const BlockFitOptions& options, const Execution& execution = {});
}

#endif
