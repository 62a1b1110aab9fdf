// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTSplineFit
 * @brief   adaptive trivariate cubic T-spline through a volume image
 *
 * Fits point arrays of an image by least squares with a T-spline that is refined where the error
 * is, until the wanted error or the allowed number of control points is reached. The image's index
 * space is the parameter space: voxel (i, j, k), counted from the first voxel of the image's
 * extent, lies at (u, v, w) = (i, j, k). The geometry of the spline is the image's own affine map
 * from indices to space (origin, spacing, direction), exactly.
 *
 * Over a domain: with the parameters of the voxels, and the cubes and block meshes that belong to
 * them, one spline is fitted over all blocks of the domain. X, Y, Z become functions of (u, v, w)
 * whose faces lie on the surface of the segments, wherever on it, on the coarsest net that puts
 * them there, and later splits carry them along; every voxel takes the parameters at which this
 * shape passes through it, and the attributes are fitted there. With block meshes the shape then
 * moves, its surface held, to where the errors of the attributes want it, and these are fitted
 * again, in turns and as long as that lowers the error. Blocks of one group are joined C2, also
 * where they do not fill a box: cells outside of them are switched off, and functions without
 * support in them left out; across other common faces the control points are the same on both
 * sides, so there is no gap. Between two segments that holds for their places; attributes are each
 * segment's own, fitted to the voxels with parameters in its blocks.
 *
 * @par Input
 * Port 0: a vtkImageData with two or more points along each axis. The point array chosen with
 * SetInputArrayToProcess(0, ...) and those named with AddAttribute are fitted, any real type and
 * number of components each, with the same blending functions for all. An optional point array
 * (SetMaskArray) says which voxels count. Over a domain also with the arrays Parameter and
 * ParameterMask; voxels where that is zero do not count.
 * Port 1 (optional): vtkUnstructuredGrid, the polycube of vtkVolumeParameterization; makes it a fit
 * over a domain.
 * Port 2 (optional): vtkPartitionedDataSetCollection, its block meshes, which tell where the
 * surface is; a barrier on the determinant then keeps the shape from folding, and a warning says in
 * how many cells it folds still. Without them the shape is fitted to the voxels and ends near the
 * outermost of them.
 *
 * @par Output
 * Port 0: the T-spline grid, a vtkUnstructuredGrid with one point and one vertex cell a control
 * point and the point arrays KnotsU, KnotsV, KnotsW (double x 5), Weight (double), Segment and
 * Block (int32, zero), and one double array an attribute under the attribute's own name; see
 * Documentation/Arrays.md. vtkTSplineSource evaluates it, vtkTSplineWriter stores it.
 * Over a domain the Segment and Block of the polycube instead of zeros, and SharedControlPoint
 * (vtkIdType): functions that share a control point have the same number there; and where blocks of
 * a group do not fill a box the field data Holes (double x 6).
 * Port 1: a vtkTable with one row a round of solving and refining and the columns ControlPoints
 * (vtkIdType), RMS (100 x root mean square error / range of the attribute), MaximumError (share of
 * the range; NaN after a round that did not need it) and Seconds (since the start). Of several
 * attributes the worst counts. The last row belongs to the output. Over a domain control points are
 * counted once for all functions that share them, rows are the rounds of the attributes, and the
 * field data has ShapeControlPoints (vtkIdType), ShapeDistance (double x 2: root mean square and
 * largest distance of the spline from where its surface is wanted, in voxels), NumbersFitted
 * (vtkIdType: three for each control point of the shape and one a component of the attributes for
 * each of all control points; a file has the places of all), VoxelsInside (vtkIdType
 * x 2: voxels that the shape passes through, of how many), VoxelsNear (vtkIdType: others, up to
 * half a voxel away from it, which take their nearest point), SmallestJacobian (double: least
 * determinant of d(X, Y, Z)/d(u, v, w), in parts of its mean), FittedSegment (int32) and
 * FittedSegmentRMS (double, percent of the range as RMS: the last round's in each of them),
 * FittedDomain (string, of each of them: Cubes, or LayeredCubes with blocks along the surface),
 * FittedRange (double, a component for each of the attributes': the range of the voxels that
 * count), ShapeCells (vtkIdType x 3: Bezier cells of the shape, those with a fold, those proven to
 * have none) and GradientJump (double x 2: root mean square and largest jump of an attribute's
 * gradient in space across faces inside of a segment that are joined by common control points only,
 * in parts of its range a voxel).
 *
 * @par Cost
 * About 100 bytes a voxel for one component and 6 kB a control point at the peak, of which the copy
 * of the samples is 8 bytes a voxel and component. Each round reads the voxels a few times; solving
 * does not depend on their number. Threaded with vtkSMPTools; the result does not depend on the
 * number of threads.
 *
 * @par Distributed data
 * The fit is one global solve. Under several processes the pieces are gathered to process 0 with a
 * warning; it gives the same result as one process would, the others give an empty output.
 *
 * @par Errors
 * An image without points, without the chosen array, with a mask array of another size or without
 * a voxel that counts, one voxel thick, with NaN or infinity, or too large for the memory. Over a
 * domain: the refinement rule UNIFORM, parameters outside of the blocks, fewer control
 * points allowed than the blocks have at least.
 *
 * @par Reference
 * Sederberg, Zheng, Bakenov, Nasri. T-splines and T-NURCCs. SIGGRAPH 2003.
 *
 * @sa vtkVolumeParameterization vtkTSplineSource vtkTSplineWriter vtkTSplineReader
 */
#ifndef vtkTSplineFit_h
#define vtkTSplineFit_h

#include "vtkTrivariateFiltersModule.h" // for export macro
#include "vtkUnstructuredGridAlgorithm.h"

#include <string> // for MaskArray
#include <vector> // for Attributes

class vtkDataArray;
class vtkImageData;
class vtkMultiProcessController;
class vtkTable;

namespace trivariate
{
struct ImageSamples;
}

class VTKTRIVARIATEFILTERS_EXPORT vtkTSplineFit : public vtkUnstructuredGridAlgorithm
{
public:
  static vtkTSplineFit* New();
  vtkTypeMacro(vtkTSplineFit, vtkUnstructuredGridAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// How the mesh is refined.
  enum RefinementRules
  {
    /// Blending functions split by knot insertion, anisotropic: the fewest control points.
    COMPACT = 0,
    /// Bisection with a closure: dual-compatible and linearly independent, all weights one.
    ANALYSIS_SUITABLE = 1,
    /// No refinement: one tensor-product fit with about the allowed number of control points.
    UNIFORM = 2
  };

  ///@{
  /**
   * One of RefinementRules. Default is COMPACT.
   */
  vtkSetClampMacro(RefinementRule, int, COMPACT, UNIFORM);
  vtkGetMacro(RefinementRule, int);
  ///@}

  ///@{
  /**
   * Refinement stops before there are more control points. Valid range [64, VTK_INT_MAX]; 64 are
   * one tricubic polynomial. Default is 50000.
   */
  vtkSetClampMacro(MaximumNumberOfControlPoints, int, 64, VTK_INT_MAX);
  vtkGetMacro(MaximumNumberOfControlPoints, int);
  ///@}

  ///@{
  /**
   * Refinement stops when the root mean square error over the voxels is at most this many percent
   * of the range of each attribute (and MaximumErrorTolerance is met too). 0 is no such limit: only
   * the number of control points counts. Valid range [0, 100]. Default is 0.
   */
  vtkSetClampMacro(RMSTolerance, double, 0.0, 100.0);
  vtkGetMacro(RMSTolerance, double);
  ///@}

  ///@{
  /**
   * Refinement stops when the largest error of a voxel is at most this share of the range of each
   * attribute (and RMSTolerance is met too). 0 is no such limit. Valid range [0, 1]. Default is 0.
   */
  vtkSetClampMacro(MaximumErrorTolerance, double, 0.0, 1.0);
  vtkGetMacro(MaximumErrorTolerance, double);
  ///@}

  ///@{
  /**
   * Whether the blending functions of the compact rule are made linearly independent: a function
   * that knot insertion left over is removed and the others adjusted, the spline staying what it
   * is. A basis is needed for analysis, not for the fit; the search takes about a tenth of the
   * fit's time. The other rules give independent functions in any case; over a domain it is not
   * done, for it would part what both sides of a face have in common. Default is true.
   */
  vtkSetMacro(LinearlyIndependent, bool);
  vtkGetMacro(LinearlyIndependent, bool);
  vtkBooleanMacro(LinearlyIndependent, bool);
  ///@}

  ///@{
  /**
   * Over a domain, the shape is refined until its root mean square distance from where the surface
   * is wanted is at most this many voxels: a quarter of a voxel outside of the block meshes, so
   * that the voxels next to it are inside. Without block meshes it is the distance of the voxels
   * from their places. Valid range [0, 100]. Default is 0.1.
   */
  vtkSetClampMacro(ShapeTolerance, double, 0.0, 100.0);
  vtkGetMacro(ShapeTolerance, double);
  ///@}

  ///@{
  /**
   * Over a domain, refinement of the shape takes at most this share of the control points, and up
   * to half of them, but not more than 2000, as long as it is farther than 0.35 voxels from its
   * surface (root mean square): there it gains more than the arrays lose. Valid range [0, 1].
   * Default is a quarter: then X, Y, Z are up to three sevenths of the numbers of the spline.
   */
  vtkSetClampMacro(ShapeShare, double, 0.0, 1.0);
  vtkGetMacro(ShapeShare, double);
  ///@}

  ///@{
  /**
   * Over a domain, a shape that is farther than this many voxels from its surface (root mean
   * square) when it is refined no further is refused with an error, before the steps that take
   * most of the time. Valid range [0, 100]. Default is 0: none is refused.
   */
  vtkSetClampMacro(LargestShapeDistance, double, 0.0, 100.0);
  vtkGetMacro(LargestShapeDistance, double);
  ///@}

  ///@{
  /**
   * Names of further point arrays that are fitted beside the chosen one. Default is none; naming
   * the chosen one again changes nothing.
   */
  void AddAttribute(const char* name);
  void ClearAttributes();
  int GetNumberOfAttributes() const { return static_cast<int>(this->Attributes.size()); }
  const char* GetAttribute(int i) const;
  ///@}

  ///@{
  /**
   * Name of a point array with one component; voxels where it is zero do not count, and blending
   * functions without a voxel that counts are left out. "None" or the empty name: all voxels count.
   * Default is "None".
   */
  void SetMaskArray(const char* name);
  const char* GetMaskArray() const { return this->MaskArray.c_str(); }
  ///@}

  ///@{
  /**
   * Processes that share distributed data. Default is the global controller.
   */
  void SetController(vtkMultiProcessController* controller);
  vtkMultiProcessController* GetController() const { return this->Controller; }
  ///@}

protected:
  vtkTSplineFit();
  ~vtkTSplineFit() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  vtkTSplineFit(const vtkTSplineFit&) = delete;
  void operator=(const vtkTSplineFit&) = delete;

  void FitImage(trivariate::ImageSamples& samples, vtkUnstructuredGrid* output, vtkTable* rounds);
  void FitDomain(trivariate::ImageSamples& samples, vtkInformationVector** inputVector,
    vtkUnstructuredGrid* output, vtkTable* rounds);

  int RefinementRule = COMPACT;
  int MaximumNumberOfControlPoints = 50000;
  double RMSTolerance = 0.0;
  double MaximumErrorTolerance = 0.0;
  bool LinearlyIndependent = true;
  double ShapeTolerance = 0.1;
  double ShapeShare = 0.25;
  double LargestShapeDistance = 0.0;
  std::vector<std::string> Attributes;
  std::string MaskArray = "None";
  vtkMultiProcessController* Controller = nullptr;
};

#endif
