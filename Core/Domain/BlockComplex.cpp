// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "BlockComplex.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

namespace trivariate
{
namespace
{
// VTK's number of the corner of a hexahedron at the given ends of its axes.
int CornerOf(const std::array<int, 3>& ends)
{
  return (ends[1] ? (ends[0] ? 2 : 3) : ends[0]) + 4 * ends[2];
}

[[noreturn]] void Fail(Index block, const std::string& what)
{
  throw std::invalid_argument("Block " + std::to_string(block) + what);
}

// How the face with the points `own` runs on the one with the points `other`.
FaceTwin Match(const std::array<Index, 4>& own, const BlockFace& face,
  const std::array<Index, 4>& other, const BlockFace& otherFace)
{
  std::array<int, 3> at; // the corners (0, 0), (1, 0), (0, 1) on the other face, as s + 2 t
  for (int corner = 0; corner < 3; ++corner)
  {
    const auto found = std::find(other.begin(), other.end(), own[corner]);
    at[corner] = static_cast<int>(found - other.begin());
  }
  const int alongS = at[0] ^ at[1], alongT = at[0] ^ at[2];
  if (std::set<Index>(own.begin(), own.end()).size() < 4 || alongS + alongT != 3 || alongS == 3 ||
      alongT == 3)
  {
    Fail(face.Block, " and block " + std::to_string(otherFace.Block) +
                       " have a face in common on which a point comes twice or which is twisted.");
  }
  FaceTwin twin;
  twin.Face = otherFace;
  twin.Swapped = alongS == 2;
  twin.Flipped = { (at[0] & 1) != 0, (at[0] & 2) != 0 };
  return twin;
}

// The bounding box of the places of each group, low and high end.
using Boxes = std::map<int, std::pair<LatticePoint, LatticePoint>>;
Boxes BoxesOf(const std::vector<int>& groups, const std::vector<LatticePoint>& places)
{
  Boxes boxes;
  for (std::size_t b = 0; b < groups.size(); ++b)
  {
    auto& [low, high] = boxes.try_emplace(groups[b], places[b], places[b]).first->second;
    for (int a = 0; a < 3; ++a)
    {
      low[a] = std::min(low[a], places[b][a]);
      high[a] = std::max(high[a], places[b][a] + 1);
    }
  }
  return boxes;
}
}

//------------------------------------------------------------------------------
BlockComplex::BlockComplex(std::vector<std::array<Index, 8>> blocks, std::vector<int> segments,
  std::vector<int> groups, std::vector<LatticePoint> places)
  : Blocks(std::move(blocks))
  , Segments(std::move(segments))
  , Groups(std::move(groups))
{
  const std::size_t n = this->Blocks.size();
  if (n == 0 || this->Segments.size() != n || this->Groups.size() != n || places.size() != n)
  {
    throw std::invalid_argument("A domain needs at least one block, and a segment, a group and a "
                                "place for each of its " +
                                std::to_string(n) + " blocks.");
  }
  this->FindTwins();
  this->Arrange(places);
  this->SplitGroups(places);
}

//------------------------------------------------------------------------------
std::array<Index, 4> BlockComplex::FacePoints(const BlockFace& face) const
{
  const auto [s, t] = TangentialAxes(face.Axis);
  std::array<Index, 4> points;
  for (int corner = 0; corner < 4; ++corner)
  {
    std::array<int, 3> ends;
    ends[face.Axis] = face.Side;
    ends[s] = corner & 1;
    ends[t] = corner >> 1;
    points[corner] = this->Blocks[face.Block][CornerOf(ends)];
  }
  return points;
}

//------------------------------------------------------------------------------
void BlockComplex::FindTwins()
{
  std::map<std::array<Index, 4>, std::vector<BlockFace>> faces;
  for (Index b = 0; b < this->Size(); ++b)
  {
    for (int f = 0; f < 6; ++f)
    {
      const BlockFace face{ b, f / 2, f % 2 };
      std::array<Index, 4> points = this->FacePoints(face);
      std::sort(points.begin(), points.end());
      faces[points].push_back(face);
    }
  }
  this->Twins.assign(this->Blocks.size(), {});
  for (const auto& entry : faces)
  {
    const std::vector<BlockFace>& same = entry.second;
    if (same.size() > 2)
    {
      Fail(same[2].Block, " has a face that two others have already.");
    }
    for (std::size_t k = 0; same.size() == 2 && k < 2; ++k)
    {
      const BlockFace &own = same[k], &other = same[1 - k];
      this->Twins[own.Block][2 * own.Axis + own.Side] =
        Match(this->FacePoints(own), own, this->FacePoints(other), other);
    }
  }
}

//------------------------------------------------------------------------------
// Groups in the cells of a regular arrangement that is about as long in all directions: the work of
// a refinement is proportional to the volume of all.
void BlockComplex::Arrange(const std::vector<LatticePoint>& places)
{
  const Boxes boxes = BoxesOf(this->Groups, places);
  LatticePoint pitch{ 0, 0, 0 };
  for (const auto& box : boxes)
  {
    for (int a = 0; a < 3; ++a)
    {
      pitch[a] = std::max(pitch[a], box.second.second[a] - box.second.first[a] + 1);
    }
  }
  const auto count = static_cast<double>(boxes.size());
  const int nu = static_cast<int>(std::ceil(std::cbrt(count) - 1e-9));
  const int nv = static_cast<int>(std::ceil(std::sqrt(count / nu) - 1e-9));
  std::map<int, LatticePoint> shifts;
  for (const auto& [group, box] : boxes)
  {
    const int k = static_cast<int>(shifts.size());
    const LatticePoint cell{ k % nu, k / nu % nv, k / (nu * nv) };
    for (int a = 0; a < 3; ++a)
    {
      shifts[group][a] = cell[a] * pitch[a] - box.first[a];
    }
  }

  this->Origins = places;
  this->BlockOfPlace.clear();
  for (Index b = 0; b < this->Size(); ++b)
  {
    for (int a = 0; a < 3; ++a)
    {
      this->Origins[b][a] += shifts.at(this->Groups[b])[a];
    }
    const auto [at, isNew] = this->BlockOfPlace.emplace(this->Origins[b], b);
    if (!isNew)
    {
      Fail(b, " is at the place of block " + std::to_string(at->second) + " of the same group, " +
                NameOf(places[b]) + ".");
    }
  }
  for (Index b = 0; b < this->Size(); ++b)
  {
    for (int a = 0; a < 3; ++a)
    {
      LatticePoint above = this->Origins[b];
      ++above[a];
      const auto at = this->BlockOfPlace.find(above);
      if (at == this->BlockOfPlace.end())
      {
        continue;
      }
      if (!this->IsJoined({ b, a, 1 }))
      {
        Fail(b, " and block " + std::to_string(at->second) +
                  " are neighbours in their group but have no face in common.");
      }
      if (this->Segments[b] != this->Segments[at->second])
      {
        Fail(b, " and block " + std::to_string(at->second) +
                  " are of one group but of different segments.");
      }
    }
  }
}

//------------------------------------------------------------------------------
void BlockComplex::SplitGroups(const std::vector<LatticePoint>& places)
{
  std::map<int, Index> sizes;
  std::set<int> split;
  int next = 0;
  for (Index b = 0; b < this->Size(); ++b)
  {
    ++sizes[this->Groups[b]];
    next = std::max(next, this->Groups[b] + 1);
    for (int f = 0; f < 6; ++f)
    {
      if (this->IsGlued({ b, f / 2, f % 2 }))
      {
        split.insert(this->Groups[b]);
      }
    }
  }
  for (int& group : this->Groups)
  {
    if (split.count(group) && sizes[group] > 1)
    {
      group = next++;
    }
  }
  this->Arrange(places);
}

//------------------------------------------------------------------------------
bool BlockComplex::IsJoined(const BlockFace& face) const
{
  const FaceTwin& twin = this->Twin(face);
  if (!twin.Exists() || this->Groups[face.Block] != this->Groups[twin.Face.Block])
  {
    return false;
  }
  LatticePoint next = this->Origins[face.Block];
  next[face.Axis] += face.Side ? 1 : -1;
  return next == this->Origins[twin.Face.Block] && twin.Face.Axis == face.Axis &&
         twin.Face.Side != face.Side && !twin.Swapped && !twin.Flipped[0] && !twin.Flipped[1];
}

//------------------------------------------------------------------------------
Index BlockComplex::BlockAt(const std::array<double, 3>& parameter) const
{
  const std::vector<Index> found = this->BlocksAt(parameter);
  return found.empty() ? -1 : found[0];
}

//------------------------------------------------------------------------------
std::vector<Index> BlockComplex::BlocksAt(const std::array<double, 3>& parameter) const
{
  std::vector<Index> found;
  for (int side = 0; side < 8; ++side)
  {
    LatticePoint place;
    for (int a = 0; a < 3; ++a)
    {
      const double below = std::floor(parameter[a]);
      // A point on an integer belongs to the box below too.
      place[a] = static_cast<int>(below) - (side >> a & 1 && below == parameter[a] ? 1 : 0);
    }
    const auto at = this->BlockOfPlace.find(place);
    if (at != this->BlockOfPlace.end())
    {
      found.push_back(at->second);
    }
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

//------------------------------------------------------------------------------
LatticePoint BlockComplex::Extent() const
{
  return BoxesOf(std::vector<int>(this->Origins.size(), 0), this->Origins).at(0).second;
}

//------------------------------------------------------------------------------
std::map<int, std::pair<LatticePoint, LatticePoint>> BlockComplex::GroupBoxes() const
{
  return BoxesOf(this->Groups, this->Origins);
}
}
