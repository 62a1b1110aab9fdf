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
 * @par Input
 * Port 0: a vtkImageData with two or more points along each axis. The point array chosen with
 * SetInputArrayToProcess(0, ...) and those named with AddAttribute are fitted, any real type and
 * number of components each, with the same blending functions for all. An optional point array
 * (SetMaskArray) says which voxels count.
 *
 * @par Output
 * Port 0: the T-spline grid, a vtkUnstructuredGrid with one point and one vertex cell a control
 * point and the point arrays KnotsU, KnotsV, KnotsW (double x 5), Weight (double), Segment and
 * Block (int32, zero), and one double array an attribute under the attribute's own name; see
 * Documentation/Arrays.md. vtkTSplineSource evaluates it, vtkTSplineWriter stores it.
 * Port 1: a vtkTable with one row a round of solving and refining and the columns ControlPoints
 * (vtkIdType), RMS (100 x root mean square error / range of the attribute), MaximumError (share of
 * the range; NaN after a round that did not need it) and Seconds (since the start). Of several
 * attributes the worst counts. The last row belongs to the output.
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
 * a voxel that counts, one voxel thick, with NaN or infinity, or too large for the memory.
 *
 * @par Reference
 * Sederberg, Zheng, Bakenov, Nasri. T-splines and T-NURCCs. SIGGRAPH 2003.
 *
 * @sa vtkTSplineSource vtkTSplineWriter vtkTSplineReader
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
   * fit's time. The other rules give independent functions in any case. Default is true.
   */
  vtkSetMacro(LinearlyIndependent, bool);
  vtkGetMacro(LinearlyIndependent, bool);
  vtkBooleanMacro(LinearlyIndependent, bool);
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

  vtkDataArray* ChosenArray(vtkImageData* image);

  int RefinementRule = COMPACT;
  int MaximumNumberOfControlPoints = 50000;
  double RMSTolerance = 0.0;
  double MaximumErrorTolerance = 0.0;
  bool LinearlyIndependent = true;
  std::vector<std::string> Attributes;
  std::string MaskArray = "None";
  vtkMultiProcessController* Controller = nullptr;
};

#endif
