// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "CoarsePolycube.h"

#include "CellShape.h"
#include "SolidGrid.h"

#include <algorithm>
#include <set>

namespace trivariate
{
namespace
{
using Eigen::Vector3d;

constexpr int GridCells = 64; // along the longest axis
constexpr int MostSlabs = 8;  // along the longest axis
constexpr int LeastSlabs = 4; // along the others
constexpr int LeastWidth = 2; // of a slab, in cells of the grid
constexpr int MostRounds = 20;

// Planes[axis]: 0, those of the lattice, the end of the grid. Cells in the first and last slabs,
// which may be empty, are outside.
class Lattice
{
public:
  explicit Lattice(const SolidGrid& grid)
    : Grid(&grid)
  {
    const std::array<int, 3>& size = grid.Size();
    const int longest = *std::max_element(size.begin(), size.end());
    for (int axis = 0; axis < 3; ++axis)
    {
      const int slabs =
        std::max(1, std::min(size[axis] / LeastWidth,
                      std::max(LeastSlabs, (2 * MostSlabs * size[axis] + longest) / 2 / longest)));
      std::vector<int>& planes = this->Planes[axis];
      planes.push_back(0);
      for (int i = 0; i <= slabs; ++i)
      {
        planes.push_back(i * size[axis] / slabs);
      }
      planes.push_back(size[axis]);
    }
  }

  int Slabs(int axis) const { return static_cast<int>(this->Planes[axis].size()) - 3; }

  // Moves planes until none is better anywhere between its neighbours.
  void Settle()
  {
    bool moved = true;
    for (int round = 0; round < MostRounds && moved; ++round)
    {
      moved = false;
      for (int axis = 0; axis < 3; ++axis)
      {
        for (int i = 1; i <= this->Slabs(axis) + 1; ++i)
        {
          moved |= this->SettlePlane(axis, i);
        }
      }
    }
  }

  // The planes between slabs, [axis, plane].
  std::vector<std::array<int, 2>> InnerPlanes() const
  {
    std::vector<std::array<int, 2>> inner;
    for (int axis = 0; axis < 3; ++axis)
    {
      for (int i = 2; i <= this->Slabs(axis); ++i)
      {
        inner.push_back({ axis, i });
      }
    }
    return inner;
  }

  // How much more misfit there is without a plane.
  double Worth(const std::array<int, 2>& plane) const
  {
    const auto [axis, i] = plane;
    const std::vector<int>& planes = this->Planes[axis];
    return this->Misfit(axis, planes[i - 1], planes[i + 1], false) -
           this->Misfit(axis, planes[i - 1], planes[i], false) -
           this->Misfit(axis, planes[i], planes[i + 1], false);
  }

  void Remove(const std::array<int, 2>& plane)
  {
    this->Planes[plane[0]].erase(this->Planes[plane[0]].begin() + plane[1]);
  }

  // Two neighbouring slabs with the same cells become one.
  std::vector<LatticePoint> FullCells()
  {
    const std::array<int, 3> size{ this->Slabs(0), this->Slabs(1), this->Slabs(2) };
    std::vector<double> gains;
    std::array<int, 3> cell;
    for (cell[2] = 0; cell[2] < size[2]; ++cell[2])
    {
      for (cell[1] = 0; cell[1] < size[1]; ++cell[1])
      {
        for (cell[0] = 0; cell[0] < size[0]; ++cell[0])
        {
          gains.push_back(this->GainOf(cell));
        }
      }
    }
    std::vector<LatticePoint> cells = CellShape(size, std::move(gains)).Best();
    for (int axis = 0; axis < 3; ++axis)
    {
      this->MergeSlabs(axis, cells);
    }
    return cells;
  }

  double MisfitOf(const std::vector<LatticePoint>& cells) const
  {
    const double inside = this->Grid->Inside({ 0, 0, 0 }, this->Grid->Size());
    double misfit = inside;
    for (const LatticePoint& cell : cells)
    {
      misfit -= this->GainOf(cell);
    }
    return misfit / inside;
  }

  Vector3d Place(const LatticePoint& p) const
  {
    Vector3d place;
    for (int axis = 0; axis < 3; ++axis)
    {
      place[axis] = this->Planes[axis][p[axis] + 1];
    }
    return this->Grid->Place(place);
  }

private:
  // What speaks for a full cell.
  double GainOf(const std::array<int, 3>& cell) const
  {
    std::array<int, 3> low, high;
    for (int axis = 0; axis < 3; ++axis)
    {
      low[axis] = this->Planes[axis][cell[axis] + 1];
      high[axis] = this->Planes[axis][cell[axis] + 2];
    }
    return this->Grid->Inside(low, high) - this->Grid->Outside(low, high);
  }

