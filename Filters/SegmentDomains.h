// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// The domains of several segments, and which surfaces they share.
#ifndef SegmentDomains_h
#define SegmentDomains_h

#include "Domain/DomainLayers.h"
#include "SegmentContacts.h"

#include <string>
#include <vector>

namespace trivariate
{
/// A piece of surface with the polycube inside of it.
struct LaidOutSurface
{
  SegmentDomain Domain;
  std::vector<Index> Origins; ///< of each triangle of the piece: which one of the labelled surface
};

struct BlocksOfSegment
{
  int Segment;
  Index Outer;      ///< of DomainSet::Surfaces
  Index Inner = -1; ///< of a shell: the surface of what is inside of it, turned away from it
  DomainBlocks Blocks;
};

struct DomainSet
{
  std::vector<LaidOutSurface> Surfaces;
  std::vector<SharedPatch> Shared;       ///< between touching segments; of Surfaces
  std::vector<BlocksOfSegment> Segments; ///< in order of the labels
  std::vector<std::string> Failures;     ///< one sentence for each segment without a domain
  std::vector<std::string> Remarks;      ///< about domains that are not what could be wished for
};

struct DomainSettings
{
  DomainOptions Options;
  bool Layered = true;
  double LayerDepth = 0.0; ///< in voxels; 0: automatic
  double Voxel = 0.0;      ///< its size; 0: not known, a mean edge of the surface
};

/// The domain's blocks as the settings want them.
DomainBlocks BlocksOf(
  const SegmentDomain& domain, const DomainSettings& settings, const Execution& execution);

/**
 * Domains found automatically. A segment with a cavity becomes a shell; where what is in the cavity
 * is one of the segments with a domain of one cube, both share that surface with its corners and
 * patches. Segments that touch in a disc share it as a patch (SegmentContacts.h). Remarks tell of
 * those that touch and share nothing.
 */
DomainSet FindDomains(const LabelledSurface& surface, const std::vector<int>& segments,
  const DomainSettings& settings, const Execution& execution);

/**
 * Adds the domain of a segment whose surface is one piece, with the corners of `cubes` at or near
 * the picked places, at most `snapLimit` times the surface's diagonal away. Throws as OnlyPieceOf
 * and DomainFromCorners.
 */
void AddDomainFromCorners(const LabelledSurface& surface, int segment, const Polycube& cubes,
  const std::vector<Eigen::Vector3d>& picked, double snapLimit, const DomainSettings& settings,
  const Execution& execution, DomainSet& set);

/// A sentence on blocks that are inverted; empty where there are none.
std::string RemarkOn(const BlocksOfSegment& segment);

/// PiecesOf a segment, which throws std::invalid_argument where there are none. Throws it too where
/// the segment has no volume inside of them, as what lies around all others has not.
std::vector<SurfacePiece> BoundedPiecesOf(const LabelledSurface& surface, int segment);

/// The only one of BoundedPiecesOf. Throws std::invalid_argument where there are more.
SurfacePiece OnlyPieceOf(const LabelledSurface& surface, int segment);

/// FindDomain, with a hint for the user where the surface has handles.
SegmentDomain DomainOf(
  const SurfaceMesh& mesh, const DomainOptions& options, const Execution& execution);
}

#endif
