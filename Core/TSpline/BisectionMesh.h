// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The T-mesh of an analysis-suitable T-spline: root cells, halved again and again.
 *
 * A cell of level k is halved in direction k mod 3; a direction that has no room left (a cell one
 * index wide cannot be halved) is passed over, so the level alone says how wide a cell is. Before a
 * cell of level k is halved, every cell of a lower level near it is: that closure keeps any two
 * blending functions dual-compatible.
 *
 * Blending functions sit on the mesh's vertices, those of the boundary on two layers in each
 * direction that ends there (which makes the functions clamped). Their local knots are the indices
 * at which the lines through the vertex cross or touch a face of the mesh.
 *
 * Reference: P. Morgenstern. Globally structured three-dimensional analysis-suitable T-splines:
 * definition, linear independence and m-graded local refinement. SIAM J. Numer. Anal. 54, 2016.
 */
#ifndef trivariate_BisectionMesh_h
#define trivariate_BisectionMesh_h

#include "IndexBox.h"
#include "TSpline.h"

#include <functional>
#include <unordered_set>

namespace trivariate
{
/**
 * How far around a cell the mesh must be as fine as the cell before that is halved.
 *
 * Narrow: the cells whose midpoint is at most 1.5 cell widths away in the direction that is halved
 * and 2.5 in the two others. The two-dimensional rule carried over, and the narrowest one that kept
 * thousands of random meshes dual-compatible; not proven in three dimensions.
 * Published: the cells of which a point is at most p + 3/2 = 4.5 cell widths away in every
 * direction, for which the reference has the proof; costs a third more functions and upwards.
 */
enum class Closure
{
  Narrow,
  Published
};

/// Memory: about 8 bytes a cell and 40 bytes a function. Finding a cell takes one step a level.
class BisectionMesh
{
public:
  /// Number of a node in the tree of cells, in the order of their making.
  using Node = std::int32_t;

  /// A cell of the mesh: the lower its level, the larger.
  struct Cell
  {
    Node Id;
    int Level;
  };

  /// How often a cell can be halved in a direction, and how many spans a direction can have.
  static constexpr int MaximumDepth = 20;
  static constexpr std::int32_t MaximumKnots = 1 << 28;

  /// `rootCells[a]` cells in direction a, each of which can be halved `depth[a]` times;
  /// std::invalid_argument if that exceeds a limit or makes no cell.
  BisectionMesh(const GridIndex& rootCells, const std::array<int, 3>& depth, Closure closure);

  /// The cell that holds the unit cell `at`. With an earlier value of CountNodes(): the cell that
  /// held it then.
  Cell Find(const GridIndex& at, Node nodes) const;
  Cell Find(const GridIndex& at) const { return this->Find(at, this->CountNodes()); }

  /// Whether there is such a unit cell.
  bool Inside(const GridIndex& unit) const
  {
    return unit[0] >= 0 && unit[1] >= 0 && unit[2] >= 0 && unit[0] < this->Ends[0] &&
           unit[1] < this->Ends[1] && unit[2] < this->Ends[2];
  }

  /// The box of the cell of this level that holds, or held, the unit cell `at`.
  IndexBox Box(const GridIndex& at, int level) const;

  /// Halves the cell that holds `at`, after those that the closure asks for. False if it is of the
  /// finest level, and nothing is done.
  bool Bisect(const GridIndex& at);

  Node CountNodes() const { return static_cast<Node>(this->Children.size()); }

  /// All cells: root by root (u fastest), from low to high inside of each.
  std::vector<IndexBox> Cells() const;

  /// Those of them that overlap a box inside of the mesh.
  std::vector<IndexBox> Cells(const IndexBox& box) const;

  /// Told a node and its low corner.
  using Visitor = std::function<void(const Cell& node, const GridIndex& corner)>;

  /// Visits the cells that overlap the box and for which, as for every node above them, wanted[Id]
  /// is not zero; wanted.size() tells of which time the cells are, as in Find.
  void VisitCells(const IndexBox& box, const std::vector<char>& wanted, const Visitor& visit) const;

  /// Sets wanted[Id] for the nodes from the root down to the cell that holds `at`, which is
  /// returned.
  Cell MarkPath(const GridIndex& at, std::vector<char>& wanted) const;

  /**
   * The cells of the mesh that belongs to an analysis-suitable T-spline of which only the functions
   * are known (from a file, say). A cell counts as halved if the four corners of the face between
   * its halves carry functions. Empty if the spline's functions are not just those of such a mesh.
   * Root cells are equally wide, and knots that no function has may be missing from the lines; or,
   * with knots at other distances, they have equally many intervals of the line each. In any case
   * their halves end at knots. O(n log n).
   */
  static std::vector<IndexBox> Recover(const TSpline& spline, const GridIndex& rootCells);

  /// Number of blending functions.
  Index CountFunctions() const { return static_cast<Index>(this->Anchors.size()); }

  /// Where the blending functions sit (numbers for FunctionAt), ascending in w, v, u, u fastest:
  /// the order of MakeTensorProduct.
  std::vector<Index> SortedAnchors() const;

  /// The local knot vectors of the blending function at an anchor.
  BlendingFunction FunctionAt(Index anchor) const;

  /// All blending functions in the order of SortedAnchors.
  std::vector<BlendingFunction> Functions() const;

private:
  // A cell of this level is 1 << Shift[a] indices wide and is halved in Direction.
  struct LevelShape
  {
    std::array<int, 3> Shift;
    int Direction;
  };

  Node RootOf(const GridIndex& at) const;
  // The child of a node that holds `at`.
  Cell ChildAt(const Cell& node, const GridIndex& at) const
  {
    const int a = this->Levels[node.Level].Direction;
    const int upper = (at[a] >> this->Levels[node.Level + 1].Shift[a]) & 1;
    return { this->Children[node.Id] + upper, node.Level + 1 };
  }
  bool IsCell(Node id, Node nodes) const
  {
    return this->Children[id] == 0 || this->Children[id] >= nodes;
  }
  void VisitBelow(const Cell& node, const GridIndex& corner, const IndexBox& box,
    const std::vector<char>& wanted, const Visitor& visit) const;

  IndexBox Neighbours(const GridIndex& at, int level) const;
  std::array<GridIndex, 4> NewVertices(const GridIndex& at, int level) const;
  void Halve(const GridIndex& at, const Cell& cell);
  void AddVertex(const GridIndex& vertex);
  Index AnchorOf(const GridIndex& layer) const;
  std::array<std::int32_t, 2> NextKnots(const GridIndex& vertex, int direction, bool up) const;

  GridIndex RootCells;
  GridIndex Ends; // the last index of each direction
  Closure Rule;
  std::vector<LevelShape> Levels; // the last one, of cells that cannot be halved, has no direction
  std::vector<Node> Children;     // the first of a node's two children; 0 for a cell
  std::unordered_set<Index> Anchors;
};
}

#endif
