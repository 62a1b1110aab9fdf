// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSegmentTopology
 * @brief   makes segments of a labelled image whole: one piece, no cavities, no handles
 *
 * Segments of measured volumes have specks, pores and thin bridges that no domain of a few cubes
 * can follow. Here each chosen segment keeps its largest piece; cavities are filled; and handles
 * are cut, or closed, by the smallest sheet of voxels. Sheets and cavities larger than a limit are
 * left: those belong to the shape.
 *
 * A ball is grown within the segment, deepest voxels first, by voxels that do not change its
 * topology (simple points); what cannot be taken are the sheets that cut handles. The same from
 * outside gives the sheets that close them. Voxels that a segment loses go to their neighbours.
 *
 * @par Input
 * Port 0: a vtkImageData. Its point array of labels, whole numbers from 0, is chosen with
 * SetInputArrayToProcess(0, ...), by default "Segment".
 *
 * @par Output
 * Port 0: the image with the labels changed (int32, under the same name). Field data, one tuple a
 * chosen segment: TopologySegment, TopologyPieces, TopologyCavities, TopologyCut, TopologyClosed
 * (voxels that changed for each reason), TopologyEuler (vtkIdType; 1 - handles + cavities of the
 * result: 1 for a segment like a ball).
 *
 * @par Cost
 * Time: some passes over the voxels, about 0.2 microseconds a voxel and segment each; twenty or so
 * where there are many handles of all sizes. Memory: 30 bytes a voxel.
 *
 * @par Distributed data
 * Under several processes the pieces are gathered to process 0 with a warning and the labels sent
 * back: each keeps its piece, with the labels one process would give.
 *
 * @par Errors
 * An image without points or labels, labels that are no whole numbers or negative, too large for
 * the memory; a chosen segment that does not exist. A warning for each segment that is not whole
 * in the end, or gone.
 *
 * @par Reference
 * Bertrand, Malandain. A new characterization of three-dimensional simple points. Pattern
 * Recognition Letters 15, 1994.
 *
 * @sa vtkTextureSegmentation vtkSegmentBoundary
 */
#ifndef vtkSegmentTopology_h
#define vtkSegmentTopology_h

#include "vtkImageAlgorithm.h"
#include "vtkTrivariateFiltersModule.h" // for export macro

#include <vector> // for Segments

class vtkMultiProcessController;
namespace trivariate
{
struct LabelledImage;
struct SegmentChanges;
}

class VTKTRIVARIATEFILTERS_EXPORT vtkSegmentTopology : public vtkImageAlgorithm
{
public:
  static vtkSegmentTopology* New();
  vtkTypeMacro(vtkSegmentTopology, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The segments to be made whole, in this order. Default is none, which means all but segment 0,
   * the highest first.
   */
  void AddSegment(int segment);
  void ClearSegments();
  int GetNumberOfSegments() const { return static_cast<int>(this->Segments.size()); }
  int GetSegment(int i) const;
  ///@}

  ///@{
  /**
   * The largest sheet, in voxels, by which a handle is cut or closed. Valid range [0, VTK_INT_MAX].
   * Default is 1000.
   */
  vtkSetClampMacro(LargestSheet, int, 0, VTK_INT_MAX);
  vtkGetMacro(LargestSheet, int);
  ///@}

  ///@{
  /**
   * The largest cavity, in voxels, that is filled. What fills a cavity may be another segment.
   * Valid range [0, VTK_INT_MAX]. Default is 1000.
   */
  vtkSetClampMacro(LargestCavity, int, 0, VTK_INT_MAX);
  vtkGetMacro(LargestCavity, int);
  ///@}

  ///@{
  /**
   * Processes that share distributed data. Default is the global controller.
   */
  virtual void SetController(vtkMultiProcessController*);
  vtkGetObjectMacro(Controller, vtkMultiProcessController);
  ///@}

protected:
  vtkSegmentTopology();
  ~vtkSegmentTopology() override;

  int RequestUpdateExtent(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkSegmentTopology(const vtkSegmentTopology&) = delete;
  void operator=(const vtkSegmentTopology&) = delete;

  std::vector<trivariate::SegmentChanges> MakeWhole(
    trivariate::LabelledImage& image, bool gathered);
  void Share(trivariate::LabelledImage& image);

  std::vector<int> Segments;
  int LargestSheet = 1000;
  int LargestCavity = 1000;
  vtkMultiProcessController* Controller = nullptr;
};

#endif
