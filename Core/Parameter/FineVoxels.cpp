// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "FineVoxels.h"

#include "InsideShares.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>

namespace trivariate
{
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace
{
using Place = std::array<Index, 3>;

// Fine cells around the grid: surfaces may leave it by two voxels, as for BoxOfCells.
constexpr Index Room = 4;

Place FineSize(const Place& size)
{
  return { 2 * size[0] - 1, 2 * size[1] - 1, 2 * size[2] - 1 };
}

Place PlaceOf(Index id, const Place& size)
{
  return { id % size[0], id / size[0] % size[1], id / (size[0] * size[1]) };
}

// The voxels of the segment around a fine one: itself, or on both of its sides.
template <typename Visit>
void VisitAround(const ParameterVoxels& voxels, const Place& fine, const Visit& visit)
{
  for (Index k = fine[2] / 2; k <= (fine[2] + 1) / 2; ++k)
  {
    for (Index j = fine[1] / 2; j <= (fine[1] + 1) / 2; ++j)
    {
      for (Index i = fine[0] / 2; i <= (fine[0] + 1) / 2; ++i)
      {
        const Index id = i + voxels.Size[0] * (j + voxels.Size[1] * k);
        if (voxels.Mask[id] != 0)
        {
          visit(id);
        }
      }
    }
  }
}

// The mean; unit rows stay unit rows.
Matrix3d MeanFrame(const ParameterVoxels& voxels, const Place& fine)
{
  Matrix3d sum = Matrix3d::Zero();
  Vector3d lengths = Vector3d::Zero();
  double count = 0.0;
  VisitAround(voxels, fine,
    [&](Index id)
    {
      const Matrix3d frame = voxels.FrameAt(id);
      sum += frame;
      lengths += frame.rowwise().norm();
      count += 1.0;
    });
  const Vector3d norms = sum.rowwise().norm();
  for (int row = 0; row < 3; ++row)
  {
    sum.row(row) *= norms[row] > 0.0 ? lengths[row] / (count * norms[row]) : 0.0;
  }
  return sum;
}

std::vector<std::uint8_t> FineMask(
  const ParameterVoxels& voxels, const ParameterSurface& surface, const Execution& execution)
{
  const Place size = FineSize(voxels.Size);
  std::vector<Vector3d> points; // of the surface, in cells whose middles are the fine voxels
  for (const Vector3d& point : surface.Points)
  {
    const Vector3d at = 2.0 * point.cwiseQuotient(voxels.Spacing) + Vector3d::Constant(Room + 0.5);
    const bool isIn = (at.array() > 0.0).all() && at[0] < size[0] + 2 * Room &&
                      at[1] < size[1] + 2 * Room && at[2] < size[2] + 2 * Room;
    if (!isIn)
    {
      throw std::invalid_argument("The surface leaves the image: it is not that of this segment.");
    }
    points.push_back(at);
  }
  const Place cells = { size[0] + 2 * Room, size[1] + 2 * Room, size[2] + 2 * Room };
  const InsideShares inside(points, surface.Triangles, cells);
  std::vector<std::uint8_t> mask(size[0] * size[1] * size[2], 0);
  std::vector<CellOctants> octants;
  for (Index k = 0; k < size[2]; ++k)
  {
    execution.Check(static_cast<double>(k) / static_cast<double>(size[2]));
    for (Index j = 0; j < size[1]; ++j)
    {
      inside.Row(j + Room + cells[1] * (k + Room), octants);
      for (Index i = 0; i < size[0]; ++i)
      {
        const std::array<float, 8>& shares = octants[i + Room].Shares;
        const bool isInside = std::accumulate(shares.begin(), shares.end(), 0.0F) >= 4.0F;
        const bool isGiven = i % 2 == 0 && j % 2 == 0 && k % 2 == 0;
        std::uint8_t& known = mask[i + size[0] * (j + size[1] * k)];
        if (isGiven || isInside)
        {
          VisitAround(voxels, { i, j, k }, [&known](Index) { known = 1; });
        }
      }
    }
  }
  return mask;
}

// The values at every second voxel.
VoxelParameter EverySecond(const VoxelParameter& fine, const Vector3d& spacing)
{
  VoxelParameter coarse;
  coarse.Spacing = spacing;
  coarse.Coordinates = fine.Coordinates;
  coarse.Lengths = fine.Lengths;
  coarse.Solves = fine.Solves;
  for (int a = 0; a < 3; ++a)
  {
    // Rounded up from below, so that the first one is in the box.
    coarse.Low[a] = (fine.Low[a] + (fine.Low[a] >= 0 ? 1 : 0)) / 2;
    coarse.Size[a] = (fine.Low[a] + fine.Size[a] - 1 - 2 * coarse.Low[a]) / 2 + 1;
  }
  const Index count = coarse.Size[0] * coarse.Size[1] * coarse.Size[2];
  coarse.Values.assign(3 * count, 0.0);
  coarse.Known.assign(count, 0);
  for (Index to = 0; to < count; ++to)
  {
    const Place at = PlaceOf(to, coarse.Size);
    const Index from = fine.At(
      { 2 * (coarse.Low[0] + at[0]), 2 * (coarse.Low[1] + at[1]), 2 * (coarse.Low[2] + at[2]) });
    if (from >= 0)
    {
      coarse.Known[to] = fine.Known[from];
      std::copy_n(&fine.Values[3 * from], 3, &coarse.Values[3 * to]);
    }
  }
  return coarse;
}
}

//------------------------------------------------------------------------------
Index CountFineVoxels(const std::array<Index, 3>& size)
{
  const Place fine = FineSize(size);
  return fine[0] * fine[1] * fine[2];
}

//------------------------------------------------------------------------------
VoxelParameter SolveOnFineVoxels(const ParameterVoxels& voxels, const ParameterSurface& surface,
  const ParameterOptions& options, const Execution& execution)
{
  const std::vector<std::uint8_t> mask = FineMask(voxels, surface, execution.Part(0.0, 0.05));
  const Place size = FineSize(voxels.Size);
  const ParameterVoxels fine{ size, 0.5 * voxels.Spacing, mask.data(),
    [&voxels, size](Index id) { return MeanFrame(voxels, PlaceOf(id, size)); } };
  return EverySecond(
    SolveVoxelParameter(fine, surface, options, execution.Part(0.05, 1.0)), voxels.Spacing);
}
}
