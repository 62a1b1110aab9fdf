// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "BlockDomain.h"

#include <algorithm>
#include <set>
#include <stdexcept>
#include <string>

namespace trivariate
{
namespace
{
std::invalid_argument Unsound(Index patch, const std::string& why)
{
  return std::invalid_argument("Patch " + std::to_string(patch) + " " + why + ".");
}

FacePointSet Sorted(FacePointSet points)
{
  std::sort(points.begin(), points.end());
  return points;
}

void Append(DomainParts& parts, const SegmentDomain& domain, bool reversed, Index firstCorner)
{
  const SurfaceLayout& layout = domain.Layout;
  const Index firstPoint = static_cast<Index>(parts.SurfacePoints.size());
  const Index firstPatch =
    parts.PatchOf.empty() ? 0 : *std::max_element(parts.PatchOf.begin(), parts.PatchOf.end()) + 1;
  parts.SurfacePoints.insert(parts.SurfacePoints.end(), layout.Points.begin(), layout.Points.end());
  parts.Parameters.insert(
    parts.Parameters.end(), layout.Parameters.begin(), layout.Parameters.end());
  parts.Parameters.resize(parts.SurfacePoints.size(), Eigen::Vector3d::Zero());
  parts.CornerOf.resize(parts.SurfacePoints.size(), -1);
  for (std::size_t corner = 0; corner < layout.Corners.size(); ++corner)
  {
    parts.CornerOf[firstPoint + layout.Corners[corner]] = firstCorner + static_cast<Index>(corner);
  }
  for (std::size_t t = 0; t < layout.Triangles.size(); ++t)
  {
    const Triangle& c = layout.Triangles[t];
    parts.Triangles.push_back(
      { firstPoint + c[0], firstPoint + c[reversed ? 2 : 1], firstPoint + c[reversed ? 1 : 2] });
    parts.PatchOf.push_back(firstPatch + layout.Patches[t]);
  }
}
}

//------------------------------------------------------------------------------
BlockDomain::BlockDomain(DomainParts parts)
  : DomainParts(std::move(parts))
{
  for (std::size_t t = 0; t < this->Triangles.size(); ++t)
  {
    const std::size_t patch = static_cast<std::size_t>(this->PatchOf[t]);
    this->Patches.resize(std::max(this->Patches.size(), patch + 1));
    this->Patches[patch].Triangles.push_back(static_cast<Index>(t));
  }
  for (std::size_t patch = 0; patch < this->Patches.size(); ++patch)
  {
    this->FindSides(static_cast<Index>(patch));
    const FacePointSet corners = Sorted(this->Patches[patch].Corners);
    if (!this->PatchAt.emplace(corners, static_cast<Index>(patch)).second)
    {
      throw Unsound(static_cast<Index>(patch), "has the corners of another one");
    }
  }
  std::vector<char> used(this->Patches.size(), 0);
  for (const BlockPoints& block : this->Blocks)
  {
    for (int face = 0; face < 6; ++face)
    {
      const Index patch = this->PatchOn(FacePoints(block, face / 2, face % 2));
      if (patch >= 0)
      {
        used[patch] = 1;
      }
    }
  }
  const auto unused = std::find(used.begin(), used.end(), 0);
  if (unused != used.end())
  {
    throw Unsound(unused - used.begin(), "is not the face of a block");
  }
}

//------------------------------------------------------------------------------
// Follows the boundary of the patch, with its triangles on the left.
void BlockDomain::FindSides(Index number)
{
  BlockPatch& patch = this->Patches[number];
  if (patch.Triangles.empty())
  {
    throw Unsound(number, "has no triangles");
  }
  std::set<std::array<Index, 2>> edges;
  std::set<Index> points;
  for (const Index t : patch.Triangles)
  {
    const Triangle& c = this->Triangles[t];
    points.insert(c.begin(), c.end());
    for (int k = 0; k < 3; ++k)
    {
      edges.insert({ c[k], c[(k + 1) % 3] });
    }
  }
  std::map<Index, Index> next;
  Index inner = 0;
  for (const auto& [from, to] : edges)
  {
    if (edges.count({ to, from }))
    {
      ++inner;
    }
    else
    {
      next[from] = to;
    }
  }
  const Index boundary = static_cast<Index>(edges.size()) - inner;
  const Index euler = static_cast<Index>(points.size()) - (boundary + inner / 2) +
                      static_cast<Index>(patch.Triangles.size());
  const auto start = std::find_if(
    next.begin(), next.end(), [this](const auto& edge) { return this->CornerOf[edge.first] >= 0; });
  if (euler != 1 || start == next.end())
  {
    throw Unsound(number, euler != 1 ? "is not a disc" : "has no corners");
  }
  int side = -1;
  Index point = start->first, way = 0;
  do
  {
    if (this->CornerOf[point] >= 0)
    {
      if (++side == 4)
      {
        throw Unsound(number, "has more than four corners");
      }
      patch.Corners[side] = this->CornerOf[point];
    }
    patch.Sides[side].push_back(point);
    point = next.at(point);
    if (this->CornerOf[point] >= 0)
    {
      patch.Sides[side].push_back(point);
    }
  } while (point != start->first && ++way <= boundary);
  if (side != 3)
  {
    throw Unsound(number, "has " + std::to_string(side + 1) + " corners instead of four");
  }
  for (int i = 0; i < 4; ++i)
  {
    const Index from = patch.Corners[i], to = patch.Corners[(i + 1) % 4];
    std::vector<Index> line = patch.Sides[i];
    if (to < from)
    {
      std::reverse(line.begin(), line.end());
    }
    const auto found =
      this->Borders.emplace(std::array<Index, 2>{ std::min(from, to), std::max(from, to) }, line);
    if (found.first->second != line)
    {
      throw Unsound(number, "has another border between two corners than its neighbour");
    }
  }
}

//------------------------------------------------------------------------------
std::vector<Index> BlockDomain::Border(Index from, Index to) const
{
  const auto found = this->Borders.find({ std::min(from, to), std::max(from, to) });
  if (found == this->Borders.end())
  {
    return {};
  }
  std::vector<Index> line = found->second;
  if (to < from)
  {
    std::reverse(line.begin(), line.end());
  }
  return line;
}

//------------------------------------------------------------------------------
std::vector<double> BlockDomain::SharesAlong(const std::vector<Index>& border) const
{
  for (const std::vector<Eigen::Vector3d>* places : { &this->Parameters, &this->SurfacePoints })
  {
    std::vector<double> shares(1, 0.0);
    bool growing = !places->empty();
    for (std::size_t i = 1; i < border.size() && growing; ++i)
    {
      shares.push_back(shares.back() + ((*places)[border[i]] - (*places)[border[i - 1]]).norm());
      growing = shares[i] > shares[i - 1] || places == &this->SurfacePoints;
    }
    if (growing)
    {
      const double whole = std::max(shares.back(), 1e-300);
      for (double& share : shares)
      {
        share /= whole;
      }
      return shares;
    }
  }
  return {};
}

//------------------------------------------------------------------------------
Index BlockDomain::PatchOn(const FacePointSet& points) const
{
  const auto found = this->PatchAt.find(Sorted(points));
  return found == this->PatchAt.end() ? -1 : found->second;
}

double BlockDomain::EdgeLength(Index from, Index to) const
{
  const std::vector<Index> line = this->Border(from, to);
  double length = line.empty() ? (this->Points[to] - this->Points[from]).norm() : 0.0;
  for (std::size_t i = 1; i < line.size(); ++i)
  {
    length += (this->SurfacePoints[line[i]] - this->SurfacePoints[line[i - 1]]).norm();
  }
  return length;
}

//------------------------------------------------------------------------------
std::vector<PatchFace> PatchFaces(const BlockDomain& domain, const BlockMesh& mesh)
{
  std::vector<PatchFace> faces(domain.Patches.size());
  for (std::size_t b = 0; b < domain.Blocks.size(); ++b)
  {
    for (int face = 0; face < 6; ++face)
    {
      const int axis = face / 2, side = face % 2;
      const Index patch = domain.PatchOn(FacePoints(domain.Blocks[b], axis, side));
      if (patch >= 0)
      {
        const std::array<int, 3>& n = mesh.Sizes[b];
        const Index block = static_cast<Index>(b);
        faces[patch] = { block, axis, side, { n[axis == 0 ? 1 : 0], n[axis == 2 ? 1 : 2] },
          mesh.FaceNodes(block, axis, side) };
      }
    }
  }
  return faces;
}

//------------------------------------------------------------------------------
BlockDomain DomainOfSegment(
  const DomainBlocks& blocks, const SegmentDomain& outer, const SegmentDomain* inner, int segment)
{
  DomainParts parts;
  for (const DomainBlock& block : blocks.Blocks)
  {
    parts.Blocks.push_back(block.Points);
  }
  parts.Segments.assign(parts.Blocks.size(), segment);
  parts.Points = blocks.Places;
  Append(parts, outer, false, 0);
  if (inner)
  {
    Append(parts, *inner, true, outer.Cubes.NumberOfCorners);
  }
  return BlockDomain(std::move(parts));
}
}
