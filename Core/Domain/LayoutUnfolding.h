// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * A surface mapped onto the surface of a polycube, which is flat except at its corners.
 *
 * Every triangle has its corners in the chart (PolycubeCharts.h) of the face that it belonged to in
 * the layout given. Where points go is not bound to that face: a chart goes on beyond its face's
 * borders, as the neighbouring face unfolded. Variables are two coordinates of each point, in the
 * chart of one of its faces, and the places of the lattice's lines, so the lengths of the cubes. In
 * the other charts around a point its coordinates are the same, turned by quarters and moved by
 * places of lines: all coordinates are sums of at most three variables with signs.
 */
#ifndef trivariate_LayoutUnfolding_h
#define trivariate_LayoutUnfolding_h

#include "LayoutMesh.h"
#include "PolycubeCharts.h"
#include "SurfaceLayout.h"

#include <map>

namespace trivariate
{
class LayoutUnfolding
{
public:
  /**
   * Borders go to the edges of the polycube by length, points inside nowhere yet (PlaceInside). A
   * line's place is the mean length of the borders that end there from the line before. With
   * `fixed` all corners stay where they are in the layout, otherwise those at which the polycube is
   * flat are points like others. Points of borders that are edges of the surface (SharpBorders.h)
   * may move along them only.
   *
   * Edges within a patch that join two points of its borders are cut in two.
   */
  LayoutUnfolding(const SurfaceLayout& layout, const Polycube& cubes, bool fixed);

  /// How a point's own coordinates become those in another chart.
  struct Transition
  {
    int Turn = 0;
    Index Pivot = -1; // none: the chart is the point's own
  };

  /// Three points in the chart of one face.
  struct ChartTriangle
  {
    Triangle Points;
    Index Face;
    std::array<Transition, 3> Transitions;
  };

  /// Any three points that belong to the face.
  ChartTriangle InChart(const Triangle& points, Index face) const;

  /// Where corner k of a triangle is in its chart.
  Eigen::Vector2d Place(const ChartTriangle& triangle, int k) const
  {
    return this->Place(this->Values, triangle, k);
  }
  Eigen::Vector2d Place(
    const std::vector<double>& values, const ChartTriangle& triangle, int k) const
  {
    Eigen::Vector2d place = Eigen::Vector2d::Zero();
    for (int axis = 0; axis < 2; ++axis)
    {
      this->ForTerms(triangle, k, axis,
        [&](Index variable, double sign) { place[axis] += sign * values[variable]; });
    }
    return place;
  }

  /// Calls add(variable, sign) for all of which coordinate `axis` of a corner is the sum. Numbers
  /// from NumberOfFree on stay as they are.
  template <typename Add>
  void ForTerms(const ChartTriangle& triangle, int k, int axis, const Add& add) const
  {
    const auto& [turn, pivot] = triangle.Transitions[k];
    // x of a turned vector is x, -y, -x, y of the vector; y is its y, x, -y, -x.
    const int from = (axis + turn) % 2;
    const double sign = (axis == 0 ? turn == 1 || turn == 2 : turn >= 2) ? -1.0 : 1.0;
    add(this->Own[triangle.Points[k]][from], sign);
    if (pivot >= 0)
    {
      add(this->Pivots[pivot].Before[from], -sign);
      add(this->Pivots[pivot].After[axis], 1.0);
    }
  }

  double LineValue(Index line) const { return this->Values[this->LineVariables[line]]; }
  /// Whether a point is a corner that stays one.
  bool IsTied(Index point) const
  {
    return this->Own[point][0] >= this->FirstLine && this->Own[point][1] >= this->FirstLine;
  }
  /// Whether a point was on no border of the layout.
  bool IsInside(Index point) const { return !this->OnBorder[point]; }
  /// The variables that are a point's own coordinates.
  const std::array<Index, 2>& VariablesOf(Index point) const { return this->Own[point]; }

  /// Places the points of these triangles, which cover the surface, that are inside of patches in
  /// the middle of their neighbours: one to one but for rounding (W. T. Tutte, How to draw a graph,
  /// 1963). A sparse Cholesky factorisation.
  void PlaceInside(const std::vector<ChartTriangle>& triangles);

  /// Places lines that are no variables between those that are as they were with the values before.
  void SpaceLines(const std::vector<double>& before);

  LayoutMesh Mesh;
  std::vector<ChartTriangle> Triangles; ///< those of the mesh
  std::vector<double> Values;           ///< of the variables
  Index FirstLine = 0;                  ///< the first variable that is the place of a line
  Index NumberOfFree = 0;               ///< so many variables from the first one on may change
  std::vector<Index> LineVariables;     ///< of each line
  PolycubeCharts Charts;

private:
  // A point of the lattice in two charts: turned about there, one becomes the other.
  struct Pivot
  {
    std::array<Index, 2> Before, After; // variables of lines
  };

  void CutChords(std::vector<Index>& patches);
  void NumberPoints(const SurfaceLayout& layout, const std::vector<Index>& patches, bool fixed);
  void NumberLines(const SurfaceLayout& layout, const std::vector<char>& tied);
  void FindTransitions(const SurfaceLayout& layout);
  void PlaceLines(const SurfaceLayout& layout);
  void PlaceBorders(const SurfaceLayout& layout);
  Index PivotAt(Index point, Index before, Index after);

  std::vector<char> Sharp;               // of each border of the layout
  std::vector<char> OnBorder;            // of each point
  std::vector<std::array<Index, 2>> Own; // variables of each point
  std::vector<Index> Home;               // of each point: the face in whose chart they are
  // By point and face: of points on borders, in the charts that are not their own.
  std::map<std::array<Index, 2>, Transition> Elsewhere;
  std::vector<Pivot> Pivots;
};
}

#endif
