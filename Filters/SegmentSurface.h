// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// Surfaces of segments as the core wants them: closed meshes, one a piece.
#ifndef SegmentSurface_h
#define SegmentSurface_h

#include "Domain/SurfaceMesh.h"

#include <string>
#include <vector>

class vtkMultiProcessController;
class vtkPointSet;
class vtkPolyData;

namespace trivariate
{
/// Field data of a surface made from voxels: their size along i, j and k.
constexpr const char* VoxelSpacingName = "VoxelSpacing";

struct LabelledSurface
{
  std::vector<Eigen::Vector3d> Points;
  std::vector<Triangle> Triangles;
  std::vector<std::array<int, 2>> Labels; ///< of each triangle: its inner and its outer side
  double Voxel = 0.0;                     ///< edge of a cube as large as a voxel; 0: not known
};

/// A connected part of the surface of one segment.
struct SurfacePiece
{
  SurfaceMesh Mesh;           ///< seen from outside of the segment
  std::vector<Index> Origins; ///< of each triangle: which one of the labelled surface it is
  double Volume;              ///< negative around a cavity
};

/**
 * Without the cell array BoundaryLabels all is the surface of segment 1 in segment 0, turned as a
 * whole so that it is seen from outside. Throws std::invalid_argument with a sentence for the user:
 * for no cells, cells that are no triangles, points that are not finite, labels of another form.
 */
LabelledSurface ReadSurface(vtkPolyData* input);

/// All segments but 0 and the outside, ascending.
std::vector<int> SegmentsIn(const LabelledSurface& surface);

/// The pieces of the surface of one segment. Throws std::invalid_argument where there are none, or
/// the surface is not closed or not two-manifold.
std::vector<SurfacePiece> PiecesOf(const LabelledSurface& surface, int segment);

/// Throws std::invalid_argument where a point is not finite.
std::vector<Eigen::Vector3d> ReadPoints(vtkPointSet* input);

/// Throws std::invalid_argument where there are no cells, or others than triangles.
std::vector<Triangle> ReadTriangles(vtkPolyData* input);

/**
 * Collective: process 0 gets `input` and the pieces of all others, their common points merged; the
 * others get nothing.
 */
void GatherSurface(vtkPolyData* input, vtkPolyData* whole, vtkMultiProcessController* controller);
}

#endif
