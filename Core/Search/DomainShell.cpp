// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "DomainShell.h"

#include "Domain/DomainLayers.h"
#include "Domain/InnerCorners.h"
#include "Domain/InnerPath.h"
#include "Domain/TriangleTree.h"
#include "Parameter/CoarseHexahedra.h"
#include "PosedSurface.h"

#include <Eigen/LU>

#include <algorithm>
#include <functional>
#include <limits>
#include <optional>
#include <stdexcept>

namespace trivariate
{
namespace
{
using Eigen::Vector3d;

constexpr int MostSteps = 1000;
constexpr double Arrived = 1e-3;     // of the way so far
constexpr Index FewTriangles = 3000; // enough to tell how good hexahedra become
constexpr double Hopeless = -1.0;    // these, where they cannot be made

// Where rays outwards from the corners of the inner surface meet the outer one. No step is longer
// than the distance to the outer surface, so that none leads across it.
std::vector<Vector3d> CornersAbove(const SurfaceMesh& outer, const SurfaceLayout& inner)
{
  const TriangleTree tree(outer.Points, outer.Triangles);
  const double radius = 2.5 * MeanEdge(inner);
  std::vector<Vector3d> places;
  for (const Index corner : inner.Corners)
  {
    const Vector3d start = inner.Points[corner];
    const Vector3d outward = -InwardAt(inner, start, radius);
    TriangleTree::Foot foot = tree.Nearest(start);
    double way = 0.0;
    for (int i = 0; i < MostSteps && foot.Distance > Arrived * way; ++i)
    {
      way += foot.Distance;
      foot = tree.Nearest(start + way * outward);
    }
    places.push_back(foot.Place);
  }
  return places;
}

// The points of a surface nearest to the corners of another one.
std::vector<Vector3d> CornersNear(const SurfaceMesh& surface, const SegmentDomain& domain)
{
  const TriangleTree tree(surface.Points, surface.Triangles);
  std::vector<Vector3d> places;
  for (const Index corner : domain.Layout.Corners)
  {
    places.push_back(tree.Nearest(domain.Layout.Points[corner]).Place);
  }
  return places;
}

// The other domain's polycube with these corners; none where two of them coincide or the surface
// does not suit it.
std::optional<SegmentDomain> WithCorners(const SurfaceMesh& surface, const SegmentDomain& other,
  const std::vector<Vector3d>& corners, const Execution& execution)
{
  try
  {
    return DomainFromCorners(surface, other.Cubes, corners, execution);
  }
  catch (const std::invalid_argument&)
  {
  }
  catch (const std::runtime_error&)
  {
  }
  return std::nullopt;
}

std::vector<Vector3d> CornersOf(const SegmentDomain& domain)
{
  return { domain.Places.begin(), domain.Places.begin() + domain.Cubes.NumberOfCorners };
}

DomainOptions WithOneCube(DomainOptions options)
{
  options.MostCubes = 1;
  return options;
}

// Pairs of domains, judged on surfaces of few triangles as PosedSurface has them.
class ShellSearch
{
public:
  ShellSearch(const SurfaceMesh& outer, const SegmentDomain& core, const Execution& execution)
    : Outer(outer)
    , Core(core)
    , Run(execution)
    , Posed(outer)
    , FewOutside(Reduced(this->Posed.Mesh, FewTriangles, execution.Part(0.0, 0.1)))
    , FewInside(Reduced(
        PosedSurface(SurfaceMesh(core.Layout.Points, core.Layout.Triangles), this->Posed).Mesh,
        FewTriangles, execution.Part(0.1, 0.2)))
    , FewCore(this->OnFew(FewInside, core))
  {
  }

  // The outer surface's own domain, around the core.
  void OfferOwn(const SegmentDomain& own)
  {
    const SegmentDomain turned = TurnedToward(own, this->Core);
    this->Offer(this->OnFew(this->FewOutside, turned), this->FewCore,
      [this, turned](const Execution&) {
        return ShellDomains{ turned, this->Core };
      });
  }

