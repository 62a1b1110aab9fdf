// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// A block mesh to start from: on the surface where it must be, interpolated inside.
#ifndef trivariate_BlockStart_h
#define trivariate_BlockStart_h

#include "Execution.h"
#include "PatchMap.h"

namespace trivariate
{
/**
 * Nodes on borders are evenly spaced in the domain's parameters, by length without, those on
 * patches are the regular grid of their PatchMap. The face across from the patch of a layer is the
 * patch, moved as its corners are. All other edges are straight, faces and blocks transfinite
 * interpolations of what bounds them. Cells may be inverted.
 */
BlockMesh StartOfBlockMesh(const BlockDomain& domain, const std::vector<PatchMap>& maps,
  const std::vector<std::array<int, 3>>& sizes);

/// Of all patches, in order.
std::vector<PatchMap> MapPatches(const BlockDomain& domain, const Execution& execution);
}

#endif
