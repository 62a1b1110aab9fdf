// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "BlockLocation.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/QR>

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

namespace trivariate
{
namespace
{
using Eigen::Matrix3d;
using Eigen::Vector3d;
using Box = Eigen::AlignedBox3d;

constexpr int MostSteps = 40, MostHalvings = 12;
constexpr double Exact = 1e-9;         // of a cell's diagonal: as good as inside
constexpr double Arrived = 1e-13;      // of a cell, in parameters
constexpr double Flat = 1e-20;         // a squared volume of the cell, of the box of its edges
constexpr Index PerLeaf = 4;           // cells
constexpr Index BetweenChecks = 50000; // points

// A Newton step; of least length where the cell is flat.
Vector3d Downhill(const Matrix3d& curve, const Vector3d& slope)
{
  Matrix3d inverse;
  bool isRegular = false;
  curve.computeInverseWithCheck(inverse, isRegular, Flat * curve.diagonal().prod());
  return isRegular ? Vector3d(-inverse * slope)
                   : Vector3d(-curve.completeOrthogonalDecomposition().solve(slope));
}

struct CellAddress
{
  Index Block;
  std::array<int, 3> At;
};

// The trilinear map of a cell.
class CellMap
{
public:
  CellMap(const BlockMesh& mesh, const CellAddress& cell)
  {
    const BlockPoints nodes = mesh.Cell(cell.Block, cell.At[0], cell.At[1], cell.At[2]);
    for (int i = 0; i < 8; ++i)
    {
      this->Corners[i] = mesh.Places[nodes[i]];
    }
  }

  Vector3d At(const Vector3d& t) const
  {
    Vector3d place = Vector3d::Zero();
    for (int i = 0; i < 8; ++i)
    {
      place += Weight(i, 0, t) * Weight(i, 1, t) * Weight(i, 2, t) * this->Corners[i];
    }
    return place;
  }

  Matrix3d JacobianAt(const Vector3d& t) const
  {
    Matrix3d jacobian = Matrix3d::Zero();
    for (int i = 0; i < 8; ++i)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        const double others = Weight(i, (axis + 1) % 3, t) * Weight(i, (axis + 2) % 3, t);
        jacobian.col(axis) += (EndOfCorner(i, axis) ? others : -others) * this->Corners[i];
      }
    }
    return jacobian;
  }

  // The parameter in [0, 1]^3 whose place is nearest to p, from the middle by Gauss-Newton steps in
  // the directions that do not lead out of the cube.
  Vector3d Nearest(const Vector3d& p) const;

private:
  static double Weight(int corner, int axis, const Vector3d& t)
  {
    return EndOfCorner(corner, axis) ? t[axis] : 1.0 - t[axis];
  }

  std::array<Vector3d, 8> Corners;
};

Vector3d CellMap::Nearest(const Vector3d& p) const
{
  Vector3d t = Vector3d::Constant(0.5);
  Vector3d rest = this->At(t) - p;
  for (int step = 0; step < MostSteps; ++step)
  {
    const Matrix3d jacobian = this->JacobianAt(t);
    Vector3d slope = jacobian.transpose() * rest;
    Matrix3d curve = jacobian.transpose() * jacobian;
    for (int axis = 0; axis < 3; ++axis)
    {
      if ((t[axis] <= 0.0 && slope[axis] > 0.0) || (t[axis] >= 1.0 && slope[axis] < 0.0))
      {
        slope[axis] = 0.0;
        curve.row(axis).setZero();
        curve.col(axis).setZero();
        curve(axis, axis) = 1.0;
      }
    }
    const Vector3d way = Downhill(curve, slope);
    if (way.lpNorm<Eigen::Infinity>() < Arrived)
    {
      break;
    }
    double share = 1.0;
    Vector3d next, nextRest;
    for (int halving = 0; halving < MostHalvings; ++halving, share *= 0.5)
    {
      next = (t + share * way).cwiseMax(0.0).cwiseMin(1.0);
      nextRest = this->At(next) - p;
      if (nextRest.squaredNorm() < rest.squaredNorm())
      {
        break;
      }
    }
    if (!(nextRest.squaredNorm() < rest.squaredNorm()))
    {
      break;
    }
    t = next;
    rest = nextRest;
  }
  return t;
}

// A binary tree of boxes around cells, split at the median of their middles.
class CellTree
{
public:
  CellTree(const BlockMesh& mesh, const std::vector<Index>& blocks);

  BlockLocation Nearest(const Vector3d& p, double farthest) const;

private:
  struct Node
  {
    Box Around;
    Index Begin, End; // of Cells
    Index Right;      // the second child; the first one comes next; -1: a leaf
  };

  void Split(Index begin, Index end);
  void Search(Index node, const Vector3d& p, BlockLocation& best) const;
  void Compare(Index cell, const Vector3d& p, BlockLocation& best) const;

  const BlockMesh& Mesh;
  std::vector<CellAddress> Cells;
  std::vector<Box> Boxes; // of the cells
  std::vector<Node> Nodes;
};

