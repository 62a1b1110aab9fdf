// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// Normals from triangles, and frames in grids of any spacing and direction.
#include "Field/FrameStart.h"
#include "Field/SegmentField.h"
#include "Field/SurfaceConstraints.h"
#include "FrameShapes.h"
#include "SegmentSurfaces.h"
#include "SegmentVolumes.h"

#include <gtest/gtest.h>

#include <map>

namespace trivariate
{
using Eigen::Matrix3d;

namespace
{
using trivariate_testing::Vector3d;

const Execution Alone;
constexpr double Degree = 57.29577951308232;

FrameVoxels VoxelsOf(const SegmentVolume& volume, int segment)
{
  std::vector<std::uint8_t> mask;
  for (const std::int32_t label : volume.Labels)
  {
    mask.push_back(label == segment ? 1 : 0);
  }
  return CollectVoxels(volume.Size, mask.data());
}

// The surface of one segment; side(centroid, normal) names the patch of a triangle.
template <typename Side>
std::vector<SurfaceTriangle> TrianglesOf(const SegmentVolume& volume, int segment, const Side& side)
{
  const SegmentBoundary boundary = ComputeSegmentBoundary(volume.View(), BoundaryOptions(), Alone);
  const SurfaceMesh surface = trivariate_testing::SurfaceOfSegment(boundary, segment);
  std::vector<SurfaceTriangle> triangles;
  for (const Triangle& t : surface.Triangles)
  {
    SurfaceTriangle triangle{ { surface.Points[t[0]], surface.Points[t[1]], surface.Points[t[2]] },
      AnyAxis };
    const auto& c = triangle.Corners;
    triangle.Side = side((c[0] + c[1] + c[2]) / 3.0, (c[1] - c[0]).cross(c[2] - c[0]).normalized());
    triangles.push_back(triangle);
  }
  return triangles;
}

std::int8_t SideOfNormal(const Vector3d&, const Vector3d& normal)
{
  int axis;
  normal.cwiseAbs().maxCoeff(&axis);
  return static_cast<std::int8_t>(2 * axis + (normal[axis] > 0.0 ? 1 : 0));
}

std::int8_t Open(const Vector3d&, const Vector3d&)
{
  return AnyAxis;
}

Vector3d AsVector(const std::array<float, 3>& normal)
{
  return Vector3d(normal[0], normal[1], normal[2]);
}
}

//------------------------------------------------------------------------------
TEST(SurfaceConstraints, ReachEveryVoxelAlongABall)
{
  const SegmentVolume volume = BallVolume({ 31, 31, 31 }, { 15.2, 14.9, 15.1 }, 11.0);
  const FrameVoxels voxels = VoxelsOf(volume, 1);
  for (const bool open : { true, false })
  {
    const SurfaceConstraints bound = ConstrainToSurface(
      voxels, open ? TrianglesOf(volume, 1, Open) : TrianglesOf(volume, 1, SideOfNormal), Alone);
    EXPECT_GT(bound.Along, 1000);
    EXPECT_EQ(bound.Bound, bound.Along);
    EXPECT_LT(bound.Astray, 1e-9);
    double square = 0.0;
    for (const FrameConstraint& constraint : bound.Constraints)
    {
      const std::array<Index, 3> p = voxels.Place(constraint.Voxel);
      const Vector3d outward = Vector3d(p[0] - 15.2, p[1] - 14.9, p[2] - 15.1).normalized();
      const double angle =
        Degree * std::acos(std::min(1.0, outward.dot(AsVector(constraint.Normal))));
      square += angle * angle;
      EXPECT_LT(angle, open ? 10.0 : 25.0); // at a border of patches the mean lies beside the voxel
    }
    const double count = static_cast<double>(bound.Constraints.size());
    EXPECT_LT(std::sqrt(square / count), open ? 4.0 : 6.0);
    EXPECT_LT(count, (open ? 1.01 : 1.3) * static_cast<double>(bound.Along));
  }
}

//------------------------------------------------------------------------------
// A voxel at an edge of a box has both normals, one at a corner three, and none of a neighbour's.
TEST(SurfaceConstraints, NameTheSidesOfABox)
{
  std::vector<std::uint8_t> mask(8 * 8 * 8, 0);
  for (Index id = 0; id < 512; ++id)
  {
    const Index i = id % 8, j = id / 8 % 8, k = id / 64;
    mask[id] = i > 0 && i < 7 && j > 1 && j < 6 && k > 1 && k < 5 ? 1 : 0;
  }
  const FrameVoxels voxels = CollectVoxels({ 8, 8, 8 }, mask.data());
  const Vector3d low(0.5, 1.5, 1.5), size(6.0, 4.0, 3.0);
  std::vector<SurfaceTriangle> open, named;
  for (int side = 0; side < 6; ++side)
  {
    const int a = side / 2, b = (a + 1) % 3, c = (a + 2) % 3;
    const Vector3d corner = low + (side % 2) * size[a] * Vector3d::Unit(a);
    const Vector3d u = size[b] * Vector3d::Unit(b), v = size[c] * Vector3d::Unit(c);
    SurfaceTriangle first{ { corner, corner + u, corner + u + v }, static_cast<std::int8_t>(side) };
    SurfaceTriangle second{ { corner, corner + u + v, corner + v }, first.Side };
    for (SurfaceTriangle* triangle : { &first, &second })
    {
      if (side % 2 == 0)
      {
        std::swap(triangle->Corners[1], triangle->Corners[2]);
      }
      named.push_back(*triangle);
      triangle->Side = AnyAxis;
      open.push_back(*triangle);
    }
  }
  for (const std::vector<SurfaceTriangle>& triangles : { named, open })
  {
    const SurfaceConstraints bound = ConstrainToSurface(voxels, triangles, Alone);
    EXPECT_EQ(bound.Bound, 6 * 4 * 3 - 4 * 2 * 1);
    EXPECT_EQ(bound.Along, bound.Bound);
    std::map<std::int32_t, int> faces, found;
    for (Index v = 0; v < voxels.Count(); ++v)
    {
      const auto& neighbours = voxels.Neighbours[v];
      faces[static_cast<std::int32_t>(v)] =
        static_cast<int>(std::count(neighbours.begin(), neighbours.end(), -1));
    }
    for (const FrameConstraint& constraint : bound.Constraints)
    {
      ++found[constraint.Voxel];
      const Vector3d normal = AsVector(constraint.Normal);
      const int side = SideOfNormal(normal, normal);
      EXPECT_GT(normal.cwiseAbs().maxCoeff(), 1.0 - 1e-6);
      EXPECT_EQ(constraint.Side, triangles[0].Side == AnyAxis ? AnyAxis : side);
      EXPECT_EQ(voxels.Neighbours[constraint.Voxel][side], -1);
    }
    for (const auto& [voxel, count] : found)
    {
      EXPECT_EQ(count, faces[voxel]);
    }
  }
}

//------------------------------------------------------------------------------
TEST(SurfaceConstraints, TellOfSurfacesElsewhere)
{
  const SegmentVolume volume = BallVolume({ 24, 24, 24 }, { 11.0, 11.0, 11.0 }, 7.0);
  const FrameVoxels voxels = VoxelsOf(volume, 1);
  std::vector<SurfaceTriangle> triangles = TrianglesOf(volume, 1, Open);
  for (const double away : { 5.0, 100.0, 1e12 })
  {
    std::vector<SurfaceTriangle> moved = triangles;
    for (SurfaceTriangle& triangle : moved)
    {
      triangle.Corners[0].x() += away;
      triangle.Corners[1].x() += away;
      triangle.Corners[2].x() += away > 1e6 ? 2.0 * away : away;
    }
    EXPECT_GT(ConstrainToSurface(voxels, moved, Alone).Astray, 0.5) << away;
  }
  EXPECT_EQ(ConstrainToSurface(voxels, {}, Alone).Bound, 0);
  Execution stopped;
  stopped.Continue = [](double) { return false; };
  EXPECT_THROW(ConstrainToSurface(voxels, triangles, stopped), Aborted);
}

//------------------------------------------------------------------------------
// The annulus again, of voxels that are not cubes, in a grid that is turned or mirrored in space:
// its frames are polar all the same, and its energy per volume is that of cubes.
TEST(SegmentField, FollowsSpacingAndDirection)
{
  const double inner = 11.0, outer = 30.0, height = 12.0;
  double reference = 0.0;
  for (const Vector3d& spacing :
    { Vector3d(1, 1, 1), Vector3d(1, 1, 3), Vector3d(0.5, 1, 2), Vector3d(2, 1, 0.7) })
  {
    for (const bool mirrored : { false, true })
    {
      Matrix3d turn =
        Eigen::AngleAxisd(0.7, Vector3d(1.0, -2.0, 0.5).normalized()).toRotationMatrix();
      if (mirrored)
      {
        turn.col(0) *= -1.0;
      }
      std::array<Index, 3> size;
      for (int a = 0; a < 3; ++a)
      {
        size[a] = 1 + static_cast<Index>((a == 2 ? height : outer) / spacing[a]);
      }
      // Cylinder coordinates of a voxel; the first voxels are half a spacing from the planes.
      const auto pointOf = [&](const std::array<Index, 3>& p) -> Vector3d
      { return spacing.cwiseProduct(Vector3d(p[0] + 0.5, p[1] + 0.5, p[2] + 0.5)); };
      const auto inside = [&](const Vector3d& x)
      {
        const double r = std::hypot(x[0], x[1]);
        return r > inner && r < outer && x[2] < height;
      };
      std::vector<std::uint8_t> mask;
      for (Index id = 0; id < size[0] * size[1] * size[2]; ++id)
      {
        mask.push_back(
          inside(pointOf({ id % size[0], id / size[0] % size[1], id / size[0] / size[1] })));
      }
      FrameVoxels voxels = CollectVoxels(size, mask.data());
      voxels.Steps = turn * spacing.asDiagonal();
      std::vector<FrameConstraint> constraints;
      for (Index v = 0; v < voxels.Count(); ++v)
      {
        const Vector3d x = pointOf(voxels.Place(v));
        for (int face = 0; face < 6; ++face)
        {
          if (voxels.Neighbours[v][face] >= 0)
          {
            continue;
          }
          const Vector3d beyond =
            x + (face % 2 ? 1.0 : -1.0) * spacing[face / 2] * Vector3d::Unit(face / 2);
          const double r = std::hypot(beyond[0], beyond[1]);
          // Radius u, angle v, height w; the angle grows to the left of the radius.
          const int side = beyond[2] < 0.0      ? 4
                           : beyond[2] > height ? 5
                           : beyond[1] < 0.0    ? 2
                           : beyond[0] < 0.0    ? 3
                           : r < inner          ? 0
                                                : 1;
          Vector3d normal = side / 2 == 2   ? Vector3d::UnitZ()
                            : side / 2 == 1 ? Vector3d(-x[1], x[0], 0.0)
                                            : Vector3d(x[0], x[1], 0.0);
          normal = (side % 2 ? 1.0 : -1.0) * (turn * normal.normalized());
          // A mirrored grid makes the labels left-handed, but for one axis turned.
          const std::int8_t named =
            static_cast<std::int8_t>(mirrored && side > 3 ? 9 - side : side);
          const Eigen::Vector3f n = normal.cast<float>();
          constraints.push_back({ static_cast<std::int32_t>(v), { n[0], n[1], n[2] }, named });
        }
      }
      if (mirrored)
      {
        std::vector<FrameConstraint> wrong = constraints;
        for (FrameConstraint& constraint : wrong)
        {
          constraint.Side ^= constraint.Side > 3 ? 1 : 0;
        }
        EXPECT_THROW(
          ComputeSegmentField(voxels, wrong, FieldOptions(), Alone), std::invalid_argument);
      }
      const SegmentField field = ComputeSegmentField(voxels, constraints, FieldOptions(), Alone);
      double largest = 0.0;
      for (Index v = 0; v < voxels.Count(); ++v)
      {
        const Vector3d x = pointOf(voxels.Place(v));
        const Vector3d u = turn * Vector3d(x[0], x[1], 0.0).normalized();
        const Vector3d w = (mirrored ? -1.0 : 1.0) * turn.col(2);
        const Matrix3d frame = field.Frames[v].cast<double>().toRotationMatrix();
        largest = std::max(largest, Degree * frame.row(0).transpose().cross(u).norm());
        largest = std::max(largest, Degree * (frame.row(2).transpose() - w).norm());
      }
      EXPECT_LT(largest, 1.0) << spacing.transpose();
      EXPECT_LT(field.Alignment, 0.01);
      EXPECT_TRUE(field.Graph.Edges.empty());
      // The sum times the mean spacing approximates an integral.
      const double energy =
        field.Records.back().Energy.Harmonic * std::cbrt(spacing[0] * spacing[1] * spacing[2]);
      reference = reference > 0.0 ? reference : energy;
      EXPECT_NEAR(energy / reference, 1.0, 0.15) << spacing.transpose();
    }
  }
}

//------------------------------------------------------------------------------
// All starts and steps come to the same frames where labels lead; a start that lacks labels says
// so.
TEST(SegmentField, TakesAnyStart)
{
  const FrameShape shape = HelicalBar(20, 1.2);
  const std::vector<FrameLevel> levels = LevelsOf(shape, true), open = LevelsOf(shape, false);
  FieldOptions options;
  const auto energy = [&]()
  {
    return ComputeSegmentField(levels[0].Voxels, levels[0].Constraints, options, Alone)
      .Records.back()
      .Energy.Harmonic;
  };
  const double reference = energy();
  for (const FieldStart start :
    { FieldStart::Linear, FieldStart::Constant, FieldStart::HarmonicCoordinates })
  {
    options.Start = start;
    EXPECT_NEAR(energy() / reference, 1.0, 5e-3);
  }
  options.CoarseToFine = false;
  EXPECT_NEAR(energy() / reference, 1.0, 5e-3);
  EXPECT_GT(
    FieldBytesPerVoxel(options), 10.0 * sizeof(double) + FieldBytesPerVoxel(FieldOptions()));
  EXPECT_THROW(ComputeSegmentField(open[0].Voxels, open[0].Constraints, options, Alone),
    std::invalid_argument);
}
}
