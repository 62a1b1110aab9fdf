// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The domain of a shell: a block for each patch, between an outer and an inner surface with the
 * same polycube.
 */
#ifndef trivariate_DomainShell_h
#define trivariate_DomainShell_h

#include "DomainLayers.h"

namespace trivariate
{
/**
 * A block on each patch of the outer surface, down to the same patch of the inner one. Points:
 * corners of the outer surface, then of the inner one. Throws std::invalid_argument where the
 * polycubes differ.
 */
DomainBlocks ShellBlocks(const SegmentDomain& outer, const SegmentDomain& inner);

/// A domain of one cube with its axes exchanged and turned so that its corners come near those of
/// another.
SegmentDomain TurnedToward(const SegmentDomain& domain, const SegmentDomain& other);

/**
 * A domain for a surface around another, with the same polycube. Of one cube: the domain found for
 * the surface itself, or that with its corners above those of the inner one, if that makes better
 * blocks between the two, none of them inverted (the least ScaledJacobian of ShellBlocks). Of more
 * cubes: with its corners above those of the inner one. Throws as FindDomain and, for more cubes,
 * as DomainFromCorners, but only std::runtime_error.
 */
SegmentDomain DomainAround(const SurfaceMesh& outer, const SegmentDomain& inner,
  const DomainOptions& options, const Execution& execution);
}

#endif
