// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "BlockCells.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>

namespace trivariate
{
namespace
{
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double LeastShare = 0.2; // of the volume of boxes with the mean lengths

double Weight(int corner, int axis, double t)
{
  return EndOfCorner(corner, axis) ? t : 1.0 - t;
}
}

//------------------------------------------------------------------------------
BlockCells::BlockCells(const BlockMesh& mesh)
{
  this->Cells.reserve(mesh.NumberOfCells());
  for (std::size_t b = 0; b < mesh.Sizes.size(); ++b)
  {
    const std::array<int, 3>& n = mesh.Sizes[b];
    for (int k = 0; k < n[2]; ++k)
    {
      for (int j = 0; j < n[1]; ++j)
      {
        for (int i = 0; i < n[0]; ++i)
        {
          this->Cells.push_back(mesh.Cell(static_cast<Index>(b), i, j, k));
          this->BlockOf.push_back(static_cast<Index>(b));
        }
      }
    }
  }
  this->FindUses(static_cast<Index>(mesh.Places.size()));
  this->FindColours(static_cast<Index>(mesh.Places.size()));
}

void BlockCells::FindUses(Index nodes)
{
  this->UseStart.assign(nodes + 1, 0);
  for (const BlockPoints& cell : this->Cells)
  {
    for (const Index node : cell)
    {
      ++this->UseStart[node + 1];
    }
  }
  for (Index node = 0; node < nodes; ++node)
  {
    this->UseStart[node + 1] += this->UseStart[node];
  }
  std::vector<Index> end(this->UseStart.begin(), this->UseStart.end() - 1);
  this->Uses.resize(8 * this->Cells.size());
  for (std::size_t c = 0; c < this->Cells.size(); ++c)
  {
    for (int corner = 0; corner < 8; ++corner)
    {
      this->Uses[end[this->Cells[c][corner]]++] = { static_cast<Index>(c), corner };
    }
  }
}

// Each node gets the first colour that no neighbour has.
void BlockCells::FindColours(Index nodes)
{
  std::vector<int> colourOf(nodes, -1);
  std::vector<Index> usedFor;
  for (Index node = 0; node < nodes; ++node)
  {
    for (const Use* use = this->UsesBegin(node); use != this->UsesEnd(node); ++use)
    {
      for (const Index neighbour : this->Cells[use->Cell])
      {
        if (colourOf[neighbour] >= 0)
        {
          usedFor[colourOf[neighbour]] = node;
        }
      }
    }
    const auto free =
      std::find_if(usedFor.begin(), usedFor.end(), [node](Index used) { return used != node; });
    colourOf[node] = static_cast<int>(free - usedFor.begin());
    if (free == usedFor.end())
    {
      usedFor.push_back(-1);
      this->Colours.emplace_back();
    }
    this->Colours[colourOf[node]].push_back(node);
  }
}

//------------------------------------------------------------------------------
std::vector<Vector3d> CellTargets(const BlockMesh& mesh)
{
  const BlockCells cells(mesh);
  std::vector<Vector3d> lengths(mesh.Sizes.size(), Vector3d::Zero());
  std::vector<double> volumes(mesh.Sizes.size(), 0.0), count(mesh.Sizes.size(), 0.0);
  for (std::size_t c = 0; c < cells.Cells.size(); ++c)
  {
    const BlockPoints& cell = cells.Cells[c];
    const Index block = cells.BlockOf[c];
    volumes[block] += HexahedronVolume(mesh.Places, cell);
    ++count[block];
    for (int corner = 0; corner < 8; ++corner)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        if (EndOfCorner(corner, axis) == 0)
        {
          const Index across = cell[AcrossAxis(corner, axis)];
          lengths[block][axis] += 0.25 * (mesh.Places[across] - mesh.Places[cell[corner]]).norm();
        }
      }
    }
  }
  for (std::size_t b = 0; b < lengths.size(); ++b)
  {
    lengths[b] /= count[b];
    const double box = lengths[b].prod();
    lengths[b] *= std::cbrt(std::max(volumes[b] / count[b] / box, LeastShare));
  }
  return lengths;
}

//------------------------------------------------------------------------------
Vector3d ShapeGradient(int corner, const Vector3d& at)
{
  Vector3d gradient;
  for (int axis = 0; axis < 3; ++axis)
  {
    const int second = (axis + 1) % 3, third = (axis + 2) % 3;
    const double others = Weight(corner, second, at[second]) * Weight(corner, third, at[third]);
    gradient[axis] = EndOfCorner(corner, axis) ? others : -others;
  }
  return gradient;
}

