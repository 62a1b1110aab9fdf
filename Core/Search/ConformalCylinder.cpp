// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ConformalCylinder.h"

#include <Eigen/Geometry>
#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cmath>
#include <queue>
#include <stdexcept>

namespace trivariate
{
namespace
{
constexpr double Pi = 3.14159265358979323846;

// Bounds of the cotangents. Positive weights keep the maximum principle, and so the level lines
// whole, on any triangles.
constexpr double LeastWeight = 1e-2, LargestWeight = 1e2;
}

struct ConformalCylinder::Laplacian
{
  // For each triangle the weights of its sides k: half the sum of the cotangents on both sides.
  std::vector<std::array<double, 3>> Weights;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> Inverse; // point 0 held at zero

  Eigen::VectorXd Solve(const Eigen::VectorXd& source) const
  {
    Eigen::VectorXd x(source.size());
    x[0] = 0.0;
    x.tail(source.size() - 1) = this->Inverse.solve(source.tail(source.size() - 1));
    return x;
  }
};

//------------------------------------------------------------------------------
ConformalCylinder::ConformalCylinder(const SurfaceMesh& mesh, const Execution& execution)
  : Mesh(mesh)
  , Operator(std::make_unique<Laplacian>())
{
  const auto cotangent = [&mesh](Index t, int k)
  {
    const Triangle& c = mesh.Triangles[t];
    const Eigen::Vector3d& apex = mesh.Points[c[(k + 2) % 3]];
    const Eigen::Vector3d p = mesh.Points[c[k]] - apex, q = mesh.Points[c[(k + 1) % 3]] - apex;
    return p.dot(q) / std::max(p.cross(q).norm(), 1e-300);
  };
  const Index n = mesh.NumberOfPoints();
  std::vector<Eigen::Triplet<double>> entries;
  this->Operator->Weights.resize(mesh.Triangles.size());
  for (Index t = 0; t < mesh.NumberOfTriangles(); ++t)
  {
    for (int k = 0; k < 3; ++k)
    {
      const Index a = mesh.Triangles[t][k], b = mesh.Triangles[t][(k + 1) % 3];
      const Index across = mesh.Neighbour(t, k);
      const double w =
        std::clamp(0.5 * (cotangent(t, k) + cotangent(across, mesh.CornerOf(across, b))),
          LeastWeight, LargestWeight);
      this->Operator->Weights[t][k] = w;
      if (a > 0)
      {
        entries.emplace_back(a - 1, a - 1, w);
        if (b > 0)
        {
          entries.emplace_back(a - 1, b - 1, -w);
        }
      }
    }
  }
  Eigen::SparseMatrix<double> matrix(n - 1, n - 1);
  matrix.setFromTriplets(entries.begin(), entries.end());
  execution.Check(0.2);
  this->Operator->Inverse.analyzePattern(matrix);
  execution.Check(0.5);
  this->Operator->Inverse.factorize(matrix);
  if (this->Operator->Inverse.info() != Eigen::Success)
  {
    throw std::runtime_error("The Laplacian of the surface could not be factorised.");
  }
}

//------------------------------------------------------------------------------
ConformalCylinder::~ConformalCylinder() = default;

//------------------------------------------------------------------------------
CylinderCoordinates ConformalCylinder::Map(Index low, Index high) const
{
  const SurfaceMesh& mesh = this->Mesh;
  const Index n = mesh.NumberOfPoints();
  Eigen::VectorXd source = Eigen::VectorXd::Zero(n);
  source[high] = 2.0 * Pi;
  source[low] = -2.0 * Pi;
  const Eigen::VectorXd height = this->Operator->Solve(source);

  // Up the steepest edges from pole to pole: a cut that every turn crosses once. The maximum
  // principle leaves no other summit.
  std::vector<Index> after(n, -1), before(n, -1);
  for (Index p = low; p != high;)
  {
    Index best = -1;
    for (const Index* t = mesh.FanBegin(p); t != mesh.FanEnd(p); ++t)
    {
      const Index q = mesh.Triangles[*t][(mesh.CornerOf(*t, p) + 1) % 3];
      best = best < 0 || height[q] > height[best] ? q : best;
    }
    if (!(height[best] > height[p]))
    {
      throw std::runtime_error("The surface has a part that is not connected to the rest.");
    }
    after[p] = best;
    before[best] = p;
    p = best;
  }
  // Edges that leave the cut to its left (seen from outside, looking up) jump by a full turn.
  std::vector<std::array<double, 3>> jump(mesh.Triangles.size(), { 0.0, 0.0, 0.0 });
  for (Index p = low; p >= 0; p = after[p])
  {
    if (p == low || p == high)
    {
      continue;
    }
    // Anticlockwise from the edge towards the next point of the cut to that towards the last one.
    const Index size = mesh.FanEnd(p) - mesh.FanBegin(p);
    Index start = 0;
    const auto spoke = [&mesh, p, size](Index i)
    {
      const Index t = mesh.FanBegin(p)[i % size];
      return mesh.Triangles[t][(mesh.CornerOf(t, p) + 1) % 3];
    };
    while (spoke(start) != after[p])
    {
      ++start;
    }
    for (Index i = start + 1; spoke(i) != before[p]; ++i)
    {
      const Index t = mesh.FanBegin(p)[i % size];
      const int k = mesh.CornerOf(t, p);
      const Index across = mesh.Neighbour(t, k);
      // Two points of the cut cannot be joined by another edge to its left: the cut is steepest.
      jump[t][k] = 2.0 * Pi;
      jump[across][mesh.CornerOf(across, spoke(i))] = -2.0 * Pi;
    }
  }
  // Least squares of the differences along all edges against the jumps.
  source.setZero();
  for (Index t = 0; t < mesh.NumberOfTriangles(); ++t)
  {
    for (int k = 0; k < 3; ++k)
    {
      source[mesh.Triangles[t][k]] -= this->Operator->Weights[t][k] * jump[t][k];
    }
  }
  const Eigen::VectorXd angle = this->Operator->Solve(source);
  CylinderCoordinates result;
  result.Height.assign(height.data(), height.data() + n);
  result.Angle.resize(n);
  for (Index p = 0; p < n; ++p)
  {
    const double turned = angle[p] - angle[after[low]];
    result.Angle[p] = turned - 2.0 * Pi * std::floor(turned / (2.0 * Pi));
  }
  return result;
}
}
