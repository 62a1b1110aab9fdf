// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// A refinement rule that can do again what it has done.
#ifndef trivariate_RefinementHistory_h
#define trivariate_RefinementHistory_h

#include "TSpline/RefinementRule.h"

#include <memory>
#include <utility>
#include <vector>

namespace trivariate
{
class RefinementHistory : public RefinementRule
{
public:
  explicit RefinementHistory(std::unique_ptr<RefinementRule> rule)
    : Rule(std::move(rule))
  {
  }

  void Refine(TSpline& spline, const std::vector<RefinementMark>& marks) override
  {
    this->Rule->Refine(spline, marks);
    this->Steps.push_back(marks);
  }

  std::unique_ptr<RefinementRule> Clone() const override
  {
    auto clone = std::make_unique<RefinementHistory>(this->Rule->Clone());
    clone->Steps = this->Steps;
    return clone;
  }

  /// Refines a spline with the functions that this rule was made for, once more in the same way:
  /// the result has the functions that the rule has reached, in the same order. `first` is the rule
  /// as it was then.
  void Repeat(const RefinementRule& first, TSpline& spline) const
  {
    const std::unique_ptr<RefinementRule> rule = first.Clone();
    for (const std::vector<RefinementMark>& marks : this->Steps)
    {
      rule->Refine(spline, marks);
    }
  }

private:
  std::unique_ptr<RefinementRule> Rule;
  std::vector<std::vector<RefinementMark>> Steps;
};
}

#endif
