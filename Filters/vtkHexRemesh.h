// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkHexRemesh
 * @brief   hexahedra from a domain: a structured grid in each block, untangled
 *
 * The nodes of a block lie on lines of constant u, v and w; blocks share the nodes of common faces,
 * edges and corners bit by bit, also from one segment to another. The mesh is made coarse,
 * untangled and made even with the foldover-free energy of Garanzha et al., then refined and
 * treated again until its cells are as long as wanted. Nodes of the surface slide on it, held by
 * edges that are sharp and by curves where three surfaces meet, and faces of cells are drawn to
 * where the surface is: so that they hold its volume, nodes may leave it by half a voxel. Faces that
 * see the inside of the segment are turned, or pleats would cover the surface more than once. Layers
 * along the surface become as deep as their cells are long, where the domain has them thinner,
 * since three blocks meet at better angles then; CellsPerBlock leaves them as they are. With block
 * meshes as fourth input only these are resampled and, where that folds cells, untangled.
 *
 * @par Input
 * Port 0: vtkImageData, whose point arrays are sampled at the nodes (trilinear; the labels Segment,
 * frames and parameters are left out, labels of other names are taken for numbers). Port 1: the
 * patches and port 2: the polycube, outputs 0 and 1 of vtkPolycubeDomain. Port 3 (optional):
 * vtkPartitionedDataSetCollection, block meshes of this polycube, as this filter or
 * vtkVolumeParameterization writes them.
 *
 * @par Output
 * Port 0: vtkPartitionedDataSetCollection with one vtkStructuredGrid for each block.
 * - points: Node (vtkIdType), the same number for what blocks share; Parameter (double x 3), in the
 *   unit cube of the block; the arrays of the image (double).
 * - cells: Segment, Block (int32), as those of the polycube; ScaledJacobian (double), the least
 * over the corners of the determinant of the unit vectors along its edges: 1 for a box, 0 or less
 * where a cell is inverted.
 *
 * Port 1: vtkUnstructuredGrid with the same hexahedra over common points, with Segment, Block,
 * ScaledJacobian and the arrays of the image, ready for a solver; ElementBlockIds (int32) is
 * Segment again, by which VTK's Exodus writer makes an element block of each. Field data:
 * InvertedCells (vtkIdType x 2), as interpolated and in the end; ScaledJacobian (double x 2), its
 * least and mean; CellVolumeRatio (double x 2), of a cell's volume to the mean of its block: 1 and
 * 99 percent; PatchDistance (double x 2), of patches from the faces of cells, and FaceDistance,
 * back, in units of space: root mean square and the most.
 *
 * @par Cost
 * 80 to 400 microseconds of processor time for a cell where the domain fits its segment; up to 7 ms
 * where it does not (Documentation/Results.md).
 *
 * @par Distributed data
 * Process 0 makes all, from whole inputs; the others give nothing.
 *
 * @par Errors
 * No polycube, or one that the patches do not fit; an image without points, or one that the patches
 * reach out of by more than a voxel; more cells than MostCells. Warnings say how many cells are
 * inverted, if any are left, how far they are from the surface, if that is more than they are long
 * (and a voxel; not with CellsPerBlock), and at how many nodes an array is not finite.
 *
 * @par Reference
 * V. Garanzha, I. Kaporin, L. Kudryavtseva, F. Protais, N. Ray, D. Sokolov. Foldover-free maps in
 * 50 lines of code. ACM Transactions on Graphics 40(4), 2021.
 *
 * @sa vtkPolycubeDomain vtkTSplineFit
 */
#ifndef vtkHexRemesh_h
#define vtkHexRemesh_h

#include "vtkPartitionedDataSetCollectionAlgorithm.h"
#include "vtkTrivariateFiltersModule.h" // for export macro

class vtkUnstructuredGrid;

class VTKTRIVARIATEFILTERS_EXPORT vtkHexRemesh : public vtkPartitionedDataSetCollectionAlgorithm
{
public:
  static vtkHexRemesh* New();
  vtkTypeMacro(vtkHexRemesh, vtkPartitionedDataSetCollectionAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The wanted length of a cell's edges, in units of space. Default is 0, which means two voxels of
   * the image. Edges that are parallel through glued blocks have as many cells.
   */
  vtkSetClampMacro(EdgeLength, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(EdgeLength, double);
  ///@}

  ///@{
  /**
   * The number of cells along each edge of each block, instead of EdgeLength. Valid range [0,
   * 1000]. Default is 0: EdgeLength decides.
   */
  vtkSetClampMacro(CellsPerBlock, int, 0, 1000);
  vtkGetMacro(CellsPerBlock, int);
  ///@}

  ///@{
  /**
   * A mesh with more cells is refused. Default is 2000000.
   */
  vtkSetClampMacro(MostCells, vtkIdType, 1, VTK_ID_MAX);
  vtkGetMacro(MostCells, vtkIdType);
  ///@}

  vtkUnstructuredGrid* GetHexahedra();

  ///@{
  /**
   * After an update: how many cells are inverted in the mesh as it was interpolated and in the
   * output, that is, have a determinant of 0 or less at a corner or at one of 3 x 3 x 3 Gauss
   * points; the least and mean scaled Jacobian of the output. 0 after one that failed.
   */
  vtkGetMacro(InvertedBefore, vtkIdType);
  vtkGetMacro(InvertedCells, vtkIdType);
  vtkGetMacro(LeastScaledJacobian, double);
  vtkGetMacro(MeanScaledJacobian, double);
  ///@}

protected:
  vtkHexRemesh();
  ~vtkHexRemesh() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  vtkHexRemesh(const vtkHexRemesh&) = delete;
  void operator=(const vtkHexRemesh&) = delete;

  void Remesh(vtkInformationVector** inputVector, vtkInformationVector* outputVector);

  double EdgeLength = 0.0;
  int CellsPerBlock = 0;
  vtkIdType MostCells = 2000000;
  vtkIdType InvertedBefore = 0;
  vtkIdType InvertedCells = 0;
  double LeastScaledJacobian = 0.0;
  double MeanScaledJacobian = 0.0;
};

#endif
