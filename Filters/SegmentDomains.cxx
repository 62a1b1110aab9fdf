// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "SegmentDomains.h"

#include "Domain/InnerCorners.h"
#include "Domain/InnerPath.h"
#include "Search/DomainShell.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>

namespace trivariate
{
namespace
{
std::string NameOf(int segment)
{
  return "Segment " + std::to_string(segment);
}

struct SegmentPieces
{
  int Segment;
  std::vector<SurfacePiece> Pieces;

  // Inside of the outermost piece.
  double Volume() const
  {
    return std::max_element(this->Pieces.begin(), this->Pieces.end(),
      [](const SurfacePiece& a, const SurfacePiece& b) { return a.Volume < b.Volume; })
      ->Volume;
  }
};

// The same triangles seen from the other side.
SurfaceMesh Reversed(const SurfaceMesh& mesh)
{
  std::vector<Triangle> triangles = mesh.Triangles;
  for (Triangle& triangle : triangles)
  {
    std::swap(triangle[1], triangle[2]);
  }
  return SurfaceMesh(mesh.Points, std::move(triangles));
}

bool IsShell(const std::vector<SurfacePiece>& pieces)
{
  return pieces.size() == 2 && (pieces[0].Volume > 0.0) != (pieces[1].Volume > 0.0);
}

// Domains of segments, innermost first, so that a shell finds that of what is inside of it.
class Nest
{
public:
  explicit Nest(const DomainSettings& settings)
    : Settings(settings)
  {
  }

  void AddSolid(SolidSegment solid, const Execution& execution)
  {
    DomainBlocks blocks = BlocksOf(solid.Domain, this->Settings, execution);
    const Index outer = this->Keep(std::move(solid.Domain), solid.Piece.Origins);
    this->Finish({ solid.Segment, outer, -1, std::move(blocks) });
    this->OuterOf[solid.Piece.Origins] = outer;
  }

  void AddShell(const SegmentPieces& segment, const Execution& execution)
  {
    if (!IsShell(segment.Pieces))
    {
      const auto cavities = std::count_if(segment.Pieces.begin(), segment.Pieces.end(),
        [](const SurfacePiece& piece) { return piece.Volume < 0.0; });
      throw std::invalid_argument(
        "Its surface has " + std::to_string(segment.Pieces.size()) + " pieces, " +
        std::to_string(cavities) +
        " of them around cavities; make it one piece, or one shell, first "
        "(Segment Topology).");
    }
    const bool first = segment.Pieces[0].Volume > 0.0;
    const SurfacePiece& outside = segment.Pieces[first ? 0 : 1];
    const SurfacePiece& inside = segment.Pieces[first ? 1 : 0];
    const auto filled = this->OuterOf.find(inside.Origins);
    if (filled != this->OuterOf.end())
    {
      try
      {
        this->Lay(segment.Segment, outside,
          DomainAround(outside.Mesh, this->Set.Surfaces[filled->second].Domain,
            this->Settings.Options, execution),
          filled->second);
        return;
      }
      catch (const std::runtime_error& error)
      {
        this->Reasons[segment.Segment] = error.what();
      }
    }
    ShellDomains shell =
      FindShell(outside.Mesh, Reversed(inside.Mesh), this->Settings.Options, execution);
    const Index inner = this->Keep(std::move(shell.Inner), inside.Origins);
    this->Lay(segment.Segment, outside, std::move(shell.Outer), inner);
  }

  // Tells of segments that touch and share nothing. `reasons`: why, of some pairs.
  void RemarkOnContacts(
    const LabelledSurface& surface, const std::map<std::array<int, 2>, std::string>& reasons)
  {
    std::set<std::array<int, 2>> touching;
    for (const std::array<int, 2>& labels : surface.Labels)
    {
      touching.insert({ std::min(labels[0], labels[1]), std::max(labels[0], labels[1]) });
    }
    for (const BlocksOfSegment& a : this->Set.Segments)
    {
      for (const BlocksOfSegment& b : this->Set.Segments)
      {
        if (touching.count({ a.Segment, b.Segment }) > 0 && a.Segment < b.Segment &&
            !this->AreJoined(a, b))
        {
          const auto found = reasons.find({ a.Segment, b.Segment });
          const auto reasonOf = [this](const BlocksOfSegment& segment)
          { return this->Reasons.count(segment.Segment) ? this->Reasons.at(segment.Segment) : ""; };
          const std::string reason = found != reasons.end() ? found->second
                                     : !reasonOf(a).empty() ? reasonOf(a)
                                     : !reasonOf(b).empty() ? reasonOf(b)
                                                            : "one of them has a cavity";
          this->Set.Remarks.push_back("Segments " + std::to_string(a.Segment) + " and " +
                                      std::to_string(b.Segment) +
                                      " touch but have separate domains there: " + reason +
                                      (reason.back() == '.' ? "" : "."));
        }
      }
    }
  }

