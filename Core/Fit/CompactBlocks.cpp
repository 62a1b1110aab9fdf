// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Knot insertion over blocks: what a split leaves different on the two sides of a glued face is
// split too, until nothing is.
#include "BlockSpline.h"

namespace trivariate
{
namespace
{
class BlockRule : public RefinementRule
{
public:
  BlockRule(const BlockSpline& layout, std::unique_ptr<RefinementRule> inner)
    : Layout(&layout)
    , Inner(std::move(inner))
  {
  }

  std::unique_ptr<RefinementRule> Clone() const override
  {
    return std::make_unique<BlockRule>(*this->Layout, this->Inner->Clone());
  }

  void Refine(TSpline& spline, const std::vector<RefinementMark>& marks) override
  {
    std::vector<RefinementMark> wanted = marks;
    do
    {
      this->Inner->Refine(spline, wanted);
      wanted = this->Layout->CrossedTraces(spline);
    } while (!wanted.empty());
    this->Layout->MakePointsEqual(spline);
  }

private:
  const BlockSpline* Layout;
  std::unique_ptr<RefinementRule> Inner;
};
}

//------------------------------------------------------------------------------
std::unique_ptr<RefinementRule> MakeBlockRule(const BlockSpline& layout, const TSpline& coarsest)
{
  return std::make_unique<BlockRule>(layout, MakeKnotInsertionRule(coarsest));
}
}
