// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Adaptive least-squares fit of a T-spline to samples on a regular grid.
 *
 * Minimises sum over the voxels of |F(u, v, w) - sample|^2 over the spline's attributes, refines
 * where a further function would lower that sum the most, and repeats until the wanted error or the
 * allowed number of control points is reached.
 */
#ifndef trivariate_Fit_h
#define trivariate_Fit_h

#include "Execution.h"
#include "TSpline/TSpline.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace trivariate
{
/// Samples at the integer parameters (i, j, k), 0 <= i < Size[0] and so on; i runs fastest.
struct GridSamples
{
  std::array<Index, 3> Size;
  int Components = 1; ///< attributes, each fitted with the same blending functions
  const double* Values =
    nullptr; ///< Components blocks, each of Size[0] * Size[1] * Size[2] numbers
  const std::uint8_t* Mask = nullptr; ///< voxels that count are non-zero; all count without a mask

  Index Count() const { return this->Size[0] * this->Size[1] * this->Size[2]; }
};

enum class Refinement
{
  Compact,          ///< split by knot insertion, anisotropic, fewest control points
  AnalysisSuitable, ///< bisection with closure: dual-compatible, all weights one
  Uniform,          ///< no refinement: one tensor-product fit with about the wanted control points
};

struct FitOptions
{
  Refinement Rule = Refinement::Compact;
  Index MaximumControlPoints = 50000; ///< hard limit, >= 64
  /// Wanted root mean square and maximum error, as shares of each attribute's range; 0 = no limit.
  double RmsTolerance = 0.0;
  double MaximumErrorTolerance = 0.0;
  /**
   * Find and remove linear dependences that knot insertion left (RepairLinearDependence), so that
   * the functions are a basis, as analysis needs it. The fit itself does not need it; the search
   * takes about a tenth of the fit's time. The functions of the other rules are independent as they
   * are.
   */
  bool Independent = true;
};

/// What one round of solve and refine reached; errors as shares of the range, the worst attribute.
struct FitRound
{
  Index ControlPoints;
  double Rms;
  double MaximumError;
  double Seconds; ///< since the start of the fit
};

struct FitResult
{
  /// Components: X, Y, Z (the parameter itself), then the attributes in the samples' own values.
  /// Under a mask without the functions that have no voxel in their support: whole between voxels
  /// that count, open elsewhere.
  TSpline Spline;
  std::vector<FitRound> Rounds; ///< the last one belongs to Spline
  std::array<int, 3>
    RootCells; ///< cells of the coarsest mesh; each halved as often as the lines allow
  /// Seconds spent, by topic ("evaluate", "refine", "assemble", "solve", ...).
  std::vector<std::pair<std::string, double>> Seconds;
};

/**
 * Throws std::invalid_argument (sizes below 2, empty mask, non-finite sample, a limit out of range)
 * with a sentence for the user, Aborted when stopped. The result is the same for any threads.
 */
FitResult FitGrid(
  const GridSamples& samples, const FitOptions& options, const Execution& execution = {});
}

#endif
