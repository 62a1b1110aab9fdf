// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "MomentPyramid.h"

#include <algorithm>
#include <map>

namespace trivariate
{
namespace
{
std::array<Index, 3> SizeOf(const Axes& axes, const Levels& level)
{
  return { axes[0].Functions(level[0]), axes[1].Functions(level[1]), axes[2].Functions(level[2]) };
}

void Add(Array3& sum, Array3&& term, const Execution& execution)
{
  if (sum.Empty())
  {
    sum = std::move(term);
    return;
  }
  execution.ParallelFor(static_cast<Index>(sum.Values.size()),
    [&sum, &term](Index begin, Index end)
    {
      for (Index i = begin; i < end; ++i)
      {
        sum.Values[i] += term.Values[i];
      }
    });
}

// Adds the functions of one group to `target`. Each thread owns some layers, so that every number
// is summed in the order of the functions.
void Scatter(const std::vector<LevelFunction>& functions, const LevelGroup& group,
  const std::vector<double>& coefficients, Array3& target, const Execution& execution)
{
  execution.ParallelFor(target.Size[2],
    [&](Index begin, Index end)
    {
      for (const Index id : group.Functions)
      {
        const auto& [fx, fy, fz] = functions[id].Factors;
        const Index zBegin = std::max<Index>(begin, fz->First);
        const Index zEnd = std::min<Index>(end, fz->First + Index(fz->Coefficients.size()));
        for (Index z = zBegin; z < zEnd; ++z)
        {
          const double cz = coefficients[id] * fz->Coefficients[z - fz->First];
          for (std::size_t y = 0; y < fy->Coefficients.size(); ++y)
          {
            const double cyz = cz * fy->Coefficients[y];
            double* row =
              &target.Values[(z * target.Size[1] + fy->First + y) * target.Size[0] + fx->First];
            for (std::size_t x = 0; x < fx->Coefficients.size(); ++x)
            {
              row[x] += cyz * fx->Coefficients[x];
            }
          }
        }
      }
    });
}

// The groups as a tree: level in w, then in v, then in u.
using LevelTree = std::map<int, std::map<int, std::map<int, const LevelGroup*>>>;

LevelTree MakeTree(const std::vector<LevelGroup>& groups)
{
  LevelTree tree;
  for (const LevelGroup& group : groups)
  {
    tree[group.Level[2]][group.Level[1]][group.Level[0]] = &group;
  }
  return tree;
}

// Walks from the finest wanted level of one direction to the coarsest, restricting as it goes.
template <typename Node, typename Visit>
void Descend(const Axes& axes, int a, const Array3& moments, int level,
  const std::map<int, Node>& wanted, const Visit& visit, const Execution& execution)
{
  Array3 restricted;
  const Array3* current = &moments;
  for (auto node = wanted.rbegin(); node != wanted.rend(); ++node)
  {
    for (; level > node->first; --level)
    {
      restricted = Apply(axes[a].Restrict[level - 1], a, *current, execution);
      current = &restricted;
    }
    visit(node->second, *current);
  }
}

// The adjoint of Descend: from the coarsest level up to `level`, adding what belongs to each.
template <typename Node, typename Make>
Array3 Ascend(const Axes& axes, int a, int level, const std::map<int, Node>& wanted,
  const Make& make, const Execution& execution)
{
  Array3 sum;
  int at = wanted.begin()->first;
  for (const auto& [nodeLevel, node] : wanted)
  {
    for (; at < nodeLevel; ++at)
    {
      sum = Apply(axes[a].Prolong[at], a, sum, execution);
    }
    Add(sum, make(nodeLevel, node), execution);
  }
  for (; at < level; ++at)
  {
    sum = Apply(axes[a].Prolong[at], a, sum, execution);
  }
  return sum;
}
}

//------------------------------------------------------------------------------
std::vector<LevelGroup> GroupByLevel(const std::vector<LevelFunction>& functions)
{
  std::map<Levels, std::vector<Index>> byLevel;
  for (std::size_t i = 0; i < functions.size(); ++i)
  {
    byLevel[functions[i].Level()].push_back(static_cast<Index>(i));
  }
  std::vector<LevelGroup> groups;
  for (auto& [level, members] : byLevel)
  {
    groups.push_back({ level, std::move(members) });
  }
  return groups;
}

//------------------------------------------------------------------------------
void VisitMoments(const Axes& axes, const Array3& moments, const Levels& level,
  const std::vector<LevelGroup>& groups,
  const std::function<void(const LevelGroup&, const Array3&)>& visit, const Execution& execution)
{
  const LevelTree tree = MakeTree(groups);
  Descend(
    axes, 2, moments, level[2], tree,
    [&](const auto& inV, const Array3& z)
    {
      Descend(
        axes, 1, z, level[1], inV,
        [&](const auto& inU, const Array3& y)
        {
          Descend(
            axes, 0, y, level[0], inU,
            [&](const LevelGroup* group, const Array3& x) { visit(*group, x); }, execution);
        },
        execution);
    },
    execution);
}

//------------------------------------------------------------------------------
Array3 Synthesize(const Axes& axes, const std::vector<LevelFunction>& functions,
  const std::vector<LevelGroup>& groups, const std::vector<double>& coefficients,
  const Levels& level, const std::shared_ptr<ArrayPool>& pool, const Execution& execution)
{
  return Ascend(
    axes, 2, level[2], MakeTree(groups),
    [&](int, const auto& inV)
    {
      return Ascend(
        axes, 1, level[1], inV,
        [&](int, const auto& inU)
        {
          return Ascend(
            axes, 0, level[0], inU,
            [&](int, const LevelGroup* group)
            {
              Array3 target(SizeOf(axes, group->Level), pool);
              std::fill(target.Values.begin(), target.Values.end(), 0.0);
              Scatter(functions, *group, coefficients, target, execution);
              return target;
            },
            execution);
        },
        execution);
    },
    execution);
}

//------------------------------------------------------------------------------
void ContractLine(
  const Array3& moments, const LevelFunction& function, int a, std::vector<double>& line)
{
  const auto& [fx, fy, fz] = function.Factors;
  line.assign(function.Factors[a]->Coefficients.size(), 0.0);
  for (std::size_t z = 0; z < fz->Coefficients.size(); ++z)
  {
    for (std::size_t y = 0; y < fy->Coefficients.size(); ++y)
    {
      const double* row =
        &moments.Values[((fz->First + z) * moments.Size[1] + fy->First + y) * moments.Size[0] +
                        fx->First];
      if (a == 0)
      {
        const double c = fz->Coefficients[z] * fy->Coefficients[y];
        for (std::size_t x = 0; x < line.size(); ++x)
        {
          line[x] += c * row[x];
        }
        continue;
      }
      double sum = 0.0;
      for (std::size_t x = 0; x < fx->Coefficients.size(); ++x)
      {
        sum += fx->Coefficients[x] * row[x];
      }
      line[a == 1 ? y : z] += sum * (a == 1 ? fz->Coefficients[z] : fy->Coefficients[y]);
    }
  }
}

//------------------------------------------------------------------------------
Array3 Restrict(const Axes& axes, const Array3& moments, Levels from, const Levels& to,
  const Execution& execution)
{
  Array3 restricted;
  const Array3* current = &moments;
  for (int a = 2; a >= 0; --a)
  {
    for (; from[a] > to[a]; --from[a])
    {
      restricted = Apply(axes[a].Restrict[from[a] - 1], a, *current, execution);
      current = &restricted;
    }
  }
  return current == &moments ? moments.Clone() : std::move(restricted);
}
}
