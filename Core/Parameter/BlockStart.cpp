// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "BlockStart.h"

#include <algorithm>
#include <cmath>

namespace trivariate
{
namespace
{
using Eigen::Vector2d;
using Eigen::Vector3d;
using Size = std::array<int, 3>;

constexpr int First[3] = { 1, 0, 0 }, Second[3] = { 2, 2, 1 }; // the other axes

class Start
{
public:
  Start(const BlockDomain& domain, const std::vector<Size>& sizes)
    : Domain(domain)
    , Mesh(NumberNodes(domain.Blocks, static_cast<Index>(domain.Points.size()), sizes))
    , Placed(this->Mesh.Places.size(), 0)
  {
    for (std::size_t p = 0; p < domain.Points.size(); ++p)
    {
      this->Place(static_cast<Index>(p), domain.Points[p]);
    }
  }

  void PlaceBorders();
  void PlacePatches(const std::vector<PatchMap>& maps);
  void PlaceBelowPatches();
  void PlaceEdges();
  void PlaceFaces();
  void PlaceInside();

private:
  bool Place(Index node, const Vector3d& place)
  {
    if (this->Placed[node])
    {
      return false;
    }
    this->Placed[node] = 1;
    this->Mesh.Places[node] = place;
    return true;
  }

  // Calls function(block, axis, nodes) for all 12 edges of all blocks.
  template <typename Function>
  void ForEdges(const Function& function) const
  {
    for (std::size_t b = 0; b < this->Domain.Blocks.size(); ++b)
    {
      for (int edge = 0; edge < 12; ++edge)
      {
        function(this->Mesh.EdgeNodes(static_cast<Index>(b), edge / 4, edge % 2, edge / 2 % 2));
      }
    }
  }

