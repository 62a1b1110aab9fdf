// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "FrameVoxels.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace trivariate
{
using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using Eigen::Vector3f;

namespace
{
constexpr double Pi = 3.14159265358979323846;

Vector3d NormalOf(const FrameConstraint& constraint)
{
  return Eigen::Map<const Vector3f>(constraint.Normal.data()).cast<double>();
}

// The direction of the frame, in its own coordinates, that a constraint binds to the normal.
Vector3d BoundAxis(const FrameConstraint& constraint)
{
  return (constraint.Side % 2 == 1 ? 1.0 : -1.0) * Vector3d::Unit(constraint.Side / 2);
}

// The one of the six directions of a frame that is closest, in its own coordinates.
Vector3d NearestAxis(const Vector3d& direction)
{
  int row;
  direction.cwiseAbs().maxCoeff(&row);
  return (direction[row] > 0.0 ? 1.0 : -1.0) * Vector3d::Unit(row);
}

// Normals of open axes at one voxel belong to the axes of the frame built of those before them.
std::vector<FrameConstraint> NameOpenAxes(std::vector<FrameConstraint> constraints)
{
  std::vector<Vector3d> axes;
  for (FrameConstraint& constraint : constraints)
  {
    const Vector3d normal = NormalOf(constraint);
    std::size_t axis = 0;
    while (axis < axes.size() && std::abs(axes[axis].dot(normal)) < std::sqrt(0.5))
    {
      ++axis;
    }
    if (axis == 3)
    {
      continue;
    }
    if (axis == axes.size())
    {
      Vector3d fresh = normal;
      for (const Vector3d& other : axes)
      {
        fresh -= other.dot(fresh) * other;
      }
      axes.push_back(fresh.normalized());
      if (axis == 2 && axes[0].cross(axes[1]).dot(axes[2]) < 0.0)
      {
        axes[2] = -axes[2];
      }
    }
    constraint.Side = static_cast<std::int8_t>(2 * axis + (axes[axis].dot(normal) > 0.0 ? 1 : 0));
  }
  return constraints;
}

FrameBound Resolve(std::vector<FrameConstraint> constraints)
{
  FrameBound bound;
  bound.Voxel = constraints.front().Voxel;
  const bool open = std::any_of(constraints.begin(), constraints.end(),
    [](const FrameConstraint& c) { return c.Side == AnyAxis; });
  if (open)
  {
    constraints = NameOpenAxes(std::move(constraints));
  }
  Matrix3d sum = Matrix3d::Zero();
  for (const FrameConstraint& constraint : constraints)
  {
    if (constraint.Side != AnyAxis)
    {
      sum += BoundAxis(constraint) * NormalOf(constraint).transpose();
    }
  }
  const Eigen::JacobiSVD<Matrix3d> svd(sum, Eigen::ComputeFullU | Eigen::ComputeFullV);
  // The singular values of two unit normals with an angle t are as 1 to tan(t / 2).
  if (svd.singularValues()[1] > std::tan(Pi / 8) * svd.singularValues()[0])
  {
    Matrix3d u = svd.matrixU();
    if ((u * svd.matrixV().transpose()).determinant() < 0.0)
    {
      u.col(2) = -u.col(2);
    }
    bound.What = FrameBound::Kind::Fixed;
    bound.Fixed = Quaterniond(Matrix3d(u * svd.matrixV().transpose())).cast<float>();
    return bound;
  }
  bound.What = open ? FrameBound::Kind::AnyAxis : FrameBound::Kind::Axis;
  bound.Normal = svd.matrixV().col(0).cast<float>();
  bound.Axis = svd.matrixU().col(0).cast<float>();
  return bound;
}

// Groups of equal voxels in a sorted list.
template <typename Body>
void ForEachVoxel(const std::vector<FrameConstraint>& constraints, const Body& body)
{
  for (std::size_t begin = 0, end = 0; begin < constraints.size(); begin = end)
  {
    while (end < constraints.size() && constraints[end].Voxel == constraints[begin].Voxel)
    {
      ++end;
    }
    body(std::vector<FrameConstraint>(constraints.begin() + begin, constraints.begin() + end));
  }
}

void SetConstraints(FrameLevel& level, std::vector<FrameConstraint> constraints)
{
  std::stable_sort(constraints.begin(), constraints.end(),
    [](const FrameConstraint& a, const FrameConstraint& b) { return a.Voxel < b.Voxel; });
  level.Constraints = std::move(constraints);
  level.Bounds.clear();
  ForEachVoxel(level.Constraints, [&level](std::vector<FrameConstraint> group)
    { level.Bounds.push_back(Resolve(std::move(group))); });
}

// One constraint for all that have the same label, and for open ones less than 45 degrees apart.
std::vector<FrameConstraint> Average(const std::vector<FrameConstraint>& group)
{
  std::vector<FrameConstraint> merged;
  std::vector<Vector3d> sums;
  for (const FrameConstraint& constraint : group)
  {
    const Vector3d normal = NormalOf(constraint);
    std::size_t i = 0;
    while (i < merged.size() &&
           (merged[i].Side != constraint.Side ||
             (constraint.Side == AnyAxis && sums[i].normalized().dot(normal) < std::sqrt(0.5))))
    {
      ++i;
    }
    if (i == merged.size())
    {
      merged.push_back(constraint);
      sums.push_back(Vector3d::Zero());
    }
    sums[i] += normal;
  }
  std::vector<FrameConstraint> result;
  for (std::size_t i = 0; i < merged.size(); ++i)
  {
    // Normals of a thin sheet's two sides can cancel: then nothing is bound.
    if (sums[i].norm() > 1e-3)
    {
      Eigen::Map<Vector3f>(merged[i].Normal.data()) = sums[i].normalized().cast<float>();
      result.push_back(merged[i]);
    }
  }
  return result;
}

FrameLevel Coarsen(FrameLevel& fine, const Execution& execution)
{
  const FrameVoxels& voxels = fine.Voxels;
  FrameLevel coarse;
  std::array<Index, 3> size;
  std::array<Index, 3>& factors = fine.Factors;
  const Vector3d lengths = voxels.Steps.colwise().norm();
  Matrix3d steps = voxels.Steps;
  for (int a = 0; a < 3; ++a)
  {
    factors[a] = lengths[a] < 1.5 * lengths.minCoeff() ? 2 : 1;
    size[a] = (voxels.Size[a] + factors[a] - 1) / factors[a];
    steps.col(a) *= static_cast<double>(factors[a]);
  }
  const auto cellOf = [&voxels, &size, &factors](Index voxel)
  {
    const std::array<Index, 3> p = voxels.Place(voxel);
    return p[0] / factors[0] + size[0] * (p[1] / factors[1] + size[1] * (p[2] / factors[2]));
  };
  std::vector<std::uint8_t> mask(size[0] * size[1] * size[2], 0);
  for (Index v = 0; v < voxels.Count(); ++v)
  {
    mask[cellOf(v)] = 1;
  }
  coarse.Voxels = CollectVoxels(size, mask.data(), execution);
  coarse.Voxels.Steps = steps;
  std::vector<std::int32_t> places(mask.size(), -1);
  for (Index c = 0; c < coarse.Voxels.Count(); ++c)
  {
    places[coarse.Voxels.Ids[c]] = static_cast<std::int32_t>(c);
    coarse.Voxels.Neighbours[c].fill(-1);
  }
  fine.Parents.resize(voxels.Count());
  for (Index v = 0; v < voxels.Count(); ++v)
  {
    fine.Parents[v] = places[cellOf(v)];
  }
  execution.Check(1.0);
  for (Index v = 0; v < voxels.Count(); ++v)
  {
    for (int side = 0; side < 6; ++side)
    {
      const std::int32_t n = voxels.Neighbours[v][side];
      if (n >= 0 && fine.Parents[n] != fine.Parents[v])
      {
        coarse.Voxels.Neighbours[fine.Parents[v]][side] = fine.Parents[n];
      }
    }
  }
  execution.Check(1.0);
  std::vector<FrameConstraint> lifted = fine.Constraints, averaged;
  for (FrameConstraint& constraint : lifted)
  {
    constraint.Voxel = fine.Parents[constraint.Voxel];
  }
  std::stable_sort(lifted.begin(), lifted.end(),
    [](const FrameConstraint& a, const FrameConstraint& b) { return a.Voxel < b.Voxel; });
  ForEachVoxel(lifted,
    [&averaged](const std::vector<FrameConstraint>& group)
    {
      const std::vector<FrameConstraint> means = Average(group);
      averaged.insert(averaged.end(), means.begin(), means.end());
    });
  SetConstraints(coarse, std::move(averaged));
  return coarse;
}
}

//------------------------------------------------------------------------------
FrameVoxels CollectVoxels(
  const std::array<Index, 3>& size, const std::uint8_t* mask, const Execution& execution)
{
  FrameVoxels voxels;
  voxels.Size = size;
  const Index n = size[0] * size[1] * size[2];
  const Index count = n - std::count(mask, mask + n, std::uint8_t{ 0 });
  if (count > std::numeric_limits<std::int32_t>::max())
  {
    throw std::length_error("The segment has " + std::to_string(count) +
                            " voxels; a frame field can have 2147483647. Take a smaller region.");
  }
  voxels.Ids.reserve(count);
  std::vector<std::int32_t> places(n, -1);
  for (int colour = 0; colour < 2; ++colour)
  {
    Index id = 0;
    for (Index k = 0; k < size[2]; ++k)
    {
      execution.Check(0.4 * colour + 0.4 * static_cast<double>(k) / static_cast<double>(size[2]));
      for (Index j = 0; j < size[1]; ++j)
      {
        for (Index i = 0; i < size[0]; ++i, ++id)
        {
          if (mask[id] && (i + j + k) % 2 == colour)
          {
            places[id] = static_cast<std::int32_t>(voxels.Ids.size());
            voxels.Ids.push_back(id);
          }
        }
      }
    }
    if (colour == 0)
    {
      voxels.Red = voxels.Count();
    }
  }
  const std::array<Index, 3> stride = { 1, size[0], size[0] * size[1] };
  execution.Check(0.8);
  voxels.Neighbours.resize(voxels.Ids.size());
  for (Index v = 0; v < voxels.Count(); ++v)
  {
    const std::array<Index, 3> place = voxels.Place(v);
    for (int a = 0; a < 3; ++a)
    {
      const Index id = voxels.Ids[v];
      voxels.Neighbours[v][2 * a] = place[a] > 0 ? places[id - stride[a]] : -1;
      voxels.Neighbours[v][2 * a + 1] = place[a] + 1 < size[a] ? places[id + stride[a]] : -1;
    }
  }
  return voxels;
}

//------------------------------------------------------------------------------
Quaterniond FrameBound::Apply(const Quaterniond& frame) const
{
  if (this->What == Kind::Fixed)
  {
    return this->Fixed.cast<double>();
  }
  const Vector3d there = frame * this->Normal.cast<double>();
  Vector3d axis = this->Axis.cast<double>();
  if (this->What == Kind::AnyAxis)
  {
    axis = NearestAxis(there);
  }
  return (Quaterniond::FromTwoVectors(there, axis) * frame).normalized();
}

//------------------------------------------------------------------------------
bool FrameLevel::IsLabelled() const
{
  return std::none_of(this->Constraints.begin(), this->Constraints.end(),
    [](const FrameConstraint& c) { return c.Side == AnyAxis; });
}

//------------------------------------------------------------------------------
std::vector<FrameLevel> MakeFrameLevels(FrameVoxels voxels,
  std::vector<FrameConstraint> constraints, Index coarsest, const Execution& execution)
{
  for (const FrameConstraint& constraint : constraints)
  {
    const double length = NormalOf(constraint).norm();
    if (constraint.Voxel < 0 || constraint.Voxel >= voxels.Count())
    {
      throw std::invalid_argument("A constraint is on voxel " + std::to_string(constraint.Voxel) +
                                  " of " + std::to_string(voxels.Count()) + ".");
    }
    if (!(std::abs(length - 1.0) < 1e-3) || constraint.Side < AnyAxis || constraint.Side > 5)
    {
      throw std::invalid_argument("The constraint on voxel " + std::to_string(constraint.Voxel) +
                                  " has a normal of length " + std::to_string(length) +
                                  " and the side " + std::to_string(constraint.Side) +
                                  "; length 1 and a side from -1 to 5 are needed.");
    }
  }
  std::vector<FrameLevel> levels(1);
  levels[0].Voxels = std::move(voxels);
  SetConstraints(levels[0], std::move(constraints));
  for (double rest = 1.0;; rest *= 0.125)
  {
    FrameLevel coarse = Coarsen(levels.back(), execution.Part(1.0 - rest, 1.0 - 0.125 * rest));
    if (coarse.Voxels.Count() < coarsest)
    {
      levels.back().Parents.clear();
      return levels;
    }
    levels.push_back(std::move(coarse));
  }
}

//------------------------------------------------------------------------------
FrameList Prolong(const FrameLevel& fine, const FrameLevel& coarse, const FrameList& frames,
  const Execution& execution)
{
  const bool jumps = !fine.IsLabelled();
  FrameList result(fine.Voxels.Count());
  execution.ParallelFor(fine.Voxels.Count(),
    [&](Index begin, Index end)
    {
      for (Index v = begin; v < end; ++v)
      {
        const std::array<Index, 3> place = fine.Voxels.Place(v);
        const std::int32_t parent = fine.Parents[v];
        const Matrix3d own = frames[parent].cast<double>().toRotationMatrix();
        Eigen::Vector4d sum = frames[parent].coeffs().cast<double>();
        for (int a = 0; a < 3; ++a)
        {
          const std::int32_t next = coarse.Voxels.Neighbours[parent][2 * a + place[a] % 2];
          if (next < 0 || fine.Factors[a] == 1)
          {
            continue;
          }
          Quaterniond other = frames[next].cast<double>();
          if (jumps)
          {
            const Matrix3d there = other.toRotationMatrix();
            other = Quaterniond(CubeRotations()[MatchFrames(there, own)] * there);
          }
          const Eigen::Vector4d to = frames[parent].coeffs().cast<double>();
          sum += 0.25 * ((to.dot(other.coeffs()) < 0.0 ? -1.0 : 1.0) * other.coeffs() - to);
        }
        result[v] = Quaterniond(sum).normalized().cast<float>();
      }
    });
  ApplyBounds(fine, result);
  return result;
}

//------------------------------------------------------------------------------
void ApplyBounds(const FrameLevel& level, FrameList& frames)
{
  for (const FrameBound& bound : level.Bounds)
  {
    Eigen::Quaternionf& frame = frames[bound.Voxel];
    frame = bound.Apply(frame.cast<double>()).cast<float>();
  }
}

//------------------------------------------------------------------------------
double AlignmentError(const FrameLevel& level, const FrameList& frames)
{
  double largest = 0.0;
  ForEachVoxel(level.Constraints,
    [&frames, &largest](const std::vector<FrameConstraint>& group)
    {
      if (group.size() > 1)
      {
        return;
      }
      const FrameConstraint& c = group.front();
      const Vector3d there = frames[c.Voxel].cast<double>() * NormalOf(c);
      const Vector3d axis = c.Side == AnyAxis ? NearestAxis(there) : BoundAxis(c);
      const double rest = std::atan2(there.cross(axis).norm(), there.dot(axis));
      largest = std::max(largest, rest * 180.0 / Pi);
    });
  return largest;
}
}
