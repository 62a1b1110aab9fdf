// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Where frames live: the voxels of a segment, what binds frames at its boundary, and both again on
 * coarser and coarser levels. Frames and normals are directions in space; how the grid lies in it,
 * its steps say.
 *
 * Memory: 32 bytes a voxel of the segment (its number in the grid and its six neighbours), 4 more
 * for its parent, an eighth of that for each coarser level; while it is built, 4 bytes a voxel of
 * the grid. With the frames themselves (16 bytes) a field takes 60 bytes a voxel in all, 1 GB for a
 * segment that fills 256^3 (63 measured, 0.96 s on one core to make the levels).
 */
#ifndef trivariate_FrameVoxels_h
#define trivariate_FrameVoxels_h

#include "Execution.h"
#include "FrameMatching.h"

#include <Eigen/Geometry>

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace trivariate
{
/// A frame as it is stored: frame = q.toRotationMatrix(). 16 bytes.
using FrameList = std::vector<Eigen::Quaternionf>;

/**
 * The voxels of a segment. Those with an even sum of grid coordinates ("red") come first: no two of
 * one colour are neighbours, so that all of one colour can change at once.
 */
struct FrameVoxels
{
  std::array<Index, 3> Size = { 0, 0, 0 }; ///< of the grid
  /// Column a: from a voxel to the next one along grid axis a, in space. At right angles.
  Eigen::Matrix3d Steps = Eigen::Matrix3d::Identity();
  Index Red = 0;          ///< how many of the voxels are red
  std::vector<Index> Ids; ///< i + Size[0] (j + Size[1] k), ascending in a colour
  /// At -x, +x, -y, +y, -z, +z; -1 outside the segment.
  std::vector<std::array<std::int32_t, 6>> Neighbours;

  Index Count() const { return static_cast<Index>(this->Ids.size()); }

  /// What a pair of neighbours along each grid axis counts: the face between them over their
  /// distance, both in units of the mean spacing; so sums over pairs are integrals in space.
  Eigen::Vector3d PairWeights() const
  {
    const double volume = std::abs(this->Steps.determinant());
    return std::pow(volume, 2.0 / 3.0) * this->Steps.colwise().squaredNorm().cwiseInverse();
  }

  /// Grid coordinates of a voxel.
  std::array<Index, 3> Place(Index voxel) const
  {
    const Index id = this->Ids[voxel];
    return { id % this->Size[0], id / this->Size[0] % this->Size[1],
      id / this->Size[0] / this->Size[1] };
  }
};

/// The voxels whose mask is not zero. At most 2^31 - 1 of them (std::length_error).
FrameVoxels CollectVoxels(const std::array<Index, 3>& size, const std::uint8_t* mask,
  const Execution& execution = Execution());

/// Any direction of the frame may be the one along the normal.
constexpr std::int8_t AnyAxis = -1;

/// At a voxel that touches the boundary a direction of the frame is along the normal.
struct FrameConstraint
{
  std::int32_t Voxel = 0;                    ///< place in the list of voxels
  std::array<float, 3> Normal = { 0, 0, 0 }; ///< unit, out of the segment
  /// AnyAxis, or 2 axis + side: the row `axis` is +normal at the high side (1), -normal at the low
  /// side (0), so that u, v, w grow from the low to the high side.
  std::int8_t Side = AnyAxis;
};

/**
 * What the constraints of one voxel come to. Normals of two axes more than 45 degrees apart fix the
 * frame (the rotation closest to both, so least squares). Normals of two axes that are closer than
 * that, as along the edges of a domain on a smooth surface, cannot both hold: the middle of the
 * axes is bound to the middle of the normals.
 */
struct FrameBound
{
  enum class Kind : std::uint8_t
  {
    Axis,    ///< frame * Normal = Axis
    AnyAxis, ///< one of the six directions of the frame is Normal
    Fixed    ///< the frame is Fixed
  };
  std::int32_t Voxel = 0;
  Kind What = Kind::Axis;
  Eigen::Vector3f Normal = Eigen::Vector3f::UnitX();
  Eigen::Vector3f Axis = Eigen::Vector3f::UnitX();
  Eigen::Quaternionf Fixed = Eigen::Quaternionf::Identity();

  /// The frame turned by the smallest angle that makes the constraint hold exactly.
  Eigen::Quaterniond Apply(const Eigen::Quaterniond& frame) const;
};

struct FrameLevel
{
  FrameVoxels Voxels;
  std::vector<FrameConstraint> Constraints; ///< ascending in the voxels
  std::vector<FrameBound> Bounds;           ///< one a constrained voxel, ascending
  std::vector<std::int32_t> Parents;        ///< of each voxel on the next level; empty on the last
  /// How many voxels along each grid axis make one of the next level: 2, or 1 along long steps.
  std::array<Index, 3> Factors = { 2, 2, 2 };

  /// No constraint leaves the axis open.
  bool IsLabelled() const;
};

/**
 * Levels from fine to coarse: eight voxels make one, as long as at least `coarsest` voxels are
 * left; where steps differ in length, fewer, until they are about equal. Two coarse voxels are
 * neighbours where fine ones of theirs are; normals with equal labels are averaged. The constraints
 * may come in any order; one that names no voxel or is not of unit length within 1e-3 throws
 * std::invalid_argument.
 */
std::vector<FrameLevel> MakeFrameLevels(FrameVoxels voxels,
  std::vector<FrameConstraint> constraints, Index coarsest = 300,
  const Execution& execution = Execution());

/**
 * The frames of a level from those of the next coarser one, made to fit the constraints: linear
 * between the middles of the coarse voxels; across jumps where constraints have no labels.
 */
FrameList Prolong(const FrameLevel& fine, const FrameLevel& coarse, const FrameList& frames,
  const Execution& execution);

/// Turns every bound frame onto its constraints.
void ApplyBounds(const FrameLevel& level, FrameList& frames);

/**
 * The largest angle, in degrees, between a constrained direction and its normal, over the voxels
 * whose constraints do not contradict each other.
 */
double AlignmentError(const FrameLevel& level, const FrameList& frames);
}

#endif
