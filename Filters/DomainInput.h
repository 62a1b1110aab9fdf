// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// The outputs of vtkPolycubeDomain, read back.
#ifndef DomainInput_h
#define DomainInput_h

#include "Domain/Polycube.h"
#include "Parameter/BlockDomain.h"

class vtkPolyData;
class vtkUnstructuredGrid;

namespace trivariate
{
/// How far nodes of a block mesh may leave the surface, in voxels: as chords of cells must to hold
/// its volume, and less than the surface itself may be off.
constexpr double FreedomOfNodes = 0.45;

struct DomainInput
{
  BlockDomain Domain;
  std::vector<int> Groups;                     ///< of each block: blocks of one (u, v, w) grid
  std::vector<LatticePoint> Coordinates;       ///< of each point of the domain
  std::vector<int> PatchIds;                   ///< of each patch: the number it has in `patches`
  std::vector<std::array<int, 2>> PatchPlanes; ///< of each patch: its axis and side, seen from the
                                               ///< segment that has it first
};

/**
 * Patches and hexahedra, the outputs 0 and 1 of vtkPolycubeDomain. A patch that two segments share
 * is there once. Throws std::invalid_argument with a sentence for the user where arrays are absent
 * or do not fit each other.
 */
DomainInput ReadDomain(vtkPolyData* patches, vtkUnstructuredGrid* polycube);
}

#endif
