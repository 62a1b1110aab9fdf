// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Analysis-suitable refinement: cells are bisected with a closure (see BisectionMesh.h).
 *
 * All weights are one, any two functions are dual-compatible, and therefore the functions are
 * linearly independent, sum to one and span every tricubic polynomial, and the spaces are nested.
 *
 * A mark (function, direction, knot) bisects the up to four cells at the function's axis that the
 * knot lies inside of; each cell at most once in a call of Refine, whatever the number of marks.
 * The level of a cell fixes the direction of its bisection, so a mark may have to be repeated,
 * twice at the most, until the function at that vertex has the knot. (Bisecting until it has it at
 * once was measured: a fit needs a tenth more control points for the same error.)
 */
#ifndef trivariate_AnalysisSuitableRule_h
#define trivariate_AnalysisSuitableRule_h

#include "BisectionMesh.h"
#include "RefinementRule.h"

namespace trivariate
{
class AnalysisSuitableRule : public RefinementRule
{
public:
  AnalysisSuitableRule(
    const GridIndex& rootCells, const std::array<int, 3>& depth, Closure closure);

  std::unique_ptr<RefinementRule> Clone() const override
  {
    return std::make_unique<AnalysisSuitableRule>(*this);
  }

  void Refine(TSpline& spline, const std::vector<RefinementMark>& marks) override
  {
    this->Bisect(spline, marks);
    this->Carry(spline);
  }

  /// Whether the spline's functions are those of the mesh.
  bool Matches(const TSpline& spline) const { return spline.Functions == this->Mesh.Functions(); }

  /// The two steps of Refine, between which cells may be bisected that no mark asks for.
  void Bisect(const TSpline& spline, const std::vector<RefinementMark>& marks);
  void Carry(TSpline& spline);

  const BisectionMesh& Cells() const { return this->Mesh; }

  /// Halves the cell that holds a unit cell (see BisectionMesh).
  bool Bisect(const GridIndex& unit) { return this->Mesh.Bisect(unit); }

private:
  void Check(const TSpline& spline, const std::vector<RefinementMark>& marks) const;
  void BisectAround(const BlendingFunction& f, int direction, std::int32_t knot);
  TSpline CarryFunctions(const TSpline& coarse, std::vector<Index>& changed);
  void Transfer(const TSpline& coarse, const std::vector<Index>& changed, TSpline& refined) const;

  BisectionMesh Mesh;
  std::vector<Index> Anchors;      // of the functions of the spline, in their order
  BisectionMesh::Node CoarseNodes; // of the mesh that the spline has
};

/**
 * As MakeAnalysisSuitableRule(tensorProduct), with the choice of the closure. `tensorProduct` must
 * come from MakeTensorProduct with strides that are powers of two (the cells that Refine bisects);
 * otherwise std::invalid_argument.
 *
 * Refine throws std::out_of_range for a mark whose function or knot does not exist and
 * std::invalid_argument for another spline than it was made for; neither changes anything. It takes
 * a few microseconds for each function plus some ten for each that is new or changed. Functions
 * that keep their knots keep their control points to the last bit.
 */
std::unique_ptr<AnalysisSuitableRule> MakeAnalysisSuitableRule(
  const TSpline& tensorProduct, Closure closure);
}

#endif
