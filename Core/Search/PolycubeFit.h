// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// The boundary of a polycube laid over a surface like a sheet of rubber.
#ifndef trivariate_PolycubeFit_h
#define trivariate_PolycubeFit_h

#include "Domain/Polycube.h"
#include "Domain/TriangleTree.h"
#include "Execution.h"

#include <array>
#include <memory>

namespace trivariate
{
struct PolycubeFit
{
  std::vector<Eigen::Vector3d> Corners; ///< of the polycube: near the surface
  /// Area-weighted mean over the sheet of the symmetric stretch of its map from the polycube with
  /// the mean lengths of its slabs, (s^2 + t^2 + 1/s^2 + 1/t^2) / 4 - 1 for singular values s, t.
  double Stretch;
  /// Root of the mean square distance of the surface from the sheet, in the third root of the
  /// volume.
  double Distance;
};

/// The surface, ready to have polycubes laid over it whose axes are the rows of `frame`.
class PolycubeFitter
{
public:
  /// The mesh is not copied: it must outlive the fitter. O(n log n).
  PolycubeFitter(const SurfaceMesh& mesh, const Eigen::Matrix3d& frame);

  /**
   * `corners`: where the polycube's corners are at first, a lattice along the axes of the frame.
   * The sheet is drawn to where the surface faces the same way, as rigid as possible [Sorkine and
   * Alexa, "As-rigid-as-possible surface modeling", 2007] and less and less so. A fixed number of
   * nodes and rounds; O(log n).
   */
  PolycubeFit Fit(const Polycube& polycube, const std::vector<Eigen::Vector3d>& corners,
    const Execution& execution) const;

private:
  const SurfaceMesh& Mesh;
  Eigen::Matrix3d Frame;
  double Size; // third root of the volume
  std::vector<Index> Samples;
  std::array<std::vector<Triangle>, 6> Facing; // triangles that face a side: 2 axis + side
  std::array<std::unique_ptr<TriangleTree>, 6> Trees;
};
}

#endif
