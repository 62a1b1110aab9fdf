// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The data side of a gridded fit: moments of the samples and of the residual, errors, indicator.
 *
 * Unknowns are the homogeneous coefficients d_i = w_i p_i of one attribute: the fitted spline is
 * sum_i d_i B_i, because the weighted blending functions sum to one.
 */
#ifndef trivariate_GridFitSystem_h
#define trivariate_GridFitSystem_h

#include "Fit.h"
#include "FunctionTable.h"
#include "GramMatrix.h"
#include "RefinementMarks.h"

namespace trivariate
{
/// How far a fit is from its samples, in the samples' own unit.
struct FitError
{
  double Rms = 0.0;
  double Maximum = 0.0;
};

/// The residual of one attribute, as the fit sees it.
struct Residual
{
  Levels Level{ -1, -1, -1 }; ///< of the uniform basis
  Array3 Moments; ///< sums over the voxels of residual times the functions of that basis
  double SquaredSum =
    0.0; ///< of the residual over the voxels; relative accuracy 1e-16 of the samples'
};

class GridFitSystem
{
public:
  GridFitSystem(const GridSamples& samples, const Axes& axes, const Execution& execution);

  /// The spline's functions have changed.
  void Update(const TSpline& spline);

  const FunctionTable& Table() const { return this->Functions; }
  const VoxelMask& Mask() const { return this->Voxels; }
  Index NumberOfVoxels() const { return this->CountedVoxels; }

  /// Whether a voxel that counts lies in the support of function i or on its faces.
  bool HasVoxel(Index i) const;

  double Mean(int component) const { return this->Means[component]; }

  /// Largest minus smallest sample of an attribute; where they are equal their size, or one.
  double Range(int component) const { return this->Ranges[component]; }

  /// The coarsest level of the uniform basis that has all functions and all their splits.
  const Levels& WorkLevel() const { return this->Work; }

  /// Sums over the voxels of an attribute's samples times the functions of WorkLevel().
  const Array3& SampleMoments(int component);

  /// The residual of attribute `component` on WorkLevel().
  Residual ComputeResidual(int component, const std::vector<double>& d);

  /// Sums over the voxels of residual times B_i, one number a function: the negative gradient.
  std::vector<double> Gradient(const Residual& residual) const;

  /// Gains of all splits of all functions, times `factor`, added to `gains` (the first call makes
  /// them).
  void AddGains(const Residual& residual, double factor, std::vector<SplitGain>& gains) const;

  /// Error at the voxels.
  FitError Error(int component, const std::vector<double>& d) const;

private:
  Array3 Reconstruct(const std::vector<double>& d) const;
  double SumOfLayers(const std::function<double(Index begin, Index end)>& term) const;

  const GridSamples& Samples;
  const Axes& Grid;
  const Execution& Run;
  Levels Finest;
  std::shared_ptr<ArrayPool> Pool = std::make_shared<ArrayPool>();
  FunctionTable Functions;
  VoxelMask Voxels;
  Index CountedVoxels = 0;
  std::vector<double> Means, Ranges, SquaredSums;
  std::vector<Array3> FinestMoments; // of the samples, one for each attribute
  std::vector<Array3> WorkMoments;   // the same on WorkMomentsLevel
  Levels WorkMomentsLevel{ -1, -1, -1 };
  std::vector<LevelFunction> Expansions;
  std::vector<LevelGroup> Groups;
  Levels Work{ 0, 0, 0 };
};
}

#endif
