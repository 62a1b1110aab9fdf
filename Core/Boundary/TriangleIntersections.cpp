// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "TriangleIntersections.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace trivariate
{
namespace
{
using Eigen::Vector3d;
using Corners = std::array<Vector3d, 3>;

const double FoldCosine = std::cos(EIGEN_PI / 180.0);

// Whether the projections onto an axis of any length leave a gap.
bool HasGap(const Corners& a, const Corners& b, const Vector3d& axis, double distance)
{
  const double length = axis.norm();
  if (length < 1e-12)
  {
    return false;
  }
  const Vector3d p(axis.dot(a[0]), axis.dot(a[1]), axis.dot(a[2]));
  const Vector3d q(axis.dot(b[0]), axis.dot(b[1]), axis.dot(b[2]));
  return std::max(p.minCoeff() - q.maxCoeff(), q.minCoeff() - p.maxCoeff()) > distance * length;
}

// Separating axes: convex sets are disjoint when a normal of either, a normal to an edge of each,
// or, in a plane, a normal to one edge has a gap. A segment is a triangle with a vertex twice.
bool AreApart(const Corners& a, const Corners& b, double distance)
{
  const Corners u = { a[1] - a[0], a[2] - a[1], a[0] - a[2] };
  const Corners v = { b[1] - b[0], b[2] - b[1], b[0] - b[2] };
  const Vector3d n = u[0].cross(u[1]), m = v[0].cross(v[1]);
  if (HasGap(a, b, n, distance) || HasGap(a, b, m, distance))
  {
    return true;
  }
  for (const Vector3d& edge : u)
  {
    for (const Vector3d& other : v)
    {
      if (HasGap(a, b, edge.cross(other), distance))
      {
        return true;
      }
    }
  }
  for (int i = 0; i < 3; ++i)
  {
    if (HasGap(a, b, n.cross(u[i]), distance) || HasGap(a, b, m.cross(v[i]), distance) ||
        HasGap(a, b, m.cross(u[i]), distance) || HasGap(a, b, n.cross(v[i]), distance))
    {
      return true;
    }
  }
  return false;
}

class IntersectionSearch
{
public:
  IntersectionSearch(const std::vector<Point>& points, const std::vector<Triangle>& triangles,
    const std::vector<char>& suspect, double distance)
    : Points(points)
    , Triangles(triangles)
    , Suspect(suspect)
    , Distance(distance)
  {
  }

  std::vector<std::pair<Index, Index>> Run(const Execution& execution)
  {
    this->SortByLayers();
    const Index layers = static_cast<Index>(this->LayerBegin.size()) - 1;
    std::vector<std::vector<std::pair<Index, Index>>> found(std::max<Index>(layers, 0));
    const Index block = 16; // layers between two looks at the abort button
    for (Index start = 0; start < layers; start += block)
    {
      execution.Check(static_cast<double>(start) / layers);
      execution.ParallelFor(std::min(block, layers - start),
        [&](Index begin, Index end)
        {
          for (Index layer = start + begin; layer < start + end; ++layer)
          {
            this->SearchLayer(layer, found[layer]);
          }
        });
    }
    std::vector<std::pair<Index, Index>> all;
    for (const auto& pairs : found)
    {
      all.insert(all.end(), pairs.begin(), pairs.end());
    }
    return all;
  }

private:
  Corners CornersOf(Index triangle) const
  {
    const Triangle& t = this->Triangles[triangle];
    return { Eigen::Map<const Vector3d>(this->Points[t[0]].data()),
      Eigen::Map<const Vector3d>(this->Points[t[1]].data()),
      Eigen::Map<const Vector3d>(this->Points[t[2]].data()) };
  }

  struct Box
  {
    Eigen::Array3d Low, High;
    bool Meets(const Box& other) const
    {
      return (this->Low <= other.High).all() && (other.Low <= this->High).all();
    }
  };

  Box BoxOf(Index triangle) const
  {
    const Corners c = this->CornersOf(triangle);
    return { c[0].array().min(c[1].array()).min(c[2].array()) - this->Distance,
      c[0].array().max(c[1].array()).max(c[2].array()) + this->Distance };
  }

  // Lists the triangles of every layer of unit cells; a triangle is in all that its box meets.
  void SortByLayers()
  {
    if (this->Triangles.empty())
    {
      return;
    }
    this->Low.fill(std::numeric_limits<Index>::max());
    this->High.fill(std::numeric_limits<Index>::min());
    for (std::size_t t = 0; t < this->Triangles.size(); ++t)
    {
      const Box box = this->BoxOf(t);
      for (int a = 0; a < 3; ++a)
      {
        this->Low[a] = std::min(this->Low[a], Cell(box.Low[a]));
        this->High[a] = std::max(this->High[a], Cell(box.High[a]));
      }
    }
    this->LayerBegin.assign(this->High[2] - this->Low[2] + 2, 0);
    const auto visit = [this](const auto& action)
    {
      for (Index t = 0; t < static_cast<Index>(this->Triangles.size()); ++t)
      {
        const Box box = this->BoxOf(t);
        for (Index layer = Cell(box.Low[2]); layer <= Cell(box.High[2]); ++layer)
        {
          action(layer - this->Low[2], t);
        }
      }
    };
    visit([this](Index layer, Index) { ++this->LayerBegin[layer + 1]; });
    std::partial_sum(this->LayerBegin.begin(), this->LayerBegin.end(), this->LayerBegin.begin());
    this->Sorted.resize(this->LayerBegin.back());
    std::vector<Index> next = this->LayerBegin;
    visit([this, &next](Index layer, Index t) { this->Sorted[next[layer]++] = t; });
  }

  static Index Cell(double x) { return static_cast<Index>(std::floor(x)); }

  void SearchLayer(Index layer, std::vector<std::pair<Index, Index>>& found) const
  {
    const Index* first = this->Sorted.data() + this->LayerBegin[layer];
    const Index count = this->LayerBegin[layer + 1] - this->LayerBegin[layer];
    const bool any =
      std::any_of(first, first + count, [this](Index t) { return this->Suspect[t]; });
    if (!any)
    {
      return;
    }
    // The same again for the cells of the layer.
    std::vector<Box> boxes(count);
    for (Index m = 0; m < count; ++m)
    {
      boxes[m] = this->BoxOf(first[m]);
    }
    const Index nx = this->High[0] - this->Low[0] + 1, ny = this->High[1] - this->Low[1] + 1;
    const auto visit = [&](const auto& action)
    {
      for (Index m = 0; m < count; ++m)
      {
        for (Index j = Cell(boxes[m].Low[1]); j <= Cell(boxes[m].High[1]); ++j)
        {
          for (Index i = Cell(boxes[m].Low[0]); i <= Cell(boxes[m].High[0]); ++i)
          {
            action(i - this->Low[0] + nx * (j - this->Low[1]), m);
          }
        }
      }
    };
    std::vector<Index> begin(nx * ny + 1, 0);
    visit([&](Index cell, Index) { ++begin[cell + 1]; });
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    std::vector<Index> members(begin.back()), next = begin;
    visit([&](Index cell, Index m) { members[next[cell]++] = m; });
    for (Index cell = 0; cell < nx * ny; ++cell)
    {
      for (Index p = begin[cell]; p < begin[cell + 1]; ++p)
      {
        for (Index q = p + 1; q < begin[cell + 1]; ++q)
        {
          const Index s = first[members[p]], t = first[members[q]];
          if ((this->Suspect[s] || this->Suspect[t]) &&
              boxes[members[p]].Meets(boxes[members[q]]) && this->Intersect(s, t))
          {
            found.emplace_back(s, t);
          }
        }
      }
    }
  }

  bool Intersect(Index s, Index t) const
  {
    // Where the common vertices are in either.
    std::array<int, 3> inS, inT;
    int common = 0;
    for (int i = 0; i < 3; ++i)
    {
      for (int j = 0; j < 3; ++j)
      {
        if (this->Triangles[s][i] == this->Triangles[t][j])
        {
          inS[common] = i;
          inT[common++] = j;
        }
      }
    }
    const Corners a = this->CornersOf(s), b = this->CornersOf(t);
    if (common == 0)
    {
      return !AreApart(a, b, this->Distance);
    }
    if (common == 1)
    {
      // What the two have in common starts at the vertex and ends at an edge opposite to it.
      const Vector3d &a1 = a[(inS[0] + 1) % 3], &a2 = a[(inS[0] + 2) % 3];
      const Vector3d &b1 = b[(inT[0] + 1) % 3], &b2 = b[(inT[0] + 2) % 3];
      return !AreApart({ a1, a2, a2 }, b, this->Distance) ||
             !AreApart({ b1, b2, b2 }, a, this->Distance);
    }
    if (common == 2)
    {
      const Vector3d& origin = a[inS[0]];
      const Vector3d edge = (a[inS[1]] - origin).normalized();
      const Vector3d u = a[3 - inS[0] - inS[1]] - origin, v = b[3 - inT[0] - inT[1]] - origin;
      const Vector3d x = u - edge * edge.dot(u), y = v - edge * edge.dot(v);
      return x.dot(y) >= FoldCosine * x.norm() * y.norm();
    }
    return true;
  }

  const std::vector<Point>& Points;
  const std::vector<Triangle>& Triangles;
  const std::vector<char>& Suspect;
  const double Distance;
  std::array<Index, 3> Low = {}, High = {};
  std::vector<Index> LayerBegin, Sorted;
};
}

//------------------------------------------------------------------------------
std::vector<std::pair<Index, Index>> FindIntersections(const std::vector<Point>& points,
  const std::vector<Triangle>& triangles, const std::vector<char>& suspect, double distance,
  const Execution& execution)
{
  return IntersectionSearch(points, triangles, suspect, distance).Run(execution);
}
}
