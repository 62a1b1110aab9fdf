// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "VoxelMask.h"

#include <algorithm>
#include <numeric>

namespace trivariate
{
namespace
{
// The voxels that the supports of two functions share, [Begin, End) in each direction.
struct VoxelBox
{
  std::array<Index, 3> Begin, End;

  VoxelBox(const FunctionTable& table, Index i, Index j)
  {
    for (int a = 0; a < 3; ++a)
    {
      const SampledFunction& f = table.Factor(i, a).Samples;
      const SampledFunction& g = table.Factor(j, a).Samples;
      this->Begin[a] = std::max(f.first, g.first);
      this->End[a] = std::min(f.first + static_cast<Index>(f.second.size()),
        g.first + static_cast<Index>(g.second.size()));
    }
  }

  Index Count() const
  {
    return std::max<Index>(0, this->End[0] - this->Begin[0]) *
           std::max<Index>(0, this->End[1] - this->Begin[1]) *
           std::max<Index>(0, this->End[2] - this->Begin[2]);
  }
};

// The product of the factors in direction a at the voxels of a range.
std::vector<double> FactorProducts(
  const FunctionTable& table, const FunctionPair& pair, int a, Index begin, Index end)
{
  const SampledFunction& f = table.Factor(pair[0], a).Samples;
  const SampledFunction& g = table.Factor(pair[1], a).Samples;
  std::vector<double> products(std::max<Index>(0, end - begin));
  for (Index at = begin; at < end; ++at)
  {
    products[at - begin] = f.second[at - f.first] * g.second[at - g.first];
  }
  return products;
}

// Sums along x of one product of two factors, row by row, over the voxels that count.
class RowSums
{
public:
  explicit RowSums(const VoxelMask& mask)
    : Mask(mask)
    , Sums(mask.Size[1] * mask.Size[2])
  {
  }

  // For the rows [begin, end) of y and z; the factors in x are those of `pair`.
  void Take(const FunctionTable& table, const FunctionPair& pair, const VoxelBox& rows)
  {
    const Index first = rows.Begin[0], last = rows.End[0];
    const std::vector<double> products = FactorProducts(table, pair, 0, first, last);
    std::vector<double> running(products.size() + 1, 0.0);
    std::partial_sum(products.begin(), products.end(), running.begin() + 1);
    for (Index z = rows.Begin[2]; z < rows.End[2]; ++z)
    {
      for (Index y = rows.Begin[1]; y < rows.End[1]; ++y)
      {
        const Index row = z * this->Mask.Size[1] + y;
        double& sum = this->Sums[row];
        sum = 0.0;
        for (Index run = this->Mask.RowBegin[row]; run < this->Mask.RowBegin[row + 1]; ++run)
        {
          const Index begin = std::max<Index>(first, this->Mask.Runs[run][0]);
          const Index end = std::min<Index>(last, this->Mask.Runs[run][1]);
          sum += begin < end ? running[end - first] - running[begin - first] : 0.0;
        }
      }
    }
  }

  // The sums times the factors in y and z.
  double Product(const FunctionTable& table, const FunctionPair& pair, const VoxelBox& box) const
  {
    const std::vector<double> v = FactorProducts(table, pair, 1, box.Begin[1], box.End[1]);
    const std::vector<double> w = FactorProducts(table, pair, 2, box.Begin[2], box.End[2]);
    double sum = 0.0;
    for (Index z = box.Begin[2]; z < box.End[2]; ++z)
    {
      const double* row = &this->Sums[z * this->Mask.Size[1] + box.Begin[1]];
      sum += w[z - box.Begin[2]] * std::inner_product(v.begin(), v.end(), row, 0.0);
    }
    return sum;
  }

private:
  const VoxelMask& Mask;
  std::vector<double> Sums;
};

// The pairs in order of their factors in x, and where each group of equal ones begins.
struct PairGroups
{
  std::vector<Index> Order, Begin;

