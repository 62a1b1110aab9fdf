// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "DomainShell.h"

#include "Domain/DomainLayers.h"
#include "Domain/InnerCorners.h"
#include "Domain/InnerPath.h"
#include "Domain/TriangleTree.h"

#include <Eigen/LU>

#include <algorithm>
#include <limits>
#include <optional>
#include <stdexcept>

namespace trivariate
{
namespace
{
using Eigen::Vector3d;

constexpr int MostSteps = 1000;
constexpr double Arrived = 1e-3; // of the way so far
// In alignment: of the worst block's ScaledJacobian, and of each block that is inverted.
constexpr double WorthOfJacobian = 0.2, CostOfInversion = 0.03;

// How well both surfaces are aligned, and how good the blocks between them are.
double Worth(const SegmentDomain& outer, const SegmentDomain& inner)
{
  const DomainBlocks blocks = ShellBlocks(outer, inner);
  double least = std::numeric_limits<double>::infinity();
  for (const DomainBlock& block : blocks.Blocks)
  {
    least = std::min(least, ScaledJacobian(blocks.Places, block.Points));
  }
  return 0.5 * (outer.Alignment + inner.Alignment) + WorthOfJacobian * std::max(least, 0.0) -
         CostOfInversion * double(InvertedBlocks(blocks).size());
}

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
  std::optional<SegmentDomain> best;
  if (inner.Cubes.Cubes.size() == 1)
  {
    DomainOptions oneCube = options;
    oneCube.MostCubes = 1;
    best = TurnedToward(FindDomain(outer, oneCube, execution.Part(0.0, 0.7)), inner);
  }
  for (const std::vector<Vector3d>& corners :
    { CornersAbove(outer, inner.Layout), CornersNear(outer, inner) })
  {
    std::optional<SegmentDomain> found =
      WithCorners(outer, inner, corners, execution.Part(0.7, 1.0));
    if (found && (!best || Worth(*found, inner) > Worth(*best, inner)))
    {
      best = std::move(found);
    }
  }
  if (!best)
  {
    throw std::runtime_error("Around the " + std::to_string(inner.Cubes.Cubes.size()) +
                             " cubes inside, no domain of as many was found.");
  }
  return std::move(*best);
}

//------------------------------------------------------------------------------
ShellDomains FindShell(const SurfaceMesh& outer, const SurfaceMesh& inner,
  const DomainOptions& options, const Execution& execution)
{
  DomainOptions oneCube = options;
  oneCube.MostCubes = 1;
  const SegmentDomain core = FindDomain(inner, oneCube, execution.Part(0.0, 0.4));
  ShellDomains shell{ DomainAround(outer, core, options, execution.Part(0.4, 0.8)), core };
  SegmentDomain own = FindDomain(outer, oneCube, execution.Part(0.8, 0.9));
  std::optional<SegmentDomain> below =
    WithCorners(inner, own, CornersNear(inner, own), execution.Part(0.9, 1.0));
  if (below && Worth(own, *below) > Worth(shell.Outer, shell.Inner))
  {
    return { std::move(own), std::move(*below) };
  }
  return shell;
}
}
