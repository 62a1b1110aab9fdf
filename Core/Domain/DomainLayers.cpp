// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "DomainLayers.h"

#include "InnerCorners.h"
#include "InnerPath.h"

#include <Eigen/LU>

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace trivariate
{
namespace
{
using Eigen::Vector3d;

constexpr double AutomaticDepth = 2.5; // of the mean edge
constexpr double Lessened = 0.7;
constexpr int MostLessenings = 12;

// For the corners of a hexahedron: their neighbours along the first, second and third axis.
constexpr int Neighbours[8][3] = { { 1, 3, 4 }, { 0, 2, 5 }, { 3, 1, 6 }, { 2, 0, 7 }, { 5, 7, 0 },
  { 4, 6, 1 }, { 7, 5, 2 }, { 6, 4, 3 } };

// Which end of the axis corner i is at.
int EndOf(int i, int axis)
{
  return axis == 0 ? (i + 1) / 2 % 2 : axis == 1 ? i / 2 % 2 : i / 4;
}

// The corner of the hexahedron across the axis.
int Across(int i, int axis)
{
  return Neighbours[i][axis];
}

void PlaceInnerCorners(DomainBlocks& blocks, const std::vector<InnerPath>& paths,
  const std::vector<double>& depths, const std::vector<Index>& below)
{
  for (std::size_t corner = 0; corner < paths.size(); ++corner)
  {
    blocks.Places[below[corner]] = paths[corner].At(depths[corner]);
  }
}
}

//------------------------------------------------------------------------------
double ScaledJacobian(const std::vector<Vector3d>& places, const std::array<Index, 8>& hexahedron)
{
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 8; ++i)
  {
    Eigen::Matrix3d edges;
    for (int axis = 0; axis < 3; ++axis)
    {
      const double sign = EndOf(i, axis) ? -1.0 : 1.0;
      const Vector3d edge = places[hexahedron[Neighbours[i][axis]]] - places[hexahedron[i]];
      edges.col(axis) = sign * edge.normalized();
    }
    least = std::min(least, edges.determinant());
  }
  return least;
}

//------------------------------------------------------------------------------
DomainBlock BlockOn(const Polycube& cubes, Index number, const std::vector<Index>& below)
{
  const Polycube::Face& face = cubes.Faces[number];
  DomainBlock block{ cubes.CubePoints[face.Cube], number };
  const std::array<Index, 8> points = block.Points;
  for (int i = 0; i < 8; ++i)
  {
    if (EndOf(i, face.Axis) != face.Side)
    {
      block.Points[i] = below[points[Across(i, face.Axis)]];
    }
  }
  return block;
}

//------------------------------------------------------------------------------
DomainBlocks CubeBlocks(const SegmentDomain& domain)
{
  DomainBlocks blocks{ domain.Places, domain.Cubes.Points, {} };
  for (const std::array<Index, 8>& points : domain.Cubes.CubePoints)
  {
    blocks.Blocks.push_back({ points, -1 });
  }
  return blocks;
}

//------------------------------------------------------------------------------
DomainBlocks LayeredBlocks(const SegmentDomain& domain, double depth, const Execution& execution)
{
  const Polycube& cubes = domain.Cubes;
  const double edge = MeanEdge(domain.Layout);
  const double wanted = depth > 0.0 ? depth : AutomaticDepth * edge;

  DomainBlocks blocks = CubeBlocks(domain);
  std::vector<Index> below;
  for (Index corner = 0; corner < cubes.NumberOfCorners; ++corner)
  {
    below.push_back(static_cast<Index>(blocks.Places.size()));
    blocks.Places.push_back(domain.Places[corner]);
    blocks.Coordinates.push_back(cubes.Points[corner]);
  }
  for (DomainBlock& cube : blocks.Blocks)
  {
    for (Index& point : cube.Points)
    {
      point = point < cubes.NumberOfCorners ? below[point] : point;
    }
  }
  for (std::size_t face = 0; face < cubes.Faces.size(); ++face)
  {
    blocks.Blocks.push_back(BlockOn(cubes, static_cast<Index>(face), below));
  }

  const std::vector<InnerPath> paths = InnerPaths(domain.Layout, edge, 2.0 * wanted, execution);
  std::vector<double> depths, best;
  for (const InnerPath& path : paths)
  {
    depths.push_back(std::min(wanted, 0.5 * path.Reach()));
  }
  PlaceInnerCorners(blocks, paths, depths, below);
  best = depths;
  std::vector<std::size_t> inverted = InvertedBlocks(blocks);
  std::size_t fewest = inverted.size();
  for (int round = 0; round < MostLessenings && !inverted.empty(); ++round)
  {
    std::vector<char> lessen(blocks.Places.size(), 0);
    for (const std::size_t b : inverted)
    {
      for (const Index point : blocks.Blocks[b].Points)
      {
        lessen[point] = 1;
      }
    }
    for (std::size_t corner = 0; corner < depths.size(); ++corner)
    {
      depths[corner] *= lessen[below[corner]] ? Lessened : 1.0;
    }
    PlaceInnerCorners(blocks, paths, depths, below);
    inverted = InvertedBlocks(blocks);
    if (inverted.size() < fewest)
    {
      fewest = inverted.size();
      best = depths;
    }
  }
  PlaceInnerCorners(blocks, paths, best, below);
  UntangleInnerCorners(blocks, domain.Layout, below, best);
  return blocks;
}

//------------------------------------------------------------------------------
DomainBlocks ShellBlocks(const SegmentDomain& outer, const SegmentDomain& inner)
{
  if (outer.Cubes.Cubes != inner.Cubes.Cubes)
  {
    throw std::invalid_argument("A shell needs the same polycube on both of its surfaces.");
  }
  const Polycube& cubes = outer.Cubes;
  const auto firstInside = cubes.NumberOfCorners;
  DomainBlocks blocks{ { outer.Places.begin(), outer.Places.begin() + firstInside },
    { cubes.Points.begin(), cubes.Points.begin() + firstInside }, {} };
  std::vector<Index> below;
  for (Index corner = 0; corner < cubes.NumberOfCorners; ++corner)
  {
    below.push_back(static_cast<Index>(blocks.Places.size()));
    blocks.Places.push_back(inner.Places[corner]);
    blocks.Coordinates.push_back(cubes.Points[corner]);
  }
  for (std::size_t face = 0; face < cubes.Faces.size(); ++face)
  {
    blocks.Blocks.push_back(BlockOn(cubes, static_cast<Index>(face), below));
  }
  return blocks;
}
}
