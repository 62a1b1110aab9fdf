// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "TargetField.h"

#include "StencilMatrix.h"

#include <sstream>
#include <stdexcept>

namespace trivariate
{
using Eigen::Vector3d;

namespace
{
// Of a voxel of the segment.
Vector3d TargetAt(const ParameterCells& cells, const ParameterVoxels& voxels, int axis, Index node)
{
  const Index x = node % cells.Size[0] + cells.Low[0],
              y = node / cells.Size[0] % cells.Size[1] + cells.Low[1],
              z = node / (cells.Size[0] * cells.Size[1]) + cells.Low[2];
  const Vector3d target =
    voxels.FrameAt(x + voxels.Size[0] * (y + voxels.Size[1] * z)).row(axis).transpose();
  if (!(target.squaredNorm() > 1e-12) || !target.allFinite())
  {
    std::ostringstream message;
    message << "The frame of voxel (" << x << ", " << y << ", " << z << ") has "
            << target.transpose() << " along "
            << "uvw"[axis] << ": the frame field does not belong to this segment.";
    throw std::invalid_argument(message.str());
  }
  return target;
}

// The mean of the filled neighbours, if there are some.
bool FillFromNeighbours(const ParameterCells& cells, const std::vector<std::uint8_t>& filled,
  Index node, TargetField& targets)
{
  Vector3d sum = Vector3d::Zero();
  double weights = 0.0;
  for (int d = 0; d < 27; ++d)
  {
    const int step[3] = { d % 3 - 1, d / 3 % 3 - 1, d / 9 - 1 };
    const Index other = node + step[0] + cells.Size[0] * (step[1] + cells.Size[1] * step[2]);
    if (filled[other] == 2)
    {
      const double weight = 1.0 / (step[0] * step[0] + step[1] * step[1] + step[2] * step[2]);
      sum += weight * targets[other];
      weights += weight;
    }
  }
  if (weights > 0.0)
  {
    targets[node] = sum / weights;
  }
  return weights > 0.0;
}
}

//------------------------------------------------------------------------------
TargetField FillTargets(
  const ParameterCells& cells, const ParameterVoxels& voxels, int axis, const Execution& execution)
{
  TargetField targets(cells.Nodes()); // not initialised: the loop is the first to touch it
  ForEachSlab(cells.Size, cells.Size[2], execution.Part(0.0, 0.9),
    [&](Index k)
    {
      const Index begin = cells.NodeAt(0, 0, k);
      for (Index node = begin; node < begin + cells.Size[0] * cells.Size[1]; ++node)
      {
        targets[node] = Vector3d::Zero();
        if (cells.Known[node] == 2)
        {
          targets[node] = TargetAt(cells, voxels, axis, node);
        }
      }
    });
  // From the segment outwards, a layer of nodes at a time; nearer neighbours weigh more.
  std::vector<std::uint8_t> filled = cells.Known;
  std::vector<std::vector<Index>> layers(cells.Size[2]);
  for (bool more = true; more;)
  {
    ForEachSlab(cells.Size, cells.Size[2], execution.Part(0.9, 0.9),
      [&](Index k)
      {
        layers[k].clear();
        const Index begin = cells.NodeAt(0, 0, k);
        for (Index node = begin; node < begin + cells.Size[0] * cells.Size[1]; ++node)
        {
          if (filled[node] == 1 && FillFromNeighbours(cells, filled, node, targets))
          {
            layers[k].push_back(node);
          }
        }
      });
    more = false;
    for (const std::vector<Index>& layer : layers)
    {
      for (const Index node : layer)
      {
        filled[node] = 2;
        more = true;
      }
    }
  }
  return targets;
}
}
