// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "LayoutBuilder.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <tuple>

namespace trivariate
{
namespace
{
// Connected charts, numbered in order of their first triangles.
std::vector<Index> ChartsOf(const SurfaceMesh& mesh, const std::vector<ChartLabel>& labels,
  std::vector<ChartLabel>& labelOfChart)
{
  std::vector<Index> charts(labels.size(), -1), waiting;
  for (Index seed = 0; seed < mesh.NumberOfTriangles(); ++seed)
  {
    if (labels[seed] < 0 || labels[seed] > 5)
    {
      throw std::invalid_argument("Triangle " + std::to_string(seed) + " has label " +
                                  std::to_string(labels[seed]) +
                                  "; labels are 2 axis + side, 0 to 5.");
    }
    if (charts[seed] >= 0)
    {
      continue;
    }
    const Index chart = static_cast<Index>(labelOfChart.size());
    labelOfChart.push_back(labels[seed]);
    charts[seed] = chart;
    waiting.push_back(seed);
    while (!waiting.empty())
    {
      const Index t = waiting.back();
      waiting.pop_back();
      for (int k = 0; k < 3; ++k)
      {
        const Index next = mesh.Neighbour(t, k);
        if (charts[next] < 0 && labels[next] == labels[seed])
        {
          charts[next] = chart;
          waiting.push_back(next);
        }
      }
    }
  }
  return charts;
}

// The triangles at a point that begin a new chart, anticlockwise.
std::vector<Index> Beginnings(const SurfaceMesh& mesh, const std::vector<Index>& charts, Index p)
{
  std::vector<Index> beginnings;
  if (mesh.FanBegin(p) != mesh.FanEnd(p))
  {
    Index before = charts[mesh.FanEnd(p)[-1]];
    for (const Index* t = mesh.FanBegin(p); t != mesh.FanEnd(p); ++t)
    {
      if (charts[*t] != before)
      {
        beginnings.push_back(*t);
      }
      before = charts[*t];
    }
  }
  return beginnings;
}

// V - E + F of each chart, with the points where it touches itself counted apart: 1 for a disc.
void CheckDiscs(const SurfaceMesh& mesh, const std::vector<Index>& charts, std::size_t count)
{
  std::vector<Index> doubled(count, 0); // 2 (V - E + F)
  for (Index t = 0; t < mesh.NumberOfTriangles(); ++t)
  {
    doubled[charts[t]] += 2;
    for (int k = 0; k < 3; ++k)
    {
      doubled[charts[t]] -= charts[mesh.Neighbour(t, k)] == charts[t] ? 1 : 2;
    }
  }
  for (Index p = 0; p < mesh.NumberOfPoints(); ++p)
  {
    const std::vector<Index> beginnings = Beginnings(mesh, charts, p);
    for (const Index t : beginnings)
    {
      doubled[charts[t]] += 2;
    }
    if (beginnings.empty() && mesh.FanBegin(p) != mesh.FanEnd(p))
    {
      doubled[charts[*mesh.FanBegin(p)]] += 2;
    }
  }
  for (std::size_t chart = 0; chart < count; ++chart)
  {
    if (doubled[chart] != 2)
    {
      throw std::invalid_argument("Chart " + std::to_string(chart) +
                                  " is not a disc: its Euler characteristic is " +
                                  std::to_string(doubled[chart] / 2) + ".");
    }
  }
}

void FindCorners(const SurfaceMesh& mesh, const std::vector<Index>& charts, LayoutBuilder& builder)
{
  for (Index p = 0; p < mesh.NumberOfPoints(); ++p)
  {
    const std::vector<Index> beginnings = Beginnings(mesh, charts, p);
    for (std::size_t i = 1; i < beginnings.size(); ++i)
    {
      for (std::size_t j = 0; j < i; ++j)
      {
        if (charts[beginnings[i]] == charts[beginnings[j]])
        {
          throw std::invalid_argument("Chart " + std::to_string(charts[beginnings[i]]) +
                                      " touches itself at point " + std::to_string(p) + ".");
        }
      }
    }
    if (beginnings.size() > 3)
    {
      throw std::invalid_argument(std::to_string(beginnings.size()) + " charts meet at point " +
                                  std::to_string(p) + "; three may.");
    }
    builder.Mesh.Occupied[p] = !beginnings.empty();
    if (beginnings.size() == 3)
    {
      builder.Corners.push_back(p);
    }
  }
}

// Walks along a border from a corner, with the given triangle on its left, and marks it.
void WalkBorder(const SurfaceMesh& mesh, const std::vector<Index>& charts,
  const std::vector<Index>& cornerOfPoint, Index point, Index left, LayoutBuilder& builder)
{
  const Index mark = static_cast<Index>(builder.Borders.size());
  LayoutBorder border{ { cornerOfPoint[point], -1 },
    { charts[left], charts[mesh.Neighbour(left, mesh.CornerOf(left, point))] }, {} };
  do
  {
    const int side = mesh.CornerOf(left, point);
    builder.Mesh.SetMark(left, side, mark);
    point = mesh.Triangles[left][(side + 1) % 3];
    // The next edge of the border: clockwise around the new point, as far as the chart goes.
    while (charts[mesh.Neighbour(left, mesh.CornerOf(left, point))] == charts[left])
    {
      left = mesh.Neighbour(left, mesh.CornerOf(left, point));
    }
  } while (cornerOfPoint[point] < 0);
  border.Corners[1] = cornerOfPoint[point];
  builder.Borders.push_back(border);
}

void FindBorders(const SurfaceMesh& mesh, const std::vector<Index>& charts, LayoutBuilder& builder)
{
  std::vector<Index> cornerOfPoint(mesh.Points.size(), -1);
  for (std::size_t i = 0; i < builder.Corners.size(); ++i)
  {
    cornerOfPoint[builder.Corners[i]] = static_cast<Index>(i);
  }
  // In order of labels, the lower one on the left, so that the order of the triangles has no say.
  struct Beginning
  {
    ChartLabel Left, Right;
    Index Corner, Triangle;
  };
  std::vector<Beginning> beginnings;
  for (const Index corner : builder.Corners)
  {
    for (const Index t : Beginnings(mesh, charts, corner))
    {
      const Index across = mesh.Neighbour(t, mesh.CornerOf(t, corner));
      const Beginning beginning{ builder.PatchLabels[charts[t]],
        builder.PatchLabels[charts[across]], corner, t };
      if (beginning.Left < beginning.Right)
      {
        beginnings.push_back(beginning);
      }
    }
  }
  std::stable_sort(beginnings.begin(), beginnings.end(),
    [](const Beginning& a, const Beginning& b)
    { return std::tie(a.Left, a.Right) < std::tie(b.Left, b.Right); });
  for (const Beginning& beginning : beginnings)
  {
    WalkBorder(mesh, charts, cornerOfPoint, beginning.Corner, beginning.Triangle, builder);
  }
  for (Index t = 0; t < mesh.NumberOfTriangles(); ++t)
  {
    for (int k = 0; k < 3; ++k)
    {
      const Index other = charts[mesh.Neighbour(t, k)];
      if (other != charts[t] && builder.Mesh.Mark(t, k) < 0)
      {
        throw std::invalid_argument("The border between charts " + std::to_string(charts[t]) +
                                    " and " + std::to_string(other) +
                                    " is a ring without a corner.");
      }
    }
  }
}
}

//------------------------------------------------------------------------------
SurfaceLayout LayoutFromCharts(const SurfaceMesh& mesh, const std::vector<ChartLabel>& labels,
  const Execution& execution, double stretch)
{
  if (labels.size() != mesh.Triangles.size())
  {
    throw std::invalid_argument("There are " + std::to_string(labels.size()) + " labels for " +
                                std::to_string(mesh.Triangles.size()) + " triangles.");
  }
  LayoutBuilder builder(mesh);
  const std::vector<Index> charts = ChartsOf(mesh, labels, builder.PatchLabels);
  CheckDiscs(mesh, charts, builder.PatchLabels.size());
  FindCorners(mesh, charts, builder);
  FindBorders(mesh, charts, builder);
  builder.Straighten(stretch, execution);
  return builder.Result();
}
}