  DomainSet Set;

private:
  Index Keep(SegmentDomain domain, const std::vector<Index>& origins)
  {
    this->Set.Surfaces.push_back({ std::move(domain), origins });
    return static_cast<Index>(this->Set.Surfaces.size()) - 1;
  }

  void Finish(BlocksOfSegment segment)
  {
    const std::string remark = RemarkOn(segment);
    if (!remark.empty())
    {
      this->Set.Remarks.push_back(remark);
    }
    this->Set.Segments.push_back(std::move(segment));
  }

  void Lay(int segment, const SurfacePiece& outside, SegmentDomain domain, Index inner)
  {
    DomainBlocks blocks = ShellBlocks(domain, this->Set.Surfaces[inner].Domain);
    const Index outer = this->Keep(std::move(domain), outside.Origins);
    this->Finish({ segment, outer, inner, std::move(blocks) });
    this->OuterOf[outside.Origins] = outer;
  }

  bool AreJoined(const BlocksOfSegment& a, const BlocksOfSegment& b) const
  {
    return a.Inner == b.Outer || b.Inner == a.Outer ||
           std::any_of(this->Set.Shared.begin(), this->Set.Shared.end(),
             [&](const SharedPatch& patch)
             { return std::minmax(patch.First, patch.Second) == std::minmax(a.Outer, b.Outer); });
  }

  const DomainSettings& Settings;
  // Outer surfaces by their triangles of the labelled surface, ascending.
  std::map<std::vector<Index>, Index> OuterOf;
  std::map<int, std::string> Reasons; // of a shell: why it does not share its inner surface
};
}

//------------------------------------------------------------------------------
std::string RemarkOn(const BlocksOfSegment& segment)
{
  const std::size_t inverted = InvertedBlocks(segment.Blocks).size();
  return inverted == 0
           ? ""
           : NameOf(segment.Segment) + ": " + std::to_string(inverted) + " of " +
               std::to_string(segment.Blocks.Blocks.size()) +
               " blocks are inverted or flat between their corners, which more cubes or other "
               "corners may avoid.";
}

//------------------------------------------------------------------------------
DomainBlocks BlocksOf(
  const SegmentDomain& domain, const DomainSettings& settings, const Execution& execution)
{
  const double voxel = settings.Voxel > 0.0 ? settings.Voxel : MeanEdge(domain.Layout);
  return settings.Layered ? LayeredBlocks(domain, settings.LayerDepth * voxel, execution)
                          : CubeBlocks(domain);
}

//------------------------------------------------------------------------------
SegmentDomain DomainOf(
  const SurfaceMesh& mesh, const DomainOptions& options, const Execution& execution)
{
  try
  {
    return FindDomain(mesh, options, execution);
  }
  catch (const std::exception& error)
  {
    const Index euler = mesh.EulerCharacteristic();
    if (euler == 2 || dynamic_cast<const Aborted*>(&error))
    {
      throw;
    }
    const Index handles = (2 - euler) / 2;
    throw std::runtime_error("Its surface has " + std::to_string(handles) +
                             (handles == 1 ? " handle" : " handles") + " (Euler characteristic " +
                             std::to_string(euler) +
                             "); cut or close them first (Segment Topology). " + error.what());
  }
}

//------------------------------------------------------------------------------
std::vector<SurfacePiece> BoundedPiecesOf(const LabelledSurface& surface, int segment)
{
  std::vector<SurfacePiece> pieces = PiecesOf(surface, segment);
  double volume = 0.0;
  for (const SurfacePiece& piece : pieces)
  {
    volume += piece.Volume;
  }
  if (volume < 0.0)
  {
    throw std::invalid_argument("Its surface is seen from inside (a volume of " +
                                std::to_string(volume) +
                                "): it lies around the others, as a background does.");
  }
  return pieces;
}

//------------------------------------------------------------------------------
SurfacePiece OnlyPieceOf(const LabelledSurface& surface, int segment)
{
  std::vector<SurfacePiece> pieces = BoundedPiecesOf(surface, segment);
  if (pieces.size() != 1)
  {
    throw std::invalid_argument(
      "Its surface has " + std::to_string(pieces.size()) + " pieces; corners are picked on one.");
  }
  return std::move(pieces[0]);
}

//------------------------------------------------------------------------------
void AddDomainFromCorners(const LabelledSurface& surface, int segment, const Polycube& cubes,
  const std::vector<Eigen::Vector3d>& picked, double snapLimit, const DomainSettings& settings,
  const Execution& execution, DomainSet& set)
{
  const SurfacePiece piece = OnlyPieceOf(surface, segment);
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& point : piece.Mesh.Points)
  {
    box.extend(point);
  }
  SegmentDomain domain = DomainFromCorners(
    piece.Mesh, cubes, picked, execution.Part(0.0, 0.3), snapLimit * box.diagonal().norm());
  if (settings.Options.Relax)
  {
    RelaxDomain(domain, execution.Part(0.3, 0.75));
  }
  DomainBlocks blocks = BlocksOf(domain, settings, execution.Part(0.75, 1.0));
  const auto outer = static_cast<Index>(set.Surfaces.size());
  set.Surfaces.push_back({ std::move(domain), piece.Origins });
  set.Segments.push_back({ segment, outer, -1, std::move(blocks) });
  const std::string remark = RemarkOn(set.Segments.back());
  if (!remark.empty())
  {
    set.Remarks.push_back(remark);
  }
}

