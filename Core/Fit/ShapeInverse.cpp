// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ShapeInverse.h"

#include "TSpline/Evaluator.h"
#include "TSpline/InverseMap.h"

#include <Eigen/Dense>

#include <algorithm>
#include <limits>

namespace trivariate
{
namespace
{
// Gauss-Newton steps from p towards the point of the unit box whose image is nearest to `place`.
void ProjectIntoBox(const Evaluator& evaluator, const double* place, const LatticePoint& box,
  std::array<double, 3>& p)
{
  using Eigen::Matrix3d;
  using Eigen::Vector3d;
  Vector3d values;
  Eigen::Matrix<double, 3, 3, Eigen::RowMajor> jacobian;
  EvaluatorOutput output;
  output.Values = values.data();
  output.Gradients = jacobian.data();
  const auto residualAt = [&](const std::array<double, 3>& x)
  {
    evaluator.Evaluate(x.data(), output);
    return Vector3d(Eigen::Map<const Vector3d>(place) - values);
  };
  Vector3d residual = residualAt(p);
  double damping = 1e-3;
  for (int iteration = 0; iteration < 20; ++iteration)
  {
    const Matrix3d normal = jacobian.transpose() * jacobian;
    Matrix3d damped = normal;
    damped.diagonal() *= 1.0 + damping;
    Vector3d gradient = jacobian.transpose() * residual;
    for (int a = 0; a < 3; ++a)
    {
      // At an end of the box and on the way out of it: the direction is left out.
      if ((p[a] <= box[a] && gradient[a] < 0.0) || (p[a] >= box[a] + 1.0 && gradient[a] > 0.0))
      {
        gradient[a] = 0.0;
        damped.row(a).setZero();
        damped.col(a).setZero();
        damped(a, a) = 1.0;
      }
    }
    const Vector3d step = damped.ldlt().solve(gradient);
    std::array<double, 3> next;
    for (int a = 0; a < 3; ++a)
    {
      next[a] = std::clamp(p[a] + step[a], double(box[a]), box[a] + 1.0);
    }
    const Matrix3d before = jacobian;
    const Vector3d there = residualAt(next);
    const bool isNearer = there.squaredNorm() < residual.squaredNorm();
    damping *= isNearer ? 0.1 : 10.0;
    if (isNearer)
    {
      p = next;
      residual = there;
    }
    else
    {
      jacobian = before;
    }
  }
}

Index NearestSample(const std::vector<double>& samples, const double* place)
{
  Index nearest = 0;
  double least = std::numeric_limits<double>::max();
  for (std::size_t i = 0; i < samples.size() / 3; ++i)
  {
    const double* other = &samples[3 * i];
    const double x = other[0] - place[0], y = other[1] - place[1], z = other[2] - place[2];
    const double distance = x * x + y * y + z * z;
    if (distance < least)
    {
      least = distance;
      nearest = static_cast<Index>(i);
    }
  }
  return nearest;
}
}

//------------------------------------------------------------------------------
FoundParameters FindParametersOnShape(const TSpline& spline, const BezierMesh& mesh,
  const BlockComplex& blocks, const std::vector<double>& places, const std::vector<double>& starts,
  const ShapeSamples& samples, const Execution& execution)
{
  const InverseMap inverse(spline, mesh, execution);
  const Evaluator evaluator(spline, mesh, { 0, 1, 2 }, execution);
  const Index n = static_cast<Index>(places.size() / 3);
  FoundParameters result;
  result.Parameters.resize(3 * n);
  std::vector<std::uint8_t> found(n);
  inverse.Find(n, places.data(), result.Parameters.data(), found.data(), execution);
  std::vector<Index>& lost = result.Outside;
  for (Index i = 0; i < n; ++i)
  {
    if (!found[i])
    {
      lost.push_back(i);
    }
  }
  result.Inside = n - static_cast<Index>(lost.size());
  constexpr Index Batch = 1 << 12; // between two looks at the abort flag
  const Index count = static_cast<Index>(lost.size());
  for (Index first = 0; first < count; first += Batch)
  {
    execution.Check(static_cast<double>(first) / count);
    execution.ParallelFor(std::min(Batch, count - first),
      [&, first](Index begin, Index end)
      {
        for (Index k = first + begin; k < first + end; ++k)
        {
          const double* place = &places[3 * lost[k]];
          const double* start = starts.empty()
                                  ? &samples.Parameters[3 * NearestSample(samples.Places, place)]
                                  : &starts[3 * lost[k]];
          std::array<double, 3> p{ start[0], start[1], start[2] };
          ProjectIntoBox(evaluator, place, blocks.Origins[blocks.BlockAt(p)], p);
          std::copy(p.begin(), p.end(), &result.Parameters[3 * lost[k]]);
        }
      });
  }
  return result;
}
}
