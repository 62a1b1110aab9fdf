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
constexpr float SurfaceWeight = 25.0f;

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
ScatteredSamples SamplesOfShape(const BlockComplex& blocks, const ShapeSamples& shape)
{
  ScatteredSamples samples;
  samples.Parameters = shape.Parameters;
  samples.Components = 3;
  const Index n = samples.Count();
  std::vector<char> onSurface(n, 0);
  for (Index i = 0; i < n; ++i)
  {
    const double* p = &samples.Parameters[3 * i];
    const Index b = blocks.BlockAt({ p[0], p[1], p[2] });
    for (int face = 0; b >= 0 && face < 6; ++face)
    {
      const int a = face / 2, side = face % 2;
      const FaceTwin& twin = blocks.Twin({ b, a, side });
      const bool isOuter = !twin.Exists() || blocks.Segments[twin.Face.Block] != blocks.Segments[b];
      onSurface[i] |= isOuter && p[a] == blocks.Origins[b][a] + side;
    }
    samples.Weights.push_back(onSurface[i] ? SurfaceWeight : 1.0f);
  }
  for (int a = 0; a < 3; ++a)
  {
    for (Index i = 0; i < n; ++i)
    {
      samples.Values.push_back(shape.Places[3 * i + a]);
    }
  }
  return samples;
}
}
