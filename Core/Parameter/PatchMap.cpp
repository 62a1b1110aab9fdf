// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "PatchMap.h"

#include <Eigen/Geometry>
#include <Eigen/IterativeLinearSolvers>
#include <Eigen/LU>
#include <Eigen/SparseCore>
#include <Eigen/SparseLU>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace trivariate
{
namespace
{
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int MostRounds = 12;
constexpr double Gain = 0.01;       // the least share by which a round must lower the stretch
constexpr double LeastArea = 1e-14; // of a triangle in the square
constexpr int MostIterations = 300;
constexpr double Tolerance = 1e-11; // of the equations

using Matrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;

// Incomplete factors that look at the user's abort flag whenever a solver uses them.
class StoppableFactors : public Eigen::IncompleteLUT<double>
{
public:
  StoppableFactors() { this->setDroptol(1e-4); }

  void RunBy(const Execution& execution) { this->Run = execution; }

  template <typename Given>
  Eigen::VectorXd solve(const Given& b) const
  {
    this->Run.Check(0.0);
    return IncompleteLUT::solve(b);
  }

private:
  Execution Run;
};

Vector2d SquareCorner(int i)
{
  return { i == 1 || i == 2 ? 1.0 : 0.0, i >= 2 ? 1.0 : 0.0 };
}

// The tangent of half the angle between two directions; finite up to a straight angle.
double TangentOfHalf(const Vector3d& a, const Vector3d& b)
{
  const double sine = a.cross(b).norm(), product = a.norm() * b.norm();
  const double one = product + a.dot(b);
  return sine / std::max(one, 1e-12 * product);
}

// The barycentric coordinates of p, and the least of them; -infinity in a flat triangle.
double Barycentric(
  const Vector2d& p, const Vector2d& a, const Vector2d& b, const Vector2d& c, Vector3d& weights)
{
  const auto area = [](const Vector2d& x, const Vector2d& y) { return x[0] * y[1] - x[1] * y[0]; };
  const double whole = area(b - a, c - a);
  if (std::abs(whole) < LeastArea)
  {
    return -std::numeric_limits<double>::infinity();
  }
  weights = Vector3d(area(b - p, c - p), area(c - p, a - p), area(a - p, b - p)) / whole;
  return weights.minCoeff();
}
}

//------------------------------------------------------------------------------
PatchMap::PatchMap(const BlockDomain& domain, Index patch, const Execution& execution)
  : Domain(domain)
  , Patch(domain.Patches[patch])
{
  this->Number();
  if (!this->TakeParameters())
  {
    this->MapSides();
    this->MapInside(execution);
  }
  this->FillBuckets();
}

void PatchMap::Number()
{
  for (const Index t : this->Patch.Triangles)
  {
    const Triangle& c = this->Domain.Triangles[t];
    this->Points.insert(this->Points.end(), c.begin(), c.end());
  }
  std::sort(this->Points.begin(), this->Points.end());
  this->Points.erase(std::unique(this->Points.begin(), this->Points.end()), this->Points.end());
  const auto numberOf = [this](Index point)
  {
    return static_cast<Index>(
      std::lower_bound(this->Points.begin(), this->Points.end(), point) - this->Points.begin());
  };
  for (const Index t : this->Patch.Triangles)
  {
    const Triangle& c = this->Domain.Triangles[t];
    this->Triangles.push_back({ numberOf(c[0]), numberOf(c[1]), numberOf(c[2]) });
  }
}

// Whether parameters are there and fold no triangle. Faces of the polycube are unit squares.
bool PatchMap::TakeParameters()
{
  if (this->Domain.Parameters.empty())
  {
    return false;
  }
  std::array<Vector3d, 4> corners;
  for (int side = 0; side < 4; ++side)
  {
    corners[side] = this->Domain.Parameters[this->Patch.Sides[side].front()];
  }
  const Vector3d first = corners[1] - corners[0], second = corners[3] - corners[0];
  this->Square.clear();
  for (const Index point : this->Points)
  {
    const Vector3d place = this->Domain.Parameters[point] - corners[0];
    this->Square.emplace_back(first.dot(place), second.dot(place));
  }
  return std::none_of(this->Triangles.begin(), this->Triangles.end(),
    [this](const Triangle& c)
    {
      const Vector2d a = this->Square[c[1]] - this->Square[c[0]];
      const Vector2d b = this->Square[c[2]] - this->Square[c[0]];
      return !(a[0] * b[1] - a[1] * b[0] > 0.0);
    });
}

void PatchMap::MapSides()
{
  this->Square.assign(this->Points.size(), Vector2d::Zero());
  this->OnSide.assign(this->Points.size(), 0);
  for (int side = 0; side < 4; ++side)
  {
    const std::vector<Index>& line = this->Patch.Sides[side];
    const double length =
      this->Domain.EdgeLength(this->Patch.Corners[side], this->Patch.Corners[(side + 1) % 4]);
    double way = 0.0;
    for (std::size_t i = 0; i + 1 < line.size(); ++i)
    {
      const Index point =
        std::lower_bound(this->Points.begin(), this->Points.end(), line[i]) - this->Points.begin();
      const double share = way / length;
      this->Square[point] =
        (1.0 - share) * SquareCorner(side) + share * SquareCorner((side + 1) % 4);
      this->OnSide[point] = 1;
      way += (this->Domain.SurfacePoints[line[i + 1]] - this->Domain.SurfacePoints[line[i]]).norm();
    }
  }
}

void PatchMap::MapInside(const Execution& execution)
{
  std::vector<double> divisors(this->Points.size(), 1.0), stretch;
  double least = std::numeric_limits<double>::infinity();
  for (int round = 0; round < MostRounds; ++round)
  {
    const std::vector<Vector2d> square = this->Solved(
      divisors, execution.Part(double(round) / MostRounds, double(round + 1) / MostRounds));
    const double total = this->Stretch(square, stretch);
    if (!(total < (1.0 - Gain) * least))
    {
      break;
    }
    least = total;
    this->Square = square;
    for (std::size_t p = 0; p < divisors.size(); ++p)
    {
      divisors[p] *= stretch[p];
    }
  }
}

// The root mean square of the singular values of the map from the square (made as large as the
// surface) to the surface, over the surface; and at each point, over the triangles there.
double PatchMap::Stretch(const std::vector<Vector2d>& square, std::vector<double>& ofPoints) const
{
  std::vector<double> areas(square.size(), 0.0);
  ofPoints.assign(square.size(), 0.0);
  double total = 0.0, area = 0.0;
  for (const Triangle& c : this->Triangles)
  {
    const Vector3d& at = this->Domain.SurfacePoints[this->Points[c[0]]];
    const Vector3d p = this->Domain.SurfacePoints[this->Points[c[1]]] - at;
    const Vector3d q = this->Domain.SurfacePoints[this->Points[c[2]]] - at;
    Eigen::Matrix2d flat;
    flat << square[c[1]] - square[c[0]], square[c[2]] - square[c[0]];
    const double here = 0.5 * p.cross(q).norm();
    const double determinant = std::max(std::abs(flat.determinant()), LeastArea);
    Eigen::Matrix2d adjugate;
    adjugate << flat(1, 1), -flat(0, 1), -flat(1, 0), flat(0, 0);
    Eigen::Matrix<double, 3, 2> edges;
    edges << p, q;
    const double square2 = 0.5 * (edges * adjugate / determinant).squaredNorm();
    total += here * square2;
    area += here;
    for (const Index corner : c)
    {
      areas[corner] += here;
      ofPoints[corner] += here * square2;
    }
  }
  for (std::size_t p = 0; p < square.size(); ++p)
  {
    ofPoints[p] = std::sqrt(ofPoints[p] / std::max(areas[p] * area, 1e-300));
    ofPoints[p] = this->OnSide[p] || !(ofPoints[p] > 0.0) ? 1.0 : ofPoints[p];
  }
  return std::sqrt(total) / area;
}

// With each point's weight in the means around it divided.
std::vector<Vector2d> PatchMap::Solved(
  const std::vector<double>& divisors, const Execution& execution) const
{
  std::vector<Index> unknown(this->Points.size(), -1);
  Index unknowns = 0;
  for (std::size_t p = 0; p < this->Points.size(); ++p)
  {
    unknown[p] = this->OnSide[p] ? -1 : unknowns++;
  }
  std::vector<Vector2d> square = this->Square;
  if (unknowns == 0)
  {
    return square;
  }
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::MatrixX2d right = Eigen::MatrixX2d::Zero(unknowns, 2);
  for (const Triangle& c : this->Triangles)
  {
    for (int k = 0; k < 3; ++k)
    {
      const Index row = unknown[c[k]];
      if (row < 0)
      {
        continue;
      }
      const Vector3d& at = this->Domain.SurfacePoints[this->Points[c[k]]];
      const Index ends[2] = { c[(k + 1) % 3], c[(k + 2) % 3] };
      const Vector3d edges[2] = { this->Domain.SurfacePoints[this->Points[ends[0]]] - at,
        this->Domain.SurfacePoints[this->Points[ends[1]]] - at };
      const double tangent = TangentOfHalf(edges[0], edges[1]);
      for (int end = 0; end < 2; ++end)
      {
        const double weight = tangent / std::max(edges[end].norm() * divisors[ends[end]], 1e-300);
        entries.emplace_back(row, row, weight);
        if (unknown[ends[end]] >= 0)
        {
          entries.emplace_back(row, unknown[ends[end]], -weight);
        }
        else
        {
          right.row(row) += weight * this->Square[ends[end]].transpose();
        }
      }
    }
  }
  execution.Check(0.1);
  Matrix matrix(unknowns, unknowns);
  matrix.setFromTriplets(entries.begin(), entries.end());
  Eigen::BiCGSTAB<Matrix, StoppableFactors> solver;
  solver.setTolerance(Tolerance);
  solver.setMaxIterations(MostIterations);
  solver.preconditioner().RunBy(execution.Part(0.5, 0.5));
  solver.compute(matrix);
  Eigen::MatrixX2d solution = right;
  bool isSolved = solver.info() == Eigen::Success;
  for (int axis = 0; axis < 2 && isSolved; ++axis)
  {
    solution.col(axis) = solver.solve(right.col(axis));
    isSolved = solver.info() == Eigen::Success;
  }
  if (!isSolved) // far from flat; exact factors take longer, and do not look at the flag
  {
    execution.Check(0.6);
    const Eigen::SparseLU<Eigen::SparseMatrix<double>> factors(matrix);
    isSolved = factors.info() == Eigen::Success;
    solution = isSolved ? Eigen::MatrixX2d(factors.solve(right)) : solution;
  }
  if (!isSolved || !solution.allFinite())
  {
    throw std::runtime_error(
      "A patch of " + std::to_string(this->Points.size()) + " points cannot be made flat.");
  }
  for (std::size_t p = 0; p < this->Points.size(); ++p)
  {
    if (unknown[p] >= 0)
    {
      square[p] = solution.row(unknown[p]);
    }
  }
  return square;
}

// Fewer of them where long triangles would be in very many.
void PatchMap::FillBuckets()
{
  constexpr std::size_t mostOfTriangle = 16;
  const std::size_t most = mostOfTriangle * this->Triangles.size();
  int along = std::max(1, static_cast<int>(std::sqrt(double(this->Triangles.size()) / 2)));
  const auto range = [&along](const Vector2d& low, const Vector2d& high, int axis)
  {
    const auto bucket = [along](double x)
    { return std::clamp(static_cast<int>(x * along), 0, along - 1); };
    return std::array<int, 2>{ bucket(low[axis] - 1e-9), bucket(high[axis] + 1e-9) };
  };
  const auto bounds = [this](const Triangle& c)
  {
    const Vector2d &p = this->Square[c[0]], &q = this->Square[c[1]], &r = this->Square[c[2]];
    return std::array<Vector2d, 2>{ p.cwiseMin(q).cwiseMin(r), p.cwiseMax(q).cwiseMax(r) };
  };
  const auto countEntries = [&]()
  {
    std::size_t count = 0;
    for (const Triangle& c : this->Triangles)
    {
      const auto [low, high] = bounds(c);
      const auto [i0, i1] = range(low, high, 0);
      const auto [j0, j1] = range(low, high, 1);
      count += std::size_t(i1 - i0 + 1) * std::size_t(j1 - j0 + 1);
    }
    return count;
  };
  while (along > 1 && countEntries() > most)
  {
    along /= 2;
  }
  this->BucketsAlong = along;
  this->Buckets.resize(std::size_t(along) * along);
  for (std::size_t t = 0; t < this->Triangles.size(); ++t)
  {
    const auto [low, high] = bounds(this->Triangles[t]);
    const auto [i0, i1] = range(low, high, 0);
    const auto [j0, j1] = range(low, high, 1);
    for (int j = j0; j <= j1; ++j)
    {
      for (int i = i0; i <= i1; ++i)
      {
        this->Buckets[i + std::size_t(along) * j].push_back(static_cast<Index>(t));
      }
    }
  }
}

//------------------------------------------------------------------------------
Vector3d PatchMap::At(const Vector2d& st) const
{
  const auto bucket = [this](double x)
  { return std::clamp(static_cast<int>(x * this->BucketsAlong), 0, this->BucketsAlong - 1); };
  double best = -std::numeric_limits<double>::infinity();
  Vector3d place = Vector3d::Zero();
  for (const Index t :
    this->Buckets[bucket(st[0]) + std::size_t(this->BucketsAlong) * bucket(st[1])])
  {
    const Triangle& c = this->Triangles[t];
    Vector3d weights;
    const double least =
      Barycentric(st, this->Square[c[0]], this->Square[c[1]], this->Square[c[2]], weights);
    if (least > best)
    {
      best = least;
      weights = weights.cwiseMax(0.0);
      weights /= weights.sum();
      place = weights[0] * this->Domain.SurfacePoints[this->Points[c[0]]] +
              weights[1] * this->Domain.SurfacePoints[this->Points[c[1]]] +
              weights[2] * this->Domain.SurfacePoints[this->Points[c[2]]];
    }
  }
  return place;
}

Vector2d PatchMap::CornerOf(Index point) const
{
  const auto found = std::find(this->Patch.Corners.begin(), this->Patch.Corners.end(), point);
  return SquareCorner(static_cast<int>(found - this->Patch.Corners.begin()));
}
}
