// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * One T-spline over the blocks of a domain.
 *
 * The knot lines cover the parameter space of a BlockComplex; every unit box has 2^Depth intervals.
 * Inside a group there are ordinary blending functions, clamped at the ends of its box, so groups
 * do not touch each other. Where the blocks do not fill that box the rest is a hole of the spline,
 * and functions without support in a block are dropped; others reach into the hole, so there the
 * surface lies where it is by fitting, not by clamping. On a face only functions with a knot four
 * times there are not zero, and what they are there, their trace, is a function of the two knot
 * vectors along the face. Functions with one trace on the two sides of a glued face share one
 * control point: then both sides agree on the face exactly, and so do all blocks around an edge or
 * a corner. Between two segments they share its place only, so that there is no gap, but attributes
 * jump as the values of the voxels do.
 */
#ifndef trivariate_BlockSpline_h
#define trivariate_BlockSpline_h

#include "Domain/BlockComplex.h"
#include "TSpline/RefinementRule.h"

#include <memory>
#include <vector>

namespace trivariate
{
/// Which functions have one control point together.
struct SharedPoints
{
  std::vector<Index> PointOf; ///< of each function
  std::vector<Index> FirstOf; ///< of each point, the first function that has it
  Index Count() const { return static_cast<Index>(this->FirstOf.size()); }
};

/// What of a control point functions share across the faces of blocks.
enum class Sharing
{
  Places,    ///< X, Y, Z, across all glued faces
  Attributes ///< those too, across faces inside of a segment
};

class BlockSpline
{
public:
  /// `complex` must outlive this object. 0 <= depth <= 16.
  BlockSpline(const BlockComplex& complex, int depth);

  const BlockComplex& Blocks() const { return *this->Complex; }
  int Depth() const { return this->Levels; }

  /// The spline with `cells` (a power of two, at most 2^depth) cells along each edge of a block;
  /// weights one, control points zero.
  TSpline MakeCoarsest(int cells, int attributes) const;

  /// The part of it in the box of a group (see BlockComplex::GroupBoxes), with knots counted from
  /// the box's low end; X, Y, Z are (u, v, w), and there are no attributes.
  TSpline MakeCoarsestGroup(const std::pair<LatticePoint, LatticePoint>& box, int cells) const;

  /// A block in the support of a function: its only one, or one of its group.
  Index BlockOf(const BlendingFunction& f) const;

  /// Points are numbered by their first functions. O(n).
  SharedPoints Share(const TSpline& spline, Sharing what) const;

  /// Gives functions the weight and what they share of the control point of the first of them.
  void MakePointsEqual(TSpline& spline) const;

  /// A way to split a function: in the middle of one of the four spans of its knots in a direction.
  static Index SplitNumber(Index function, int direction, int span)
  {
    return 12 * function + 4 * direction + span;
  }

  /// Splits along a common face are made on both sides: of each split (SplitNumber) the first of
  /// those that are made together; or, of Attributes, that add to the same unknown.
  std::vector<Index> LinkSplits(const TSpline& spline, Sharing what) const;

  /// The segment of the block of each function.
  std::vector<int> SegmentsOf(const TSpline& spline) const;

  /// Splits that functions need because knots of other traces on the same face cross theirs. As
  /// long as there are some, the traces on the two sides need not be the same. O(n 2^Depth).
  std::vector<RefinementMark> CrossedTraces(const TSpline& spline) const;

private:
  // The knots of a trace along a glued face as the face with the smaller number of the two sees
  // them, counted from its corner; Face < 0: the function has none there.
  struct Trace
  {
    Index Face = -1;
    std::array<LocalKnots, 2> Knots;
  };
  Trace TraceOf(const BlendingFunction& f, Index block, int axis, int side) const;
  std::pair<int, bool> AlongTrace(const BlockFace& face, Index traceFace, int d) const;
  RefinementMark ToMark(
    Index function, const BlockFace& face, Index traceFace, int d, std::int32_t knot) const;
  void AddHoles(
    const std::pair<LatticePoint, LatticePoint>& box, std::vector<IndexBox>& holes) const;
  bool IsShared(const BlockFace& face, Sharing what) const;
  template <typename Visit>
  void VisitTraces(const TSpline& spline, Sharing what, const Visit& visit) const;

  const BlockComplex* Complex;
  int Levels;
  std::int32_t One; // knots along the edge of a block
  LatticePoint Size;
  std::vector<Index> BlockOfBox; // of every unit box, u fastest; -1: none
};

/**
 * The rule of MakeKnotInsertionRule, with further splits until the traces on the two sides of every
 * glued face are the same. Weights and what functions share of control points then agree to
 * rounding, and are made equal. `layout` must outlive the rule.
 */
std::unique_ptr<RefinementRule> MakeBlockRule(const BlockSpline& layout, const TSpline& coarsest);

/**
 * The rule of MakeAnalysisSuitableRule in each group, for the spline of MakeCoarsest with so many
 * cells, with further bisections until the meshes on the two sides of every glued face are the
 * same. Weights are one, and functions are dual-compatible and independent in each group. `layout`
 * must outlive the rule.
 */
std::unique_ptr<RefinementRule> MakeAnalysisSuitableBlockRule(const BlockSpline& layout, int cells);
}

#endif