  // With its corners above those of the core, or near to them.
  void OfferAround()
  {
    for (const std::vector<Vector3d>& corners :
      { CornersAbove(this->FewOutside, this->FewCore.Layout),
        CornersNear(this->FewOutside, this->FewCore) })
    {
      if (const auto few = WithCorners(this->FewOutside, this->Core, corners, this->Run))
      {
        this->Offer(*few, this->FewCore,
          [this, corners](const Execution& run)
          {
            return ShellDomains{ DomainFromCorners(
                                   this->Outer, this->Core.Cubes, this->ToGiven(corners), run),
              this->Core };
          });
      }
    }
  }

  // The outer surface's own, and the inner surface with its corners near to those.
  void OfferInside(const SegmentDomain& own, const SurfaceMesh& inner)
  {
    const std::vector<Vector3d> corners = CornersNear(this->FewInside, this->Posed.ToPosed(own));
    if (const auto few = WithCorners(this->FewInside, own, corners, this->Run))
    {
      this->Offer(this->OnFew(this->FewOutside, own), *few,
        [this, own, corners, &inner](const Execution& run) {
          return ShellDomains{ own,
            DomainFromCorners(inner, own.Cubes, this->ToGiven(corners), run) };
        });
    }
  }

  // The best that can be laid out.
  ShellDomains Best(const Execution& execution)
  {
    std::stable_sort(this->Found.begin(), this->Found.end(),
      [](const Candidate& a, const Candidate& b) { return a.Quality > b.Quality; });
    for (const Candidate& candidate : this->Found)
    {
      try
      {
        return candidate.LayOut(execution);
      }
      catch (const std::invalid_argument&)
      {
      }
      catch (const std::runtime_error&)
      {
      }
    }
    throw std::runtime_error("Around the " + std::to_string(this->Core.Cubes.Cubes.size()) +
                             " cubes inside, no domain of as many was found.");
  }

private:
  using Layout = std::function<ShellDomains(const Execution&)>;

  struct Candidate
  {
    double Quality; // of the hexahedra between
    Layout LayOut;
  };

  void Offer(const SegmentDomain& outer, const SegmentDomain& inner, Layout layOut)
  {
    double quality = Hopeless;
    try
    {
      quality = CoarseHexahedra(outer, inner, this->Run);
    }
    catch (const std::invalid_argument&)
    {
    }
    catch (const std::runtime_error&) // a patch that cannot be made flat
    {
    }
    this->Found.push_back({ quality, std::move(layOut) });
  }

  // As it is where it cannot be laid out there.
  SegmentDomain OnFew(const SurfaceMesh& few, const SegmentDomain& domain) const
  {
    const SegmentDomain posed = this->Posed.ToPosed(domain);
    return WithCorners(few, posed, CornersOf(posed), this->Run).value_or(posed);
  }

  std::vector<Vector3d> ToGiven(std::vector<Vector3d> places) const
  {
    for (Vector3d& place : places)
    {
      place = this->Posed.ToGiven(place);
    }
    return places;
  }

