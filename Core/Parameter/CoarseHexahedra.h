// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// How good the hexahedra of a domain become, told by a few of them.
#ifndef trivariate_CoarseHexahedra_h
#define trivariate_CoarseHexahedra_h

#include "Domain/SegmentDomain.h"
#include "Execution.h"

namespace trivariate
{
/**
 * The mean scaled Jacobian of some 2000 hexahedra in the layered blocks of a domain, over 1 + d /
 * h: d is the root mean square distance of the surface from the faces of the outer cells or, where
 * that is more, of these from the surface, and h the edge of a cube with 1 / 2000 of the volume.
 * What is left uncovered, what lies outside and cells that fold over each other there all count
 * through d. 0.89 for a box, 0.93 for a ball; less than 0 where most are inside out. Domains with
 * more blocks or longer borders have as many cells, only shorter blocks, so that all are compared
 * at the same price.
 *
 * Time: 0.2 to 1 s for a surface of a few thousand triangles, most for a bad domain. Throws
 * std::invalid_argument as BlockDomain.
 */
double CoarseHexahedra(const SegmentDomain& domain, const Execution& execution);

/// The same for the blocks of a shell, with the distances of both surfaces.
double CoarseHexahedra(
  const SegmentDomain& outer, const SegmentDomain& inner, const Execution& execution);
}

#endif
