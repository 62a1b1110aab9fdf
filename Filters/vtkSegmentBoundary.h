// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSegmentBoundary
 * @brief   smooth closed surfaces between the segments of a labelled image
 *
 * The faces between voxels of different labels, made two-manifold for every segment, smoothed
 * without shrinking and cut into triangles. No point moves more than half a voxel from the voxel
 * faces. Where the densities of two segments differ, their surface settles on the level half-way
 * between them. Neighbours share their surface: one set of points, one triangle for both sides. For
 * every segment the triangles that name it are a closed, oriented two-manifold surface without
 * self-intersection, also where three or more segments meet along a curve. A voxel is the box
 * around its point, so that segments at the border of the image are closed half a voxel outside of
 * the outermost points, where the surface is flat.
 *
 * Where a segment touches itself only at a voxel edge or corner, it is connected or not by these
 * rules: across an edge when its label is higher than the other two's, or when the other two
 * differ; at a corner never, but for eight voxels of four segments, each of which is there in
 * opposite octants (the highest label is connected). So of two labels the higher is 18-connected
 * and the lower has the complementary connectivity.
 *
 * @par Input
 * Port 0: a vtkImageData with two or more points along each axis. Its point array of labels, whole
 * numbers from 0, is chosen with SetInputArrayToProcess(0, ...), by default "Segment"; its density
 * with SetInputArrayToProcess(1, ...), by default "Automatic": the active scalars or, where these
 * are the labels or have more than one component, the first other point array with one. If there
 * is none, or UseDensity is off, the labels alone count.
 *
 * @par Output
 * Port 0: vtkPolyData with triangles, points in double precision, and these arrays:
 * - cells: BoundaryLabels (int32 x 2), the segments on the inner and the outer side; normals point
 *   from the first to the second. The outer one is that which was not chosen, or segment 0, or the
 *   higher; -1 is the outside of the image. (vtkSurfaceNets3D orders them so, but does not
 *   turn the polygons accordingly.)
 * - points: Normals (float x 3, the active normals), from the inner to the outer side, in the mean
 *   over the chosen surfaces at the point weighted by angle; Junction (uint8), 0 inside a surface,
 *   1 on a curve where three or more segments (or two and the outside) meet, 2 where such curves
 *   end or meet.
 * - field data: VoxelSpacing (double x 3), the size of the voxels along i, j and k.
 * The surface of one segment s is where one of the labels is s; turn those where it is the second.
 * Which segments are chosen changes neither points nor triangles, only which are there.
 *
 * @par Accuracy
 * Balls of radius 16 and more: 0.07 voxels RMS from labels alone, 0.04 with a density with partial
 * volume; normals 3.3 and 1.6 degrees RMS; volume to 0.1 percent.
 *
 * @par Cost
 * Time linear in the voxels and in the faces between labels. Memory: 8 bytes a voxel (4 without
 * density) and about 600 bytes a face. Threaded with vtkSMPTools; the result does not depend on the
 * number of threads.
 *
 * @par Distributed data
 * Under several processes the pieces are gathered to process 0 with a warning; it gives the same
 * result as one process would, the others give an empty output.
 *
 * @par Errors
 * An image without points or labels, with labels that are no whole numbers or negative, with one
 * label only, one voxel thick, with a density that is not finite, or too large for the memory; a
 * chosen segment or density that does not exist.
 *
 * @par References
 * S. Gibson. Constrained elastic surface nets. MICCAI 1998. G. Taubin. A signal processing approach
 * to fair surface design. SIGGRAPH 1995. vtkSurfaceNets3D of VTK 9.3 makes a net with one vertex a
 * corner, where segments may touch themselves, and does not look for self-intersections; so this
 * class does not use it, whatever the version of VTK.
 *
 * @sa vtkTextureSegmentation vtkSurfaceNets3D
 */
#ifndef vtkSegmentBoundary_h
#define vtkSegmentBoundary_h

#include "vtkPolyDataAlgorithm.h"
#include "vtkTrivariateFiltersModule.h" // for export macro

#include <vector> // for Segments

class vtkDataArray;
class vtkImageData;
class vtkMultiProcessController;

class VTKTRIVARIATEFILTERS_EXPORT vtkSegmentBoundary : public vtkPolyDataAlgorithm
{
public:
  static vtkSegmentBoundary* New();
  vtkTypeMacro(vtkSegmentBoundary, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The segments whose surfaces are wanted. Default is none, which means all but segment 0, the
   * background.
   */
  void AddSegment(int segment);
  void ClearSegments();
  int GetNumberOfSegments() const { return static_cast<int>(this->Segments.size()); }
  int GetSegment(int i) const;
  ///@}

  ///@{
  /**
   * How often the surface is smoothed. Steps of the voxels that are wider need more; 0 leaves the
   * voxel faces as they are, also with a density. Valid range [0, 1000]. Default is 60.
   */
  vtkSetClampMacro(SmoothingIterations, int, 0, 1000);
  vtkGetMacro(SmoothingIterations, int);
  ///@}

  ///@{
  /**
   * Whether the surface between two segments settles on the level half-way between their densities,
   * where these differ by more than their standard deviations. Default is true.
   */
  vtkSetMacro(UseDensity, bool);
  vtkGetMacro(UseDensity, bool);
  vtkBooleanMacro(UseDensity, bool);
  ///@}

  ///@{
  /**
   * Processes that share distributed data. Default is the global controller.
   */
  void SetController(vtkMultiProcessController* controller);
  vtkMultiProcessController* GetController() const { return this->Controller; }
  ///@}

protected:
  vtkSegmentBoundary();
  ~vtkSegmentBoundary() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  vtkSegmentBoundary(const vtkSegmentBoundary&) = delete;
  void operator=(const vtkSegmentBoundary&) = delete;

  vtkDataArray* DensityArray(vtkImageData* image, vtkDataArray* labels);

  std::vector<int> Segments;
  int SmoothingIterations = 60;
  bool UseDensity = true;
  vtkMultiProcessController* Controller = nullptr;
};

#endif
