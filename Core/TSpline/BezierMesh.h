// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The Bezier cells of a T-spline: boxes in parameter space on which every blending function is one
 * tricubic polynomial.
 *
 * Each knot of a function is a face in parameter space that spans the function's support in the two
 * other directions; the cells are the regions between all those faces. The faces of a T-spline that
 * was refined by one of our rules always end on other faces, so the regions are boxes and the cells
 * are as few as can be. Of any other set of functions a region that is no box is cut further.
 * Regions in which no function is active are left out.
 *
 * Built from the knots alone: control points and weights may change without rebuilding. Cost: time
 * proportional to the number of unit boxes of the index grid (the product over the directions of
 * the number of knots in use) plus the number of pairs of a cell and an active function (64 to 100
 * a cell): 0.3 s for 50000 functions on a grid of 256^3. Memory: about 1 kB a cell.
 */
#ifndef trivariate_BezierMesh_h
#define trivariate_BezierMesh_h

#include "Execution.h"
#include "IndexBox.h"
#include "TSpline.h"

#include <array>
#include <cstdint>
#include <vector>

namespace trivariate
{
/// A run of ids in memory, for range-based for.
struct IdRange
{
  const std::int32_t* First;
  const std::int32_t* Last;

  const std::int32_t* begin() const { return this->First; }
  const std::int32_t* end() const { return this->Last; }
  Index size() const { return this->Last - this->First; }
};

class BezierMesh
{
public:
  /// Limits that keep a hostile spline from exhausting time or memory, generous for sane ones.
  static constexpr Index MaximumGrid = Index(1) << 31; ///< unit boxes of the index grid
  /// Cells, for that many functions: 64 for each of them or a million, whichever is more (1 to 4
  /// for each are usual).
  static Index MaximumCells(Index functions);
  /// Pairs of a cell and an active function: 4096 for each function or 2^24, whichever is more (64
  /// to 300 for each are usual).
  static Index MaximumPairs(Index functions);

  /**
   * `spline` must be valid (see Validate). Throws std::length_error with a sentence for the user
   * when a limit is exceeded, Aborted when stopped.
   */
  explicit BezierMesh(const TSpline& spline, const Execution& execution = {});

  /// Number of cells. They are numbered in ascending order of their intervals in w, then v, then u.
  Index Size() const { return static_cast<Index>(this->Boxes.size()); }

  /// The knots that bound the cell.
  const IndexBox& Box(Index cell) const { return this->Boxes[cell]; }

  /// The cell in parameter space: u low, u high, v low, v high, w low, w high.
  std::array<double, 6> Bounds(Index cell) const;

  /// How often the coarsest cell was halved to get this one: the sum over the directions of the
  /// logarithm to the base two of the ratio of their widths in knots, each rounded to the nearest.
  int Level(Index cell) const { return this->Levels[cell]; }

  /// The functions that do not vanish on the cell, each once, ascending by their univariate
  /// functions in w, then v, then u (see UnivariateOf).
  IdRange ActiveFunctions(Index cell) const
  {
    const std::int32_t* ids = this->Active.data();
    return { ids + this->ActiveOffsets[cell], ids + this->ActiveOffsets[cell + 1] };
  }

  /// The cell that holds a point of parameter space, -1 if there is none. Cells are closed at their
  /// low ends and open at their high ends, except where no cell follows.
  Index FindCell(double u, double v, double w) const;

  /// Index of the knot interval of direction a that holds x (half open, closed at the end of the
  /// line); -1 outside.
  std::int32_t FindSpan(int a, double x) const;

  const std::array<KnotLine, 3>& KnotLines() const { return this->Lines; }

  /**
   * The distinct local knot vectors of direction a, ascending, and for each function which of them
   * it has. Many functions share one: what belongs to it is computed once.
   */
  const std::vector<LocalKnots>& Univariate(int a) const { return this->UnivariateKnots[a]; }
  std::int32_t UnivariateOf(Index function, int a) const
  {
    return this->UnivariateIds[function][a];
  }

private:
  std::array<KnotLine, 3> Lines;
  std::vector<IndexBox> Boxes;
  std::vector<std::int32_t> Levels;
  std::vector<Index> ActiveOffsets;
  std::vector<std::int32_t> Active;
  std::array<std::vector<LocalKnots>, 3> UnivariateKnots;
  std::vector<std::array<std::int32_t, 3>> UnivariateIds;

  // For each direction: spans at equally spaced places, between which FindSpan bisects.
  struct SpanTable
  {
    double Origin, InverseStep;
    std::vector<std::int32_t> Spans;
  };
  std::array<SpanTable, 3> SpanTables;

  // A tree of blocks of the index grid, each halved twice in every direction: an entry of a block
  // is a cell (>= 0), Nothing, or the block below (-2 - its place in Tree). The root is the first
  // one and its entries are 4^(Depth - 1) knots wide.
  static constexpr std::int32_t Nothing = -1;
  static constexpr std::size_t MaximumBlocks = std::size_t(1) << 23;
  struct Block
  {
    std::array<std::int32_t, 64> Entries;
    std::uint64_t
      Ways; // bits of the entries that hold a cell's low corner or lead to a block below
  };
  std::vector<Block> Tree;
  int Depth = 1;

  std::int32_t CellOfSpans(const std::array<std::int32_t, 3>& span) const; // a cell or Nothing
  void BuildUnivariate(const TSpline& spline);
  void BuildSpanTables();
  void BuildLevels();
  void BuildTree(const Execution& execution);
  void BuildActive(const TSpline& spline, const Execution& execution);

  // The place of a block in the index grid: its low corner, and its depth (1: entries are unit
  // boxes).
  struct Place
  {
    std::array<Index, 3> Low;
    int Depth;
  };
  template <typename Visitor>
  void VisitEntries(
    const IndexBox& box, const Place& place, std::uint64_t entries, Visitor&& visit) const;
  std::int32_t AddBlock(); // returns what an entry holds that leads to the new block
  void InsertIntoTree(std::int32_t cell, std::size_t block, const Place& place);
  template <typename Visitor>
  void VisitCells(
    const IndexBox& box, std::size_t block, const Place& place, Visitor&& visit) const;
};
}

#endif
