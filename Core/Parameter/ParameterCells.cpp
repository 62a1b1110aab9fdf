// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ParameterCells.h"

#include "StencilMatrix.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace trivariate
{
namespace
{
// No octant of a cell weighs less, so that no unknown is left without a hold.
constexpr float LeastShare = 0.03F;
// Layers of nodes around the segment: the band and one without unknowns.
constexpr Index Room = 2;
constexpr Index CheckEvery = 1 << 20; // nodes, less than a second of work

void MarkSegment(const ParameterVoxels& voxels, ParameterCells& cells)
{
  cells.Known.assign(cells.Nodes(), 0);
  Index id = 0;
  for (Index k = 0; k < voxels.Size[2]; ++k)
  {
    for (Index j = 0; j < voxels.Size[1]; ++j)
    {
      for (Index i = 0; i < voxels.Size[0]; ++i, ++id)
      {
        if (voxels.Mask[id] != 0)
        {
          cells.Known[cells.NodeAt(i - cells.Low[0], j - cells.Low[1], k - cells.Low[2])] = 2;
        }
      }
    }
  }
}

// Of a row of cells, the cut ones.
struct CutRow
{
  std::vector<Index> Cells;
  std::vector<CellOctants> Octants;
  double Inside = 0.0; // in cells
};

CutRow CutRowOf(const InsideShares& inside, const std::vector<std::uint8_t>& isSampled, Index row,
  const ParameterCells& cells, std::vector<CellOctants>& octants, std::int32_t* cut)
{
  CutRow result;
  inside.Row(row, octants);
  for (Index i = 0; i + 1 < cells.Size[0]; ++i)
  {
    const Index cell = i + cells.Size[0] * row;
    bool segment = false;
    for (int c = 0; c < 8; ++c)
    {
      segment = segment || cells.Known[cells.Corner(cell, c)] == 2;
    }
    std::array<float, 8>& shares = octants[i].Shares;
    const auto [least, most] = std::minmax_element(shares.begin(), shares.end());
    if (*least > 1.0F - 1e-5F && isSampled[cell] == 0)
    {
      cut[i] = WholeCell;
      result.Inside += 1.0;
    }
    else if (segment || isSampled[cell] != 0 || *most > 1e-5F)
    {
      for (float& share : shares)
      {
        result.Inside += share / 8.0;
        share = std::max(share, LeastShare);
      }
      cut[i] = 0;
      result.Cells.push_back(cell);
      result.Octants.push_back(octants[i]);
    }
  }
  return result;
}

void MarkBand(ParameterCells& cells)
{
  for (Index cell = 0; cell < cells.Nodes(); ++cell)
  {
    for (int c = 0; c < 8 && cells.Cut[cell] != UnusedCell; ++c)
    {
      std::uint8_t& known = cells.Known[cells.Corner(cell, c)];
      known = std::max<std::uint8_t>(known, 1);
    }
  }
}

// The nodes reached from the first one over common cells; how many are not.
Index CountCutOff(const ParameterCells& cells, const Execution& execution)
{
  std::vector<std::uint8_t> seen(cells.Nodes(), 0), isCrossed(cells.Nodes(), 0);
  std::vector<Index> front;
  for (Index node = 0; node < cells.Nodes() && front.empty(); ++node)
  {
    if (cells.Known[node] != 0)
    {
      seen[node] = 1;
      front.push_back(node);
    }
  }
  const Index back = cells.NodeAt(1, 1, 1);
  for (Index reached = 0; !front.empty(); ++reached)
  {
    if (reached % CheckEvery == 0)
    {
      execution.Check(static_cast<double>(reached) / static_cast<double>(cells.Nodes()));
    }
    const Index node = front.back();
    front.pop_back();
    for (int c = 0; c < 8; ++c)
    {
      const Index cell = cells.Corner(node - back, c);
      if (cells.Cut[cell] == UnusedCell || isCrossed[cell] != 0)
      {
        continue;
      }
      isCrossed[cell] = 1;
      for (int d = 0; d < 8; ++d)
      {
        const Index other = cells.Corner(cell, d);
        if (seen[other] == 0)
        {
          seen[other] = 1;
          front.push_back(other);
        }
      }
    }
  }
  Index left = 0;
  for (Index node = 0; node < cells.Nodes(); ++node)
  {
    left += cells.Known[node] == 2 && seen[node] == 0 ? 1 : 0;
  }
  return left;
}
}

//------------------------------------------------------------------------------
Index ParameterCells::CellOf(const Eigen::Vector3d& place, Eigen::Vector3d& local) const
{
  Index at[3];
  for (int a = 0; a < 3; ++a)
  {
    at[a] = std::clamp<Index>(static_cast<Index>(std::floor(place[a])), 0, this->Size[a] - 2);
    local[a] = place[a] - static_cast<double>(at[a]);
  }
  return this->NodeAt(at[0], at[1], at[2]);
}

//------------------------------------------------------------------------------
ParameterCells BoxOfCells(const ParameterVoxels& voxels, const ParameterSurface& surface)
{
  ParameterCells cells;
  cells.Spacing = voxels.Spacing;
  std::array<Index, 3> low = voxels.Size, high = { -1, -1, -1 };
  Index id = 0;
  for (Index k = 0; k < voxels.Size[2]; ++k)
  {
    for (Index j = 0; j < voxels.Size[1]; ++j)
    {
      for (Index i = 0; i < voxels.Size[0]; ++i, ++id)
      {
        if (voxels.Mask[id] != 0)
        {
          low = { std::min(low[0], i), std::min(low[1], j), std::min(low[2], k) };
          high = { std::max(high[0], i), std::max(high[1], j), std::max(high[2], k) };
        }
      }
    }
  }
  if (high[0] < 0)
  {
    throw std::invalid_argument("The segment has no voxels.");
  }
  for (const Eigen::Vector3d& point : surface.Points)
  {
    for (int a = 0; a < 3; ++a)
    {
      const double place = point[a] / voxels.Spacing[a];
      if (!(place > static_cast<double>(low[a]) - 2.0 &&
            place < static_cast<double>(high[a]) + 2.0))
      {
        std::ostringstream message;
        message << "The surface goes "
                << (a == 0    ? "along x"
                     : a == 1 ? "along y"
                              : "along z")
                << " to voxel " << place << ", the segment from " << low[a] << " to " << high[a]
                << ": it is not the surface of this segment.";
        throw std::invalid_argument(message.str());
      }
    }
  }
  for (int a = 0; a < 3; ++a)
  {
    cells.Low[a] = low[a] - Room - 1;
    cells.Size[a] = high[a] - low[a] + 1 + 2 * (Room + 1);
  }
  return cells;
}

//------------------------------------------------------------------------------
void FindCells(const ParameterVoxels& voxels, const ParameterSurface& surface,
  const std::vector<Index>& sampled, ParameterCells& cells, const Execution& execution)
{
  MarkSegment(voxels, cells);
  std::vector<Eigen::Vector3d> places;
  for (const Eigen::Vector3d& point : surface.Points)
  {
    places.push_back(cells.PlaceOf(point));
  }
  std::vector<std::uint8_t> isSampled(cells.Nodes(), 0);
  for (const Index cell : sampled)
  {
    isSampled[cell] = 1;
  }
  execution.Check(0.2);
  const InsideShares inside(
    places, surface.Triangles, { cells.Size[0] - 1, cells.Size[1], cells.Size[2] });
  cells.Cut.assign(cells.Nodes(), UnusedCell);
  const Index rows = cells.Size[1] * cells.Size[2];
  std::vector<CutRow> cutRows(rows);
  ForEachSlab(cells.Size, cells.Size[2] - 1, execution.Part(0.4, 0.8),
    [&](Index k)
    {
      std::vector<CellOctants> octants;
      for (Index j = 0; j + 1 < cells.Size[1]; ++j)
      {
        const Index row = j + cells.Size[1] * k;
        cutRows[row] =
          CutRowOf(inside, isSampled, row, cells, octants, cells.Cut.data() + cells.Size[0] * row);
      }
    });
  execution.Check(0.8);
  double volume = 0.0;
  for (const CutRow& row : cutRows)
  {
    for (std::size_t c = 0; c < row.Cells.size(); ++c)
    {
      cells.Cut[row.Cells[c]] = static_cast<std::int32_t>(cells.CutCells.size());
      cells.CutCells.push_back(row.Octants[c]);
    }
    volume += row.Inside;
  }
  const double count =
    static_cast<double>(std::count(cells.Known.begin(), cells.Known.end(), std::uint8_t(2)));
  if (!(volume > 0.3 * count && volume < 3.0 * count))
  {
    std::ostringstream message;
    message << "The surface encloses " << volume << " voxels, the segment has " << count
            << ": it is not the surface of this segment, or it is inside out.";
    throw std::invalid_argument(message.str());
  }
  MarkBand(cells);
  if (const Index left = CountCutOff(cells, execution.Part(0.9, 1.0)))
  {
    throw std::invalid_argument("The segment is in pieces: " + std::to_string(left) +
                                " of its voxels do not hang together with the others.");
  }
  execution.Check(1.0);
}
}
