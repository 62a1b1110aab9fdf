// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "SegmentDomains.h"

#include "Domain/InnerCorners.h"
#include "Domain/InnerPath.h"

#include <algorithm>
#include <map>
#include <new>
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
  double Volume = 0.0; // inside of the outermost piece
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

  void Add(const SegmentPieces& segment, const Execution& execution)
  {
    if (segment.Pieces.size() == 1)
    {
      this->AddSolid(segment, execution);
    }
    else if (IsShell(segment.Pieces))
    {
      this->AddShell(segment, execution);
    }
    else
    {
      const auto cavities = std::count_if(segment.Pieces.begin(), segment.Pieces.end(),
        [](const SurfacePiece& piece) { return piece.Volume < 0.0; });
      throw std::invalid_argument(
        "Its surface has " + std::to_string(segment.Pieces.size()) + " pieces, " +
        std::to_string(cavities) +
        " of them around cavities; make it one piece, or one shell, first "
        "(Segment Topology).");
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

  void AddSolid(const SegmentPieces& segment, const Execution& execution)
  {
    const SurfacePiece& piece = segment.Pieces[0];
    SegmentDomain domain = DomainOf(piece.Mesh, this->Settings.Options, execution.Part(0.0, 0.9));
    DomainBlocks blocks = BlocksOf(domain, this->Settings, execution.Part(0.9, 1.0));
    const Index outer = this->Keep(std::move(domain), piece.Origins);
    this->Finish({ segment.Segment, outer, -1, std::move(blocks) });
    this->OuterOf[piece.Origins] = outer;
  }

  void AddShell(const SegmentPieces& segment, const Execution& execution)
  {
    const bool first = segment.Pieces[0].Volume > 0.0;
    const SurfacePiece& outside = segment.Pieces[first ? 0 : 1];
    const SurfacePiece& inside = segment.Pieces[first ? 1 : 0];
    const Index inner = this->InnerSurface(segment.Segment, inside, execution.Part(0.0, 0.4));
    const SegmentDomain& core = this->Set.Surfaces[inner].Domain;
    SegmentDomain domain =
      DomainAround(outside.Mesh, core, this->Settings.Options, execution.Part(0.4, 1.0));
    DomainBlocks blocks = ShellBlocks(domain, core);
    const Index outer = this->Keep(std::move(domain), outside.Origins);
    this->Finish({ segment.Segment, outer, inner, std::move(blocks) });
    this->OuterOf[outside.Origins] = outer;
  }

  // That of the segment in the cavity, or one for the cavity alone.
  Index InnerSurface(int shell, const SurfacePiece& cavity, const Execution& execution)
  {
    const auto found = this->OuterOf.find(cavity.Origins);
    if (found != this->OuterOf.end())
    {
      const std::size_t cubes = this->Set.Surfaces[found->second].Domain.Cubes.Cubes.size();
      if (cubes == 1)
      {
        return found->second;
      }
      this->Set.Remarks.push_back(
        NameOf(shell) +
        " does not share its inner surface with the segment there, whose domain has " +
        std::to_string(cubes) + " cubes; a shell goes around one. Their domains are separate.");
    }
    DomainOptions oneCube = this->Settings.Options;
    oneCube.MostCubes = 1;
    return this->Keep(DomainOf(Reversed(cavity.Mesh), oneCube, execution), cavity.Origins);
  }

  const DomainSettings& Settings;
  // Outer surfaces by their triangles of the labelled surface, ascending.
  std::map<std::vector<Index>, Index> OuterOf;
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
  return settings.Layered
           ? LayeredBlocks(domain, settings.LayerDepth * MeanEdge(domain.Layout), execution)
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
SurfacePiece OnlyPieceOf(const LabelledSurface& surface, int segment)
{
  std::vector<SurfacePiece> pieces = PiecesOf(surface, segment);
  if (pieces.size() != 1)
  {
    throw std::invalid_argument(
      "Its surface has " + std::to_string(pieces.size()) + " pieces; corners are picked on one.");
  }
  return std::move(pieces[0]);
}

//------------------------------------------------------------------------------
DomainSet FindDomains(const LabelledSurface& surface, const std::vector<int>& segments,
  const DomainSettings& settings, const Execution& execution)
{
  Nest nest(settings);
  std::vector<SegmentPieces> inOrder;
  for (const int segment : segments)
  {
    try
    {
      inOrder.push_back({ segment, PiecesOf(surface, segment) });
      for (const SurfacePiece& piece : inOrder.back().Pieces)
      {
        inOrder.back().Volume = std::max(inOrder.back().Volume, piece.Volume);
      }
    }
    catch (const std::invalid_argument& error)
    {
      nest.Set.Failures.push_back(NameOf(segment) + ": " + error.what());
    }
  }
  std::stable_sort(inOrder.begin(), inOrder.end(),
    [](const SegmentPieces& a, const SegmentPieces& b) { return a.Volume < b.Volume; });
  for (std::size_t i = 0; i < inOrder.size(); ++i)
  {
    const double count = double(inOrder.size());
    try
    {
      nest.Add(inOrder[i], execution.Part(i / count, (i + 1) / count));
    }
    catch (const Aborted&)
    {
      throw;
    }
    catch (const std::bad_alloc&)
    {
      throw;
    }
    catch (const std::exception& error)
    {
      nest.Set.Failures.push_back(NameOf(inOrder[i].Segment) + ": " + error.what());
    }
  }
  std::sort(nest.Set.Segments.begin(), nest.Set.Segments.end(),
    [](const BlocksOfSegment& a, const BlocksOfSegment& b) { return a.Segment < b.Segment; });
  return std::move(nest.Set);
}
}
