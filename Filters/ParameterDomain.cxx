// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ParameterDomain.h"

#include "LatticeSurface.h"
#include "MemoryLimit.h"
#include "Parameter/BlockLocation.h"
#include "Parameter/FineVoxels.h"
#include "Parameter/ThinParts.h"

#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>
#include <string>

namespace trivariate
{
using Eigen::Vector3d;

namespace
{
// Voxels farther from the block mesh than so many of their sides have no parameter.
constexpr double FarthestFromMesh = 1.5;

constexpr double ThinPart = 0.05; // of the work on a segment: to look for thin parts

// Twice what solving takes (vtkVolumeParameterization), for it is not the only one.
constexpr double BytesPerFineVoxel = 320.0;
constexpr double BytesPerCell = 520.0; // of a block mesh while it is repaired

BlockComplex ComplexOf(const DomainInput& input)
{
  std::vector<LatticePoint> places;
  for (const BlockPoints& block : input.Domain.Blocks)
  {
    places.push_back(input.Coordinates[block[0]]);
  }
  // Groups that had to be split are numbered anew: again, so that whoever reads the new groups
  // finds the same places for them.
  const BlockComplex first(input.Domain.Blocks, input.Domain.Segments, input.Groups, places);
  return BlockComplex(input.Domain.Blocks, input.Domain.Segments, first.Groups, places);
}

// Frames in the axes of the grid.
ParameterVoxels VoxelsOf(
  const ImageSamples& samples, const GridSpace& space, const std::vector<std::uint8_t>& mask)
{
  const Index count = samples.Count();
  return { { samples.Points(0), samples.Points(1), samples.Points(2) }, space.Spacing, mask.data(),
    [&samples, count, axes = space.Axes](Index id) -> Eigen::Matrix3d
    {
      Eigen::Matrix3d frame;
      for (int c = 0; c < 9; ++c)
      {
        frame(c / 3, c % 3) = samples.Values[(c + 1) * count + id];
      }
      return frame * axes;
    } };
}

std::vector<std::uint8_t> MaskOf(const ImageSamples& samples, int segment)
{
  std::vector<std::uint8_t> mask(samples.Count());
  std::transform(samples.Values.begin(), samples.Values.begin() + samples.Count(), mask.begin(),
    [segment](double label) { return static_cast<std::uint8_t>(label == segment ? 1 : 0); });
  return mask;
}

// On voxels of half the size where parts are thin and there is memory for it. What cannot be solved
// for there is tried on those of the image, in which the error is told.
VoxelParameter SolveSegment(const ParameterVoxels& voxels, const ParameterSurface& surface,
  const ParameterSettings& settings, ThinParts& thin, const Execution& execution)
{
  const double bytes = BytesPerFineVoxel * static_cast<double>(CountFineVoxels(voxels.Size));
  thin.Refined = settings.RefinesThinParts && thin.Share > MostThin &&
                 MemoryFault("The finer grid", bytes).empty();
  if (thin.Refined)
  {
    try
    {
      return SolveOnFineVoxels(voxels, surface, settings.Options, execution.Part(0.0, 0.9));
    }
    catch (const std::logic_error&)
    {
    }
    catch (const std::runtime_error&)
    {
    }
    thin.Refined = false;
  }
  return SolveVoxelParameter(
    voxels, surface, settings.Options, execution.Part(thin.Share > MostThin ? 0.9 : 0.0, 1.0));
}

void SolveSegments(const ImageSamples& samples, vtkPolyData* patches, const GridSpace& space,
  const ParameterSettings& settings, ParameterDomain& domain, const Execution& execution)
{
  const std::vector<int>& owners = domain.Input.Domain.Segments;
  const std::set<int> segments(owners.begin(), owners.end());
  std::size_t done = 0;
  for (const int segment : segments)
  {
    const double share = 1.0 / static_cast<double>(segments.size());
    const double from = share * static_cast<double>(done++);
    try
    {
      const std::vector<std::uint8_t> mask = MaskOf(samples, segment);
      ThinParts& thin = domain.Thin[segment];
      thin.Share = ThinShare(mask, { samples.Points(0), samples.Points(1), samples.Points(2) },
        execution.Part(from, from + ThinPart * share));
      const ParameterSurface surface = LatticeSurfaceOf(patches, domain.Input, segment, space);
      if (surface.Triangles.empty())
      {
        continue;
      }
      const Execution solving = execution.Part(from + ThinPart * share, from + share);
      const VoxelParameter& solved =
        domain.Solved
          .emplace(
            segment, SolveSegment(VoxelsOf(samples, space, mask), surface, settings, thin, solving))
          .first->second;
      domain.Folds[segment] = CountFolds(solved, space.IsMirrored() ? -1.0 : 1.0, solving);
    }
    catch (const std::invalid_argument& error)
    {
      throw std::invalid_argument("Segment " + std::to_string(segment) + ": " + error.what());
    }
    catch (const std::runtime_error& error)
    {
      throw std::runtime_error("Segment " + std::to_string(segment) + ": " + error.what());
    }
  }
}

// Places in the block mesh, each voxel's in the blocks of its own segment.
void LocateVoxels(const ImageSamples& samples, const GridSpace& space, ParameterDomain& domain,
  const Execution& execution)
{
  std::map<int, std::vector<Index>> blocksOf, voxelsOf; // each segment
  for (std::size_t b = 0; b < domain.Input.Domain.Segments.size(); ++b)
  {
    blocksOf[domain.Input.Domain.Segments[b]].push_back(static_cast<Index>(b));
  }
  const Index count = samples.Count();
  for (Index id = 0; id < count; ++id)
  {
    const int segment = static_cast<int>(samples.Values[id]);
    if (blocksOf.count(segment) != 0)
    {
      voxelsOf[segment].push_back(id);
    }
  }
  domain.Parameter.assign(3 * count, 0.0);
  domain.Block.assign(count, -1);
  domain.Mask.assign(count, 0);
  double done = 0.0;
  for (const auto& [segment, voxels] : voxelsOf)
  {
    std::vector<Vector3d> points;
    for (const Index id : voxels)
    {
      const Index nx = samples.Points(0), ny = samples.Points(1);
      const Vector3d index(static_cast<double>(id % nx), static_cast<double>(id / nx % ny),
        static_cast<double>(id / (nx * ny)));
      points.push_back(space.ToSpace(index.cwiseProduct(space.Spacing)));
    }
    const double next = done + 1.0 / static_cast<double>(voxelsOf.size());
    const std::vector<BlockLocation> locations = LocateInBlocks(domain.Mesh, blocksOf[segment],
      points, FarthestFromMesh * space.Spacing.maxCoeff(), execution.Part(done, next));
    done = next;
    for (std::size_t v = 0; v < voxels.size(); ++v)
    {
      const BlockLocation& location = locations[v];
      if (location.Block >= 0)
      {
        const LatticePoint& origin = domain.Complex.Origins[location.Block];
        for (int a = 0; a < 3; ++a)
        {
          domain.Parameter[3 * voxels[v] + a] = origin[a] + location.Parameter[a];
        }
        domain.Block[voxels[v]] = domain.Complex.Groups[location.Block];
        domain.Mask[voxels[v]] = 1;
      }
    }
  }
}

// The solved parameters of all segments on the voxels of the image.
void CollectSolved(const ImageSamples& samples, ParameterDomain& domain)
{
  const Index nx = samples.Points(0), ny = samples.Points(1);
  domain.FrameParameter.assign(3 * samples.Count(), 0.0);
  domain.FrameMask.assign(samples.Count(), 0);
  for (Index id = 0; id < samples.Count(); ++id)
  {
    const auto solved = domain.Solved.find(static_cast<int>(samples.Values[id]));
    const Index at = solved == domain.Solved.end()
                       ? -1
                       : solved->second.At({ id % nx, id / nx % ny, id / (nx * ny) });
    if (at >= 0 && solved->second.Known[at] == KnownInSegment)
    {
      std::copy_n(&solved->second.Values[3 * at], 3, &domain.FrameParameter[3 * id]);
      domain.FrameMask[id] = 1;
    }
  }
}
}

//------------------------------------------------------------------------------
ParameterDomain ParameterizeDomain(const ImageSamples& samples, vtkPolyData* patches,
  vtkUnstructuredGrid* polycube, const ParameterSettings& settings, const Execution& execution)
{
  const GridSpace space(samples.IndexToPhysical, samples.Extent);
  ParameterDomain domain{ ReadDomain(patches, polycube), {}, {}, {}, {}, {}, {}, {}, {}, {}, {},
    {} };
  domain.Complex = ComplexOf(domain.Input);
  BlockMeshOptions options;
  options.CellLength = settings.CellLength * std::cbrt(space.Spacing.prod());
  options.Freedom = FreedomOfNodes * space.Spacing.minCoeff();
  const std::string lack = MemoryFault("The block mesh (a larger CellLength needs less)",
    BytesPerCell * CountCells(SizesOf(domain.Input.Domain, options)));
  if (!lack.empty())
  {
    throw std::invalid_argument(lack);
  }
  SolveSegments(samples, patches, space, settings, domain, execution.Part(0.0, 0.3));
  CollectSolved(samples, domain);
  domain.Mesh =
    MakeBlockMesh(domain.Input.Domain, options, execution.Part(0.3, 0.9), &domain.Report);
  LocateVoxels(samples, space, domain, execution.Part(0.9, 1.0));
  return domain;
}
}