CellTree::CellTree(const BlockMesh& mesh, const std::vector<Index>& blocks)
  : Mesh(mesh)
{
  for (const Index b : blocks)
  {
    const std::array<int, 3>& n = mesh.Sizes[b];
    for (Index i = 0; i < Index(n[0]) * n[1] * n[2]; ++i)
    {
      this->Cells.push_back({ b, { int(i % n[0]), int(i / n[0] % n[1]), int(i / n[0] / n[1]) } });
    }
  }
  this->Split(0, static_cast<Index>(this->Cells.size()));
  for (const CellAddress& cell : this->Cells)
  {
    this->Boxes.emplace_back();
    for (const Index node : mesh.Cell(cell.Block, cell.At[0], cell.At[1], cell.At[2]))
    {
      this->Boxes.back().extend(mesh.Places[node]);
    }
  }
  for (std::size_t node = this->Nodes.size(); node-- > 0;)
  {
    Node& here = this->Nodes[node];
    for (Index cell = here.Begin; cell < here.End && here.Right < 0; ++cell)
    {
      here.Around.extend(this->Boxes[cell]);
    }
    if (here.Right >= 0)
    {
      here.Around = this->Nodes[node + 1].Around.merged(this->Nodes[here.Right].Around);
    }
  }
}

void CellTree::Split(Index begin, Index end)
{
  const std::size_t node = this->Nodes.size();
  this->Nodes.push_back({ Box(), begin, end, -1 });
  if (end - begin <= PerLeaf)
  {
    return;
  }
  const auto middle = [this](const CellAddress& cell)
  { return this->Mesh.Places[this->Mesh.Node(cell.Block, cell.At[0], cell.At[1], cell.At[2])]; };
  Box middles;
  for (Index cell = begin; cell < end; ++cell)
  {
    middles.extend(middle(this->Cells[cell]));
  }
  int axis = 0;
  middles.sizes().maxCoeff(&axis);
  const Index half = begin + (end - begin) / 2;
  std::nth_element(this->Cells.begin() + begin, this->Cells.begin() + half,
    this->Cells.begin() + end,
    [&middle, axis](const CellAddress& a, const CellAddress& b)
    { return middle(a)[axis] < middle(b)[axis]; });
  this->Split(begin, half);
  this->Nodes[node].Right = static_cast<Index>(this->Nodes.size());
  this->Split(half, end);
}

BlockLocation CellTree::Nearest(const Vector3d& p, double farthest) const
{
  BlockLocation best;
  best.Distance = farthest;
  this->Search(0, p, best);
  return best;
}

bool IsInside(const BlockLocation& location)
{
  return location.Block >= 0 && location.Distance == 0.0;
}

void CellTree::Search(Index number, const Vector3d& p, BlockLocation& best) const
{
  const Node& node = this->Nodes[number];
  if (node.Right < 0)
  {
    for (Index cell = node.Begin; cell < node.End; ++cell)
    {
      if (!IsInside(best) && this->Boxes[cell].exteriorDistance(p) <= best.Distance)
      {
        this->Compare(cell, p, best);
      }
    }
    return;
  }
  const std::array<Index, 2> children{ number + 1, node.Right };
  // Of two boxes around the point that with the nearer middle first.
  std::array<std::array<double, 2>, 2> distances;
  for (int child = 0; child < 2; ++child)
  {
    const Box& around = this->Nodes[children[child]].Around;
    distances[child] = { around.exteriorDistance(p), (around.center() - p).squaredNorm() };
  }
  const int first = distances[1] < distances[0];
  for (const int child : { first, 1 - first })
  {
    if (distances[child][0] <= best.Distance && !IsInside(best))
    {
      this->Search(children[child], p, best);
    }
  }
}

void CellTree::Compare(Index number, const Vector3d& p, BlockLocation& best) const
{
  const CellAddress& cell = this->Cells[number];
  const CellMap map(this->Mesh, cell);
  const Vector3d t = map.Nearest(p);
  double distance = (map.At(t) - p).norm();
  distance = distance < Exact * this->Boxes[number].diagonal().norm() ? 0.0 : distance;
  if (distance < best.Distance || (distance == best.Distance && best.Block < 0))
  {
    best.Block = cell.Block;
    best.Distance = distance;
    for (int axis = 0; axis < 3; ++axis)
    {
      best.Parameter[axis] = (cell.At[axis] + t[axis]) / this->Mesh.Sizes[cell.Block][axis];
    }
  }
}
}

//------------------------------------------------------------------------------
std::vector<BlockLocation> LocateInBlocks(const BlockMesh& mesh, const std::vector<Index>& blocks,
  const std::vector<Vector3d>& points, double farthest, const Execution& execution)
{
  const CellTree tree(mesh, blocks);
  std::vector<BlockLocation> found(points.size());
  const Index n = static_cast<Index>(points.size());
  for (Index from = 0; from < n; from += BetweenChecks)
  {
    execution.Check(double(from) / n);
    execution.ParallelFor(std::min(BetweenChecks, n - from),
      [&](Index begin, Index end)
      {
        for (Index i = from + begin; i < from + end; ++i)
        {
          found[i] = tree.Nearest(points[i], farthest);
        }
      });
  }
  return found;
}

Vector3d PlaceInBlock(const BlockMesh& mesh, Index block, const Vector3d& parameter)
{
  CellAddress cell{ block, {} };
  Vector3d t;
  for (int axis = 0; axis < 3; ++axis)
  {
    const int n = mesh.Sizes[block][axis];
    cell.At[axis] = std::clamp(static_cast<int>(parameter[axis] * n), 0, n - 1);
    t[axis] = parameter[axis] * n - cell.At[axis];
  }
  return CellMap(mesh, cell).At(t);
}
}
