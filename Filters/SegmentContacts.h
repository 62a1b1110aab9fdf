// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// Segments that touch: their domains laid out anew so that both have the common surface as patch.
#ifndef SegmentContacts_h
#define SegmentContacts_h

#include "Search/FindDomain.h"
#include "SegmentSurface.h"

#include <map>
#include <string>
#include <vector>

namespace trivariate
{
/// A segment whose surface is one piece.
struct SolidSegment
{
  int Segment;
  SurfacePiece Piece;
  SegmentDomain Domain;
};

/// One patch of two surfaces.
struct SharedPatch
{
  Index First, FirstPatch, Second, SecondPatch; ///< First < Second
};

struct SegmentContacts
{
  std::vector<SharedPatch> Shared; ///< surfaces: counted in the solids
  /// Of two segments (the lower first) that touch and do not share: why.
  std::map<std::array<int, 2>, std::string> Reasons;
};

/**
 * Where two solids touch in one disc that covers about a face of both of their domains (of one
 * cube, where those of more cubes have no such face), they get new domains with that disc as a
 * patch, its corners, borders and lattice points in common. Larger discs come first; two discs of a
 * segment must lie apart, and contacts must not close a ring. Domains that touch nothing stay as
 * they are.
 */
SegmentContacts ShareContacts(const LabelledSurface& surface, std::vector<SolidSegment>& solids,
  const DomainOptions& options, const Execution& execution);
}

#endif