//------------------------------------------------------------------------------
DomainSet FindDomains(const LabelledSurface& surface, const std::vector<int>& segments,
  const DomainSettings& settings, const Execution& execution)
{
  Nest nest(settings);
  // Does the work for a segment, or keeps the reason why it cannot be done.
  const auto attempt = [&nest](int segment, const auto& work)
  {
    try
    {
      work();
    }
    catch (const std::logic_error& error)
    {
      nest.Set.Failures.push_back(NameOf(segment) + ": " + error.what());
    }
    catch (const std::runtime_error& error)
    {
      nest.Set.Failures.push_back(NameOf(segment) + ": " + error.what());
    }
  };
  std::vector<SegmentPieces> others;
  std::vector<SolidSegment> solids;
  for (std::size_t i = 0; i < segments.size(); ++i)
  {
    const double count = 2.0 * double(segments.size());
    attempt(segments[i],
      [&]()
      {
        SegmentPieces segment{ segments[i], BoundedPiecesOf(surface, segments[i]) };
        if (segment.Pieces.size() > 1)
        {
          others.push_back(std::move(segment));
          return;
        }
        SegmentDomain domain = DomainOf(
          segment.Pieces[0].Mesh, settings.Options, execution.Part(i / count, (i + 1) / count));
        solids.push_back({ segments[i], std::move(segment.Pieces[0]), std::move(domain) });
      });
  }
  SegmentContacts contacts =
    ShareContacts(surface, solids, settings.Options, execution.Part(0.5, 0.6));
  nest.Set.Shared = std::move(contacts.Shared); // surfaces are numbered as solids
  for (std::size_t i = 0; i < solids.size(); ++i)
  {
    const double step = 0.1 / double(solids.size());
    nest.AddSolid(std::move(solids[i]), execution.Part(0.6 + step * i, 0.6 + step * (i + 1)));
  }
  std::stable_sort(others.begin(), others.end(),
    [](const SegmentPieces& a, const SegmentPieces& b) { return a.Volume() < b.Volume(); });
  for (std::size_t i = 0; i < others.size(); ++i)
  {
    const double step = 0.3 / double(others.size());
    attempt(others[i].Segment,
      [&]() { nest.AddShell(others[i], execution.Part(0.7 + step * i, 0.7 + step * (i + 1))); });
  }
  nest.RemarkOnContacts(surface, contacts.Reasons);
  std::sort(nest.Set.Segments.begin(), nest.Set.Segments.end(),
    [](const BlocksOfSegment& a, const BlocksOfSegment& b) { return a.Segment < b.Segment; });
  return std::move(nest.Set);
}
}
