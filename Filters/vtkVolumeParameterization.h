// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkVolumeParameterization
 * @brief   parameters u, v, w in segments, and hexahedral block meshes, over their domains
 *
 * Two parameterizations. First, for every segment whose cubes lie in a lattice, u, v and w on its
 * voxels: their gradients are as close as possible to the directions of the frame field, and on
 * every patch the parameter along its axis is constant. Values on patches are found, not given, so
 * the lengths of the cubes come out. This is section 3 of "Feature-Aware Reconstruction of Volume
 * Data via Trivariate Splines" (2011): eq. (1) in the norm of eq. (8), patches held at sub-voxel
 * samples of the surface, conjugate gradients with multigrid.
 *
 * Where the lattice of cubes suits the segment they are the paper's; around the singular edges of
 * layers, and in shells, no lattice can be followed without folds. So second, a block mesh: a
 * structured grid of hexahedra in each block of the domain, whose faces on patches lie on the
 * surface, to half a voxel, and which share their nodes where blocks are glued. Cells that are
 * inverted are repaired by a foldover-free energy, nodes on the surface sliding on it, also over
 * the borders of patches but where the surface is sharp. The block mesh is the inverse of a
 * parameterization around singular edges too, one-to-one where cells neither fold nor lie over one
 * another, as they can where the domain does not fit: there the parameter of a voxel is where it
 * lies in the mesh. This one is what vtkTSplineFit takes. It depends on the patches, the
 * polycube and CellLength alone: neither the frames nor Epsilon, Gradient, Rounds and Tolerance
 * change it.
 *
 * Segments that share a surface share its nodes, and so its parameters.
 *
 * @par Input
 * Port 0: a vtkImageData with a point array of labels, chosen with SetInputArrayToProcess(0, ...),
 * by default "Segment", and the point arrays FrameU, FrameV, FrameW of vtkFrameField. Port 1:
 * vtkPolyData, the patches, and port 2: vtkUnstructuredGrid, the polycube, of vtkPolycubeDomain.
 *
 * @par Output
 * Port 0: the image with the point arrays
 * - Parameter (double x 3): (u, v, w) in the block mesh of the voxel's own segment, in the space in
 * which every block is a unit cube, see Block; zero where there is none;
 * - ParameterMask (uint8): 1 in the segments of the domain; 0 elsewhere, and where the mesh is more
 *   than 1.5 voxels away;
 * - Block (int32): the group of cubes that shares one (u, v, w) grid, -1 where the mask is 0;
 * - FrameParameter (double x 3): (u, v, w) solved for along the frames, in coordinates of the
 *   lattice of cubes (DomainCoordinates), zero where there is none;
 * - FrameParameterMask (uint8): 1 in the segments that were solved for, else 0.
 *
 * Field data, of the block mesh: InvertedCells (vtkIdType x 2), as interpolated and in the end;
 * ScaledJacobian (double x 2), its least and mean; CellVolumeRatio (double x 2), of a cell's volume
 * to the mean of its block: 1 and 99 percent; PatchDistance (double x 2), how far the patches are
 * from the faces of cells on them, that is from where Parameter is constant, in units of space:
 * root mean square and the most; FaceDistance (double x 2), the same back from the faces.
 *
 * For each segment that was solved for ParameterSegment, ParameterLengths (double x 3), of the
 * domain along u, v, w, ParameterIterations (int32 x 3), ParameterResidual (double x 3, relative),
 * ParameterDeviation and ParameterLargestDeviation (double x 3): how far FrameParameter is from
 * constant on patches, measured on the surface, in parts of the length: root mean square and the
 * most; ParameterFolds (vtkIdType x 2), cells of eight voxels in the segment where FrameParameter
 * is folded, and all; and ParameterRefined (uint8): 1 where voxels of half the size were used.
 *
 * Port 1, polycube: with the point array DomainPosition (double x 3), where corners lie in a domain
 * with the solved lengths (zero where a segment has no lattice), and the cell arrays BlockLengths
 * (double x 3), the mean lengths of the block's grid lines in space, and Block.
 *
 * Port 2, blocks: vtkPartitionedDataSetCollection with a vtkStructuredGrid for each hexahedron of
 * the polycube, in its order. Points: Node (vtkIdType), the same number for what blocks share, and
 * Parameter. Cells: Segment, Block, ScaledJacobian (double). Neighbours have their common points
 * bit by bit.
 *
 * @par Cost
 * Solving: 20 to 81 iterations for each parameter whatever the size; a segment that fills 256^3, 23
 * s for each on one core. Memory: 160 bytes a voxel of the box around the segment, and 105 a voxel
 * of the image; with Epsilon below 1 another 220. Repair: see Core/Parameter/BlockRepair.h.
 * Threaded with vtkSMPTools; the result does not depend on the number of threads.
 *
 * @par Distributed data
 * Under several processes the image is gathered to process 0 with a warning; it is given back in
 * pieces, polycube and blocks are there on process 0 alone. Patches and polycube must be there.
 *
 * @par Errors
 * An image without points, labels or frames; a domain of another image; a segment in pieces; frames
 * that are zero in it or left-handed; too little memory. Where cells stay inverted, a warning says
 * how many.
 *
 * @sa vtkPolycubeDomain vtkFrameField vtkTSplineFit
 */
