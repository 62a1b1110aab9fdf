// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The domain of a shell: six blocks between an outer and an inner surface, each of which is the
 * boundary of one cube.
 */
#ifndef trivariate_DomainShell_h
#define trivariate_DomainShell_h

#include "DomainLayers.h"

namespace trivariate
{
/**
 * A block on each of the six patches of a surface with one cube as domain, down to the patch of the
 * same label of the surface inside of it, also with one cube. Points: corners of the outer surface,
 * then of the inner one.
 */
DomainBlocks ShellBlocks(const SegmentDomain& outer, const SegmentDomain& inner);

/// A domain of one cube with its axes exchanged and turned so that its corners come near those of
/// another.
SegmentDomain TurnedToward(const SegmentDomain& domain, const SegmentDomain& other);

/**
 * A domain of one cube for a surface around another whose domain is one cube too: the one found
 * for the surface itself, or that with its corners above those of the inner one, if that
 * makes better blocks between the two, none of them inverted (the least ScaledJacobian of
 * ShellBlocks). Throws as
 * FindDomain.
 */
SegmentDomain DomainAround(const SurfaceMesh& outer, const SegmentDomain& inner,
  const DomainOptions& options, const Execution& execution);
}

#endif
