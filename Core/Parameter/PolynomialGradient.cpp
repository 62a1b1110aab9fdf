// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "PolynomialGradient.h"

#include <bitset>
#include <cmath>

namespace trivariate
{
using Eigen::MatrixXd;
using Eigen::Vector3d;

namespace
{
constexpr int Ring = 2;
constexpr int Side = 2 * Ring + 1;
constexpr int RingSize = Side * Side * Side;

std::array<int, 3> OffsetOf(int place)
{
  return { place % Side - Ring, place / Side % Side - Ring, place / (Side * Side) - Ring };
}

// The monomials u^i v^j w^k up to a degree: the constant one first, then u, v, w.
std::vector<std::array<int, 3>> Monomials(int degree)
{
  std::vector<std::array<int, 3>> monomials;
  for (int total = 0; total <= degree; ++total)
  {
    for (int k = 0; k <= total; ++k)
    {
      for (int j = 0; j + k <= total; ++j)
      {
        monomials.push_back({ total - j - k, j, k });
      }
    }
  }
  return monomials;
}

// Weights of the ring's voxels for the three first derivatives at its middle, per voxel, by least
// squares; empty where the voxels do not determine the polynomial.
MatrixXd FitWeights(const std::bitset<RingSize>& there, int degree)
{
  const std::vector<std::array<int, 3>> monomials = Monomials(degree);
  const Eigen::Index terms = static_cast<Eigen::Index>(monomials.size());
  std::vector<int> places;
  for (int place = 0; place < RingSize; ++place)
  {
    if (there[place])
    {
      places.push_back(place);
    }
  }
  const Eigen::Index rows = static_cast<Eigen::Index>(places.size());
  if (rows < terms)
  {
    return {};
  }
  MatrixXd q(rows, terms);
  for (Eigen::Index r = 0; r < rows; ++r)
  {
    const std::array<int, 3> offset = OffsetOf(places[r]);
    for (Eigen::Index m = 0; m < terms; ++m)
    {
      q(r, m) = 1.0;
      for (int a = 0; a < 3; ++a)
      {
        q(r, m) *= std::pow(offset[a], monomials[m][a]);
      }
    }
  }
  Eigen::LDLT<MatrixXd> normal(q.transpose() * q);
  if (normal.info() != Eigen::Success || normal.vectorD().minCoeff() < 1e-6)
  {
    return {};
  }
  const MatrixXd fit = normal.solve(q.transpose());
  MatrixXd weights = MatrixXd::Zero(3, RingSize);
  for (Eigen::Index r = 0; r < rows; ++r)
  {
    weights.col(places[r]) = fit.block<3, 1>(1, r);
  }
  return weights;
}

// Of the highest degree that does not amplify errors; zero where there is none.
MatrixXd BestWeights(const std::bitset<RingSize>& there)
{
  for (int degree = 3; degree > 0; --degree)
  {
    const MatrixXd weights = FitWeights(there, degree);
    if (weights.size() > 0 && weights.rowwise().norm().maxCoeff() < 1.0)
    {
      return weights;
    }
  }
  return MatrixXd::Zero(3, RingSize);
}
}

//------------------------------------------------------------------------------
PolynomialGradient::PolynomialGradient(const ParameterCells& cells, const Execution& execution)
  : Cells(cells)
  , Own(cells.Nodes(), -1)
{
  const auto perLength = cells.Spacing.cwiseInverse().asDiagonal();
  this->Whole = perLength * BestWeights(std::bitset<RingSize>().set());
  const auto ringOf = [&cells](Index node)
  {
    std::bitset<RingSize> there;
    for (int place = 0; place < RingSize; ++place)
    {
      const std::array<int, 3> o = OffsetOf(place);
      there[place] = cells.Known[node + o[0] + cells.Size[0] * (o[1] + cells.Size[1] * o[2])] != 0;
    }
    return there;
  };
  std::vector<Index> nodes;
  for (Index node = 0; node < cells.Nodes(); ++node)
  {
    if (cells.Known[node] == 2 && !ringOf(node).all())
    {
      this->Own[node] = static_cast<std::int32_t>(nodes.size());
      nodes.push_back(node);
    }
  }
  this->Cut.resize(nodes.size());
  constexpr Index batch = 4096; // below a second
  for (Index begin = 0; begin < static_cast<Index>(nodes.size()); begin += batch)
  {
    execution.Check(static_cast<double>(begin) / static_cast<double>(nodes.size()));
    execution.ParallelFor(std::min<Index>(batch, static_cast<Index>(nodes.size()) - begin),
      [&](Index first, Index last)
      {
        for (Index n = begin + first; n < begin + last; ++n)
        {
          this->Cut[n] = perLength * BestWeights(ringOf(nodes[n]));
        }
      });
  }
}

//------------------------------------------------------------------------------
Vector3d PolynomialGradient::At(Index node, const double* u) const
{
  const Weights& weights = this->WeightsOf(node);
  Vector3d gradient = Vector3d::Zero();
  int place = 0;
  for (int k = -Ring; k <= Ring; ++k)
  {
    for (int j = -Ring; j <= Ring; ++j)
    {
      const double* line = u + node - Ring + this->Cells.Size[0] * (j + this->Cells.Size[1] * k);
      for (int i = 0; i < Side; ++i, ++place)
      {
        gradient += line[i] * weights.col(place);
      }
    }
  }
  return gradient;
}

//------------------------------------------------------------------------------
// y += the sum over voxels of G^T force(voxel), times a voxel's volume. Slabs whose rings do not
// overlap go together.
template <typename Force>
void PolynomialGradient::Scatter(const Force& force, double* y, const Execution& execution) const
{
  const ParameterCells& cells = this->Cells;
  for (Index phase = 0; phase < Side; ++phase)
  {
    ForEachSlab(cells.Size, (cells.Size[2] - phase + Side - 1) / Side, execution,
      [&](Index slab)
      {
        const Index begin = cells.NodeAt(0, 0, phase + Side * slab);
        for (Index node = begin; node < begin + cells.Size[0] * cells.Size[1]; ++node)
        {
          if (cells.Known[node] != 2)
          {
            continue;
          }
          const Vector3d f = cells.Spacing.prod() * force(node);
          const Weights& weights = this->WeightsOf(node);
          int place = 0;
          for (int k = -Ring; k <= Ring; ++k)
          {
            for (int j = -Ring; j <= Ring; ++j)
            {
              double* line = y + node - Ring + cells.Size[0] * (j + cells.Size[1] * k);
              for (int i = 0; i < Side; ++i, ++place)
              {
                line[i] += weights.col(place).dot(f);
              }
            }
          }
        }
      });
  }
}

//------------------------------------------------------------------------------
void PolynomialGradient::AddEnergy(const TargetField& targets, double epsilon, const double* x,
  double* y, const Execution& execution) const
{
  this->Scatter(
    [&](Index node) -> Vector3d
    {
      const Vector3d gradient = this->At(node, x), along = targets[node].normalized();
      return gradient - (1.0 - epsilon) * along.dot(gradient) * along;
    },
    y, execution);
}

//------------------------------------------------------------------------------
void PolynomialGradient::AddRightHandSide(const TargetField& targets, double epsilon,
  std::vector<double>& b, const Execution& execution) const
{
  this->Scatter(
    [&](Index node) -> Vector3d { return epsilon * targets[node]; }, b.data(), execution);
}
}
