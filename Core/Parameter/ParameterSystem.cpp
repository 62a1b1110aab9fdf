// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ParameterSystem.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace trivariate
{
using Eigen::Vector3d;

namespace
{
// An integration point of a cell.
struct CellPoint
{
  CellPoint() = default;
  // local: where in the cell, each in [0, 1].
  CellPoint(const Vector3d& local, const Vector3d& spacing, double weight)
    : Weight(weight)
  {
    for (int c = 0; c < 8; ++c)
    {
      Vector3d value, slope;
      for (int a = 0; a < 3; ++a)
      {
        const bool high = (c >> a & 1) != 0;
        value[a] = high ? local[a] : 1.0 - local[a];
        slope[a] = (high ? 1.0 : -1.0) / spacing[a];
      }
      this->Values[c] = value.prod();
      this->Gradients.col(c) = Vector3d(slope[0] * value[1] * value[2],
        value[0] * slope[1] * value[2], value[0] * value[1] * slope[2]);
    }
  }

  // The target there.
  Vector3d Target(const ParameterCells& cells, const TargetField& targets, Index cell) const
  {
    Vector3d target = Vector3d::Zero();
    for (int c = 0; c < 8; ++c)
    {
      target += this->Values[c] * targets[cells.Corner(cell, c)];
    }
    return target;
  }

  double Weight = 0.0;                   // the volume that it stands for
  std::array<double, 8> Values{};        // of the corners' functions
  Eigen::Matrix<double, 3, 8> Gradients; // of the corners' functions
};

using CellPoints = std::array<CellPoint, 8>;

// Gauss's points in whole cells, the middles of what is inside of the octants in cut ones.
class Integration
{
public:
  explicit Integration(const ParameterCells& cells)
    : Cells(cells)
  {
    for (int g = 0; g < 8; ++g)
    {
      const Vector3d sides(g & 1 ? 1.0 : -1.0, g & 2 ? 1.0 : -1.0, g & 4 ? 1.0 : -1.0);
      this->Whole[g] = CellPoint(Vector3d::Constant(0.5) + 0.5 / std::sqrt(3.0) * sides,
        cells.Spacing, cells.Spacing.prod() / 8.0);
    }
  }

  const CellPoints& WholePoints() const { return this->Whole; }

  // The points of any cell; `memory` may hold them.
  const CellPoints& PointsOf(Index cell, CellPoints& memory) const
  {
    if (this->Cells.Cut[cell] == WholeCell)
    {
      return this->Whole;
    }
    const CellOctants& octants = this->Cells.CutCells[this->Cells.Cut[cell]];
    for (int g = 0; g < 8; ++g)
    {
      const std::array<float, 3>& m = octants.Middles[g];
      memory[g] = CellPoint(
        Vector3d(m[0], m[1], m[2]), this->Cells.Spacing, octants.Shares[g] * this->Whole[g].Weight);
    }
    return memory;
  }

private:
  const ParameterCells& Cells;
  CellPoints Whole;
};

using CellMatrix = Eigen::Matrix<double, 8, 8>;

// Visits the slabs of cells: first the even ones, then the odd ones, so that no node belongs to two
// at a time.
template <typename Visit>
void ForEachSlabByTurns(const ParameterCells& cells, const Execution& execution, const Visit& visit)
{
  for (Index parity = 0; parity < 2; ++parity)
  {
    ForEachSlab(cells.Size, (cells.Size[2] - 1 - parity + 1) / 2,
      execution.Part(0.5 * static_cast<double>(parity), 0.5 * static_cast<double>(parity + 1)),
      [&](Index slab) { visit(2 * slab + parity); });
  }
}

template <typename Visit>
void ForEachCell(const ParameterCells& cells, const Execution& execution, const Visit& visit)
{
  ForEachSlabByTurns(cells, execution,
    [&](Index slab)
    {
      const Index begin = cells.NodeAt(0, 0, slab);
      for (Index cell = begin; cell < begin + cells.Size[0] * cells.Size[1]; ++cell)
      {
        if (cells.Cut[cell] != UnusedCell)
        {
          visit(cell);
        }
      }
    });
}

// The place in a row of corner `to` for corner `from`.
int PlaceInRow(int from, int to)
{
  const auto step = [from, to](int a) { return (to >> a & 1) - (from >> a & 1) + 1; };
  return step(0) + 3 * step(1) + 9 * step(2);
}

void AddToRows(const ParameterCells& cells, Index cell, const CellMatrix& matrix,
  const std::vector<std::int32_t>& rowOf, std::vector<StencilRow>& rows)
{
  for (int a = 0; a < 8; ++a)
  {
    const std::int32_t row = rowOf[cells.Corner(cell, a)];
    for (int b = 0; b < 8 && row >= 0; ++b)
    {
      rows[row][PlaceInRow(a, b)] += matrix(a, b);
    }
  }
}

// Common where all eight cells around a node are whole, and the norm is the same everywhere.
std::vector<std::int32_t> NumberRows(const ParameterCells& cells, bool uniform)
{
  std::vector<std::int32_t> rowOf(cells.Nodes(), NoUnknown);
  const Index back = cells.NodeAt(1, 1, 1);
  std::int32_t rows = 0;
  for (Index node = 0; node < cells.Nodes(); ++node)
  {
    if (cells.Known[node] == 0)
    {
      continue;
    }
    bool common = uniform;
    for (int c = 0; c < 8 && common; ++c)
    {
      common = cells.Cut[cells.Corner(node - back, c)] == WholeCell;
    }
    rowOf[node] = common ? CommonRow : rows++;
  }
  return rowOf;
}

// Samples by the slab of their cells: those of slab k begin at Begin[k], in their order.
struct SamplesOfSlabs
{
  SamplesOfSlabs(const ParameterCells& cells, const PlaneSamples& samples)
    : Begin(cells.Size[2] + 1, 0)
    , Samples(samples.Samples.size())
  {
    const Index slab = cells.Size[0] * cells.Size[1];
    for (const PlaneSample& sample : samples.Samples)
    {
      ++this->Begin[sample.Cell / slab + 1];
    }
    std::partial_sum(this->Begin.begin(), this->Begin.end(), this->Begin.begin());
    std::vector<Index> next(this->Begin.begin(), this->Begin.end() - 1);
    for (const PlaneSample& sample : samples.Samples)
    {
      this->Samples[next[sample.Cell / slab]++] = &sample;
    }
  }

  template <typename Visit>
  void ForEach(Index slab, const Visit& visit) const
  {
    for (Index s = this->Begin[slab]; s < this->Begin[slab + 1]; ++s)
    {
      visit(*this->Samples[s]);
    }
  }

  std::vector<Index> Begin;
  std::vector<const PlaneSample*> Samples;
};

// The links of the nodes of a slab: summed up for all its nodes and planes from the cells below and
// above.
std::vector<StencilMatrix::Link> LinksOfSlab(const ParameterCells& cells,
  const SamplesOfSlabs& samples, Index slab, Index planes, double stiffness)
{
  const Index nodes = cells.Size[0] * cells.Size[1];
  std::vector<StencilMatrix::Link> links;
  std::vector<double> sums;
  for (Index below = std::max<Index>(0, slab - 1); below <= slab; ++below)
  {
    samples.ForEach(below,
      [&](const PlaneSample& sample)
      {
        if (sample.Plane == 0)
        {
          return;
        }
        sums.resize(nodes * planes, 0.0);
        const std::array<double, 8> corners = sample.CornerWeights();
        for (int c = below < slab ? 4 : 0; c < (below < slab ? 8 : 4); ++c)
        {
          const Index node = cells.Corner(sample.Cell, c) - nodes * slab;
          sums[planes * node + sample.Plane - 1] -= stiffness * sample.Weight * corners[c];
        }
      });
  }
  for (std::size_t s = 0; s < sums.size(); ++s)
  {
    if (sums[s] != 0.0)
    {
      const Index at = static_cast<Index>(s);
      links.push_back(
        { nodes * slab + at / planes, static_cast<std::int32_t>(at % planes), sums[s] });
    }
  }
  return links;
}

void AddPenalty(const ParameterCells& cells, const PlaneSamples& samples, double stiffness,
  const std::vector<std::int32_t>& rowOf, StencilMatrix& matrix, const Execution& execution)
{
  const Index planes = static_cast<Index>(samples.Coordinates.size()) - 1;
  const SamplesOfSlabs slabs(cells, samples);
  ForEachSlabByTurns(cells, execution.Part(0.0, 0.6),
    [&](Index slab)
    {
      slabs.ForEach(slab,
        [&](const PlaneSample& sample)
        {
          const std::array<double, 8> corners = sample.CornerWeights();
          const Eigen::Map<const Eigen::Matrix<double, 8, 1>> n(corners.data());
          AddToRows(
            cells, sample.Cell, stiffness * sample.Weight * n * n.transpose(), rowOf, matrix.Rows);
        });
    });
  std::vector<std::vector<StencilMatrix::Link>> links(cells.Size[2]);
  ForEachSlab(cells.Size, cells.Size[2], execution.Part(0.6, 1.0),
    [&](Index slab) { links[slab] = LinksOfSlab(cells, slabs, slab, planes, stiffness); });
  for (const std::vector<StencilMatrix::Link>& list : links)
  {
    matrix.Links.insert(matrix.Links.end(), list.begin(), list.end());
  }
  matrix.PlaneDiagonal.assign(planes, 0.0);
  for (const PlaneSample& sample : samples.Samples)
  {
    if (sample.Plane > 0)
    {
      matrix.PlaneDiagonal[sample.Plane - 1] += stiffness * sample.Weight;
    }
  }
}
}

//------------------------------------------------------------------------------
StencilMatrix AssembleMatrix(const ParameterCells& cells, const PlaneSamples& samples,
  const TargetField& targets, double epsilon, double energy, double stiffness,
  const Execution& execution)
{
  const Integration integration(cells);
  StencilMatrix matrix;
  matrix.Size = cells.Size;
  CellMatrix whole = CellMatrix::Zero();
  for (const CellPoint& point : integration.WholePoints())
  {
    whole += energy * point.Weight * point.Gradients.transpose() * point.Gradients;
  }
  for (int c = 0; c < 8; ++c)
  {
    for (int low = 0; low < 8; ++low)
    {
      // Cells that have both a node and its neighbour c as corners.
      matrix.Common[c] += (low & c) == 0 ? whole(low, low | c) : 0.0;
    }
  }
  const std::vector<std::int32_t> rowOf = NumberRows(cells, epsilon == 1.0);
  matrix.SetRows(rowOf);
  ForEachCell(cells, execution.Part(0.1, 0.9),
    [&](Index cell)
    {
      if (epsilon == 1.0 && cells.Cut[cell] == WholeCell)
      {
        AddToRows(cells, cell, whole, rowOf, matrix.Rows);
        return;
      }
      CellPoints memory;
      CellMatrix sum = CellMatrix::Zero();
      for (const CellPoint& point : integration.PointsOf(cell, memory))
      {
        sum += energy * point.Weight * point.Gradients.transpose() * point.Gradients;
        if (epsilon != 1.0)
        {
          const Eigen::Matrix<double, 8, 1> along =
            point.Gradients.transpose() * point.Target(cells, targets, cell).normalized();
          sum -= energy * (1.0 - epsilon) * point.Weight * along * along.transpose();
        }
      }
      AddToRows(cells, cell, sum, rowOf, matrix.Rows);
    });
  AddPenalty(cells, samples, stiffness, rowOf, matrix, execution.Part(0.9, 1.0));
  return matrix;
}

//------------------------------------------------------------------------------
std::vector<double> AssembleRightHandSide(const ParameterCells& cells, const TargetField& targets,
  double epsilon, Index planes, const Execution& execution)
{
  const Integration integration(cells);
  std::vector<double> b(cells.Nodes() + planes, 0.0);
  ForEachCell(cells, execution,
    [&](Index cell)
    {
      CellPoints memory;
      Eigen::Matrix<double, 8, 1> sum = Eigen::Matrix<double, 8, 1>::Zero();
      for (const CellPoint& point : integration.PointsOf(cell, memory))
      {
        // D f is epsilon f.
        sum +=
          epsilon * point.Weight * point.Gradients.transpose() * point.Target(cells, targets, cell);
      }
      for (int c = 0; c < 8; ++c)
      {
        b[cells.Corner(cell, c)] += sum[c];
      }
    });
  return b;
}

//------------------------------------------------------------------------------
std::vector<double> DeviationsAt(
  const ParameterCells& cells, const PlaneSamples& samples, const std::vector<double>& u)
{
  std::vector<double> deviations;
  deviations.reserve(samples.Samples.size());
  for (const PlaneSample& sample : samples.Samples)
  {
    const std::array<double, 8> weights = sample.CornerWeights();
    double value = sample.Plane > 0 ? -u[cells.Nodes() + sample.Plane - 1] : 0.0;
    for (int c = 0; c < 8; ++c)
    {
      value += weights[c] * u[cells.Corner(sample.Cell, c)];
    }
    deviations.push_back(value);
  }
  return deviations;
}
}
