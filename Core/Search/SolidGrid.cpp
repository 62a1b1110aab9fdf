// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "SolidGrid.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace trivariate
{
namespace
{
using Eigen::Vector3d;

constexpr double Margin = 0.25; // of a cell, by which the grid may be shorter than the surface
constexpr float OpenWeight = 0.5f, CleftWeight = 3.0f;

// Twice the signed area of a, b and a place in the plane of the first two coordinates, the same but
// for its sign from both sides of an edge, so that no middle falls between two triangles.
double SideOf(const std::vector<Vector3d>& points, Index a, Index b, double x, double y)
{
  const double sign = a < b ? 1.0 : -1.0;
  const Vector3d &from = points[std::min(a, b)], &to = points[std::max(a, b)];
  const double side = (to.x() - from.x()) * (y - from.y()) - (to.y() - from.y()) * (x - from.x());
  return sign * (side == 0.0 ? 1e-300 : side);
}
}

//------------------------------------------------------------------------------
SolidGrid::SolidGrid(const SurfaceMesh& mesh, const Eigen::Matrix3d& frame, int cells)
  : Frame(frame)
{
  Eigen::AlignedBox3d box;
  for (const Vector3d& point : mesh.Points)
  {
    box.extend(frame * point);
  }
  this->Width = box.sizes().maxCoeff() / cells;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double wanted = box.sizes()[axis] / this->Width - Margin;
    this->Cells[axis] = std::max(1, static_cast<int>(std::ceil(wanted)));
    this->Low[axis] = box.center()[axis] - 0.5 * this->Width * this->Cells[axis];
  }
  const std::vector<char> inside = this->FindInside(mesh);
  const std::vector<float> weights = this->Weights(inside);
  this->InsideSums.assign(inside.size(), 0.0);
  this->OutsideSums.assign(inside.size(), 0.0);
  for (int k = 1; k <= this->Cells[2]; ++k)
  {
    for (int j = 1; j <= this->Cells[1]; ++j)
    {
      for (int i = 1; i <= this->Cells[0]; ++i)
      {
        const Index cell = this->At(i - 1, j - 1, k - 1);
        for (std::vector<double>* sums : { &this->InsideSums, &this->OutsideSums })
        {
          const auto at = [&](int x, int y, int z) { return (*sums)[this->At(x, y, z)]; };
          (*sums)[this->At(i, j, k)] =
            (sums == &this->InsideSums ? double(inside[cell]) : weights[cell]) + at(i - 1, j, k) +
            at(i, j - 1, k) + at(i, j, k - 1) - at(i - 1, j - 1, k) - at(i - 1, j, k - 1) -
            at(i, j - 1, k - 1) + at(i - 1, j - 1, k - 1);
        }
      }
    }
  }
}

//------------------------------------------------------------------------------
// Lines along the third axis through all middles: a triangle changes the winding number of all that
// is above it.
std::vector<char> SolidGrid::FindInside(const SurfaceMesh& mesh) const
{
  std::vector<Vector3d> points;
  for (const Vector3d& point : mesh.Points)
  {
    points.push_back((this->Frame * point - this->Low) / this->Width -
                     Vector3d(0.5, 0.5, 0.5)); // middles at integers
  }
  std::vector<std::int32_t> winding(
    (this->Cells[0] + Index(1)) * (this->Cells[1] + Index(1)) * (this->Cells[2] + Index(1)), 0);
  for (const Triangle& c : mesh.Triangles)
  {
    const Vector3d &p = points[c[0]], &q = points[c[1]], &r = points[c[2]];
    const Vector3d low = p.cwiseMin(q).cwiseMin(r), high = p.cwiseMax(q).cwiseMax(r);
    for (int j = std::max(0, int(std::ceil(low.y()))); j <= high.y() && j < this->Cells[1]; ++j)
    {
      for (int i = std::max(0, int(std::ceil(low.x()))); i <= high.x() && i < this->Cells[0]; ++i)
      {
        const double a = SideOf(points, c[1], c[2], i, j), b = SideOf(points, c[2], c[0], i, j),
                     d = SideOf(points, c[0], c[1], i, j);
        const bool up = a > 0.0 && b > 0.0 && d > 0.0, down = a < 0.0 && b < 0.0 && d < 0.0;
        if (up || down)
        {
          const double z = (a * p.z() + b * q.z() + d * r.z()) / (a + b + d);
          const int above = std::clamp(int(std::ceil(z)), 0, this->Cells[2]);
          winding[this->At(i, j, above)] += up ? -1 : 1;
        }
      }
    }
  }
  const Index layer = this->At(0, 0, 1);
  std::vector<char> inside(winding.size());
  for (std::size_t cell = 0; cell < winding.size(); ++cell)
  {
    winding[cell] += static_cast<Index>(cell) < layer ? 0 : winding[cell - layer];
    inside[cell] = winding[cell] > 0;
  }
  return inside;
}

//------------------------------------------------------------------------------
// Of cells outside.
std::vector<float> SolidGrid::Weights(const std::vector<char>& inside) const
{
  std::vector<float> weights(inside.size());
  std::transform(inside.begin(), inside.end(), weights.begin(),
    [](char isInside) { return isInside ? 0.0f : OpenWeight; });
  const std::array<Index, 3> steps{ 1, this->At(0, 1, 0), this->At(0, 0, 1) };
  for (int axis = 0; axis < 3; ++axis)
  {
    const int a = (axis + 1) % 3, b = (axis + 2) % 3;
    for (Index i = 0; i < this->Cells[a]; ++i)
    {
      for (Index j = 0; j < this->Cells[b]; ++j)
      {
        Index last = -1; // inside
        for (Index k = 0; k < this->Cells[axis]; ++k)
        {
          const Index row = i * steps[a] + j * steps[b];
          if (inside[row + k * steps[axis]])
          {
            for (Index cleft = last + 1; last >= 0 && cleft < k; ++cleft)
            {
              weights[row + cleft * steps[axis]] = CleftWeight;
            }
            last = k;
          }
        }
      }
    }
  }
  return weights;
}

//------------------------------------------------------------------------------
double SolidGrid::Sum(const std::vector<double>& sums, const std::array<int, 3>& low,
  const std::array<int, 3>& high) const
{
  double sum = 0.0;
  for (int corner = 0; corner < 8; ++corner)
  {
    const int ends = corner % 2 + corner / 2 % 2 + corner / 4;
    sum += (ends % 2 ? 1.0 : -1.0) *
           sums[this->At(corner % 2 ? high[0] : low[0], corner / 2 % 2 ? high[1] : low[1],
             corner / 4 ? high[2] : low[2])];
  }
  return sum;
}
}
