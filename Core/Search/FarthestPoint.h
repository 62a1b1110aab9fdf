// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef trivariate_FarthestPoint_h
#define trivariate_FarthestPoint_h

#include "Domain/SurfaceMesh.h"

namespace trivariate
{
/// The point that is farthest from another along the edges of a connected mesh. O(n log n).
Index FarthestPoint(const SurfaceMesh& mesh, Index start);
}

#endif
