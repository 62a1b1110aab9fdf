// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// Ways from the corners of a layout into the solid, away from the surface.
#ifndef trivariate_InnerPath_h
#define trivariate_InnerPath_h

#include "SurfaceLayout.h"

namespace trivariate
{
struct InnerPath
{
  std::vector<Eigen::Vector3d> Places;
  std::vector<double> Depths; ///< of each place: the distance to the surface, ascending from 0

  /// The largest depth.
  double Reach() const { return this->Depths.back(); }

  /// The first place of that depth or, where there is none, the deepest.
  Eigen::Vector3d At(double depth) const;
};

/// The spacing of the surface: the edge of an equilateral triangle of the mean area.
double MeanEdge(const SurfaceLayout& layout);

/// A unit vector against the normals within a radius of a corner, those of each label counted once.
Eigen::Vector3d InwardAt(const SurfaceLayout& layout, const Eigen::Vector3d& corner, double radius);

/**
 * One for each corner of the layout. It begins against the mean of the normals around the corner,
 * each direction of the domain counted once, and turns toward the growth of the distance to the
 * surface. It ends where the distance grows no more, or at `deepest`. edge: the surface's spacing,
 * of which steps are a fifth.
 */
std::vector<InnerPath> InnerPaths(
  const SurfaceLayout& layout, double edge, double deepest, const Execution& execution);
}

#endif
