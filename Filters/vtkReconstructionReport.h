// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkReconstructionReport
 * @brief   how well, and in how many numbers, a T-spline stands for an image
 *
 * Compares an image with a T-spline that was fitted to it, segment by segment and in total. The
 * errors that count are those of the round trip: the spline is evaluated at every voxel by its
 * inverse map, as vtkTSplineSource makes an image of it, and compared with the voxel. A voxel that
 * the inverse map does not find has the value zero there, and that is how it counts.
 *
 * @par Input
 * Port 0: a vtkImageData. The point array to compare, one component of any real type, is chosen
 * with SetInputArrayToProcess(0, ...); the T-spline must have an attribute of the same name. The
 * point array of labels, whole numbers, is chosen with SetInputArrayToProcess(1, ...), by default
 * "Automatic": the one called Segment, or else all voxels are one segment; that is an error where
 * the spline has several, whose splines overlap in space. If there is a point array Parameter (3
 * components), it says where in the spline's parameter space a voxel lies, where an array
 * ParameterMask, if there is one, is not zero.
 * Port 1: the T-spline grid. The control points' array Segment tells whose spline is whose; one
 * without a segment (0 alone, as of a fit without domain) stands for all voxels.
 * Port 2 (optional): vtkPolyData, the surfaces of the segments, by vtkSegmentBoundary or (patches)
 * vtkPolycubeDomain.
 * Port 3 (optional): vtkTable, the rounds of the fit; of its columns Seconds, RMS, Range,
 * GradientJump and Domain the last row of each segment (column Segment, if there is one) counts; of
 * vtkTSplineFit over a domain the field data FittedSegmentRMS, FittedDomain, FittedRange and
 * GradientJump.
 *
 * @par Output
 * Port 0: vtkTable with one row a segment, ascending, and one with Segment -1 for all. Columns are
 * double but for the first two and the last; NaN where a number is not known.
 * - Segment (int), Voxels (vtkIdType);
 * - RMSPercent: 100 x root mean square error / range of the image's array at the voxels' own
 *   parameters. Where the geometry of the spline is affine, as under a fit without domain, they are
 *   those of the round trip. Over cubes the fit moves them from where the array Parameter has them:
 *   the rounds (port 3) tell what it ended with, over the voxels that were fitted (of several
 *   attributes at once, that of the worst one); without rounds those of Parameter count. NaN
 *   where neither tells, a voxel has no parameters, or is not found in a box;
 * - Corners: of the polycubes on the surfaces (port 2 with the point array CornerId) of segments
 * that were fitted over cubes; NaN where none was;
 * - ControlPoints: blending functions, points of the grid; DistinctControlPoints: those that glued
 *   blocks share once, as fits and their limits count them;
 * - RoundTripRMSPercent, MaximumErrorPercent: of the round trip, in percent of the same range;
 *   FoundPercent: share of the voxels found by the inverse map, in splines of segments also those
 *   that lie outside of theirs by up to 1.5 times the largest of the voxels' three spacings, and
 *   take the value at its nearest point;
 * - PSNRDecibels: -20 log10 of the round trip's RMS as a share of the range;
 * - HausdorffVoxels: Hausdorff distance of the spline's boundary and the segment's surface (port
 *   2), in units of voxels; the largest one in total. NaN for an affine geometry, whose boundary is
 *   that of a box;
 * - GradientJumpPercent: root mean square, over the faces that blocks share without being C2 there,
 *   of the jump of the array's gradient in space, a voxel, as the rounds tell (port 3); 0 where the
 *   geometry is affine, the largest one in total;
 * - MinimumScaledJacobian: smallest determinant of d(X, Y, Z)/d(u, v, w) divided by the lengths of
 *   its columns, in [-1, 1], at 3^3 points of each Bezier cell; InvertedCells: cells where it is
 *   not above zero. In an image whose indices are a left hand the sign is turned;
 * - Blocks: groups of cubes, the values of Block;
 * - NumbersStored: coordinates and attributes of the distinct control points, and twelve numbers in
 *   place of the coordinates where the geometry is affine. A fit over a domain finds those on a
 *   coarser net, which a file does not have; its NumbersFitted are fewer;
 * - SplineBytes: of the .tspline file that vtkTSplineWriter writes, with all attributes; LabelBytes
 *   (total only): of the labels deflated, which the image is written back with where splines are
 *   of segments; RawBytes, ZLibBytes: of the voxels, as they are and deflated by
 *   vtkZLibDataCompressor;
 * - Seconds: of port 3;
 * - Domain (string), over what the segment was fitted: ImageBox (one spline for all), SegmentBox,
 *   Cubes, LayeredCubes (cubes with blocks along the surface; only the rounds tell, without them
 *   they are Cubes), None (the spline has no such segment); Mixed in the last row where segments
 *   differ.
 * Where one spline stands for several segments, what else concerns the spline is in the last row
 * only.
 *
 * @par Cost
 * Time: twice that of vtkTSplineSource for the image, ten microseconds a Bezier cell, and deflating
 * the volume. Memory: 40 bytes a voxel (72 with Parameter). Threaded with vtkSMPTools; the result
 * does not depend on the number of threads.
 *
 * @par Distributed data
 * Under several processes the pieces of the image are gathered to process 0 with a warning; it
 * makes the table, the others an empty one. The T-spline must be on process 0, where the fit leaves
 * it.
 *
 * @par Errors
 * An image without points or without the chosen array, with more than one component, NaN or
 * infinity, labels that are no whole numbers or, for splines of several segments, none; a grid
 * that is no T-spline or has no attribute of that name; too little memory.
 *
 * @sa vtkTSplineFit vtkTSplineSource vtkTSplineReconstruction
 */
#ifndef vtkReconstructionReport_h
#define vtkReconstructionReport_h

#include "vtkTableAlgorithm.h"
#include "vtkTrivariateFiltersModule.h" // for export macro

class vtkImageData;
class vtkMultiProcessController;
namespace trivariate
{
struct ReportInput;
}

class VTKTRIVARIATEFILTERS_EXPORT vtkReconstructionReport : public vtkTableAlgorithm
{
public:
  static vtkReconstructionReport* New();
  vtkTypeMacro(vtkReconstructionReport, vtkTableAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The inputs beside the image: the T-spline, and optionally the segments' surfaces and the rounds
   * of the fit.
   */
  void SetTSplineConnection(vtkAlgorithmOutput* input) { this->SetInputConnection(1, input); }
  void SetSurfacesConnection(vtkAlgorithmOutput* input) { this->SetInputConnection(2, input); }
  void SetRoundsConnection(vtkAlgorithmOutput* input) { this->SetInputConnection(3, input); }
  ///@}

  ///@{
  /**
   * Processes that share distributed data. Default is the global controller.
   */
  void SetController(vtkMultiProcessController* controller);
  vtkMultiProcessController* GetController() const { return this->Controller; }
  ///@}

protected:
  vtkReconstructionReport();
  ~vtkReconstructionReport() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  vtkReconstructionReport(const vtkReconstructionReport&) = delete;
  void operator=(const vtkReconstructionReport&) = delete;

  void ReadImage(vtkImageData* image, trivariate::ReportInput& input);

  vtkMultiProcessController* Controller = nullptr;
};

#endif
