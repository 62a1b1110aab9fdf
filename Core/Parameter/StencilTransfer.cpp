// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "StencilTransfer.h"

#include <algorithm>
#include <cstdlib>

namespace trivariate
{
namespace
{
constexpr Index NodesAtOnce = 1 << 15; // each may take ten microseconds

// The weight of a coarse node for the fine node `offset` away from it.
double WeightAt(Index offset)
{
  return offset == 0 ? 1.0 : std::abs(offset) == 1 ? 0.5 : 0.0;
}

// The fine node on a coarse one, along one axis.
Index FineOf(Index coarse)
{
  return 2 * (coarse - 1);
}

// What a row of the coarse matrix is summed up in: by distance from the coarse node on the fine
// grid, -2 to 2 along each axis.
struct WideRow
{
  std::array<double, 125> Values{};

  void Add(int dx, int dy, int dz, double weight, const StencilRow& row)
  {
    double* begin = &this->Values[dx + 1 + 5 * (dy + 1) + 25 * (dz + 1)];
    for (int d = 0; d < 27; ++d)
    {
      begin[d % 3 + 5 * (d / 3 % 3) + 25 * (d / 9)] += weight * row[d];
    }
  }

  // Fine nodes shared out to the coarse nodes around them.
  StencilRow Gathered() const
  {
    StencilRow row{};
    for (int e = 0; e < 125; ++e)
    {
      const int p[3] = { e % 5 - 2, e / 5 % 5 - 2, e / 25 - 2 };
      for (int d = 0; d < 27 && this->Values[e] != 0.0; ++d)
      {
        row[d] += WeightAt(p[0] - 2 * (d % 3 - 1)) * WeightAt(p[1] - 2 * (d / 3 % 3 - 1)) *
                  WeightAt(p[2] - 2 * (d / 9 - 1)) * this->Values[e];
      }
    }
    return row;
  }
};

// Visits the fine nodes in the grid around a coarse one: visit(dx, dy, dz, node).
template <typename Visit>
void ForEachFine(
  const StencilMatrix& fine, Index i, Index j, Index k, int reach, const Visit& visit)
{
  const Index at[3] = { FineOf(i), FineOf(j), FineOf(k) };
  Index low[3], high[3];
  for (int a = 0; a < 3; ++a)
  {
    low[a] = std::max<Index>(-reach, -at[a]);
    high[a] = std::min<Index>(reach, fine.Size[a] - 1 - at[a]);
  }
  for (Index dz = low[2]; dz <= high[2]; ++dz)
  {
    for (Index dy = low[1]; dy <= high[1]; ++dy)
    {
      for (Index dx = low[0]; dx <= high[0]; ++dx)
      {
        visit(static_cast<int>(dx), static_cast<int>(dy), static_cast<int>(dz),
          at[0] + dx + fine.Size[0] * (at[1] + dy + fine.Size[1] * (at[2] + dz)));
      }
    }
  }
}

template <typename Visit>
void ForEachNode(const std::array<Index, 3>& size, const Execution& execution, const Visit& visit)
{
  ForEachSlab(
    size, size[2], execution,
    [&](Index k)
    {
      for (Index j = 0; j < size[1]; ++j)
      {
        for (Index i = 0; i < size[0]; ++i)
        {
          visit(i, j, k, i + size[0] * (j + size[1] * k));
        }
      }
    },
    NodesAtOnce);
}

std::vector<std::int32_t> CoarseRows(const StencilMatrix& fine, const StencilMatrix& coarse,
  const std::vector<std::int32_t>& rowOf, const Execution& execution)
{
  std::vector<std::int32_t> rows(coarse.Nodes(), NoUnknown);
  ForEachNode(coarse.Size, execution,
    [&](Index i, Index j, Index k, Index node)
    {
      int common = 0, others = 0;
      ForEachFine(fine, i, j, k, 1,
        [&](int, int, int, Index near)
        {
          common += rowOf[near] == CommonRow;
          others += rowOf[near] >= 0;
        });
      rows[node] = common == 27 ? CommonRow : common + others > 0 ? 0 : NoUnknown;
    });
  std::int32_t own = 0;
  for (std::int32_t& row : rows)
  {
    if (row == 0)
    {
      row = own++;
    }
  }
  return rows;
}

// The links of coarse nodes: those of the fine ones, shared out to the coarse nodes around them.
std::vector<StencilMatrix::Link> CoarseLinks(const StencilMatrix& fine, const StencilMatrix& coarse)
{
  std::vector<StencilMatrix::Link> links;
  for (const StencilMatrix::Link& link : fine.Links)
  {
    const Index at[3] = { link.Node % fine.Size[0], link.Node / fine.Size[0] % fine.Size[1],
      link.Node / (fine.Size[0] * fine.Size[1]) };
    for (int corner = 0; corner < 8; ++corner)
    {
      double weight = 1.0;
      Index parent[3];
      for (int a = 0; a < 3; ++a)
      {
        parent[a] = at[a] / 2 + 1 + (corner >> a & 1);
        weight *= WeightAt(at[a] - FineOf(parent[a]));
      }
      if (weight > 0.0)
      {
        links.push_back({ parent[0] + coarse.Size[0] * (parent[1] + coarse.Size[1] * parent[2]),
          link.Plane, weight * link.Value });
      }
    }
  }
  return links;
}
}

//------------------------------------------------------------------------------
StencilMatrix Coarsen(const StencilMatrix& fine, const Execution& execution)
{
  StencilMatrix coarse;
  for (int a = 0; a < 3; ++a)
  {
    coarse.Size[a] = (fine.Size[a] - 1) / 2 + 3;
  }
  const std::vector<std::int32_t> rowOf = fine.RowOfNodes();
  const StencilRow common = fine.CommonStencil();
  WideRow wide;
  for (int o = 0; o < 27; ++o)
  {
    const int d[3] = { o % 3 - 1, o / 3 % 3 - 1, o / 9 - 1 };
    wide.Add(d[0], d[1], d[2], WeightAt(d[0]) * WeightAt(d[1]) * WeightAt(d[2]), common);
  }
  const StencilRow coarseCommon = wide.Gathered();
  for (int c = 0; c < 8; ++c)
  {
    coarse.Common[c] = coarseCommon[13 + (c & 1) + 3 * (c >> 1 & 1) + 9 * (c >> 2)];
  }

  const std::vector<std::int32_t> rows = CoarseRows(fine, coarse, rowOf, execution.Part(0.0, 0.1));
  coarse.SetRows(rows);
  ForEachNode(coarse.Size, execution.Part(0.1, 1.0),
    [&](Index i, Index j, Index k, Index node)
    {
      if (rows[node] < 0)
      {
        return;
      }
      WideRow sum;
      ForEachFine(fine, i, j, k, 1,
        [&](int dx, int dy, int dz, Index near)
        {
          if (rowOf[near] != NoUnknown)
          {
            sum.Add(dx, dy, dz, WeightAt(dx) * WeightAt(dy) * WeightAt(dz),
              rowOf[near] == CommonRow ? common : fine.Rows[rowOf[near]]);
          }
        });
      coarse.Rows[rows[node]] = sum.Gathered();
    });
  coarse.SetLinks(CoarseLinks(fine, coarse));
  coarse.PlaneDiagonal = fine.PlaneDiagonal;
  return coarse;
}

//------------------------------------------------------------------------------
void Restrict(const StencilMatrix& fine, const StencilMatrix& coarse, const float* r, float* b,
  const Execution& execution)
{
  ForEachSlab(
    coarse.Size, coarse.Size[2], execution,
    [&](Index k)
    {
      // The fine lines around a coarse one, summed up; with room for a node before and after.
      std::vector<float> sum(2 * coarse.Size[0] + 2);
      for (Index j = 0; j < coarse.Size[1]; ++j)
      {
        const Index line = j + coarse.Size[1] * k;
        if (coarse.LineBegin[line] == coarse.LineBegin[line + 1])
        {
          continue;
        }
        std::fill(sum.begin(), sum.end(), 0.0F);
        for (int d = 0; d < 9; ++d)
        {
          const Index dy = d % 3 - 1, dz = d / 3 - 1, y = FineOf(j) + dy, z = FineOf(k) + dz;
          if (y < 0 || y >= fine.Size[1] || z < 0 || z >= fine.Size[2])
          {
            continue;
          }
          const float weight = static_cast<float>(WeightAt(dy) * WeightAt(dz));
          const float* from = r + fine.Size[0] * (y + fine.Size[1] * z);
          for (Index x = 0; x < fine.Size[0]; ++x)
          {
            sum[x + 1] += weight * from[x];
          }
        }
        for (Index n = coarse.LineBegin[line]; n < coarse.LineBegin[line + 1]; ++n)
        {
          for (Index i = coarse.Runs[n].Begin; i < coarse.Runs[n].End; ++i)
          {
            const float* at = sum.data() + FineOf(i) + 1;
            b[i + coarse.Size[0] * line] = at[0] + 0.5F * (at[-1] + at[1]);
          }
        }
      }
    },
    QuickNodes);
  std::copy(r + fine.Nodes(), r + fine.Length(), b + coarse.Nodes());
}

//------------------------------------------------------------------------------
void ProlongAdd(const StencilMatrix& fine, const StencilMatrix& coarse, const float* y, float* x,
  const Execution& execution)
{
  ForEachSlab(
    fine.Size, fine.Size[2], execution,
    [&](Index k)
    {
      std::vector<float> mean(coarse.Size[0]);
      for (Index j = 0; j < fine.Size[1]; ++j)
      {
        const Index line = j + fine.Size[1] * k;
        if (fine.LineBegin[line] == fine.LineBegin[line + 1])
        {
          continue;
        }
        // The coarse lines on both sides, which are the same one where the fine line lies on it.
        const Index j0 = j / 2 + 1, j1 = (j + 1) / 2 + 1, k0 = k / 2 + 1, k1 = (k + 1) / 2 + 1;
        const float* corners[4] = { y + coarse.Size[0] * (j0 + coarse.Size[1] * k0),
          y + coarse.Size[0] * (j1 + coarse.Size[1] * k0),
          y + coarse.Size[0] * (j0 + coarse.Size[1] * k1),
          y + coarse.Size[0] * (j1 + coarse.Size[1] * k1) };
        for (Index i = 0; i < coarse.Size[0]; ++i)
        {
          mean[i] = 0.25F * (corners[0][i] + corners[1][i] + corners[2][i] + corners[3][i]);
        }
        float* to = x + fine.Size[0] * line;
        for (Index n = fine.LineBegin[line]; n < fine.LineBegin[line + 1]; ++n)
        {
          for (Index i = fine.Runs[n].Begin; i < fine.Runs[n].End; ++i)
          {
            to[i] += 0.5F * (mean[i / 2 + 1] + mean[(i + 1) / 2 + 1]);
          }
        }
      }
    },
    QuickNodes);
  for (Index p = 0; p < fine.Planes(); ++p)
  {
    x[fine.Nodes() + p] += y[coarse.Nodes() + p];
  }
}
}
