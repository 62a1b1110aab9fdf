// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The blocks of a domain and the surfaces of its segments: which face of a block stands on which
 * patch, which edge on which border between patches.
 */
#ifndef trivariate_BlockDomain_h
#define trivariate_BlockDomain_h

#include "BlockMesh.h"
#include "Domain/DomainLayers.h"

#include <map>

namespace trivariate
{
/// Four points of a domain that are the corners of a face.
using FacePointSet = std::array<Index, 4>;

/// A disc of triangles with four sides, on which a face of one block or two blocks stands.
struct BlockPatch
{
  std::vector<Index> Triangles; ///< of BlockDomain::Triangles, which its segment sees from outside
  std::array<Index, 4> Corners; ///< points of the domain, anticlockwise
  std::array<std::vector<Index>, 4> Sides; ///< points of the surface from each corner to the next
};

/// What a domain is made of; see BlockDomain.
struct DomainParts
{
  std::vector<BlockPoints> Blocks;
  std::vector<int> Segments;           ///< of each block
  std::vector<Eigen::Vector3d> Points; ///< of the domain: corners of blocks
  std::vector<Eigen::Vector3d> SurfacePoints;
  std::vector<Index> CornerOf; ///< of each of them: the point of the domain, or -1
  /// Of each of them: its place on the surface of the polycube, in coordinates of the lattice;
  /// empty, or all the same in a patch, where none is known.
  std::vector<Eigen::Vector3d> Parameters;
  std::vector<Triangle> Triangles; ///< each once, also where two segments share it
  std::vector<Index> PatchOf;      ///< of each triangle, from 0
};

class BlockDomain : public DomainParts
{
public:
  /**
   * Finds sides and borders. Throws std::invalid_argument, naming the patch, where one is not a
   * disc with four corners, or no block stands on it. O(n log n).
   */
  explicit BlockDomain(DomainParts parts);

  /// The points of the surface along an edge of a block, from one point of the domain to another;
  /// empty where the edge is not a border.
  std::vector<Index> Border(Index from, Index to) const;

  /// How far along a border each of its points is, as a share of the whole: in the domain's
  /// parameters where they grow from point to point, else in length. From 0 to 1.
  std::vector<double> SharesAlong(const std::vector<Index>& border) const;

  /// The patch on which a face with these points stands, or -1.
  Index PatchOn(const FacePointSet& points) const;

  /// Along the border, or straight.
  double EdgeLength(Index from, Index to) const;

  std::vector<BlockPatch> Patches;

private:
  void FindSides(Index patch);

  std::map<FacePointSet, Index> PatchAt;
  std::map<std::array<Index, 2>, std::vector<Index>> Borders; // from the lesser point
};

/// The face of a block that stands on a patch.
struct PatchFace
{
  Index Block = -1;
  int Axis = 0, Side = 0;
  std::array<int, 2> Cells{}; ///< along its two axes in ascending order
  std::vector<Index> Nodes;   ///< the first axis fastest
  Index NodeAt(int s, int t) const { return this->Nodes[s + (this->Cells[0] + 1) * t]; }
};

/// Of each patch one face, where two blocks stand on it that of the last.
std::vector<PatchFace> PatchFaces(const BlockDomain& domain, const BlockMesh& mesh);

/// The blocks of one segment, with its surface; of a shell also with that of the inner one.
BlockDomain DomainOfSegment(const DomainBlocks& blocks, const SegmentDomain& outer,
  const SegmentDomain* inner = nullptr, int segment = 1);
}

#endif
