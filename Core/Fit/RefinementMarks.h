// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// From the gains of all possible splits to a refined spline of a wanted size.
#ifndef trivariate_RefinementMarks_h
#define trivariate_RefinementMarks_h

#include "TSpline/RefinementRule.h"

#include <functional>
#include <memory>
#include <vector>

namespace trivariate
{
/// What inserting a knot into a blending function is expected to bring.
struct SplitGain
{
  Index Function;
  int Direction;
  std::int32_t Knot;
  double SquaredError; ///< by how much the sum of squared residuals would fall
};

class RefinementMarks
{
public:
  /// `count`: of the control points of a spline, which functions may share.
  explicit RefinementMarks(std::function<Index(const TSpline&)> count = [](const TSpline& spline)
                           { return spline.Size(); })
    : Count(std::move(count))
  {
  }

  /**
   * Marks the splits with the largest gains, as many as let the spline grow by a fixed share, and
   * refines by `rule`. Never exceeds `maximum` control points; tries with fewer marks instead (a
   * mark can bring several control points, how many is learnt from round to round). False when no
   * split is left or none fits, and then nothing is changed.
   */
  bool Refine(std::vector<SplitGain> gains, Index maximum, TSpline& spline,
    std::unique_ptr<RefinementRule>& rule);

  /// Whether so few control points are left to the maximum that a step for them is not worth its
  /// time.
  static bool IsFull(Index size, Index maximum);

private:
  std::function<Index(const TSpline&)> Count;
  double FunctionsPerMark = 1.0;
};
}

#endif
