// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "BlockFitInput.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace trivariate
{
namespace
{
void CheckParameters(
  const BlockComplex& blocks, const std::vector<double>& parameters, const std::string& whose)
{
  for (std::size_t i = 0; i < parameters.size() / 3; ++i)
  {
    const double* p = &parameters[3 * i];
    if (!std::isfinite(p[0] + p[1] + p[2]) || blocks.BlockAt({ p[0], p[1], p[2] }) < 0)
    {
      throw std::invalid_argument("The parameter of " + whose + std::to_string(i) + ", (" +
                                  std::to_string(p[0]) + ", " + std::to_string(p[1]) + ", " +
                                  std::to_string(p[2]) + "), is in no block of the domain.");
    }
  }
}
}

//------------------------------------------------------------------------------
void CheckBlockFit(const BlockComplex& blocks, const BlockSamples& voxels,
  const ShapeSamples& shape, const BlockFitOptions& options)
{
  const auto fail = [](const std::string& what) { throw std::invalid_argument(what); };
  if (voxels.Count() == 0)
  {
    fail("The domain has no voxel to fit.");
  }
  if (!(options.RmsTolerance >= 0.0) || !(options.MaximumErrorTolerance >= 0.0) ||
      !(options.ShapeTolerance >= 0.0) || !(options.Spacing > 0.0))
  {
    fail("A tolerance is negative or not a number, or the distance of voxels is not positive.");
  }
  if (options.Rule == Refinement::Uniform)
  {
    fail("Over a domain splines are refined: choose the compact or the analysis-suitable rule, or "
         "disconnect the polycube for one uniform mesh.");
  }
  if (voxels.Parameters.empty() && shape.Parameters.empty())
  {
    fail("The voxels have no parameters, and there is no shape to find them from.");
  }
  CheckParameters(blocks, voxels.Parameters, "voxel ");
  CheckParameters(blocks, shape.Parameters, "sample of the shape ");
}

//------------------------------------------------------------------------------
int KnotDepth(const BlockComplex& blocks, const ShapeSamples& shape, double spacing)
{
  std::vector<std::array<double, 6>> bounds(
    blocks.Size(), { 1e300, -1e300, 1e300, -1e300, 1e300, -1e300 });
  for (std::size_t i = 0; i < shape.Parameters.size() / 3; ++i)
  {
    const double* p = &shape.Parameters[3 * i];
    std::array<double, 6>& box = bounds[blocks.BlockAt({ p[0], p[1], p[2] })];
    for (int a = 0; a < 3; ++a)
    {
      box[2 * a] = std::min(box[2 * a], shape.Places[3 * i + a]);
      box[2 * a + 1] = std::max(box[2 * a + 1], shape.Places[3 * i + a]);
    }
  }
  double longest = 1.0;
  for (const auto& box : bounds)
  {
    longest = std::max({ longest, box[1] - box[0], box[3] - box[2], box[5] - box[4] });
  }
  const LatticePoint extent = blocks.Extent();
  const double boxes = double(extent[0]) * extent[1] * extent[2];
  int depth = 1;
  while (depth < 8 && spacing * (1 << depth) < longest && boxes * std::pow(8.0, depth + 1) < 128e6)
  {
    ++depth;
  }
  return depth;
}

//------------------------------------------------------------------------------
void AddSamplesOfBlock(const BlockComplex& blocks, Index b, const std::array<int, 3>& intervals,
  const std::function<std::array<double, 3>(const std::array<double, 3>&)>& place,
  ShapeSamples& shape)
{
  const auto first = static_cast<Index>(shape.Places.size() / 3);
  const std::array<Index, 3> steps{ 1, intervals[0] + 1,
    Index(intervals[0] + 1) * (intervals[1] + 1) };
  for (Index m = 0; m < steps[2] * (intervals[2] + 1); ++m)
  {
    const std::array<double, 3> local{ double(m % steps[1]) / intervals[0],
      double(m % steps[2] / steps[1]) / intervals[1], double(m / steps[2]) / intervals[2] };
    for (int a = 0; a < 3; ++a)
    {
      shape.Parameters.push_back(blocks.Origins[b][a] + local[a]);
    }
    const std::array<double, 3> x = place(local);
    shape.Places.insert(shape.Places.end(), x.begin(), x.end());
  }
  for (int face = 0; face < 6; ++face)
  {
    const int axis = face / 2, side = face % 2;
    const FaceTwin& twin = blocks.Twin({ b, axis, side });
    if (twin.Exists() && blocks.Segments[twin.Face.Block] == blocks.Segments[b])
    {
      continue;
    }
    // The two directions along the face, right-handed with the one out of the block.
    const int s = (axis + 2 - side) % 3, t = (axis + 1 + side) % 3;
    for (int i = 0; i < intervals[s]; ++i)
    {
      for (int j = 0; j < intervals[t]; ++j)
      {
        const Index corner =
          first + side * intervals[axis] * steps[axis] + i * steps[s] + j * steps[t];
        const Index opposite = corner + steps[s] + steps[t];
        shape.Surface.push_back({ corner, corner + steps[s], opposite });
        shape.Surface.push_back({ corner, opposite, corner + steps[t] });
      }
    }
  }
}
}