Matrix3d JacobianAt(
  const std::vector<Vector3d>& places, const BlockPoints& cell, const Vector3d& at)
{
  Matrix3d jacobian = Matrix3d::Zero();
  for (int corner = 0; corner < 8; ++corner)
  {
    jacobian += places[cell[corner]] * ShapeGradient(corner, at).transpose();
  }
  return jacobian;
}

double HexahedronVolume(const std::vector<Vector3d>& places, const BlockPoints& cell)
{
  // The determinant is of degree 2 in each variable: 2 x 2 x 2 Gauss points are exact.
  const double gauss[2] = { 0.5 - std::sqrt(1.0 / 12.0), 0.5 + std::sqrt(1.0 / 12.0) };
  double volume = 0.0;
  for (int i = 0; i < 8; ++i)
  {
    const Vector3d t(gauss[i % 2], gauss[i / 2 % 2], gauss[i / 4]);
    volume += 0.125 * JacobianAt(places, cell, t).determinant();
  }
  return volume;
}

Vector3d GaussPoint(int i)
{
  const double gauss[3] = { 0.5 - std::sqrt(0.15), 0.5, 0.5 + std::sqrt(0.15) };
  return { gauss[i % 3], gauss[i / 3 % 3], gauss[i / 9] };
}

double LeastDeterminant(const std::vector<Vector3d>& places, const BlockPoints& cell)
{
  // How each corner's weight changes at the corners and the Gauss points.
  using Gradients = Eigen::Matrix<double, 8, 3>;
  static const std::array<Gradients, 8 + 27> gradients = []()
  {
    std::array<Gradients, 8 + 27> all;
    for (int i = 0; i < 8 + 27; ++i)
    {
      const Vector3d t = i < 8 ? Vector3d(i % 2, i / 2 % 2, i / 4) : GaussPoint(i - 8);
      for (int corner = 0; corner < 8; ++corner)
      {
        all[i].row(corner) = ShapeGradient(corner, t);
      }
    }
    return all;
  }();
  Eigen::Matrix<double, 3, 8> corners;
  for (int corner = 0; corner < 8; ++corner)
  {
    corners.col(corner) = places[cell[corner]];
  }
  double least = std::numeric_limits<double>::infinity();
  for (const Gradients& gradient : gradients)
  {
    const Matrix3d jacobian = corners.lazyProduct(gradient);
    least = std::min(least, jacobian.determinant());
  }
  return least;
}

//------------------------------------------------------------------------------
BlockMesh Resampled(const BlockMesh& mesh, const std::vector<BlockPoints>& blocks,
  const std::vector<std::array<int, 3>>& sizes)
{
  Index points = 0;
  for (const BlockPoints& block : blocks)
  {
    points = std::max(points, *std::max_element(block.begin(), block.end()) + 1);
  }
  BlockMesh fine = NumberNodes(blocks, points, sizes);
  for (std::size_t b = 0; b < blocks.size(); ++b)
  {
    const std::array<int, 3>& from = mesh.Sizes[b];
    const std::array<int, 3>& to = sizes[b];
    std::array<int, 3> at;
    for (at[2] = 0; at[2] <= to[2]; ++at[2])
    {
      for (at[1] = 0; at[1] <= to[1]; ++at[1])
      {
        for (at[0] = 0; at[0] <= to[0]; ++at[0])
        {
          std::array<int, 3> low;
          Vector3d t;
          for (int axis = 0; axis < 3; ++axis)
          {
            const int scaled = at[axis] * from[axis];
            low[axis] = std::min(scaled / to[axis], from[axis] - 1);
            t[axis] = double(scaled - low[axis] * to[axis]) / to[axis];
          }
          const BlockPoints cell = mesh.Cell(static_cast<Index>(b), low[0], low[1], low[2]);
          Vector3d place = Vector3d::Zero();
          for (int corner = 0; corner < 8; ++corner)
          {
            place += Weight(corner, 0, t[0]) * Weight(corner, 1, t[1]) * Weight(corner, 2, t[2]) *
                     mesh.Places[cell[corner]];
          }
          fine.Places[fine.Node(static_cast<Index>(b), at[0], at[1], at[2])] = place;
        }
      }
    }
  }
  return fine;
}
}