  const SurfaceMesh& Outer;
  const SegmentDomain& Core;
  const Execution Run;
  const PosedSurface Posed; // the outer one
  const SurfaceMesh FewOutside, FewInside;
  const SegmentDomain FewCore;
  std::vector<Candidate> Found;
};
}

//------------------------------------------------------------------------------
SegmentDomain TurnedToward(const SegmentDomain& domain, const SegmentDomain& other)
{
  using Turn = Eigen::Matrix3i;
  const Eigen::Vector3i low = Eigen::Vector3i(domain.Cubes.Points[0].data());
  // Twice the place of a corner, from the middle of the cube.
  const auto centred = [&low](const Polycube& cubes, Index corner) -> Eigen::Vector3i
  { return 2 * (Eigen::Vector3i(cubes.Points[corner].data()) - low) - Eigen::Vector3i::Ones(); };
  const auto cornerAt = [](const Eigen::Vector3i& place)
  { return Index(place[0] > 0) + 2 * Index(place[1] > 0) + 4 * Index(place[2] > 0); };

  Turn best = Turn::Identity();
  double least = std::numeric_limits<double>::infinity();
  std::array<int, 3> axes{ 0, 1, 2 };
  do
  {
    for (int signs = 0; signs < 8; ++signs)
    {
      Turn turn = Turn::Zero();
      for (int axis = 0; axis < 3; ++axis)
      {
        turn(axis, axes[axis]) = signs >> axis & 1 ? -1 : 1;
      }
      double sum = turn.cast<double>().determinant() > 0.0 ? 0.0 : least;
      for (Index corner = 0; corner < 8 && sum < least; ++corner)
      {
        const Index target = cornerAt(turn * centred(domain.Cubes, corner));
        sum += (domain.Places[corner] - other.Places[target]).squaredNorm();
      }
      if (sum < least)
      {
        least = sum;
        best = turn;
      }
    }
  } while (std::next_permutation(axes.begin(), axes.end()));

  SegmentDomain turned = domain;
  std::array<Index, 8> newCorner;
  for (Index corner = 0; corner < 8; ++corner)
  {
    newCorner[corner] = cornerAt(best * centred(domain.Cubes, corner));
    turned.Layout.Corners[newCorner[corner]] = domain.Layout.Corners[corner];
    turned.Places[newCorner[corner]] = domain.Places[corner];
  }
  for (Vector3d& place : turned.Layout.Parameters)
  {
    const Vector3d middle = low.cast<double>() + Vector3d::Constant(0.5);
    place = middle + best.cast<double>() * (place - middle);
  }
  // Of one cube, patches are numbered as labels: 2 axis + side.
  std::array<Index, 6> newPatch;
  for (int patch = 0; patch < 6; ++patch)
  {
    const Eigen::Vector3i direction =
      best * ((patch % 2 ? 1 : -1) * Eigen::Vector3i::Unit(patch / 2));
    int axis = 0;
    direction.cwiseAbs().maxCoeff(&axis);
    newPatch[patch] = 2 * axis + (direction[axis] > 0);
  }
  for (Index& patch : turned.Layout.Patches)
  {
    patch = newPatch[patch];
  }
  for (const LayoutBorder& border : domain.Layout.Borders)
  {
    const Index from = newCorner[border.Corners[0]], to = newCorner[border.Corners[1]];
    for (std::size_t e = 0; e < domain.Cubes.Edges.size(); ++e)
    {
      const Polycube::Edge& edge = domain.Cubes.Edges[e];
      LayoutBorder& place = turned.Layout.Borders[e];
      if (edge.From == from && edge.To == to)
      {
        place = { { from, to }, { edge.Left, edge.Right }, border.Points };
      }
      else if (edge.From == to && edge.To == from)
      {
        place = { { to, from }, { edge.Left, edge.Right },
          std::vector<Index>(border.Points.rbegin(), border.Points.rend()) };
      }
    }
  }
  return turned;
}

//------------------------------------------------------------------------------
SegmentDomain DomainAround(const SurfaceMesh& outer, const SegmentDomain& inner,
  const DomainOptions& options, const Execution& execution)
{
  ShellSearch search(outer, inner, execution.Part(0.5, 0.9));
  if (inner.Cubes.Cubes.size() == 1)
  {
    search.OfferOwn(FindDomain(outer, WithOneCube(options), execution.Part(0.0, 0.5)));
  }
  search.OfferAround();
  return search.Best(execution.Part(0.9, 1.0)).Outer;
}

//------------------------------------------------------------------------------
ShellDomains FindShell(const SurfaceMesh& outer, const SurfaceMesh& inner,
  const DomainOptions& options, const Execution& execution)
{
  const DomainOptions oneCube = WithOneCube(options);
  const SegmentDomain core =
    FindDomain(inner, SurfacePose(outer), oneCube, execution.Part(0.0, 0.3));
  const SegmentDomain own = FindDomain(outer, oneCube, execution.Part(0.3, 0.6));
  ShellSearch search(outer, core, execution.Part(0.6, 0.9));
  search.OfferOwn(own);
  search.OfferAround();
  search.OfferInside(own, inner);
  return search.Best(execution.Part(0.9, 1.0));
}
}
