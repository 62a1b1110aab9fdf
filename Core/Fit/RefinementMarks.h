// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// From the gains of all possible splits to a refined spline of a wanted size.
#ifndef trivariate_RefinementMarks_h
#define trivariate_RefinementMarks_h

#include "GridFitSystem.h"
#include "TSpline/RefinementRule.h"

namespace trivariate
{
class RefinementMarks
{
public:
  /**
   * Marks the splits with the largest gains, as many as let the spline grow by a fixed share, and
   * refines by `rule`. Never exceeds `maximum` functions; tries with fewer marks instead (a mark
   * can bring several functions, how many is learnt from round to round). False when no split is
   * left or none fits, and then nothing is changed.
   */
  bool Refine(std::vector<SplitGain> gains, Index maximum, TSpline& spline,
    std::unique_ptr<RefinementRule>& rule);

  /// Whether so few functions are left to the maximum that a step for them is not worth its time.
  static bool IsFull(Index size, Index maximum);

private:
  double FunctionsPerMark = 1.0;
};
}

#endif