  const BlockDomain& Domain;

public:
  BlockMesh Mesh;

private:
  std::vector<char> Placed;
};

// The point of a polyline at a share of the way.
Vector3d AlongLine(
  const std::vector<Vector3d>& line, const std::vector<double>& shares, double share)
{
  const std::size_t i = std::clamp<std::size_t>(
    std::upper_bound(shares.begin(), shares.end(), share) - shares.begin(), 1, line.size() - 1);
  const double length = shares[i] - shares[i - 1];
  const double t = length > 0.0 ? (share - shares[i - 1]) / length : 0.0;
  return (1.0 - t) * line[i - 1] + t * line[i];
}

void Start::PlaceBorders()
{
  this->ForEdges(
    [this](const std::vector<Index>& nodes)
    {
      const std::vector<Index> border = this->Domain.Border(nodes.front(), nodes.back());
      if (border.empty())
      {
        return;
      }
      std::vector<Vector3d> line;
      for (const Index point : border)
      {
        line.push_back(this->Domain.SurfacePoints[point]);
      }
      const std::vector<double> shares = this->Domain.SharesAlong(border);
      for (std::size_t i = 1; i + 1 < nodes.size(); ++i)
      {
        this->Place(nodes[i], AlongLine(line, shares, double(i) / (nodes.size() - 1)));
      }
    });
}

void Start::PlacePatches(const std::vector<PatchMap>& maps)
{
  const std::vector<PatchFace> faces = PatchFaces(this->Domain, this->Mesh);
  for (std::size_t patch = 0; patch < faces.size(); ++patch)
  {
    const PatchFace& face = faces[patch];
    const PatchMap& map = maps[patch];
    const std::array<Index, 4> points =
      FacePoints(this->Domain.Blocks[face.Block], face.Axis, face.Side);
    const Vector2d origin = map.CornerOf(points[0]);
    const Vector2d along = map.CornerOf(points[1]) - origin,
                   across = map.CornerOf(points[2]) - origin;
    const auto [ns, nt] = face.Cells;
    for (std::size_t i = 0; i < face.Nodes.size(); ++i)
    {
      const int s = static_cast<int>(i) % (ns + 1), t = static_cast<int>(i) / (ns + 1);
      if (!this->Placed[face.Nodes[i]])
      {
        this->Place(
          face.Nodes[i], map.At(origin + double(s) / ns * along + double(t) / nt * across));
      }
    }
  }
}

void Start::PlaceBelowPatches()
{
  std::vector<char> onSurface(this->Domain.Points.size(), 0);
  for (const Index corner : this->Domain.CornerOf)
  {
    if (corner >= 0)
    {
      onSurface[corner] = 1;
    }
  }
  for (std::size_t b = 0; b < this->Domain.Blocks.size(); ++b)
  {
    for (int face = 0; face < 6; ++face)
    {
      const int axis = face / 2, side = face % 2;
      const std::array<Index, 4> above = FacePoints(this->Domain.Blocks[b], axis, side);
      const std::array<Index, 4> below = FacePoints(this->Domain.Blocks[b], axis, 1 - side);
      if (this->Domain.PatchOn(above) < 0 ||
          std::any_of(
            below.begin(), below.end(), [&onSurface](Index point) { return onSurface[point]; }))
      {
        continue;
      }
      const std::vector<Index> from = this->Mesh.FaceNodes(b, axis, side);
      const std::vector<Index> to = this->Mesh.FaceNodes(b, axis, 1 - side);
      const int ns = this->Mesh.Sizes[b][First[axis]], nt = this->Mesh.Sizes[b][Second[axis]];
      for (std::size_t i = 0; i < from.size(); ++i)
      {
        const double s = double(i % (ns + 1)) / ns, t = double(i / (ns + 1)) / nt;
        const double weights[4] = { (1 - s) * (1 - t), s * (1 - t), (1 - s) * t, s * t };
        Vector3d place = this->Mesh.Places[from[i]];
        for (int corner = 0; corner < 4; ++corner)
        {
          place += weights[corner] *
                   (this->Domain.Points[below[corner]] - this->Domain.Points[above[corner]]);
        }
        this->Place(to[i], place);
      }
    }
  }
}

void Start::PlaceEdges()
{
  this->ForEdges(
    [this](const std::vector<Index>& nodes)
    {
      for (std::size_t i = 1; i + 1 < nodes.size(); ++i)
      {
        const double t = double(i) / (nodes.size() - 1);
        this->Place(nodes[i],
          (1.0 - t) * this->Mesh.Places[nodes.front()] + t * this->Mesh.Places[nodes.back()]);
      }
    });
}

// Coons: the ruled surfaces of both pairs of sides, less the bilinear one of the corners.
void Start::PlaceFaces()
{
  for (std::size_t b = 0; b < this->Domain.Blocks.size(); ++b)
  {
    for (int face = 0; face < 6; ++face)
    {
      const int axis = face / 2;
      const int ns = this->Mesh.Sizes[b][First[axis]], nt = this->Mesh.Sizes[b][Second[axis]];
      const std::vector<Index> nodes = this->Mesh.FaceNodes(b, axis, face % 2);
      const auto x = [&](int i, int j) -> const Vector3d&
      { return this->Mesh.Places[nodes[i + (ns + 1) * j]]; };
      for (int j = 1; j < nt; ++j)
      {
        for (int i = 1; i < ns; ++i)
        {
          const double s = double(i) / ns, t = double(j) / nt;
          this->Place(nodes[i + (ns + 1) * j], (1 - s) * x(0, j) + s * x(ns, j) +
                                                 (1 - t) * x(i, 0) + t * x(i, nt) -
                                                 (1 - t) * ((1 - s) * x(0, 0) + s * x(ns, 0)) -
                                                 t * ((1 - s) * x(0, nt) + s * x(ns, nt)));
        }
      }
    }
  }
}

// The same with six faces: ruled volumes, less those of the edges, and that of the corners.
void Start::PlaceInside()
{
  for (std::size_t b = 0; b < this->Domain.Blocks.size(); ++b)
  {
    const Size n = this->Mesh.Sizes[b];
    std::array<int, 3> at;
    for (at[2] = 1; at[2] < n[2]; ++at[2])
    {
      for (at[1] = 1; at[1] < n[1]; ++at[1])
      {
        for (at[0] = 1; at[0] < n[0]; ++at[0])
        {
          // 1 - (1 - P0)(1 - P1)(1 - P2), where P_a interpolates between the two ends of axis a.
          Vector3d place = Vector3d::Zero();
          for (int which = 1; which < 27; ++which)
          {
            const int ends[3] = { which % 3, which / 3 % 3, which / 9 };
            double weight = -1.0;
            std::array<int, 3> node = at;
            for (int axis = 0; axis < 3; ++axis)
            {
              const double t = double(at[axis]) / n[axis];
              weight *= ends[axis] == 0 ? 1.0 : ends[axis] == 1 ? t - 1.0 : -t;
              node[axis] = ends[axis] == 0 ? at[axis] : ends[axis] == 1 ? 0 : n[axis];
            }
            place += weight * this->Mesh.Places[this->Mesh.Node(b, node[0], node[1], node[2])];
          }
          this->Place(this->Mesh.Node(b, at[0], at[1], at[2]), place);
        }
      }
    }
  }
}
}

//------------------------------------------------------------------------------
std::vector<PatchMap> MapPatches(const BlockDomain& domain, const Execution& execution)
{
  std::vector<PatchMap> maps;
  for (std::size_t patch = 0; patch < domain.Patches.size(); ++patch)
  {
    const double share = 1.0 / double(domain.Patches.size());
    const Execution part = execution.Part(share * double(patch), share * double(patch + 1));
    part.Check(0.0);
    maps.emplace_back(domain, static_cast<Index>(patch), part);
  }
  return maps;
}

//------------------------------------------------------------------------------
BlockMesh StartOfBlockMesh(const BlockDomain& domain, const std::vector<PatchMap>& maps,
  const std::vector<std::array<int, 3>>& sizes)
{
  Start start(domain, sizes);
  start.PlaceBorders();
  start.PlacePatches(maps);
  start.PlaceBelowPatches();
  start.PlaceEdges();
  start.PlaceFaces();
  start.PlaceInside();
  return std::move(start.Mesh);
}
}