  // Of a slab between two places: what its cells have too much or too little.
  double Misfit(int axis, int from, int to, bool outside) const
  {
    const int a = (axis + 1) % 3, b = (axis + 2) % 3;
    double sum = 0.0;
    std::array<int, 3> low, high;
    low[axis] = from;
    high[axis] = to;
    for (std::size_t i = 0; i + 1 < this->Planes[a].size(); ++i)
    {
      low[a] = this->Planes[a][i];
      high[a] = this->Planes[a][i + 1];
      const bool outsideA = outside || i == 0 || i + 2 == this->Planes[a].size();
      for (std::size_t j = 0; j + 1 < this->Planes[b].size(); ++j)
      {
        low[b] = this->Planes[b][j];
        high[b] = this->Planes[b][j + 1];
        const double inside = this->Grid->Inside(low, high);
        const bool isOutside = outsideA || j == 0 || j + 2 == this->Planes[b].size();
        sum += isOutside ? inside : std::min(inside, this->Grid->Outside(low, high));
      }
    }
    return sum;
  }

  bool SettlePlane(int axis, int i)
  {
    std::vector<int>& planes = this->Planes[axis];
    const bool first = i == 1, last = i + 2 == static_cast<int>(planes.size());
    const int low = planes[i - 1] + (first ? 0 : LeastWidth);
    const int high = planes[i + 1] - (last ? 0 : LeastWidth);
    const auto misfit = [&](int place)
    {
      return this->Misfit(axis, planes[i - 1], place, first) +
             this->Misfit(axis, place, planes[i + 1], last);
    };
    const int before = planes[i];
    double least = misfit(before);
    int best = before;
    for (int place = low; place <= high; ++place)
    {
      const double there = misfit(place);
      if (there < least - 1e-9)
      {
        least = there;
        best = place;
      }
    }
    planes[i] = best;
    return best != before;
  }

  void MergeSlabs(int axis, std::vector<LatticePoint>& cells)
  {
    for (int slab = this->Slabs(axis) - 1; slab >= 0; --slab)
    {
      // An empty slab at an end is outside.
      std::set<LatticePoint> here, below;
      for (LatticePoint cell : cells)
      {
        const int at = cell[axis];
        cell[axis] = 0;
        if (at == slab || at == slab - 1)
        {
          (at == slab ? here : below).insert(cell);
        }
      }
      if (here == below || (slab == 0 && here.empty()))
      {
        this->Planes[axis].erase(this->Planes[axis].begin() + slab + 1);
        std::vector<LatticePoint> left;
        for (LatticePoint cell : cells)
        {
          if (cell[axis] != slab)
          {
            cell[axis] -= cell[axis] > slab;
            left.push_back(cell);
          }
        }
        cells = std::move(left);
      }
    }
    while (this->Slabs(axis) > 1 && std::none_of(cells.begin(), cells.end(),
                                      [this, axis](const LatticePoint& cell)
                                      { return cell[axis] == this->Slabs(axis) - 1; }))
    {
      this->Planes[axis].erase(this->Planes[axis].end() - 2);
    }
  }

  const SolidGrid* Grid;
  std::array<std::vector<int>, 3> Planes;
};
}

//------------------------------------------------------------------------------
std::vector<CoarsePolycube> FindCoarsePolycubes(const SurfaceMesh& mesh,
  const Eigen::Matrix3d& frame, Index mostCubes, const Execution& execution)
{
  const SolidGrid grid(mesh, frame, GridCells);
  std::vector<CoarsePolycube> found;
  if (grid.Inside({ 0, 0, 0 }, grid.Size()) == 0.0)
  {
    return found;
  }
  const auto consider = [&](Lattice lattice)
  {
    lattice.Settle();
    const Lattice settled = lattice;
    const std::vector<LatticePoint> cells = lattice.FullCells();
    if (static_cast<Index>(cells.size()) <= mostCubes)
    {
      CoarsePolycube coarse{ Polycube(cells), {}, lattice.MisfitOf(cells) };
      for (Index corner = 0; corner < coarse.Cubes.NumberOfCorners; ++corner)
      {
        coarse.Corners.push_back(lattice.Place(coarse.Cubes.Points[corner]));
      }
      found.push_back(std::move(coarse));
    }
    return settled;
  };
  Lattice lattice = consider(Lattice(grid));
  const auto stages = static_cast<double>(lattice.InnerPlanes().size() + 1);
  for (auto planes = lattice.InnerPlanes(); !planes.empty(); planes = lattice.InnerPlanes())
  {
    execution.Check(1.0 - double(planes.size() + 1) / stages);
    std::vector<std::pair<double, Lattice>> without;
    for (const std::array<int, 2>& plane : planes)
    {
      Lattice fewer = lattice;
      fewer.Remove(plane);
      without.emplace_back(lattice.Worth(plane), consider(std::move(fewer)));
    }
    lattice = std::min_element(without.begin(), without.end(),
      [](const auto& a, const auto& b) {
        return a.first < b.first;
      })->second;
  }
  std::stable_sort(found.begin(), found.end(),
    [](const CoarsePolycube& a, const CoarsePolycube& b)
    {
      return a.Cubes.NumberOfCorners != b.Cubes.NumberOfCorners
               ? a.Cubes.NumberOfCorners < b.Cubes.NumberOfCorners
               : a.Misfit < b.Misfit;
    });
  std::vector<CoarsePolycube> best;
  for (CoarsePolycube& coarse : found)
  {
    if (best.empty() || coarse.Misfit < best.back().Misfit)
    {
      best.push_back(std::move(coarse));
    }
  }
  return best;
}
}