  PairGroups(const FunctionTable& table, const std::vector<FunctionPair>& pairs)
    : Order(pairs.size())
  {
    const auto key = [&table, &pairs](Index p)
    {
      const int f = table.Id(pairs[p][0], 0), g = table.Id(pairs[p][1], 0);
      return std::make_pair(std::min(f, g), std::max(f, g));
    };
    std::iota(this->Order.begin(), this->Order.end(), Index(0));
    std::sort(this->Order.begin(), this->Order.end(),
      [&key](Index p, Index q) { return std::make_pair(key(p), p) < std::make_pair(key(q), q); });
    for (Index at = 0; at < static_cast<Index>(pairs.size()); ++at)
    {
      if (at == 0 || key(this->Order[at - 1]) != key(this->Order[at]))
      {
        this->Begin.push_back(at);
      }
    }
    this->Begin.push_back(static_cast<Index>(pairs.size()));
  }
};
}

//------------------------------------------------------------------------------
void VoxelMask::Prepare(const Execution& execution)
{
  if (!this->Values)
  {
    return;
  }
  const Index nx = this->Size[0] + 1, ny = this->Size[1] + 1, nz = this->Size[2] + 1;
  this->Counts.assign(nx * ny * nz, 0);
  execution.ParallelFor(this->Size[2],
    [this, nx, ny](Index begin, Index end)
    {
      for (Index z = begin; z < end; ++z)
      {
        for (Index y = 0; y < this->Size[1]; ++y)
        {
          std::int32_t line = 0;
          for (Index x = 0; x < this->Size[0]; ++x)
          {
            line += this->Values[(z * this->Size[1] + y) * this->Size[0] + x] != 0;
            const Index at = ((z + 1) * ny + y + 1) * nx + x + 1;
            this->Counts[at] = this->Counts[at - nx] + line;
          }
        }
      }
    });
  for (Index z = 1; z < nz; ++z)
  {
    for (Index at = z * ny * nx; at < (z + 1) * ny * nx; ++at)
    {
      this->Counts[at] += this->Counts[at - ny * nx];
    }
  }
  this->RowBegin.assign(1, 0);
  for (Index row = 0; row < this->Size[1] * this->Size[2]; ++row)
  {
    const std::uint8_t* const begin = this->Values + row * this->Size[0];
    const std::uint8_t* const end = begin + this->Size[0];
    const auto counts = [](std::uint8_t value) { return value != 0; };
    for (const std::uint8_t* at = std::find_if(begin, end, counts); at != end;
         at = std::find_if(at, end, counts))
    {
      const std::uint8_t* const last = std::find(at, end, 0);
      this->Runs.push_back(
        { static_cast<std::int32_t>(at - begin), static_cast<std::int32_t>(last - begin) });
      at = last;
    }
    this->RowBegin.push_back(static_cast<Index>(this->Runs.size()));
  }
}

//------------------------------------------------------------------------------
Index VoxelMask::CountIn(const std::array<Index, 3>& begin, const std::array<Index, 3>& end) const
{
  const Index nx = this->Size[0] + 1, ny = this->Size[1] + 1;
  Index sum = 0;
  for (int corner = 0; corner < 8; ++corner)
  {
    const Index x = corner & 1 ? end[0] : begin[0];
    const Index y = corner & 2 ? end[1] : begin[1];
    const Index z = corner & 4 ? end[2] : begin[2];
    const int low = !(corner & 1) + !(corner & 2) + !(corner & 4);
    sum += (low & 1 ? -1 : 1) * Index(this->Counts[(z * ny + y) * nx + x]);
  }
  return sum;
}

//------------------------------------------------------------------------------
Part PartThatCounts(const VoxelMask& mask, const FunctionTable& table, Index i, Index j)
{
  const VoxelBox box(table, i, j);
  const Index all = box.Count();
  const Index counted = all > 0 ? mask.CountIn(box.Begin, box.End) : 0;
  return counted == 0 ? Part::None : counted == all ? Part::All : Part::Some;
}

//------------------------------------------------------------------------------
std::vector<double> MaskedProducts(const VoxelMask& mask, const FunctionTable& table,
  const std::vector<FunctionPair>& pairs, const Execution& execution)
{
  const PairGroups groups(table, pairs);
  std::vector<double> sums(pairs.size());
  execution.ParallelFor(static_cast<Index>(groups.Begin.size()) - 1,
    [&](Index firstGroup, Index endGroup)
    {
      RowSums rowSums(mask);
      for (Index group = firstGroup; group < endGroup; ++group)
      {
        const auto box = [&](Index at)
        {
          const FunctionPair& pair = pairs[groups.Order[at]];
          return VoxelBox(table, pair[0], pair[1]);
        };
        const Index begin = groups.Begin[group], end = groups.Begin[group + 1];
        VoxelBox all = box(begin);
        for (Index at = begin + 1; at < end; ++at)
        {
          const VoxelBox one = box(at);
          for (int a = 1; a < 3; ++a)
          {
            all.Begin[a] = std::min(all.Begin[a], one.Begin[a]);
            all.End[a] = std::max(all.End[a], one.End[a]);
          }
        }
        rowSums.Take(table, pairs[groups.Order[begin]], all);
        for (Index at = begin; at < end; ++at)
        {
          const Index p = groups.Order[at];
          sums[p] = rowSums.Product(table, pairs[p], box(at));
        }
      }
    });
  return sums;
}
}
