// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The parameters u, v, w of a segment, voxel by voxel: section 3 of the paper.
 *
 * Minimised is eq. (1) in the norm of eq. (8), one parameter at a time,
 *   E(u) = int (grad u - f)^T D (grad u - f),  D = I - (1 - epsilon) f f^T / |f|^2,
 * over the inside of the segment's surface, f the row of the frame that belongs to u. Unknown are
 * the values at the voxels of the segment and of a band of one voxel around it, and one value for
 * each lattice plane of the domain: all triangles and border lines of the surface on which the
 * polycube has the same coordinate along the axis. On them u is that value, whatever it is; the
 * lowest one is 0. So the lengths of the cubes come out, in units of the grid space. They are then
 * mapped to the lattice, each axis by a monotone, continuously differentiable function of one
 * variable.
 *
 * Grid space: index times spacing; the voxel (0, 0, 0) is at the origin.
 */
#ifndef trivariate_VoxelParameter_h
#define trivariate_VoxelParameter_h

#include "Domain/SurfaceMesh.h"
#include "Execution.h"

#include <Eigen/Geometry>

#include <functional>

namespace trivariate
{
/// Where the domain has the coordinate `Coordinate` along `Axis` (0, 1, 2 for u, v, w).
struct LatticePlane
{
  int Axis = 0;
  int Coordinate = 0;
};

/// The boundary of a segment, cut along the borders of its patches.
struct ParameterSurface
{
  std::vector<Eigen::Vector3d> Points; ///< in grid space
  std::vector<Triangle> Triangles;     ///< closed, anticlockwise seen from outside
  std::vector<LatticePlane> Planes;    ///< of each triangle: that of its patch

  /// Pieces of borders between patches of cubes that lie beside one another in the domain, and
  /// where their common coordinate is: how the cubes' common face goes on over the surface.
  std::vector<std::array<Index, 2>> Lines;
  std::vector<LatticePlane> LinePlanes;
};

/// A segment in its grid, and what the gradients there should be.
struct ParameterVoxels
{
  std::array<Index, 3> Size = { 0, 0, 0 };
  Eigen::Vector3d Spacing = Eigen::Vector3d::Ones();
  const std::uint8_t* Mask = nullptr; ///< of each voxel of the grid: 0 outside the segment
  /// For a voxel of the segment, i + Size[0] (j + Size[1] k): rows are the wanted gradients of u,
  /// v, w in grid space; unit vectors, where they come from a frame field. Called from any thread.
  std::function<Eigen::Matrix3d(Index)> FrameAt;
};

enum class ParameterGradient
{
  Trilinear, ///< of the eight voxels of a cell, at 2 x 2 x 2 integration points
  Polynomial ///< of a cubic polynomial over the 2-ring, at the voxels: eqs. (2) to (7)
};

struct ParameterOptions
{
  double Epsilon = 1.0; ///< of eq. (8), in (0, 1]: how much lengths along the own direction count
  ParameterGradient Gradient = ParameterGradient::Trilinear;
  /// How often the frames are replaced by the rotations closest to the gradients, and all is solved
  /// again.
  int Rounds = 0;
  double Tolerance = 1e-8; ///< of the linear systems: residual by right-hand side
};

/// How the linear system of one parameter was solved.
struct ParameterSolve
{
  int Iterations = 0;    ///< of conjugate gradients, the last round
  double Residual = 0.0; ///< relative, at the end
  /// |u - c| over the surface, between the voxels too, in grid space: the largest, and the root of
  /// the mean square. It is largest along borders in flat parts of the surface, where u would have
  /// to turn at once.
  double Deviation = 0.0, MeanDeviation = 0.0;
};

constexpr std::uint8_t KnownInSegment = 2; ///< see VoxelParameter::Known

/// Solved parameters: trilinear between the voxels of the segment and its band.
struct VoxelParameter
{
  std::array<Index, 3> Low = { 0, 0, 0 };  ///< voxel of the first value; may be -1
  std::array<Index, 3> Size = { 0, 0, 0 }; ///< of the box of values, x fastest
  Eigen::Vector3d Spacing = Eigen::Vector3d::Ones();
  std::vector<double> Values;      ///< u, v, w in lattice units, voxel by voxel; 0 where not known
  std::vector<std::uint8_t> Known; ///< KnownInSegment, 1: of the band, 0: not known

  /// Of each axis the coordinates of its lattice planes, ascending, and their solved values: their
  /// differences are the lengths of the cubes.
  std::array<std::vector<int>, 3> Coordinates;
  std::array<std::vector<double>, 3> Lengths;

  std::array<ParameterSolve, 3> Solves;

  /// The place of a voxel of the grid in Known, and thrice that in Values; -1 outside the box.
  Index At(const std::array<Index, 3>& voxel) const;

  /// (u, v, w) at a point of grid space, and d(u, v, w)/d(x, y, z) if wanted; false where one of
  /// the eight voxels around it is not known.
  bool Evaluate(const Eigen::Vector3d& point, Eigen::Vector3d& value,
    Eigen::Matrix3d* gradient = nullptr) const;
};

/// Cells of eight voxels of the segment, and how many of them are folded.
struct ParameterFolds
{
  Index Cells = 0, Folded = 0;
};

/**
 * Folded is a cell where det d(u, v, w)/d(x, y, z) does not have the sign of `orientation` at one
 * of its 2 x 2 x 2 integration points. O(n), the same whatever the number of threads.
 */
ParameterFolds CountFolds(
  const VoxelParameter& solved, double orientation, const Execution& execution);

/**
 * Solves for u, v and w, one after the other. Time: 20 to 81 iterations of conjugate gradients with
 * multigrid, whatever the size; with polynomial gradients 70 to 120. The result does not depend on
 * the number of threads.
 *
 * Throws std::invalid_argument where the mask is empty or in pieces, the surface is open or does
 * not bound the segment, an axis has fewer than two planes, a frame is zero or not finite, an
 * option is out of its range; std::runtime_error where planes come out in the wrong order, as with
 * left-handed frames or labels, or the solver does not converge.
 */
VoxelParameter SolveVoxelParameter(const ParameterVoxels& voxels, const ParameterSurface& surface,
  const ParameterOptions& options, const Execution& execution);
}

#endif
