// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// What the shape of a fit over blocks is to reach.
#ifndef trivariate_ShapeTarget_h
#define trivariate_ShapeTarget_h

#include "BlockFit.h"
#include "Domain/TriangleTree.h"
#include "ScatteredSystem.h"

#include <map>
#include <memory>
#include <utility>
#include <vector>

namespace trivariate
{
/**
 * X, Y, Z at the samples of a shape. Those of the surface, on faces without a twin or with one in
 * another segment, count more than those inside. Where the shape tells its surface, it matters only
 * how far from it the spline is, not where on it: the samples slide along it (iterative closest
 * points with fixed parameters), which a spline can follow with far fewer functions.
 */
class ShapeTarget
{
public:
  /**
   * The spline is to lie `margin` outside of the outer surface, so that the voxels next to it are
   * inside. The arguments must outlive this object.
   */
  ShapeTarget(const BlockComplex& blocks, const ShapeSamples& shape, double margin);

  const ScatteredSamples& Samples() const { return this->Targets; }

  /// Whether there is a surface to slide on.
  bool Slides() const { return !this->Sheets.empty(); }

  /// Moves the samples of the surface to where it is nearest to the spline.
  void Slide(const TSpline& spline, const BezierMesh& mesh, const Execution& execution);

  /// Adds places that the surface is to reach at parameters on it.
  void Pull(const std::vector<double>& parameters, const std::vector<double>& places);
  /// Until Release samples of the surface count 1600 times those inside, so that it stays where it
  /// is.
  void Hold();
  void Release();

  /// How far the spline was from the surface at the samples on it when they slid last; without a
  /// surface NaN.
  ScatteredError Distance() const { return this->Distances; }

private:
  // The surface between two segments (-1: none), or of one, with a place on it for each sample.
  struct Sheet
  {
    std::vector<Triangle> Triangles;
    std::unique_ptr<TriangleTree> Tree;
    double Margin = 0.0;
  };
  using SheetKey = std::pair<int, int>;

  std::vector<SheetKey> SheetsAt(const BlockComplex& blocks, const double* parameter) const;
  void WeighSurface(float weight);
  Eigen::Vector3d NearestTarget(const Sheet& sheet, const Eigen::Vector3d& place) const;

  std::vector<Eigen::Vector3d> Points;
  std::map<SheetKey, Sheet> Sheets;
  std::vector<const Sheet*> SheetOf; // of each sample; null: inside, or where several sheets meet
  std::vector<Index> OnSurface;      // samples
  ScatteredSamples Targets;
  ScatteredError Distances;
};
}

#endif
