// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// Corners to start from when they are picked by hand.
#ifndef CornerGuess_h
#define CornerGuess_h

#include "Search/FindDomain.h"

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace trivariate
{
class CornerGuess
{
public:
  CornerGuess(SurfaceMesh mesh, const DomainOptions& options)
    : Mesh(std::move(mesh))
    , Options(options)
  {
  }

  bool IsFor(const SurfaceMesh& mesh, const DomainOptions& options) const;

  /// What DomainOf finds, sought once. Throws its error, also every other time.
  const SegmentDomain& Automatic(const Execution& execution);
  void SetAutomatic(SegmentDomain domain);
  /// There is none, and why.
  void SetFailure(std::string why);

  /**
   * size[0] x size[1] x size[2] cubes without those switched off; all sizes zero: the automatic
   * shape. Throws std::invalid_argument as Polycube and for cubes that are not there.
   */
  Polycube Shape(
    const int size[3], const std::vector<int>& switchedOff, const Execution& execution);

  /**
   * Places on the surface for the corners of a shape: the automatic ones where the shape is the
   * automatic one; else the shape is spread over one cube's automatic corners, or the bounding box
   * where there are none, and moved to the surface.
   */
  std::vector<Eigen::Vector3d> Corners(const Polycube& shape, const Execution& execution);

  const SurfaceMesh Mesh;

private:
  using EightCorners = std::array<Eigen::Vector3d, 8>;

  // Of one cube, sought once.
  const EightCorners& OneCube(const Execution& execution);
  EightCorners FindOneCube(const Execution& execution);

  DomainOptions Options;
  std::unique_ptr<SegmentDomain> Found;
  std::string Failure; // empty: not sought, or found
  std::unique_ptr<EightCorners> FoundCube;
};
}

#endif
