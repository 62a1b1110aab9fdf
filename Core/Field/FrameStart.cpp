// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "FrameStart.h"

#include "CrossHarmonics.h"
#include "Domain/ClosestRotation.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace trivariate
{
using Eigen::Matrix3d;
using Eigen::Quaternionf;
using Eigen::Vector3d;

namespace
{
// Voxels that are summed in one order, so that no sum depends on the threads.
constexpr Index BlockSize = 4096;

// The sum of term(voxel) over all voxels.
template <typename Term>
double Sum(Index n, const Execution& execution, const Term& term)
{
  std::vector<double> partial((n + BlockSize - 1) / BlockSize, 0.0);
  execution.ParallelFor(static_cast<Index>(partial.size()),
    [&](Index begin, Index end)
    {
      for (Index block = begin; block < end; ++block)
      {
        for (Index v = block * BlockSize; v < std::min(n, (block + 1) * BlockSize); ++v)
        {
          partial[block] += term(v);
        }
      }
    });
  return std::accumulate(partial.begin(), partial.end(), 0.0);
}

template <int D>
using Values = std::vector<Eigen::Matrix<double, D, 1>>;

/**
 * The values that are smoothest (least squares of the differences of neighbours, weighted) among
 * those whose voxels differ from the given ones by a vector in their free space: conjugate
 * gradients, until the residual is 1e-9 in the root mean square. release(values) takes from every
 * voxel the part that is not free to change.
 */
template <int D, typename Release>
void Smooth(
  const FrameVoxels& voxels, Values<D>& x, const Release& release, const Execution& execution)
{
  const Index n = voxels.Count();
  const Vector3d weights = voxels.PairWeights();
  const auto laplacian = [&voxels, n, weights, &execution, &release](
                           const Values<D>& from, Values<D>& to)
  {
    execution.ParallelFor(n,
      [&](Index begin, Index end)
      {
        for (Index v = begin; v < end; ++v)
        {
          to[v].setZero();
          for (int side = 0; side < 6; ++side)
          {
            const std::int32_t j = voxels.Neighbours[v][side];
            if (j >= 0)
            {
              to[v] += weights[side / 2] * (from[v] - from[j]);
            }
          }
        }
      });
    release(to);
  };
  Values<D> residual(n), product(n);
  laplacian(x, residual);
  Sum(n, execution,
    [&](Index v)
    {
      residual[v] = -residual[v];
      return 0.0;
    });
  Values<D> direction = residual;
  double square = Sum(n, execution, [&](Index v) { return residual[v].squaredNorm(); });
  for (int i = 0; i < 1000 && square > 1e-18 * n; ++i)
  {
    execution.Check(std::min(1.0, i / 200.0));
    laplacian(direction, product);
    const double curvature =
      Sum(n, execution, [&](Index v) { return direction[v].dot(product[v]); });
    if (!(curvature > 0.0))
    {
      break;
    }
    const double step = square / curvature;
    const double next = Sum(n, execution,
      [&](Index v)
      {
        x[v] += step * direction[v];
        residual[v] -= step * product[v];
        return residual[v].squaredNorm();
      });
    const double share = next / square;
    square = next;
    Sum(n, execution,
      [&](Index v)
      {
        direction[v] = residual[v] + share * direction[v];
        return 0.0;
      });
  }
}

// Solves on all levels from the coarsest to `wanted`; solve(level, values) fixes what is fixed and
// smoothes.
template <int D, typename Solve>
Values<D> SolveUpTo(const std::vector<FrameLevel>& levels, int wanted, const Solve& solve)
{
  Values<D> values(levels.back().Voxels.Count(), Eigen::Matrix<double, D, 1>::Zero());
  for (int level = static_cast<int>(levels.size()) - 1;; --level)
  {
    solve(levels[level], values);
    if (level == wanted)
    {
      return values;
    }
    const FrameLevel& finer = levels[level - 1];
    Values<D> next(finer.Voxels.Count());
    for (Index v = 0; v < finer.Voxels.Count(); ++v)
    {
      next[v] = values[finer.Parents[v]];
    }
    values = std::move(next);
  }
}

using Entries = Eigen::Matrix<double, 9, 1>;

Matrix3d AsMatrix(const Entries& entries)
{
  return Eigen::Map<const Matrix3d>(entries.data());
}

// The entries of frames: a bound frame F has F n = axis.
void SmoothEntries(const FrameLevel& level, Values<9>& values, const Execution& execution)
{
  for (const FrameBound& bound : level.Bounds)
  {
    Eigen::Map<Matrix3d> m(values[bound.Voxel].data());
    const Vector3d n = bound.Normal.cast<double>().normalized();
    if (bound.What == FrameBound::Kind::Fixed)
    {
      m = bound.Fixed.cast<double>().toRotationMatrix();
    }
    else
    {
      m += (bound.Axis.cast<double>().normalized() - m * n).eval() * n.transpose();
    }
  }
  const auto release = [&level](Values<9>& changes)
  {
    for (const FrameBound& bound : level.Bounds)
    {
      Eigen::Map<Matrix3d> m(changes[bound.Voxel].data());
      const Vector3d n = bound.Normal.cast<double>().normalized();
      if (bound.What == FrameBound::Kind::Fixed)
      {
        m.setZero();
      }
      else
      {
        m -= (m * n).eval() * n.transpose();
      }
    }
  };
  Smooth<9>(level.Voxels, values, release, execution);
}

// A bound between two axes says nothing linear about the harmonics: its voxel is left free.
bool BindsCross(const FrameBound& bound)
{
  return bound.What != FrameBound::Kind::Axis || bound.Axis.cwiseAbs().maxCoeff() > 0.999f;
}

void SmoothHarmonics(const FrameLevel& level, Values<9>& values, const Execution& execution)
{
  std::vector<Eigen::Matrix<double, 9, 2>> bases;
  for (const FrameBound& bound : level.Bounds)
  {
    bases.push_back(Eigen::Matrix<double, 9, 2>::Zero());
    CrossVector& value = values[bound.Voxel];
    if (bound.What == FrameBound::Kind::Fixed)
    {
      value = HarmonicsOf(bound.Fixed.cast<double>().toRotationMatrix());
    }
    else if (BindsCross(bound))
    {
      const AlignedCrosses crosses(bound.Normal.cast<double>().normalized());
      bases.back() = crosses.Basis;
      value = crosses.Centre + crosses.Basis * (crosses.Basis.transpose() * value).eval();
    }
  }
  const auto release = [&level, &bases](Values<9>& changes)
  {
    for (std::size_t i = 0; i < bases.size(); ++i)
    {
      if (BindsCross(level.Bounds[i]))
      {
        CrossVector& change = changes[level.Bounds[i].Voxel];
        change = bases[i] * (bases[i].transpose() * change).eval();
      }
    }
  };
  Smooth<9>(level.Voxels, values, release, execution);
}

// Coordinates are 0 and 1 where a side is; where a coarse voxel has both, in the middle.
void SmoothCoordinates(const FrameLevel& level, Values<3>& values, const Execution& execution)
{
  std::vector<Vector3d> sums(values.size(), Vector3d::Zero()), counts = sums;
  for (const FrameConstraint& constraint : level.Constraints)
  {
    sums[constraint.Voxel][constraint.Side / 2] += constraint.Side % 2;
    counts[constraint.Voxel][constraint.Side / 2] += 1.0;
  }
  for (std::size_t v = 0; v < values.size(); ++v)
  {
    for (int a = 0; a < 3; ++a)
    {
      values[v][a] = counts[v][a] > 0.0 ? sums[v][a] / counts[v][a] : values[v][a];
    }
  }
  const auto release = [&counts](Values<3>& changes)
  {
    for (std::size_t v = 0; v < changes.size(); ++v)
    {
      changes[v] = (counts[v].array() > 0.0).select(0.0, changes[v]);
    }
  };
  Smooth<3>(level.Voxels, values, release, execution);
}

// Row a: the gradient of coordinate a in space by central differences, one-sided at the boundary.
Matrix3d GradientsAt(const FrameVoxels& voxels, const Values<3>& values, Index v)
{
  Matrix3d gradients = Matrix3d::Zero(); // by steps

  for (int a = 0; a < 3; ++a)
  {
    const std::int32_t low = voxels.Neighbours[v][2 * a], high = voxels.Neighbours[v][2 * a + 1];
    const int apart = (low >= 0 ? 1 : 0) + (high >= 0 ? 1 : 0);
    if (apart > 0)
    {
      gradients.col(a) =
        (values[high >= 0 ? high : v] - values[low >= 0 ? low : v]) / static_cast<double>(apart);
    }
  }
  return gradients * voxels.Steps.inverse();
}
}

//------------------------------------------------------------------------------
FrameList ConstantFrames(const FrameLevel& level)
{
  const Index n = level.Voxels.Count();
  const auto place = [&level](Index v)
  {
    const std::array<Index, 3> p = level.Voxels.Place(v);
    return Vector3d(level.Voxels.Steps * Vector3d(static_cast<double>(p[0]),
                                           static_cast<double>(p[1]), static_cast<double>(p[2])));
  };
  Vector3d centre = Vector3d::Zero();
  for (Index v = 0; v < n; ++v)
  {
    centre += place(v) / static_cast<double>(n);
  }
  Matrix3d moment = Matrix3d::Zero();
  for (Index v = 0; v < n; ++v)
  {
    moment += (place(v) - centre) * (place(v) - centre).transpose();
  }
  Matrix3d frame = Eigen::SelfAdjointEigenSolver<Matrix3d>(moment).eigenvectors().transpose();
  frame.row(2) = frame.row(0).cross(frame.row(1));
  // Named as the constraints would have it.
  Matrix3d wanted = Matrix3d::Zero();
  for (const FrameBound& bound : level.Bounds)
  {
    if (bound.What == FrameBound::Kind::Axis)
    {
      wanted += bound.Axis.cast<double>() * bound.Normal.cast<double>().transpose();
    }
  }
  const auto fit = [&frame, &wanted](const Matrix3d& label)
  { return (label * frame).cwiseProduct(wanted).sum(); };
  const Matrix3d label = *std::max_element(CubeRotations().begin(), CubeRotations().end(),
    [&fit](const Matrix3d& a, const Matrix3d& b) { return fit(a) < fit(b); });
  FrameList frames(n, Eigen::Quaterniond(Matrix3d(label * frame)).cast<float>());
  ApplyBounds(level, frames);
  return frames;
}

//------------------------------------------------------------------------------
HarmonicFrames HarmonicCoordinateFrames(
  const std::vector<FrameLevel>& levels, int level, const Execution& execution)
{
  std::array<bool, 6> has = {};
  for (const FrameConstraint& constraint : levels.front().Constraints)
  {
    if (constraint.Side == AnyAxis)
    {
      throw std::invalid_argument("Harmonic coordinates need constraints with axes.");
    }
    has[constraint.Side] = true;
  }
  for (int side = 0; side < 6; ++side)
  {
    if (!has[side])
    {
      throw std::invalid_argument(std::string("No constraint is on the ") +
                                  (side % 2 ? "high" : "low") + " side of " + "uvw"[side / 2] +
                                  "; harmonic coordinates need both sides of each axis.");
    }
  }
  const Values<3> values = SolveUpTo<3>(levels, level,
    [&execution](const FrameLevel& here, Values<3>& x) { SmoothCoordinates(here, x, execution); });
  const FrameVoxels& voxels = levels[level].Voxels;
  HarmonicFrames result;
  result.Frames.resize(voxels.Count());
  result.LeftHanded = Sum(voxels.Count(), execution,
                        [&](Index v)
                        {
                          const Matrix3d gradients = GradientsAt(voxels, values, v);
                          result.Frames[v] =
                            Eigen::Quaterniond(ClosestRotation(gradients)).cast<float>();
                          return gradients.determinant() < 0.0 ? 1.0 : 0.0;
                        }) /
                      static_cast<double>(voxels.Count());
  ApplyBounds(levels[level], result.Frames);
  return result;
}

//------------------------------------------------------------------------------
FrameList LinearFrames(const std::vector<FrameLevel>& levels, int level, const Execution& execution)
{
  const bool labelled = levels.front().IsLabelled();
  const Values<9> values = SolveUpTo<9>(levels, level,
    [&execution, labelled](const FrameLevel& here, Values<9>& x)
    { labelled ? SmoothEntries(here, x, execution) : SmoothHarmonics(here, x, execution); });
  FrameList frames(values.size());
  execution.ParallelFor(static_cast<Index>(values.size()),
    [&](Index begin, Index end)
    {
      for (Index v = begin; v < end; ++v)
      {
        const Matrix3d frame =
          labelled ? ClosestRotation(AsMatrix(values[v])) : ClosestCross(values[v]);
        frames[v] = Eigen::Quaterniond(frame).cast<float>();
      }
    });
  ApplyBounds(levels[level], frames);
  return frames;
}
}
