// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "InsideShares.h"

#include <algorithm>
#include <cmath>

namespace trivariate
{
namespace
{
// Lines through a cell, along y and along z.
constexpr int LinesAcross = 4;

double LinePlace(Index line)
{
  return (static_cast<double>(line) + 0.5) / LinesAcross;
}

Index FirstLineFrom(double place)
{
  return static_cast<Index>(std::ceil(place * LinesAcross - 0.5));
}

// Seen along x, an edge and a point (y, z): twice the area between them.
struct EdgeSide
{
  EdgeSide(const std::vector<Eigen::Vector3d>& points, Index from, Index to, double y, double z)
  {
    // Both triangles of an edge get the same numbers but for the sign.
    const Eigen::Vector3d& p = points[std::min(from, to)];
    const Eigen::Vector3d& q = points[std::max(from, to)];
    const double area = (q[1] - p[1]) * (z - p[2]) - (q[2] - p[2]) * (y - p[1]);
    // On the edge: as if the point were moved a bit along y, and by much less along z.
    const double sign = area != 0.0 ? area : p[2] != q[2] ? p[2] - q[2] : q[1] - p[1];
    this->Area = std::abs(area);
    this->OnLeft = (sign >= 0.0) == (from < to);
  }

  double Area;
  bool OnLeft;
};
}

//------------------------------------------------------------------------------
InsideShares::InsideShares(const std::vector<Eigen::Vector3d>& points,
  const std::vector<Triangle>& triangles, const std::array<Index, 3>& cells)
  : Cells(cells)
{
  std::vector<Crossing> found;
  std::vector<Index> rows;
  for (const Triangle& t : triangles)
  {
    Index first[2], last[2];
    for (int a = 0; a < 2; ++a)
    {
      const double p[3] = { points[t[0]][a + 1], points[t[1]][a + 1], points[t[2]][a + 1] };
      first[a] = std::max<Index>(0, FirstLineFrom(*std::min_element(p, p + 3)));
      last[a] =
        std::min(FirstLineFrom(*std::max_element(p, p + 3)), LinesAcross * cells[a + 1] - 1);
    }
    for (Index m = first[1]; m <= last[1]; ++m)
    {
      for (Index l = first[0]; l <= last[0]; ++l)
      {
        double areas[3], sum = 0.0;
        int left = 0;
        for (int e = 0; e < 3; ++e)
        {
          const Index from = t[(e + 1) % 3], to = t[(e + 2) % 3];
          const EdgeSide side(points, from, to, LinePlace(l), LinePlace(m));
          left += side.OnLeft ? 1 : 0;
          areas[e] = side.Area;
          sum += side.Area;
        }
        if (left != 0 && left != 3)
        {
          continue;
        }
        double x = (points[t[0]][0] + points[t[1]][0] + points[t[2]][0]) / 3.0;
        if (sum > 0.0)
        {
          x =
            (areas[0] * points[t[0]][0] + areas[1] * points[t[1]][0] + areas[2] * points[t[2]][0]) /
            sum;
        }
        found.push_back(
          { x, static_cast<std::int8_t>(l % LinesAcross), static_cast<std::int8_t>(m % LinesAcross),
            static_cast<std::int8_t>(left == 0 ? 1 : -1) });
        rows.push_back(l / LinesAcross + cells[1] * (m / LinesAcross));
      }
    }
  }
  this->RowBegin.assign(cells[1] * cells[2] + 1, 0);
  for (const Index row : rows)
  {
    ++this->RowBegin[row + 1];
  }
  for (std::size_t row = 1; row < this->RowBegin.size(); ++row)
  {
    this->RowBegin[row] += this->RowBegin[row - 1];
  }
  std::vector<Index> next(this->RowBegin.begin(), this->RowBegin.end() - 1);
  this->Crossings.resize(found.size());
  for (std::size_t c = 0; c < found.size(); ++c)
  {
    this->Crossings[next[rows[c]]++] = found[c];
  }
}

//------------------------------------------------------------------------------
void InsideShares::Row(Index row, std::vector<CellOctants>& octants) const
{
  const Index halves = 2 * this->Cells[0];
  // An octant is the mean of so many lines.
  constexpr double share = 4.0 / (LinesAcross * LinesAcross);
  // Volume and first moments of each half of each quarter of the row, as steps from half to half: a
  // crossing changes the half in which it is, and all that follow. Lengths are in halves.
  std::array<std::vector<Eigen::Vector4d>, 4> steps;
  steps.fill(std::vector<Eigen::Vector4d>(halves + 1, Eigen::Vector4d::Zero()));
  for (Index c = this->RowBegin[row]; c < this->RowBegin[row + 1]; ++c)
  {
    const Crossing& crossing = this->Crossings[c];
    const double y = 2.0 * LinePlace(crossing.Y), z = 2.0 * LinePlace(crossing.Z);
    const int right = y > 1.0 ? 1 : 0, upper = z > 1.0 ? 1 : 0;
    const Index half = std::clamp<Index>(static_cast<Index>(2.0 * crossing.X), 0, halves - 1);
    const double x = 2.0 * crossing.X - static_cast<double>(half);
    const double weight = share * crossing.Step;
    const Eigen::Vector4d whole(1.0, 0.5, y - right, z - upper);
    const Eigen::Vector4d before(x, 0.5 * x * x, x * (y - right), x * (z - upper));
    steps[right + 2 * upper][half] += weight * (whole - before);
    steps[right + 2 * upper][half + 1] += weight * before;
  }
  octants.resize(this->Cells[0]);
  for (int quarter = 0; quarter < 4; ++quarter)
  {
    Eigen::Vector4d sum = Eigen::Vector4d::Zero();
    for (Index half = 0; half < halves; ++half)
    {
      sum += steps[quarter][half];
      const int octant = static_cast<int>(half % 2) + 2 * quarter;
      CellOctants& cell = octants[half / 2];
      cell.Shares[octant] = static_cast<float>(std::clamp(sum[0], 0.0, 1.0));
      for (int a = 0; a < 3; ++a)
      {
        const double middle = sum[0] > 1e-6 ? std::clamp(sum[a + 1] / sum[0], 0.0, 1.0) : 0.5;
        cell.Middles[octant][a] = static_cast<float>(0.5 * ((octant >> a & 1) + middle));
      }
    }
  }
}
}