#ifndef vtkVolumeParameterization_h
#define vtkVolumeParameterization_h

#include "vtkImageAlgorithm.h"
#include "vtkTrivariateFiltersModule.h" // for export macro

#include <string> // for faults

class vtkMultiProcessController;
class vtkPartitionedDataSetCollection;
class vtkPolyData;
class vtkUnstructuredGrid;

namespace trivariate
{
struct ImageSamples;
}

class VTKTRIVARIATEFILTERS_EXPORT vtkVolumeParameterization : public vtkImageAlgorithm
{
public:
  static vtkVolumeParameterization* New();
  vtkTypeMacro(vtkVolumeParameterization, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum Gradients
  {
    TRILINEAR = 0,
    POLYNOMIAL = 1
  };

  ///@{
  /**
   * Of FrameParameter: the weight of deviations along the own direction of a parameter, against
   * those across: epsilon of eq. (8). Less than 1 leaves lengths freer, and makes them less even.
   * Valid range [0.001, 1]. Default is 1.
   */
  vtkSetClampMacro(Epsilon, double, 0.001, 1.0);
  vtkGetMacro(Epsilon, double);
  ///@}

  ///@{
  /**
   * Of FrameParameter: how gradients are measured. TRILINEAR (0): in cells of eight voxels.
   * POLYNOMIAL (1): of a cubic polynomial over the 5 x 5 x 5 voxels around, the paper's. Default is
   * TRILINEAR.
   */
  vtkSetClampMacro(Gradient, int, TRILINEAR, POLYNOMIAL);
  vtkGetMacro(Gradient, int);
  ///@}

  ///@{
  /**
   * Of FrameParameter: how often frames are replaced by the rotations closest to the gradients, and
   * all is solved again. Valid range [0, 20]. Default is 0.
   */
  vtkSetClampMacro(Rounds, int, 0, 20);
  vtkGetMacro(Rounds, int);
  ///@}

  ///@{
  /**
   * Of FrameParameter: when the linear systems count as solved: residual by right-hand side. Looser
   * than 1e-6 folds FrameParameter. Valid range [1e-14, 1e-4]. Default is 1e-8.
   */
  vtkSetClampMacro(Tolerance, double, 1e-14, 1e-4);
  vtkGetMacro(Tolerance, double);
  ///@}

  ///@{
  /**
   * Of FrameParameter: whether segments with more than two percent of their voxels in parts thinner
   * than four voxels are solved for on voxels of half the size, if there is memory for it and no
   * error there; eight times the time and memory. Default is on.
   */
  vtkSetMacro(RefineThinParts, bool);
  vtkGetMacro(RefineThinParts, bool);
  vtkBooleanMacro(RefineThinParts, bool);
  ///@}

  ///@{
  /**
   * The wanted length of the block mesh's cells, in voxels. Valid range [0.5, 1000]. Default is 2.
   */
  vtkSetClampMacro(CellLength, double, 0.5, 1000.0);
  vtkGetMacro(CellLength, double);
  ///@}

  ///@{
  /**
   * Processes that share distributed data. Default is the global controller.
   */
  void SetController(vtkMultiProcessController* controller);
  vtkMultiProcessController* GetController() const { return this->Controller; }
  ///@}

  vtkUnstructuredGrid* GetPolycube();
  vtkPartitionedDataSetCollection* GetBlocks();

protected:
  vtkVolumeParameterization();
  ~vtkVolumeParameterization() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  vtkVolumeParameterization(const vtkVolumeParameterization&) = delete;
  void operator=(const vtkVolumeParameterization&) = delete;

  trivariate::ImageSamples ReadImage(vtkImageData* input, std::string& fault);
  void Parameterize(const trivariate::ImageSamples& samples, vtkPolyData* patches,
    vtkUnstructuredGrid* polycube, vtkImageData* image, vtkInformationVector* outputVector);

  double Epsilon = 1.0;
  int Gradient = TRILINEAR;
  int Rounds = 0;
  double Tolerance = 1e-8;
  double CellLength = 2.0;
  bool RefineThinParts = true;
  vtkMultiProcessController* Controller = nullptr;
};

#endif
