// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Refinement of a T-spline: a rule turns wishes into a refined spline that equals the coarse one.
 *
 * Knot lines are dyadic: an index with more trailing zero bits (relative to the root cells) belongs
 * to a coarser level, and a span is cut at its one index of the coarsest level (DyadicMiddle).
 */
#ifndef trivariate_RefinementRule_h
#define trivariate_RefinementRule_h

#include "TSpline.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace trivariate
{
/// A wish: blending function `Function` shall have a knot at index `Knot` in direction `Direction`.
struct RefinementMark
{
  Index Function;
  int Direction;
  std::int32_t Knot;
};

/// The index strictly inside (low, high) of the coarsest dyadic level; -1 if there is none.
inline std::int32_t DyadicMiddle(std::int32_t low, std::int32_t high)
{
  if (high - low < 2)
  {
    return -1;
  }
  // The highest bit in which low and high - 1 differ is the level of the wanted index.
  const std::int32_t last = high - 1;
  std::int32_t mask = low ^ last;
  std::int32_t bit = 1;
  while (mask >>= 1)
  {
    bit <<= 1;
  }
  return last & ~(bit - 1);
}

/// One way to refine. Holds the mesh that belongs to the spline it was made for.
class RefinementRule
{
public:
  virtual ~RefinementRule() = default;

  /**
   * Refines `spline` towards (at least) the marks, and transfers weights and all components of the
   * control points: the refined spline equals the given one to rounding. The compact rule meets a
   * mark at once, the analysis-suitable one when it has been repeated at most twice.
   * `spline` must be the one this object was made for or last returned.
   */
  virtual void Refine(TSpline& spline, const std::vector<RefinementMark>& marks) = 0;

  /// A copy with its mesh, to try a refinement and take it back.
  virtual std::unique_ptr<RefinementRule> Clone() const = 0;
};

/// Semi-standard T-splines by knot insertion (KnotInsertionRule.cpp).
std::unique_ptr<RefinementRule> MakeKnotInsertionRule(const TSpline& spline);

/// Analysis-suitable T-splines by bisection with a closure (AnalysisSuitableRule.cpp).
std::unique_ptr<RefinementRule> MakeAnalysisSuitableRule(const TSpline& tensorProduct);
}

#endif
