// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * What there is to say of a spline beside its errors: how much it stores, whether it folds, how far
 * its boundary is from the segment's.
 */
#ifndef SplineFacts_h
#define SplineFacts_h

#include "Execution.h"
#include "TSpline/TSplineModel.h"

#include <limits>
#include <set>
#include <string>

class vtkPolyData;
class vtkTable;

namespace trivariate
{
class BezierMesh;
struct ReportInput;

/// Stands for all segments together.
constexpr int AllSegments = -1;

/// NaN where something is not known.
struct SplineFacts
{
  static constexpr double NaN = std::numeric_limits<double>::quiet_NaN();
  double ControlPoints = NaN;
  double DistinctControlPoints = NaN; ///< those that glued blocks share once
  double NumbersStored = NaN; ///< of distinct control points; an affine geometry is twelve numbers
  double Blocks = NaN;
  double Bytes = NaN;
  double MinimumScaledJacobian = NaN; ///< as JacobianRange, above 0 for the image's own handedness
  double InvertedCells = NaN;
  double Hausdorff = NaN;    ///< in voxels; not for an affine geometry, the box of an image
  double GradientJump = NaN; ///< of the array a voxel, in its units
  bool Affine = false;       ///< the geometry, where the spline is whole

  /// Of two segments together; what is not known of one does not count. Affine is that of `other`.
  void Add(const SplineFacts& other);
};

/// Of the spline of a segment; the mesh is that of `part`.
SplineFacts DescribeSpline(const TSplineModel& part, const BezierMesh& mesh, int segment,
  const ReportInput& input, const Execution& execution);

/// Distinct corners of the polycubes on the surfaces of some segments; NaN where there are none.
double CountCorners(vtkPolyData* surface, const std::set<int>& segments);

/// The last row of a segment in the table of rounds, or the sum over segments (AllSegments).
double SecondsOf(vtkTable* rounds, int segment);

/// What the rounds tell of the fit that a segment ended with: those of vtkTSplineReconstruction, or
/// of vtkTSplineFit over a domain.
struct LastRound
{
  std::string Domain;                     ///< over what it was fitted; empty: not known
  double Rms = SplineFacts::NaN;          ///< in units of the array
  double GradientJump = SplineFacts::NaN; ///< likewise, a voxel
};

/// The component is that of the array among those of all attributes that were fitted.
LastRound LastRoundOf(vtkTable* rounds, int segment, int component);

/// Of a .tspline file as vtkTSplineWriter writes it.
double StoredBytes(const TSplineModel& model, const Execution& execution);
}

#endif
