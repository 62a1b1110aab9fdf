// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// How the squared errors of the attributes change with the shape of a spline.
#ifndef trivariate_DataErrors_h
#define trivariate_DataErrors_h

#include "FoldEnergy.h"
#include "ScatteredSystem.h"

#include <memory>
#include <vector>

namespace trivariate
{
struct DataErrorOptions
{
  double Spacing = 1.0; ///< distance of voxels in the unit of the places
  double Weight = 1.0;  ///< of the squared error of a voxel in parts of its attribute's range
  /// Of the squared way that each voxel of the shape goes, in Spacing, in parts of Weight.
  double Damping = 0.0;
  /// Voxels that the second derivative is of, for each control point, where there are more.
  Index VoxelsOfPoint = 24;
};

/**
 * A voxel at x with the value d has the error r = d - f(x) where the spline is f. A shape that
 * moves by dx there carries the value of another place to x: r + grad f . dx. The attributes are
 * fitted again to these, which takes off what they can follow: E(dx) = 1/2 Weight (|P (r + grad f .
 * dx)|^2 + Damping |dx / Spacing|^2), P the projection of values at all voxels off the attributes'
 * functions (variable projection, G. Golub and V. Pereyra, 1973; exact to first order in dx).
 * Errors are in parts of `ranges`; several attributes are summed. dx is what a net of the shape's
 * functions makes at the voxels' parameters.
 *
 * The gradient is that of all voxels. The second derivative only has to tell which way, and is
 * that of every so manieth along the cells, counted as often, with an attribute that is fitted to
 * these. A product costs about a microsecond for each of them, with one attribute, and a few tens
 * of products with their normal equations; 3 numbers for each and attribute are kept.
 */
class DataErrors
{
public:
  /**
   * `spline` has X, Y, Z and the attributes of `samples`, at whose parameters it passes through
   * them; `attributes` their residuals. The shape is that of the spline with fewer functions. The
   * layout and the execution must outlive this object.
   */
  DataErrors(const TSpline& spline, const TSpline& shape, const BlockSpline& layout,
    const ScatteredSamples& samples, const ScatteredSystem& attributes,
    const std::vector<double>& ranges, const DataErrorOptions& options, const Execution& execution);

  /// The gradient at dx = 0.
  const ShapeNet& Slope() const { return this->Gradient; }
  /// The second derivative times a net.
  ShapeNet Curve(const ShapeNet& direction) const;
  /// About as large as the second derivative, the same for X, Y and Z.
  GramMatrix Bound() const;

private:
  using Gradients = std::vector<Eigen::Matrix3Xd>; // of each attribute, a column for each voxel

  static Gradients FindSlopes(const TSpline& spline, const BezierMesh& mesh,
    const ScatteredSamples& samples, const std::vector<double>& ranges, double spacing,
    const Execution& execution);
  void TakeOffAttributes(ColumnsOfSamples& values) const;

  const Execution& Run;
  const BlockSpline& Layout;
  const TSpline Shape;
  double Weight, Damping; // Damping for ways in the unit of the places
  ShapeNet Gradient;
  std::vector<Index> Few;  // voxels of the second derivative
  ScatteredSamples Voxels; // these, without values
  ScatteredSystem Attributes, OfShape;
  std::unique_ptr<GramMatrix> Gram; // of Attributes
  Gradients Slopes;                 // in parts of each attribute's range
};
}

#endif
