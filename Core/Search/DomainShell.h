// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The domain of a shell: the same polycube on an outer and an inner surface.
 */
#ifndef trivariate_DomainShell_h
#define trivariate_DomainShell_h

#include "FindDomain.h"

namespace trivariate
{
/// A domain of one cube with its axes exchanged and turned so that its corners come near those of
/// another.
SegmentDomain TurnedToward(const SegmentDomain& domain, const SegmentDomain& other);

/**
 * A domain for a surface around another, with the same polycube: of one cube the domain found for
 * the surface itself, or one with its corners above those of the inner surface or at the points
 * nearest to them, whichever has the best hexahedra between (CoarseHexahedra.h), on surfaces of few
 * triangles. Of more cubes there is none for the surface itself. Throws as FindDomain, and
 * std::runtime_error where none can be laid out.
 */
SegmentDomain DomainAround(const SurfaceMesh& outer, const SegmentDomain& inner,
  const DomainOptions& options, const Execution& execution);

struct ShellDomains
{
  SegmentDomain Outer, Inner;
};

/**
 * Domains of one cube for a surface and for one inside of it, turned outward too, that nobody else
 * has: the inner one's own and DomainAround it or, where the hexahedra between are better, the
 * outer one's own with the inner one's corners at the points nearest to its corners.
 */
ShellDomains FindShell(const SurfaceMesh& outer, const SurfaceMesh& inner,
  const DomainOptions& options, const Execution& execution);
}

#endif
