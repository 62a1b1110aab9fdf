// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// Block meshes as VTK's data sets, and back.
#ifndef BlockMeshOutput_h
#define BlockMeshOutput_h

#include "Domain/Polycube.h"
#include "Parameter/BlockMeshing.h"

class vtkFieldData;
class vtkImageData;
class vtkPartitionedDataSetCollection;
class vtkPointData;
class vtkUnstructuredGrid;

namespace trivariate
{
/// What a block mesh belongs to: of each block, its segment, its group, and where its unit cube is
/// in the space of (u, v, w); without origins each is at 0.
struct BlockLabels
{
  std::vector<int> Segments, Groups;
  std::vector<LatticePoint> Origins;
};

/**
 * One structured grid a block, in order of the blocks. Points: Node (vtkIdType), the same for what
 * blocks share; Parameter (double x 3), in the block's unit cube; then `attributes`, which has a
 * tuple a node. Cells: Segment, Block (int32), ScaledJacobian (double).
 */
void WriteBlockMesh(const BlockMesh& mesh, const BlockLabels& labels, vtkPointData* attributes,
  vtkPartitionedDataSetCollection* output);

/// All cells in one grid of common points, with the same arrays but Node and Parameter.
void WriteHexahedra(const BlockMesh& mesh, const BlockLabels& labels, vtkPointData* attributes,
  vtkUnstructuredGrid* output);

/// InvertedCells (vtkIdType x 2: as interpolated and in the end); in the end ScaledJacobian (least
/// and mean), CellVolumeRatio (1 and 99 percent) and PatchDistance, FaceDistance (root mean square
/// and largest), each double x 2.
void WriteQuality(const BlockMeshReport& report, vtkFieldData* field);

/**
 * A mesh for these blocks: a structured grid for each, in their order. Throws std::invalid_argument
 * with a sentence for the user where it is none.
 */
BlockMesh ReadBlockMesh(
  vtkPartitionedDataSetCollection* input, const std::vector<BlockPoints>& blocks);

/**
 * The point arrays of an image at these places, trilinear, as double; places outside take the value
 * at the nearest place of the image. Left out are arrays that cannot be interpolated: the names
 * that Documentation/Arrays.md has for labels, frames and parameters.
 */
void SampleImage(
  vtkImageData* image, const std::vector<Eigen::Vector3d>& places, vtkPointData* attributes);
}

#endif
