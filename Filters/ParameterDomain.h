// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// What vtkVolumeParameterization computes, without its pipeline.
#ifndef ParameterDomain_h
#define ParameterDomain_h

#include "Domain/BlockComplex.h"
#include "DomainInput.h"
#include "ImageSamples.h"
#include "Parameter/BlockMeshing.h"
#include "Parameter/VoxelParameter.h"

#include <map>

namespace trivariate
{
struct ParameterSettings
{
  ParameterOptions Options;
  double CellLength = 2.0; ///< of the block mesh, in voxels
  bool RefinesThinParts = true;
};

/// The most of a segment that may be in parts thinner than four voxels without any remedy.
constexpr double MostThin = 0.02;

/// Of a segment.
struct ThinParts
{
  double Share = 0.0;   ///< of its voxels, see ThinShare
  bool Refined = false; ///< whether it was solved for on voxels of half the size
};

struct ParameterDomain
{
  DomainInput Input;
  BlockComplex Complex; ///< with the groups that it makes of the polycube's
  BlockMesh Mesh;       ///< in space
  BlockMeshReport Report;
  std::map<int, VoxelParameter> Solved; ///< of the segments whose cubes lie in a lattice
  std::map<int, ParameterFolds> Folds;  ///< of these
  std::map<int, ThinParts> Thin;        ///< of each segment

  /// Of each voxel of the image: the parameter in the one space of all blocks, the group of its
  /// block, or -1, and 1 where that is known, else 0.
  std::vector<double> Parameter;
  std::vector<std::int32_t> Block;
  std::vector<std::uint8_t> Mask;

  /// Likewise what was solved for, in coordinates of the lattice, and 1 where that is known.
  std::vector<double> FrameParameter;
  std::vector<std::uint8_t> FrameMask;
};

/**
 * Segment (one component, whole numbers) and FrameU, FrameV, FrameW (three components) are the
 * attributes of the samples. Throws std::invalid_argument with a sentence for the user.
 */
ParameterDomain ParameterizeDomain(const ImageSamples& samples, vtkPolyData* patches,
  vtkUnstructuredGrid* polycube, const ParameterSettings& settings, const Execution& execution);
}

#endif
