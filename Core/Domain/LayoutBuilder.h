// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// Borders cut into a mesh, straightened, and the patches between them.
#ifndef trivariate_LayoutBuilder_h
#define trivariate_LayoutBuilder_h

#include "PathTracing.h"
#include "SurfaceLayout.h"

#include <set>

namespace trivariate
{
/// The number of a border in `Borders` is its mark in `Mesh`.
class LayoutBuilder
{
public:
  explicit LayoutBuilder(const SurfaceMesh& mesh)
    : Mesh(mesh)
    , Given(mesh.NumberOfTriangles())
  {
  }

  /// Whether there are many times as many triangles as borders in each other's way need: they wind
  /// around each other, each cutting what the others cut.
  bool IsShredded() const;

  /// Replaces stretches of all borders but the fixed ones, at most so long, by geodesics between
  /// the same points within the union of the patches on their two sides, in rounds; no further
  /// where that shreds the mesh.
  void Straighten(double stretch, const Execution& execution);

  /// Makes them locally shortest without looking farther around (TightenPath), in rounds.
  void Tighten(const Execution& execution);

  /// Fills the patches from both sides of all borders. Throws std::runtime_error naming a patch
  /// where borders do not separate it from another.
  SurfaceLayout Result() const;

  LayoutMesh Mesh;
  std::vector<Index> Corners; // points
  std::vector<ChartLabel> PatchLabels;
  std::vector<LayoutBorder> Borders; // all but their points, which marks in the mesh tell
  std::set<Index> Fixed;             // borders that stay where they are

private:
  const Index Given; // triangles
  std::vector<Index> PointsOf(Index border) const;
  template <typename Border>
  void InRounds(const Border& straighten, const Execution& execution);
  double StraightenBorder(Index border, double first, double stretch);
  double StraightenStretch(Index border, const std::vector<Index>& points);
  double TightenBorder(Index border);
};
}

#endif
