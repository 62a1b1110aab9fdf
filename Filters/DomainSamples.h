// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// A parameterized image with its blocks as the core's samples over a domain.
#ifndef DomainSamples_h
#define DomainSamples_h

#include "Fit/BlockFit.h"
#include "ImageSamples.h"

#include <set>

class vtkPartitionedDataSetCollection;
class vtkUnstructuredGrid;

namespace trivariate
{
/// The arrays that a fit over a domain reads beside the attributes.
constexpr const char* ParameterArrayName = "Parameter";
constexpr const char* ParameterMaskName = "ParameterMask";

/// The blocks of a polycube (output of vtkVolumeParameterization or vtkPolycubeDomain) with their
/// groups and places. Throws std::invalid_argument with a sentence for the user.
BlockComplex ReadBlocks(vtkUnstructuredGrid* polycube);

/// The segments of a polycube some of whose blocks lie along the surface: they have a Patch.
std::set<int> LayeredSegments(vtkUnstructuredGrid* polycube);

/**
 * The voxels that have a parameter, from samples whose last two attributes are Parameter and
 * ParameterMask (which are taken off), and that count under the samples' own mask. Throws
 * std::invalid_argument with a sentence for the user.
 */
BlockSamples TakeVoxels(ImageSamples& samples, const BlockComplex& blocks);

/**
 * Points of the shape from the structured grids of the blocks: at the nodes and, where a block has
 * few along an axis, between them. An empty collection gives none. Throws std::invalid_argument
 * with a sentence for the user.
 */
ShapeSamples ReadShape(vtkPartitionedDataSetCollection* meshes, const BlockComplex& blocks);

/// The distance of neighbouring voxels: the cube root of a voxel's volume.
double VoxelSpacing(const ImageSamples& samples);
}

#endif
